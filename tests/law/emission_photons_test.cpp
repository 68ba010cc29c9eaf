// SPDX-License-Identifier: Apache-2.0
// Media that shine by themselves, by photons: where these begin, and what is scattered of them.
// in: small densities; boxes with emission -> out: counts against integrals; radiance deep inside
// in closed form, and against paths.
// docs/methods.md 3, "Shoot"
#include "kernels_cpu/photons/trace_start.h"
#include "src/world/medium/emitters.h"
#include "src/world/medium/medium.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using render_test::render_one;
using render_test::scene_from;

namespace {

Medium shining(const std::array<int, 3>& size, const std::vector<float>& densities) {
    Medium m;
    m.volume.size = size;
    m.sigma = 0.5f;
    m.density_max = 1;
    m.optics[0].emission[1] = 2;
    for (std::size_t a = 0; a < 3; ++a) {
        m.extent_m[a] = 4.0 * size[a];
        m.grid.size[a] = size[a];
        m.grid.cell_m[a] = 4;
    }
    REQUIRE(m.volume.density.resize(densities.size(), "test"));
    std::copy(densities.begin(), densities.end(), m.volume.density.data());
    return m;
}

/// Of photons that begin in the medium, how many in each of `parts` equal parts along x.
std::vector<int> begin_along_x(const Medium& m, int photons, int parts) {
    TraceParams k{};
    k.light = kLightMedia;
    for (int a = 0; a < 3; ++a) k.grid.size[a] = m.grid.size[a], k.grid.cell[a] = m.grid.cell_m[a];
    k.grid.periodic = m.grid.periodic ? 1 : 0;
    k.grid.constant = m.grid.constant ? 1 : 0;
    k.emitted_below = m.emitters[0].below.data();
    k.key = make_key(5, 64, 0);
    k.shift[0] = 123456789u, k.shift[1] = 987654321u;
    std::vector<int> counts(std::size_t(parts), 0);
    Vec<double> way{};
    for (int i = 0; i < photons; ++i) {
        const Start<float> start = start_in_medium<1>(k, std::uint32_t(i), true);
        const int part = int(start.p.x / float(m.grid.size[0]) * float(parts));
        ++counts[std::size_t(part < parts ? part : parts - 1)];
        way = {way.x + double(start.d.x), way.y + double(start.d.y), way.z + double(start.d.z)};
    }
    // As many ways as back: the mean of n unit vectors is 0 within 5 / sqrt(3 n).
    const double most = 5 / std::sqrt(3.0 * photons);
    CHECK(std::fabs(way.x / photons) < most);
    CHECK(std::fabs(way.y / photons) < most);
    CHECK(std::fabs(way.z / photons) < most);
    return counts;
}

/// The scene looks along +x from the middle of a box of optical depth 30.
std::string deep_inside(const char* method, const char* albedo) {
    return std::string(R"(
seed = 9
[method]
name = ")") +
           method +
           R"("
[camera]
position_m = [0, 0, 0]
target_m = [100, 0, 0]
fov_deg = 30
resolution = [6, 4]
[sun]
irradiance = [0.0, 0.0, 0.0]
[sky]
radiance = [0.0, 0.0, 0.0]
[[medium]]
density = "uniform:box"
bounds_m = [[-150, -150, -150], [150, 150, 150]]
extinction_per_m = 0.1
resolution = [30, 30, 30]
albedo = )" +
           albedo + R"(
emission = [0.1, 0.05, 0.2]
phase = { type = "henyey-greenstein", g = 0.5 }
[photon_grid]
photons = 1_500_000
generations = 4
cells = [6, 6, 6]
[collectors]
photons = 1_500_000
generations = 4
samples = 2_000
)";
}

}  // namespace

TEST_CASE("emission by photons: they begin as the density is, up to the faces") {
    const std::vector<float> densities{1.0f, 0.0f, 0.5f, 0.25f};
    for (const bool periodic : {false, true})
        for (const bool constant : {false, true}) {
            CAPTURE(periodic);
            CAPTURE(constant);
            Medium m = shining({4, 1, 1}, densities);
            m.grid.periodic = periodic;
            m.grid.constant = constant;
            REQUIRE(make_emitters(m));
            REQUIRE(m.emitters.size() == 1);
            CHECK(m.emitters[0].mass_m3 == doctest::Approx(1.75 * 64));
            constexpr int kPhotons = 100'000, kParts = 16, kSteps = 200;
            const std::vector<int> counts = begin_along_x(m, kPhotons, kParts);
            for (int part = 0; part < kParts; ++part) {
                double share = 0;
                for (int s = 0; s < kSteps; ++s) {
                    const float at[3] = {4 * (float(part) + (float(s) + 0.5f) / kSteps) / kParts,
                                         0.5f, 0.5f};
                    share += double(density_at(m.volume.density.span(), m.grid, at)) / kSteps;
                }
                const double expected = kPhotons * share / (1.75 * kParts / 4);
                // Five deviations of a count; points are spread evenly, so that less is to be seen.
                CHECK(std::fabs(counts[std::size_t(part)] - expected) <=
                      5 * std::sqrt(expected) + 1);
            }
        }
}

TEST_CASE("emission by photons: media that shine are found, and no others") {
    Medium m = shining({2, 1, 1}, {0.0f, 0.0f});
    REQUIRE(make_emitters(m));
    CHECK(m.emitters.empty());
    m = shining({2, 1, 1}, {1.0f, 0.5f});
    m.optics[0].emission[1] = 0;
    REQUIRE(make_emitters(m));
    CHECK(m.emitters.empty());
    m.count = 2;
    m.optics[1].emission[0] = 3;
    REQUIRE(m.parts.resize(2, "test"));
    m.parts[0] = 0, m.parts[1] = 0.25f;
    REQUIRE(make_emitters(m));
    REQUIRE(m.emitters.size() == 1);
    CHECK(m.emitters[0].medium == 1);
    CHECK(m.emitters[0].mass_m3 == doctest::Approx(16));
    CHECK(m.emitters[0].below[1] == 0);
}

TEST_CASE("emission by photons: deep inside radiance is emission over absorption") {
    // S = E + albedo J and J = S: E / (1 - albedo), E emission over extinction. The box's faces are
    // 15 optical depths away, where they take e^-13 of the light. Within 4 %: a leaf's 900 deposits
    // have noise of 3 %, and all pixels see few leaves.
    for (const char* method : {"photon-grid", "collectors", "path"}) {
        CAPTURE(method);
        const render_test::Picture grey = render_one(scene_from(deep_inside(method, "0.6")));
        double mean[3] = {};
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 6; ++x) {
                mean[0] += double(grey.at("R", x, y)) / 24;
                mean[1] += double(grey.at("G", x, y)) / 24;
                mean[2] += double(grey.at("B", x, y)) / 24;
            }
        CHECK(mean[0] == doctest::Approx(1.0 / 0.4).epsilon(0.04));
        CHECK(mean[1] == doctest::Approx(0.5 / 0.4).epsilon(0.04));
        CHECK(mean[2] == doctest::Approx(2.0 / 0.4).epsilon(0.04));
    }
}
