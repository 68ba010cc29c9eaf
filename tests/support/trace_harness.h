// SPDX-License-Identifier: Apache-2.0
// Shoots photons through media made by hand, and judges the means they give.
// in: densities, lights, numbers of photons -> out: ledgers, means with standard errors, verdicts.
// docs/testing.md, "Two-stage rule": beyond 4.5 standard errors 16 times the photons and a fresh
// seed decide; beyond 5.7 the test fails. A bias of 7.6 standard errors is found in 99.9 %.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "src/base/fnv1a64.h"
#include "src/photons/trace.h"
#include "src/world/majorant/majorant.h"

namespace trace_test {

using namespace pileus;

/// A medium, its lights and everything else a launch needs.
struct Rig {
    Medium medium;
    Lighting lighting;
    Buffer<float> majorants;
    int block = 1;
    Buffer<std::int32_t> collector_of_voxel;
    std::uint64_t collectors = 0;
    GatherCells cells;
    DepositPlan deposit;
    std::uint32_t max_events = 1u << 20;
    int threads = 1;
    const KernelTable* kernels = kernel_table(nullptr);
};

/// Bounds per block of `block` voxels; 0: one block for all.
inline void set_majorants(Rig& rig, int block) {
    int whole = 1;
    for (int n : rig.medium.grid.size) whole = n > whole ? n : whole;
    rig.block = block > 0 ? block : whole;
    REQUIRE(majorant_grid(rig.medium.volume.density.span(), rig.medium.grid, rig.block, 1,
                          rig.majorants));
}

/// A box of density 1, isotropic and white.
inline Rig make_rig(std::array<int, 3> size, Double3 extent_m, double sigma) {
    Rig rig;
    Medium& m = rig.medium;
    m.volume.size = size;
    for (std::size_t a = 0; a < 3; ++a) {
        m.extent_m[a] = extent_m[a];
        m.grid.size[a] = size[a];
        m.grid.cell_m[a] = float(extent_m[a] / size[a]);
    }
    REQUIRE(m.volume.density.resize(voxel_count(m.grid), "density"));
    for (float& v : m.volume.density.span()) v = 1.0f;
    m.density_max = 1;
    m.sigma = float(sigma);
    set_majorants(rig, 0);
    return rig;
}

constexpr double kSlabWidth = 1e5;  // in thicknesses; the sides see about 1e-5 of the light

/// A slab one metre thick of optical depth `tau`.
inline Rig make_slab(double tau, float albedo, float g) {
    Rig rig = make_rig({1, 1, 1}, {kSlabWidth, kSlabWidth, 1}, tau);
    rig.medium.optics[0] = {{albedo, albedo, albedo}, albedo, {kPhaseHg, g, 0, 1}};
    return rig;
}

inline void set_albedo(Rig& rig, const Float3& albedo) {
    Optics& optics = rig.medium.optics[0];
    for (std::size_t c = 0; c < 3; ++c) optics.albedo[c] = albedo[c];
    optics.albedo_max = std::max(albedo[0], std::max(albedo[1], albedo[2]));
    rig.medium.channels = albedo[0] == albedo[1] && albedo[1] == albedo[2] ? 1 : 3;
}

/// Adds a light of stream 1, 2, 3 ...
inline void add_light(Rig& rig, Light light) {
    light.stream = std::uint32_t(rig.lighting.lights.size()) + 1;
    light.colour = {1, 1, 1};
    rig.lighting.lights.push_back(std::move(light));
}

inline TraceInput input_of(const Rig& rig, std::uint64_t seed) {
    TraceInput in;
    in.medium = &rig.medium;
    in.lighting = &rig.lighting;
    in.majorants = rig.majorants.span();
    in.block = rig.block;
    in.collector_of_voxel = rig.collector_of_voxel.span();
    in.collectors = rig.collectors;
    in.cells = rig.cells;
    in.deposit = rig.deposit;
    in.seed = seed;
    in.threads = rig.threads;
    in.kernels = rig.kernels;
    in.max_events = rig.max_events;
    return in;
}

/// Calls `use(tallies of one generation)` for `batches` generations of `photons` per light.
template <class Use>
void shoot_batches(Rig& rig, int batches, std::uint64_t photons, std::uint64_t seed, Use use) {
    for (Light& light : rig.lighting.lights) light.photons = photons;
    const TraceInput in = input_of(rig, seed);
    TraceScratch scratch;
    PhotonSlot slot;
    REQUIRE(prepare_trace(in, scratch));
    REQUIRE(slot.sums.resize(slot_stride(in) * rig.lighting.lights.size(), "slot"));
    for (int b = 0; b < batches; ++b) {
        std::vector<TraceTally> tallies(rig.lighting.lights.size());
        REQUIRE(trace_generation(in, std::uint64_t(b), scratch, slot, tallies));
        use(tallies);
    }
}

/// All photons of the first light together.
inline TraceTally shoot(Rig& rig, std::uint64_t photons, std::uint64_t seed) {
    TraceTally sum{};
    shoot_batches(rig, 1, photons, seed,
                  [&](const std::vector<TraceTally>& t) { add_tally(t[0], sum); });
    return sum;
}

struct Mean {
    double value = 0, error = 0;
};

constexpr int kBatches = 256;

/// Mean of `quantity(tally of the first light)` over independent generations.
template <class Quantity>
Mean batch_mean(Rig& rig, std::uint64_t photons, std::uint64_t seed, Quantity quantity) {
    std::vector<double> values;
    shoot_batches(rig, kBatches, (photons + kBatches - 1) / kBatches, seed,
                  [&](const std::vector<TraceTally>& t) { values.push_back(quantity(t[0])); });
    Mean m;
    for (double v : values) m.value += v / kBatches;
    for (double v : values) m.error += (v - m.value) * (v - m.value);
    m.error = std::sqrt(m.error / (double(kBatches) * (kBatches - 1)));
    return m;
}

inline double share(std::int64_t fate, const TraceTally& t) {
    return double(fate) / double(t.light.emitted[0]);
}
/// Binomial: at least the true error, since the starting points are spread evenly.
inline Mean share_mean(std::int64_t fate, const TraceTally& t) {
    const double p = share(fate, t), n = double(t.photons);
    return {p, std::sqrt(std::max(p * (1 - p), 1 / n) / n)};
}

/// Metres travelled per photon.
inline double mean_path(const Rig& rig, const TraceTally& t) {
    double square = 0;
    for (double e : rig.medium.extent_m) square += e * e;
    return double(t.path) * std::sqrt(square) / path_units(rig.medium) / double(t.photons);
}
/// 4 V / S of the box: the mean path of light that enters it diffusely.
inline double mean_chord(const Rig& rig) {
    const auto& e = rig.medium.extent_m;
    return 2 * e[0] * e[1] * e[2] / (e[0] * e[1] + e[1] * e[2] + e[2] * e[0]);
}

inline double print_row(const char* name, const Mean& m, double reference, double model) {
    const double off = std::max(0.0, std::fabs(m.value - reference) - model);
    const double z = m.error > 0 ? off / m.error : (off > 0 ? 1e9 : 0);
    std::printf("%-44s %.7g ref %.7g se %.2g z %+.2f detectable bias %.2g\n", name, m.value,
                reference, m.error, m.value < reference ? -z : z, 7.6 * m.error);
    return z;
}

/// Two-stage verdict on `measure(multiple of photons, seed)`; `model` is the reference's own error.
template <class Measure>
Mean check_mean(const std::string& name, double reference, Measure measure, double model = 0) {
    // Every row has random numbers of its own, so that rows do not share their luck.
    const std::uint64_t seed = fnv1a64({name.data(), name.size()});
    const Mean first = measure(1, seed);
    if (print_row(name.c_str(), first, reference, model) <= 4.5) return first;
    const Mean second = measure(16, seed + 1);
    const double z = print_row((name + " (16x)").c_str(), second, reference, model);
    CHECK_MESSAGE(z <= 5.7, name);
    return second;
}

/// Emitted minus all fates of one channel, quanta; 0 unless light was lost or made.
inline std::int64_t balance(const Fates& f, std::size_t c) {
    return f.emitted[c] - f.top[c] - f.bottom[c] - f.sides[c] - f.absorbed[c] - f.ground[c] -
           f.sky[c] - f.terminated[c] - f.solid[c];
}

/// A launch made by hand, without the launcher: one block for all, no deposits, no ground.
inline TraceParams plain_params(const Rig& rig, const Light& light, Key key) {
    const Medium& m = rig.medium;
    TraceParams k{};
    double square = 0;
    k.grid = track_grid(m, rig.majorants.span(), rig.block, rig.max_events);
    for (int a = 0; a < 3; ++a) {
        k.direction[a] = light.travel[std::size_t(a)];
        square += m.extent_m[a] * m.extent_m[a];
    }
    k.channels = m.channels;
    k.media = m.count;
    for (std::size_t i = 0; i < m.optics.size(); ++i) k.optics[i] = m.optics[i];
    k.light = light.beam ? kLightBeam : kLightDiffuse;
    k.hemisphere = light.hemisphere;
    for (std::size_t f = 0; f < 6; ++f) k.face_cdf[f] = light.face_cdf[f];
    k.key = key;
    k.mode = kDepositNone;
    k.path_scale = float(path_units(m) / std::sqrt(square));
    return k;
}

}  // namespace trace_test
