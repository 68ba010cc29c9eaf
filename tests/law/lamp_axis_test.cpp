// SPDX-License-Identifier: Apache-2.0
// Lamps are lights like the sun: degrees about their own axes, and their beams.
// in: lamps made by hand, small scenes -> out: sums by the addition theorem, a second sun, a point
// far away, paths. docs/methods.md 3, repairs 5 and 6; docs/lights.md, "By photons".
#include <cmath>

#include "kernels_cpu/core/sh.h"
#include "tests/support/long_tests.h"
#include "tests/support/render_harness.h"
#include "tests/support/trace_harness.h"

namespace {

using namespace pileus;

constexpr double kFourPi = 12.566370614359172954;

LampEmission lamp_at(const Double3& at, bool parallel, std::int32_t own_axis) {
    LampEmission e{};
    for (int a = 0; a < 3; ++a) e.lamp.at[a] = float(at[a]), e.lamp.light[a] = 1;
    e.lamp.parallel = parallel ? 1 : 0;
    e.lamp.axis[2] = -1;
    e.lamp.edge = -3;
    e.lamp.slope = e.lamp.strength = 1;
    e.lamp.least_square = 1e-6f;
    e.axis[2] = 1;
    e.span = 2;
    e.own_axis = own_axis;
    for (float& share : e.face_cdf) share = 0;
    // Parallel ones come in by the upper face alone.
    e.face_cdf[5] = 1;
    return e;
}

/// Sums of one collector, a box of density 1 that scatters by HG(0.85), lit by `lamps`.
std::vector<std::int64_t> sums_of(const std::vector<LampEmission>& lamps, int bands, int degrees,
                                  int axes, const char* isa = nullptr) {
    using namespace trace_test;
    Rig rig = make_rig({4, 4, 4}, {4, 4, 4}, 2);
    rig.kernels = kernel_table(isa);
    rig.medium.optics[0] = {{1, 1, 1}, 1, {kPhaseHg, 0.85f, 0, 1}};
    rig.lighting.lamp_emission = lamps;
    for (const LampEmission& e : lamps) rig.lighting.lamps.push_back(e.lamp);
    Light light;
    light.lamps = true;
    light.face_cdf.fill(1.0f);
    light.power_m2 = 1;
    light.photons = 20'000;
    add_light(rig, light);
    rig.collectors = 1;
    REQUIRE(rig.collector_of_voxel.resize(64, "voxels"));
    rig.deposit.bands = bands;
    rig.deposit.axis_degrees = degrees;
    rig.deposit.axes = axes;
    rig.deposit.coefficients = bands * bands + degrees * axes;
    const TraceInput in = input_of(rig, 9);
    TraceScratch scratch;
    PhotonSlot slot;
    REQUIRE(prepare_trace(in, scratch));
    REQUIRE(slot.sums.resize(slot_stride(in), "sums"));
    std::vector<TraceTally> tallies(1);
    REQUIRE(trace_generation(in, 0, scratch, slot, tallies));
    return {slot.sums.data(), slot.sums.data() + rig.deposit.coefficients};
}

TEST_CASE("lamp axes: degrees about a parallel lamp are its bands by the addition theorem") {
    // sum P_l(d . w) = 4 pi / (2l+1) sum_m y_lm(w) sum y_lm(d), of the same photons.
    const std::vector<LampEmission> lamps = {lamp_at({-0.48, -0.6, 0.64}, true, 0)};
    const auto wide = sums_of(lamps, 8, 0, 1), narrow = sums_of(lamps, 4, 4, 1);
    for (std::size_t i = 0; i < 16; ++i) CHECK(narrow[i] == wide[i]);
    float y[64];
    sh_values(8, Vec<float>{0.48f, 0.6f, -0.64f}, y);
    for (int l = 4; l < 8; ++l) {
        double sum = 0;
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            sum += double(wide[std::size_t(i)]) * double(y[i]);
        const double exact = sum * kFourPi / (2 * l + 1);
        CHECK(exact > 0.02 * double(wide[0]));
        // 20 000 photons, each of a dozen deposits rounded to a half quantum of 2^-16.
        CHECK(std::fabs(double(narrow[std::size_t(12 + l)]) / exact - 1) < 1e-4);
    }
}

TEST_CASE("lamp axes: each lamp has its own, a point's is radial, and one without has none") {
    const LampEmission even = lamp_at({-0.48, -0.6, 0.64}, true, 0);
    const auto one = sums_of({even}, 4, 8, 1);
    LampEmission second = even;
    second.own_axis = 1;
    second.below = 0.5f;
    const LampEmission first = lamp_at({0, 0, 1}, true, 0);
    const auto both = sums_of({first, second}, 4, 8, 2);
    // A lamp along z: its degrees are about z, whoever else shines.
    LampEmission none = second;
    none.own_axis = -1;
    const auto without = sums_of({first, none}, 4, 8, 2);
    for (std::size_t i = 0; i < 24; ++i) CHECK(both[i] == without[i]);
    for (std::size_t i = 24; i < 32; ++i) CHECK(without[i] == 0);
    // Half of the photons each: the second block holds half of what that lamp alone brings.
    for (std::size_t d = 0; d < 4; ++d)
        CHECK(double(both[24 + d]) / (0.5 * double(one[16 + d])) ==
              doctest::Approx(1).epsilon(0.05));
    // A point in the middle: its light runs away from it, in no direction of the whole box.
    const std::vector<LampEmission> middle = {lamp_at({2, 2, 2}, false, 0)};
    const auto point = sums_of(middle, 4, 8, 1);
    CHECK(double(point[16]) > 0.05 * double(point[0]) * std::sqrt(kFourPi));
    CHECK(std::fabs(double(point[2])) < 0.05 * double(point[0]));
    CHECK(sums_of(middle, 4, 8, 1, "scalar") == point);
}

using namespace render_test;

constexpr const char* kCloud = R"(
seed = 2
[camera]
position_m = [0, -3000, 900]
target_m = [0, 0, 1050]
fov_deg = 36
resolution = [24, 24]
[[medium]]
density = "procedural:cumulus"
bounds_m = [[-800, -800, 600], [800, 800, 1700]]
resolution = [32, 32, 22]
extinction_per_m = 0.02
phase = { type = "henyey-greenstein", g = 0.85 }
[path]
samples_per_pixel = 600
[collectors]
photons = 400_000
generations = 8
[photon_grid]
photons = 400_000
[output]
layers = ["cloud", "alpha"]
)";

double light_of(const char* method, const std::string& lights) {
    const Picture p =
        render_one(scene_from(kCloud + lights, {std::string("method.name=") + method}));
    return sum_of(p, "cloud.G").value;
}

TEST_CASE("a parallel light is a second sun by photons, with the camera in its back") {
    const std::string sun = "[sun]\nazimuth_deg = 180\nelevation_deg = 20\n";
    const std::string lamp =
        "[[light]]\ntype = \"directional\"\nazimuth_deg = 180\nelevation_deg = 20\n";
    for (const char* method : {"collectors", "photon-grid"}) {
        const double a = light_of(method, lamp), b = light_of(method, sun);
        MESSAGE(std::string(method) << ": as a light over as the sun " << a / b);
        // Noise of 400 000 photons each; bands alone show half of it.
        CHECK(std::fabs(a / b - 1) < 0.03);
    }
}

TEST_CASE("points before and in a cloud light it as paths do, by photons") {
    for (const char* at : {"[0, -2200, 1100]", "[0, -100, 1000]"}) {
        const std::string lamp =
            std::string("[[light]]\ntype = \"point\"\nintensity = 1e6\nposition_m = ") + at + "\n";
        const double path = light_of("path", lamp);
        for (const char* method : {"collectors", "photon-grid"}) {
            const double v = light_of(method, lamp);
            MESSAGE(std::string(method) << " " << std::string(at) << ": " << v << ", paths " << path
                                        << ", " << v / path - 1);
            // Collectors of 400 000 photons are coarse: 11 %, with a million and finer voxels 4 %.
            // Bands alone showed a fifth.
            CHECK(std::fabs(v / path - 1) < 0.15);
        }
    }
}

}  // namespace
