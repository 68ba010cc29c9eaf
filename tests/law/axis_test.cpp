// SPDX-License-Identifier: Apache-2.0
// Degrees about the sun's axis: what bands of spherical harmonics cannot hold, and nothing else.
// in: closed forms, light of known shape, small scenes -> out: agreement; bands and ledgers
// untouched. docs/methods.md 3, repair 5.
#include <cmath>

#include "kernels_cpu/photons/deposit.h"
#include "src/methods/collectors/photons/reconstruct.h"
#include "tests/support/render_harness.h"
#include "tests/support/trace_harness.h"

using namespace pileus;

namespace {

constexpr double kFourPi = 12.566370614359172954;

double hg(double g, double cosine) {
    return (1 - g * g) / (kFourPi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

/// Radiance that one collector shows towards an orthographic camera at `angle` from the beam, lit
/// by light spread about the beam as HG(spread), with a medium of HG(g).
double shown(double spread, double g, double angle, int bands, int degrees) {
    Medium medium;
    medium.sigma = 1;
    medium.optics[0] = {{1, 1, 1}, 1, {kPhaseHg, float(g), 0, 1}};
    Lighting lighting;
    Light light;
    light.beam = true;
    light.colour = {1, 1, 1};
    lighting.lights.push_back(light);
    Photons photons;
    photons.slots.resize(1);
    PhotonSlot& slot = photons.slots[0];
    slot.generations = 1;
    slot.flux_per_photon_m2 = {1};
    slot.sun_travel = {0.48f, 0.6f, 0.64f};
    ReconstructInput in;
    in.deposit.bands = bands;
    in.deposit.axis_degrees = degrees;
    in.deposit.coefficients = bands * bands + degrees;
    in.deposit.places = 40;
    REQUIRE(slot.sums.resize(std::uint64_t(in.deposit.coefficients), "sums"));

    // Moments of HG(spread) about the beam are spread^l, in every one of its harmonics.
    const Vec<float> sun{slot.sun_travel[0], slot.sun_travel[1], slot.sun_travel[2]};
    float y[kMaxBands * kMaxBands];
    sh_values(bands, sun, y);
    for (int l = 0, i = 0; l < bands + degrees; ++l) {
        const double moment = std::pow(spread, l) * 0x1p40;
        for (int m = -l; m <= l && l < bands; ++m, ++i)
            slot.sums[std::size_t(i)] = std::llround(moment * double(y[i]));
        if (l >= bands) slot.sums[std::size_t(bands * bands + l - bands)] = std::llround(moment);
    }
    Collector collector{};
    collector.mass = 1;
    in.medium = &medium;
    in.lighting = &lighting;
    in.photons = &photons;
    in.collectors = {&collector, 1};
    in.camera.orthographic = 1;
    const Vec<float> to = turned(sun, float(std::cos(angle)), float(std::sin(angle)), 0.6f, 0.8f);
    in.camera.forward[0] = -to.x, in.camera.forward[1] = -to.y, in.camera.forward[2] = -to.z;
    CollectorColours colours;
    REQUIRE(reconstruct(in, colours));
    return double(colours.colour[0]);
}

}  // namespace

TEST_CASE("axis: Legendre polynomials from any degree on") {
    for (double c = -1; c <= 1; c += 0.0625) {
        const double c2 = c * c;
        const double exact[9] = {1,
                                 c,
                                 (3 * c2 - 1) / 2,
                                 (5 * c2 - 3) * c / 2,
                                 ((35 * c2 - 30) * c2 + 3) / 8,
                                 ((63 * c2 - 70) * c2 + 15) * c / 8,
                                 (((231 * c2 - 315) * c2 + 105) * c2 - 5) / 16,
                                 (((429 * c2 - 693) * c2 + 315) * c2 - 35) * c / 16,
                                 ((((6435 * c2 - 12012) * c2 + 6930) * c2 - 1260) * c2 + 35) / 128};
        for (int first = 0; first < 9; ++first) {
            float p[kMaxAxisDegrees];
            axis_values(first, 9 - first, float(c), p);
            // Nine steps of a recurrence in single precision.
            for (int l = first; l < 9; ++l)
                CHECK(std::fabs(double(p[l - first]) - exact[l]) < 2e-6);
        }
    }
    float ends[kMaxAxisDegrees];
    for (float end : {1.0f, -1.0f}) {
        axis_values(kMaxBands, kMaxAxisDegrees, end, ends);
        for (int j = 0; j < kMaxAxisDegrees; ++j)
            CHECK(std::fabs(ends[j] - (j % 2 == 0 ? 1.0f : end)) < 1e-5f);
    }
}

TEST_CASE("axis: light that lies evenly around the sun is shown exactly") {
    // HG(a) scattered by HG(b) is HG(ab); what lies beyond 12 degrees is (2l+1) (ab)^l < 1e-7.
    for (double angle : {0.0, 0.3, 1.0, 1.6, 2.5, 3.14159265}) {
        const double exact = hg(0.2, std::cos(angle));
        CHECK(std::fabs(shown(0.5, 0.4, angle, 4, 8) / exact - 1) < 1e-5);
        CHECK(std::fabs(shown(0.5, 0.4, angle, 2, 10) / exact - 1) < 1e-5);
    }
    // The bands alone are off by the next one: 9 * 0.2^4, in units of 1/4 pi.
    const double cut = std::fabs(shown(0.5, 0.4, 0.0, 4, 0) - hg(0.2, 1)) * kFourPi;
    CHECK(cut > 0.014);
    CHECK(cut < 0.02);
}

TEST_CASE("axis: an isotropic medium stores and shows the bands alone") {
    using namespace render_test;
    const char* const isotropic = "medium.0.phase={type=\"isotropic\"}";
    const Picture with = render_one(scene_from(kSmallCumulus, {isotropic}));
    const Picture without =
        render_one(scene_from(kSmallCumulus, {isotropic, "collectors.axis_degrees=0"}));
    CHECK(with.report.hash == without.report.hash);
    bool told = false;
    for (const LeftOut& l : with.report.plan.left_out)
        told |= l.what == std::string("degrees about the sun's axis");
    CHECK(told);
    // Phase functions are known up to degree 15: 8 bands leave room for 8 degrees.
    const auto stored = [](const char* degrees) {
        const Picture p = render_one(
            scene_from(kSmallCumulus, {"collectors.bands=8", degrees, "collectors.photons=400"}));
        for (const auto& e : p.report.executed)
            if (e.first == "coefficients") return e.second;
        return std::uint64_t(0);
    };
    CHECK(stored("collectors.axis_degrees=16") * 64 == stored("collectors.axis_degrees=0") * 72);
    CHECK(stored("collectors.axis_degrees=0") > 0);
    // With a lobe they matter.
    CHECK(render_one(scene_from(kSmallCumulus)).report.hash !=
          render_one(scene_from(kSmallCumulus, {"collectors.axis_degrees=0"})).report.hash);
}

TEST_CASE("axis: bands and ledger keep their bits") {
    using namespace trace_test;
    const auto sums_of = [](int degrees, TraceTally& tally) {
        Rig rig = make_rig({4, 4, 4}, {4, 4, 4}, 2);
        rig.medium.optics[0] = {{1, 1, 1}, 1, {kPhaseHg, 0.85f, 0, 1}};
        add_light(rig, beam_light(rig.medium, {0.48, 0.6, -0.64}));
        rig.collectors = 1;
        REQUIRE(rig.collector_of_voxel.resize(64, "voxels"));
        rig.deposit.axis_degrees = degrees;
        rig.deposit.coefficients = 16 + degrees;
        rig.lighting.lights[0].photons = 20'000;
        const TraceInput in = input_of(rig, 9);
        TraceScratch scratch;
        PhotonSlot slot;
        REQUIRE(prepare_trace(in, scratch));
        REQUIRE(slot.sums.resize(slot_stride(in), "sums"));
        std::vector<TraceTally> tallies(1);
        REQUIRE(trace_generation(in, 0, scratch, slot, tallies));
        tally = tallies[0];
        return std::vector<std::int64_t>(slot.sums.data(), slot.sums.data() + 16 + degrees);
    };
    TraceTally plain{}, more{};
    const auto bands = sums_of(0, plain), both = sums_of(5, more);
    for (std::size_t i = 0; i < 16; ++i) CHECK(bands[i] == both[i]);
    CHECK(plain.scatterings == more.scatterings);
    CHECK(plain.light.sides[0] == more.light.sides[0]);
    CHECK(balance(more.light, 0) == 0);
    // The bands hold moment 3 about the axis too: by the addition theorem it is
    // sqrt(4 pi / 7) sum_m c_3m Y_3m(axis) sqrt(4 pi / 7) = 4 pi / 7 sum_m c_3m y_3m(axis).
    // A degree more is never larger for light that runs ahead.
    float y[16];
    sh_values(4, Vec<float>{0.48f, 0.6f, -0.64f}, y);
    double third = 0;
    for (int i = 9; i < 16; ++i) third += double(bands[std::size_t(i)]) * double(y[i]);
    third *= kFourPi / 7;
    CHECK(double(both[16]) > 0.5 * third);
    CHECK(double(both[16]) < third);
}
