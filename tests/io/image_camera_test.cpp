// SPDX-License-Identifier: Apache-2.0
// The camera matrices of pictures: known points of the world fall on known pixels.
// in: cameras of either projection -> out: pass or fail.
// OpenEXR, ImfStandardAttributes.h; docs/formats.md, "OpenEXR, .exr"
#include <doctest/doctest.h>

#include <cmath>

#include "src/world/camera/view.h"

using namespace pileus;

namespace {

using Point = std::array<double, 3>;

/// [p 1] times a matrix, divided by the fourth coordinate.
Point times(const Point& p, const std::array<float, 16>& m) {
    double out[4];
    for (std::size_t c = 0; c < 4; ++c)
        out[c] = p[0] * double(m[c]) + p[1] * double(m[4 + c]) + p[2] * double(m[8 + c]) +
                 double(m[12 + c]);
    return {out[0] / out[3], out[1] / out[3], out[2] / out[3]};
}

double determinant(const std::array<float, 16>& m) {
    double a[4][4], product = 1;
    for (std::size_t i = 0; i < 16; ++i) a[i / 4][i % 4] = double(m[i]);
    for (int k = 0; k < 4; ++k) {
        int pivot = k;
        for (int r = k; r < 4; ++r)
            if (std::fabs(a[r][k]) > std::fabs(a[pivot][k])) pivot = r;
        if (pivot != k) product = -product;
        for (int c = 0; c < 4; ++c) std::swap(a[k][c], a[pivot][c]);
        product *= a[k][k];
        if (!(std::fabs(a[k][k]) > 0)) return 0;
        for (int r = k + 1; r < 4; ++r) {
            const double f = a[r][k] / a[k][k];
            for (int c = k; c < 4; ++c) a[r][c] -= f * a[k][c];
        }
    }
    return product;
}

Image image_of(const Camera& camera) {
    const Double3 low{-800, -700, 600};
    Image image;
    set_image_camera(make_camera(camera, 0, low), low, image);
    return image;
}

// Floats hold places of 3000 m to 2e-4 m, and such a place is seen from 100 m and more.
constexpr double kClose = 1e-5;

void check_near(const Point& a, const Point& b, double within) {
    for (std::size_t i = 0; i < 3; ++i) CHECK(std::fabs(a[i] - b[i]) < within);
}

Camera make(bool orthographic) {
    Camera camera;
    camera.position_m = {0, -3000, 900};
    camera.target_m = {0, 0, 900};
    camera.fov_deg = 90;
    camera.height_m = 2000;
    camera.orthographic = orthographic;
    camera.resolution = {200, 100};
    return camera;
}

}  // namespace

TEST_CASE("image camera: perspective, to the pixel") {
    const Image image = image_of(make(false));
    // To the right is x, up is z, forward is y: a frame of 2000 m by 1000 m, 500 m away.
    check_near(times({30, -2000, 950}, image.world_to_camera), {30, 50, 1000}, 1e-3);
    struct Row {
        Point world;
        double x, y;  ///< 0 to 1 from the upper left corner
    };
    const Row rows[] = {{{0, -2500, 900}, 0.5, 0.5},      {{-1000, -2500, 1400}, 0, 0},
                        {{1000, -2500, 400}, 1, 1},       {{500, -2500, 1150}, 0.75, 0.25},
                        {{1000, -2000, 400}, 0.75, 0.75}, {{-2000, -2000, 1900}, 0, 0}};
    for (const Row& row : rows) {
        const Point at = times(row.world, image.world_to_ndc);
        CHECK(std::fabs(at[0] - row.x) < kClose);
        CHECK(std::fabs(at[1] - row.y) < kClose);
        CHECK(std::fabs(at[2] - (1 - 1 / (row.world[1] + 3000))) < kClose);
    }
    CHECK(image.screen_window_width == doctest::Approx(4).epsilon(1e-6));  // 2 tan 45 * 200/100
    // By hand: (0.5/2) (-0.5/1) times that of the last two rows and columns, 1, and of a rotation
    // that turns a right hand into a left one, -1.
    CHECK(determinant(image.world_to_ndc) == doctest::Approx(0.125).epsilon(1e-3));
}

TEST_CASE("image camera: orthographic, to the pixel") {
    const Image image = image_of(make(true));
    check_near(times({30, -2000, 950}, image.world_to_camera), {30, 50, 1000}, 1e-3);
    check_near(times({0, -2000, 900}, image.world_to_ndc), {0.5, 0.5, 1000}, 1e-3);
    check_near(times({-2000, 0, 1900}, image.world_to_ndc), {0, 0, 3000}, 1e-3);
    check_near(times({1000, 500, 400}, image.world_to_ndc), {0.75, 0.75, 3500}, 1e-3);
    CHECK(image.screen_window_width == 4000);
    CHECK(std::fabs(determinant(image.world_to_ndc)) > 1e-8);
}

TEST_CASE("image camera: the rays of a slanted camera come back to their pixels") {
    for (const bool orthographic : {false, true}) {
        Camera camera = make(orthographic);
        camera.position_m = {1200, -900, 2500};
        camera.target_m = {-300, 400, 700};
        camera.up = {0.1, 0.2, 1};
        camera.fov_deg = 37;
        const Double3 low{-800, -700, 600};
        const CameraParams c = make_camera(camera, 0, low);
        Image image;
        set_image_camera(c, low, image);
        for (const double u : {0.0, 0.31, 1.0})
            for (const double v : {0.0, 0.77, 1.0}) {
                const double a = (2 * u - 1) * double(c.half_width);
                const double b = (1 - 2 * v) * double(c.half_height);
                const double far = 1234;
                Point p;
                for (std::size_t i = 0; i < 3; ++i)
                    p[i] =
                        low[i] + double(c.origin[i]) + far * double(c.forward[i]) +
                        (orthographic ? 1 : far) * (a * double(c.right[i]) + b * double(c.up[i]));
                const Point at = times(p, image.world_to_ndc);
                CHECK(std::fabs(at[0] - u) < kClose);
                CHECK(std::fabs(at[1] - v) < kClose);
            }
    }
}
