// SPDX-License-Identifier: Apache-2.0
// The map of light that a cloud scatters onto the ground, by exact counts and by the furnace.
// in: boxes over a ground -> out: counts equal in integers; nothing where nothing may change.
// docs/collectors.md "Light that needs no photon".
#include <doctest/doctest.h>

#include "tests/support/trace_harness.h"

using namespace pileus;
using namespace trace_test;

namespace {

Rig rig_over_ground(double tau, float g, double ground_albedo, double ground_z) {
    Rig rig = make_rig({1, 1, 1}, {100, 100, 100}, tau / 100);
    rig.medium.optics[0].phase = {kPhaseHg, g, 0, 1};
    rig.lighting.ground.present = true;
    rig.lighting.ground.z = ground_z;
    rig.lighting.ground.albedo = ground_albedo;
    return rig;
}

/// Light per cell and unit radiance, m^2 of flux, of one generation of all lights.
std::vector<double> map_of(const TraceInput& in, std::uint64_t generation, TraceScratch& scratch,
                           std::vector<TraceTally>& tallies) {
    const std::size_t lights = in.lighting->lights.size();
    const std::size_t cells = std::size_t(in.ground.cells) * std::size_t(in.ground.cells);
    PhotonSlot slot;
    REQUIRE(slot.sums.resize(slot_stride(in) * lights, "slot"));
    REQUIRE(trace_generation(in, generation, scratch, slot, tallies));
    std::vector<double> map(cells, 0.0);
    for (std::size_t l = 0; l < lights; ++l) {
        const Light& light = in.lighting->lights[l];
        const std::int64_t* from = slot.sums.data() + (l + 1) * slot_stride(in) - cells;
        for (std::size_t i = 0; i < cells; ++i)
            map[i] += double(from[i]) / double(std::uint64_t{1} << in.deposit.places) *
                      light.power_m2 / double(light.photons);
    }
    return map;
}

}  // namespace

TEST_CASE("ground map: light scattered straight on arrives below the box, every quantum of it") {
    Rig rig = rig_over_ground(1, 1.0f, 0, -50);
    add_light(rig, beam_light(rig.medium, {0, 0, -1}));
    rig.lighting.lights[0].photons = 100000;
    TraceInput in = input_of(rig, 11);
    in.ground = make_ground_map(rig.medium, rig.lighting);
    TraceScratch scratch;
    REQUIRE(prepare_trace(in, scratch));
    std::vector<TraceTally> tallies(1);
    const std::vector<double> map = map_of(in, 0, scratch, tallies);
    double sum = 0, outside = 0;
    for (int y = 0; y < in.ground.cells; ++y)
        for (int x = 0; x < in.ground.cells; ++x) {
            const double v = map[std::size_t(y * in.ground.cells + x)];
            sum += v;
            const double cx =
                (x + 0.5) / double(in.ground.per_metre[0]) + double(in.ground.origin[0]);
            const double cy =
                (y + 0.5) / double(in.ground.per_metre[1]) + double(in.ground.origin[1]);
            const double half = 0.5 / double(in.ground.per_metre[0]);
            if (cx < -half || cx > 100 + half || cy < -half || cy > 100 + half) outside += v;
        }
    const double arrived = double(tallies[0].light.ground[0]) / double(kPhotonQuanta) * 1e4 / 1e5;
    // Sums of whole photons times one factor: only the rounding of the additions remains.
    CHECK(sum == doctest::Approx(arrived).epsilon(1e-12));
    CHECK(outside == 0);
    CHECK(arrived > 0.6 * 1e4);  // 1 - 1/e of the light meets the medium
}

TEST_CASE("ground map: in a furnace a white cloud changes nothing on the ground") {
    Rig rig = rig_over_ground(3, 0.5f, 1, -30);
    add_light(rig, diffuse_light(rig.medium, -1));
    add_light(rig, diffuse_light(rig.medium, 1));
    check_mean("furnace: change of light under the box, share of the sky's", 0,
               [&](int multiple, std::uint64_t seed) {
                   for (Light& l : rig.lighting.lights) l.photons = std::uint64_t(4000 * multiple);
                   TraceInput in = input_of(rig, seed);
                   in.ground = make_ground_map(rig.medium, rig.lighting);
                   TraceScratch scratch;
                   REQUIRE(prepare_trace(in, scratch));
                   constexpr int kGenerations = 64;
                   std::vector<double> values;
                   for (int b = 0; b < kGenerations; ++b) {
                       std::vector<TraceTally> tallies(2);
                       const std::vector<double> map =
                           map_of(in, std::uint64_t(b), scratch, tallies);
                       double sum = 0;
                       for (int y = 15; y < 25; ++y)
                           for (int x = 15; x < 25; ++x)
                               sum += map[std::size_t(y * in.ground.cells + x)];
                       const double area =
                           100 / double(in.ground.per_metre[0]) / double(in.ground.per_metre[1]);
                       values.push_back(sum / (area * 3.14159265358979));
                   }
                   Mean m;
                   for (double v : values) m.value += v / kGenerations;
                   for (double v : values) m.error += (v - m.value) * (v - m.value);
                   m.error = std::sqrt(m.error / (kGenerations * (kGenerations - 1.0)));
                   return m;
               });
}
