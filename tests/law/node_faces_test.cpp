// SPDX-License-Identifier: Apache-2.0
// Sharp faces of media: what nodes hold goes on in a line up to the face of the box.
// in: linear fields on nodes; boxes of few deep cells, lit as they are seen -> out: the line's
// values; sunlight scattered once, in closed form.
// docs/methods.md 4, "Faces"
#include "kernels_cpu/media/medium.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using render_test::render_one;
using render_test::scene_from;

namespace {

/// x + 2 y - 3 z + 5 at the middles of cells of a grid of unit cells.
std::vector<float> linear_field(const std::int32_t (&n)[3]) {
    std::vector<float> out;
    for (int z = 0; z < n[2]; ++z)
        for (int y = 0; y < n[1]; ++y)
            for (int x = 0; x < n[0]; ++x)
                out.push_back((float(x) + 0.5f) + 2 * (float(y) + 0.5f) - 3 * (float(z) + 0.5f) +
                              5);
    return out;
}

float at(const std::vector<float>& field, const std::int32_t (&n)[3], float x, float y, float z,
         bool wraps = false) {
    return interpolate(field.data(), node_corners(Vec<float>{x, y, z}, n, wraps));
}

/// A box of 800 m and of optical depth 20, looked at along y, the sun right behind the camera.
std::string lit_face(const char* method, int cells, double turn_deg) {
    const std::string side = std::to_string(cells);
    return R"(
seed = 3
[method]
name = ")" +
           std::string(method) +
           R"("
[camera]
projection = "orthographic"
height_m = 100.0
position_m = [400, -4000, 400]
target_m = [400, 0, 400]
resolution = [2, 2]
[sun]
azimuth_deg = )" +
           std::to_string(180 + turn_deg) +
           R"(
elevation_deg = 0
irradiance = [1.0, 1.0, 1.0]
[sky]
radiance = [0.0, 0.0, 0.0]
[[medium]]
density = "uniform:box"
bounds_m = [[0, 0, 0], [800, 800, 800]]
extinction_per_m = 0.025
albedo = 0.001
resolution = [)" +
           side + ", " + side + ", " + side + R"(]
phase = { type = "henyey-greenstein", g = 0.0 }
[photon_grid]
photons = 2_000
generations = 1
[collectors]
photons = 2_000
generations = 1
samples = 200
)";
}

}  // namespace

TEST_CASE("node faces: linear fields are read exactly up to every face") {
    const std::int32_t n[3] = {4, 3, 5};
    const std::vector<float> field = linear_field(n);
    for (const float x : {0.0f, 0.25f, 0.5f, 1.9f, 3.5f, 3.75f, 4.0f})
        for (const float y : {0.0f, 0.5f, 1.2f, 3.0f})
            for (const float z : {0.0f, 0.4f, 2.5f, 4.5f, 5.0f})
                // Roundings of numbers up to 20.
                CHECK(at(field, n, x, y, z) ==
                      doctest::Approx(x + 2 * y - 3 * z + 5).epsilon(1e-5));
    // Places beyond a face count as on it; one node has one value.
    CHECK(at(field, n, -9, 1, 1) == at(field, n, 0, 1, 1));
    CHECK(at(field, n, 99, 1, 1) == at(field, n, 4, 1, 1));
    const std::int32_t one[3] = {1, 1, 1};
    CHECK(at({7.0f}, one, 0.9f, 0.0f, 0.5f) == 7.0f);
    // Around the sides of a period the next one goes on, as densities do; top and bottom are faces.
    CHECK(at(field, n, 0.0f, 0.5f, 2.5f, true) ==
          doctest::Approx(0.5 * (0.5 + 3.5) + 2 * 0.5 - 3 * 2.5 + 5).epsilon(1e-5));
    CHECK(at(field, n, 0.5f, 0.5f, 5.0f, true) ==
          doctest::Approx(0.5 + 2 * 0.5 - 3 * 5.0 + 5).epsilon(1e-5));
}

TEST_CASE("node faces: a sharp face sends back what sunlight scattered once does") {
    // albedo E p (1 - e^-(tau (1 + 1/cos))) / (1 + 1/cos), p = 1 / 4 pi; the second scattering adds
    // less than albedo of it. Within 3 %: pieces of a quarter of an optical depth, and at 60
    // degrees half a per cent of light that comes in by the box's side.
    for (const char* method : {"photon-grid", "collectors"})
        for (const int cells : {2, 4, 10, 20})
            for (const double turn : {0.0, 60.0}) {
                CAPTURE(method);
                CAPTURE(cells);
                CAPTURE(turn);
                const double ratio = 1 + 1 / std::cos(turn * 3.14159265358979 / 180);
                const double expected = 0.001 / (4 * 3.14159265358979) / ratio;
                const render_test::Picture p =
                    render_one(scene_from(lit_face(method, cells, turn)));
                CHECK(p.at("R", 0, 0) == doctest::Approx(expected).epsilon(0.03));
            }
}
