// SPDX-License-Identifier: Apache-2.0
// A host's matrices: rays, depth buffers, what is refused, and how GLM adds.
// in: matrices as GLM makes them for OpenGL, Vulkan and Direct3D -> out: pass or fail.
// docs/embedding.md, "Cameras"; docs/determinism.md, "How"
#include "src/world/camera/matrices.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <random>
#include <vector>

#include "src/world/camera/view.h"

using namespace pileus;

namespace {

constexpr double kNear = 5, kFar = 40000;
constexpr double kInf = std::numeric_limits<double>::infinity();

struct Projection {
    const char* name;
    glm::dmat4 matrix;
    bool zero_to_one;
    bool reversed = false, infinite = false;
};

/// The y axis of clip space points down.
glm::dmat4 flipped(glm::dmat4 m) {
    for (int c = 0; c < 4; ++c) m[c].y = -m[c].y;
    return m;
}

/// Near is 1, infinity 0.
glm::dmat4 reversed_infinite(double fov, double aspect, double near_m) {
    const double f = 1 / std::tan(fov / 2);
    glm::dmat4 m(0);
    m[0].x = f / aspect, m[1].y = f, m[2].w = -1, m[3].z = near_m;
    return m;
}

std::vector<Projection> projections() {
    const double fov = glm::radians(50.0), aspect = 1.6;
    return {
        {"perspective", glm::perspectiveNO(fov, aspect, kNear, kFar), false},
        {"perspective 0..1", glm::perspectiveZO(fov, aspect, kNear, kFar), true},
        {"reversed", glm::perspectiveZO(fov, aspect, kFar, kNear), true, true},
        {"infinite", glm::infinitePerspective(fov, aspect, kNear), false, false, true},
        {"reversed infinite", reversed_infinite(fov, aspect, kNear), true, true, true},
        {"frustum", glm::frustumNO(-1.0, 4.0, -2.5, 0.5, kNear, kFar), false},
        {"frustum 0..1", glm::frustumZO(0.5, 4.0, 0.25, 2.5, kNear, kFar), true},
        {"frustum, y down", flipped(glm::frustumZO(-1.0, 4.0, -2.5, 0.5, kNear, kFar)), true},
        {"ortho", glm::orthoNO(-300.0, 200.0, -100.0, 250.0, kNear, kFar), false},
        {"ortho 0..1", glm::orthoZO(-300.0, 200.0, -100.0, 250.0, kNear, kFar), true},
        {"ortho reversed", glm::orthoZO(-300.0, 200.0, -100.0, 250.0, kFar, kNear), true, true},
        {"ortho, y down", flipped(glm::orthoZO(10.0, 200.0, -100.0, 250.0, kNear, kFar)), true},
    };
}

glm::dmat4 slanted_view() {
    return glm::lookAt(glm::dvec3(1200, -900, 2500), glm::dvec3(-300, 400, 700),
                       glm::dvec3(0.1, 0.2, 1));
}

glm::dvec3 divided(const glm::dvec4& v) { return glm::dvec3(v) / v.w; }

/// Of a point so many metres in front of the eye, as the graphics card would write it.
double buffer_value(const Projection& p, double metres) {
    const glm::dvec4 clip = p.matrix * glm::dvec4(0, 0, -metres, 1);
    return p.zero_to_one ? clip.z / clip.w : 0.5 + 0.5 * clip.z / clip.w;
}

}  // namespace

TEST_CASE("matrices: a pixel's ray is the one that the matrices unproject") {
    const glm::dmat4 view = slanted_view();
    const Double3 low(-800, -700, 600);
    for (const Projection& p : projections()) {
        INFO(p.name);
        Camera camera;
        camera.resolution = {64, 40};
        DepthScale scale;
        REQUIRE(camera_from_matrices(view, p.matrix, p.zero_to_one, camera, scale));
        CHECK(camera.has_frustum);
        const CameraParams c = make_camera(camera, 0, low);
        const glm::dmat4 back = glm::inverse(p.matrix * view);
        const double down = p.matrix[1].y < 0 ? -1 : 1;
        for (const int x : {0, 17, 63})
            for (const int y : {0, 30, 39}) {
                const double u = (x + 0.5) * 2 / 64 - 1, v = down * (1 - (y + 0.5) * 2 / 40);
                const glm::dvec3 a = divided(back * glm::dvec4(u, v, 0.25, 1)),
                                 b = divided(back * glm::dvec4(u, v, 0.75, 1));
                const glm::dvec3 wanted = glm::normalize(p.reversed ? a - b : b - a);
                const Ray<float> ray = camera_ray<float>(c, float(x), float(y));
                const glm::dvec3 direction(ray.direction.x, ray.direction.y, ray.direction.z);
                const glm::dvec3 origin =
                    low + glm::dvec3(ray.origin.x, ray.origin.y, ray.origin.z);
                CHECK(glm::length(direction - wanted) < 2e-6);
                // It runs through the unprojected point as closely as floats hold places.
                CHECK(glm::length(glm::cross(a - origin, wanted)) < 2e-3);
            }
    }
}

TEST_CASE("matrices: a symmetric projection is the camera of the same angle") {
    Camera by_angle, by_matrix;
    by_angle.position_m = {1200, -900, 2500};
    by_angle.target_m = {-300, 400, 700};
    by_angle.fov_deg = 50;
    by_angle.resolution = by_matrix.resolution = {64, 40};
    const glm::dmat4 view = glm::lookAt(by_angle.position_m, by_angle.target_m, by_angle.up);
    DepthScale scale;
    REQUIRE(camera_from_matrices(view, glm::perspective(glm::radians(50.0), 1.6, kNear, kFar),
                                 false, by_matrix, scale));
    const CameraParams a = make_camera(by_angle, 0, {}), b = make_camera(by_matrix, 0, {});
    for (int i = 0; i < 3; ++i) {
        CHECK(std::fabs(a.origin[i] - b.origin[i]) < 1e-3f);
        CHECK(std::fabs(a.forward[i] - b.forward[i]) < 1e-6f);
        CHECK(std::fabs(a.right[i] - b.right[i]) < 1e-6f);
        CHECK(std::fabs(a.up[i] - b.up[i]) < 1e-6f);
    }
    CHECK(a.half_width == doctest::Approx(double(b.half_width)).epsilon(1e-6));
    CHECK(a.half_height == doctest::Approx(double(b.half_height)).epsilon(1e-6));
    CHECK(b.shift_x == 0);
    CHECK(b.shift_y == 0);
}

TEST_CASE("matrices: depths go into the buffer's values and back") {
    for (const Projection& p : projections()) {
        INFO(p.name);
        Camera camera;
        DepthScale scale;
        REQUIRE(camera_from_matrices(glm::dmat4(1), p.matrix, p.zero_to_one, camera, scale));
        CHECK(scale.known);
        CHECK(scale.far_value == (p.reversed ? 0 : 1));
        for (const double metres : {kNear, 7.5, 100.0, 3000.0, 39000.0}) {
            const double value = scale.value(metres);
            CHECK(std::fabs(value - buffer_value(p, metres)) < 1e-12);
            CHECK(value >= 0);
            CHECK(value <= 1);
            CHECK(scale.metres(value) == doctest::Approx(metres).epsilon(1e-6));
        }
        // The far end is nothing, whatever it is for the projection; NaN is in front of all.
        CHECK(scale.metres(scale.far_value) == kInf);
        CHECK(scale.value(kInf) == scale.far_value);
        CHECK(scale.metres(std::nan("")) == 0);
        // Out of the range the value is that of its end.
        CHECK(scale.value(kNear / 2) == doctest::Approx(1 - scale.far_value));
        if (!p.infinite) CHECK(scale.value(2 * kFar) == scale.far_value);
    }
}

TEST_CASE("matrices: a camera's near and far make the projection's values") {
    struct Row {
        DepthScale scale;
        glm::dmat4 matrix;
    };
    const Row rows[] = {
        {depth_scale(false, kNear, kFar), glm::perspectiveZO(1.0, 1.0, kNear, kFar)},
        {depth_scale(true, kNear, kFar), glm::orthoZO(-1.0, 1.0, -1.0, 1.0, kNear, kFar)},
        {depth_scale(false, kNear, 0), flipped(reversed_infinite(1.0, 1.0, kNear))},
    };
    for (int i = 0; i < 3; ++i) {
        CAPTURE(i);
        const DepthScale& scale = rows[i].scale;
        REQUIRE(scale.known);
        for (const double metres : {6.0, 200.0, 30000.0}) {
            const glm::dvec4 clip = rows[i].matrix * glm::dvec4(0, 0, -metres, 1);
            // Infinite ones count from near to infinity upwards.
            const double wanted = i == 2 ? 1 - clip.z / clip.w : clip.z / clip.w;
            CHECK(std::fabs(scale.value(metres) - wanted) < 1e-12);
            CHECK(scale.metres(wanted) == doctest::Approx(metres).epsilon(1e-6));
        }
    }
    CHECK_FALSE(depth_scale(false, 0, 100).known);
    CHECK_FALSE(depth_scale(true, 5, 0).known);
}

TEST_CASE("matrices: what is no camera is refused with a line, and changes nothing") {
    const glm::dmat4 view = slanted_view();
    const glm::dmat4 projection = glm::perspective(1.0, 1.6, kNear, kFar);
    const auto refuses = [](const glm::dmat4& v, const glm::dmat4& p, const char* where) {
        Camera camera;
        camera.position_m = {1, 2, 3};
        DepthScale scale;
        const Status status = camera_from_matrices(v, p, false, camera, scale);
        CHECK(status.code == Code::kBadInput);
        CHECK(status.message.find(where) == 0);
        CHECK(status.message.find('\n') == std::string::npos);
        CHECK(camera.position_m == Double3(1, 2, 3));
        CHECK_FALSE(camera.has_frustum);
        CHECK_FALSE(scale.known);
    };
    const double nan = std::nan("");
    refuses(glm::scale(view, glm::dvec3(1.01)), projection, "view");
    refuses(glm::scale(view, glm::dvec3(1, 1, -1)), projection, "view");
    refuses(glm::transpose(view), projection, "view");
    refuses(glm::dmat4(0), projection, "view");
    glm::dmat4 bad = view;
    bad[1].x += 0.01;
    refuses(bad, projection, "view");
    bad = view;
    bad[3].y = nan;
    refuses(bad, projection, "view");
    bad[3].y = kInf;
    refuses(bad, projection, "view");
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) {
            bad = projection;
            bad[c][r] = nan;
            refuses(view, bad, "projection");
        }
    bad = projection;
    bad[1].x = 0.01;
    refuses(view, bad, "projection");
    bad = projection;
    bad[0].y = 0.01;
    refuses(view, bad, "projection");
    bad = projection;
    bad[0].x = -bad[0].x;
    refuses(view, bad, "projection");
    bad = projection;
    bad[1].y = 0;
    refuses(view, bad, "projection");
    refuses(view, glm::dmat4(0), "projection");
    refuses(view, glm::perspectiveLH(1.0, 1.6, kNear, kFar), "projection");
    refuses(view, projection * 2.0, "projection");
    refuses(view, projection * view, "projection");
    // Floats of a host are near enough.
    Camera camera;
    DepthScale scale;
    CHECK(camera_from_matrices(glm::dmat4(glm::mat4(view)), glm::dmat4(glm::mat4(projection)),
                               false, camera, scale));
}

TEST_CASE("GLM adds, multiplies and takes roots in the order that pictures go by") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> numbers(-3, 3);
    const auto same = [](double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; };
    for (int turn = 0; turn < 2000; ++turn) {
        glm::dmat4 a, b;
        glm::dmat3 m, n;
        Double3 v, w;
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) a[c][r] = numbers(random), b[c][r] = numbers(random);
        for (int c = 0; c < 3; ++c) {
            v[c] = numbers(random), w[c] = numbers(random);
            for (int r = 0; r < 3; ++r) m[c][r] = a[c][r], n[c][r] = b[c][r];
        }
        const double squares = v.x * v.x + v.y * v.y + v.z * v.z;
        bool equal = same(glm::dot(v, w), v.x * w.x + v.y * w.y + v.z * w.z) &&
                     same(glm::length(v), std::sqrt(squares));
        const Double3 across = glm::cross(v, w), by = m * v, from = v * m;
        const glm::dmat3 mn = m * n, turned = glm::transpose(m);
        const glm::dmat4 ab = a * b;
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            equal = equal && same(across[i], v[j] * w[k] - v[k] * w[j]) &&
                    same(by[i], m[0][i] * v.x + m[1][i] * v.y + m[2][i] * v.z) &&
                    same(from[i], m[i][0] * v.x + m[i][1] * v.y + m[i][2] * v.z);
            for (int r = 0; r < 3; ++r)
                equal = equal && same(turned[i][r], m[r][i]) &&
                        same(mn[i][r], m[0][r] * n[i][0] + m[1][r] * n[i][1] + m[2][r] * n[i][2]);
        }
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r)
                equal = equal && same(ab[c][r], a[0][r] * b[c][0] + a[1][r] * b[c][1] +
                                                    a[2][r] * b[c][2] + a[3][r] * b[c][3]);
        REQUIRE(equal);
    }
}
