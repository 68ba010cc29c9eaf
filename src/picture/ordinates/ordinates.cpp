// SPDX-License-Identifier: Apache-2.0
// See ordinates.h. Nodes, what lies in them, the beam on them, and what a camera sees.
// docs/ordinates.md
#include "src/picture/ordinates/ordinates.h"

#include <algorithm>

#include "kernels_cpu/core/sh.h"
#include "kernels_cpu/raymarch/raymarch_field.h"
#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/picture/march_view.h"
#include "src/picture/ordinates/ordinate_solve.h"
#include "src/run/device_launch.h"

namespace pileus {
namespace {

constexpr double kPeakDeg = 20;
constexpr double kFewest = 32;  // nodes along an axis that optical depth may ask for
constexpr float kLeastRest = 1e-6f;

/// Samples of the density within a node, along each axis, so that they see every voxel.
std::array<int, 3> samples_within(const NodeGrid& grid, const Medium& medium) {
    std::array<int, 3> out{};
    for (int a = 0; a < 3; ++a) {
        const double voxels = 1 / (double(grid.per_metre[a]) * double(medium.grid.cell_m[a]));
        const int needed = int(0.5 * voxels + 0.999);
        out[std::size_t(a)] =
            voxels <= 1.01 ? 1 : std::min(std::max(needed, 2), kMaxOrdinateSamples);
    }
    return out;
}

NodeGrid sample_grid(const NodeGrid& grid, const std::array<int, 3>& within) {
    NodeGrid g = grid;
    for (std::size_t a = 0; a < 3; ++a) {
        g.size[a] *= within[a];
        g.per_metre[a] *= float(within[a]);
    }
    return g;
}

/// Calls use(index of a sample) for those within a node.
template <class Use>
void each_sample(const NodeGrid& grid, const std::array<int, 3>& within, std::size_t node,
                 const Use& use) {
    const std::size_t nx = std::size_t(grid.size[0]), ny = std::size_t(grid.size[1]);
    const std::size_t at[3] = {node % nx, node / nx % ny, node / (nx * ny)};
    const std::size_t w[3] = {std::size_t(within[0]), std::size_t(within[1]),
                              std::size_t(within[2])};
    for (std::size_t z = 0; z < w[2]; ++z)
        for (std::size_t y = 0; y < w[1]; ++y)
            for (std::size_t x = 0; x < w[0]; ++x)
                use(((at[2] * w[2] + z) * (ny * w[1]) + at[1] * w[1] + y) * (nx * w[0]) +
                    at[0] * w[0] + x);
}

Status sample_density(const Context& context, const Medium& medium, const Majorants& majorants,
                      OrdinateNodes& out) {
    const std::array<int, 3> within = samples_within(out.grid, medium);
    const NodeGrid fine = sample_grid(out.grid, within);
    PILEUS_TRY(allocate(arrays::ordinate_densities(node_count(fine)), out.samples));
    PILEUS_TRY(allocate(arrays::ordinate_nodes(node_count(out.grid), Stage::kWrite), out.density));
    MediumView view = make_medium_view(medium, majorants);
    view.detail = nullptr;
    const std::size_t nx = std::size_t(fine.size[0]), ny = std::size_t(fine.size[1]);
    parallel_each(context.threads, out.samples.size(), [&](std::size_t i) {
        const Vec<float> p{(float(i % nx) + 0.5f) / fine.per_metre[0],
                           (float(i / nx % ny) + 0.5f) / fine.per_metre[1],
                           (float(i / (nx * ny)) + 0.5f) / fine.per_metre[2]};
        out.samples[i] =
            view.constant != 0 ? grid_density<true>(view, p) : grid_density<false>(view, p);
    });
    const float share = 1.0f / float(within[0] * within[1] * within[2]);
    parallel_each(context.threads, out.density.size(), [&](std::size_t i) {
        float sum = 0;
        each_sample(out.grid, within, i, [&](std::size_t s) { sum += out.samples[s]; });
        out.density[i] = sum * share;
    });
    return Status::ok();
}

/// Optical depths towards the sun from all samples.
Status sample_sun(const Context& context, const Medium& medium, const Majorants& majorants,
                  const Lighting& lighting, const NodeGrid& fine, Buffer<float>& depths) {
    PILEUS_TRY(allocate(arrays::ordinate_depths(node_count(fine)), depths));
    ShadowParams k{};
    k.medium = make_medium_view(medium, majorants);
    k.medium.detail = nullptr;
    k.medium.step = smallest_cell(medium.grid);
    k.nodes = fine;
    for (std::size_t a = 0; a < 3; ++a) k.to_sun[a] = lighting.to_sun[a];
    return run_rows(context, context.kernels->shadow_rows, k, ShadowBuffers{depths.data()},
                    std::uint32_t(fine.size[1] * fine.size[2]));
}

/// Mean irradiance of the sun on what lies in a node, of an irradiance of 1: over each sample's
/// part of the node it falls along the sun's way.
void light_nodes(const Context& context, const Medium& medium, const OrdinateNodes& nodes,
                 const Lighting& lighting, float rest, const Buffer<float>& depths, float* beam) {
    const std::array<int, 3> within = samples_within(nodes.grid, medium);
    // The sun's way through a sample's cell, at most through its middle.
    float way = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        const float cells = nodes.grid.per_metre[a] * float(within[a]);
        const float step = lighting.to_sun[a] < 0 ? -lighting.to_sun[a] : lighting.to_sun[a];
        way = std::max(way, step * cells);
    }
    way = 1 / way;
    parallel_each(context.threads, nodes.density.size(), [&](std::size_t i) {
        float light = 0, mass = 0, plain = 0;
        each_sample(nodes.grid, within, i, [&](std::size_t s) {
            const float density = nodes.samples[s];
            const float half = 0.5f * rest * medium.sigma * density * way;
            const float left = exp_(-(rest * depths[s]));
            // sinh(x) / x, of which e^-tau at the middle is the mean; not beyond the near face.
            float spread = 1;
            if (half > 0.01f) {
                const float x = std::min(half, std::min(20.0f, std::max(rest * depths[s], 0.01f)));
                spread = 0.5f * (exp_(x) - exp_(-x)) / x;
            }
            light += density * std::min(left * spread, 1.0f);
            mass += density;
            plain += left;
        });
        const float count = float(within[0] * within[1] * within[2]);
        beam[i] = mass > 0 ? light / mass : plain / count;
    });
}

/// Nodes without medium have what their neighbours have, by extinction.
void fill_empty(const OrdinateNodes& nodes, bool periodic, const float* from, float* to,
                std::size_t node) {
    if (nodes.density[node] > 0) {
        to[node] = from[node];
        return;
    }
    const int n[3] = {nodes.grid.size[0], nodes.grid.size[1], nodes.grid.size[2]};
    const int at[3] = {int(node % std::size_t(n[0])), int(node / std::size_t(n[0])) % n[1],
                       int(node / (std::size_t(n[0]) * std::size_t(n[1])))};
    float light = 0, mass = 0;
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                int p[3] = {at[0] + x, at[1] + y, at[2] + z};
                bool outside = p[2] < 0 || p[2] >= n[2];
                for (int a = 0; a < 2; ++a) {
                    if (periodic) p[a] = (p[a] + n[a]) % n[a];
                    outside |= p[a] < 0 || p[a] >= n[a];
                }
                if (outside) continue;
                const std::size_t other =
                    (std::size_t(p[2]) * std::size_t(n[1]) + std::size_t(p[1])) *
                        std::size_t(n[0]) +
                    std::size_t(p[0]);
                light += nodes.density[other] * from[other];
                mass += nodes.density[other];
            }
    to[node] = mass > 0 ? light / mass : from[node];
}

/// Memory that is large enough is kept.
Status hold(const Array<float>& array, Buffer<float>& buffer) {
    return buffer.size() >= array.count ? Status::ok() : allocate(array, buffer);
}

/// Whether nodes are seen along one direction each by rays that read them.
bool seen_from_outside(const Medium& medium, const CameraParams& camera, const NodeGrid& grid) {
    if (camera.orthographic != 0) return true;
    if (medium.grid.periodic) return false;
    for (std::size_t a = 0; a < 3; ++a) {
        const double margin = 2 / double(grid.per_metre[a]), at = double(camera.origin[a]);
        if (at < -margin || at > medium.extent_m[a] + margin) return true;
    }
    return false;
}

}  // namespace

float ordinate_peak() { return turn_of_deg(kPeakDeg); }

NodeGrid ordinate_grid(const Medium& medium, double rest) {
    const double extinction = max_extinction(medium) * rest;
    double fewest[3], most[3], spacing = 2 * double(smallest_cell(medium.grid));
    for (int a = 0; a < 3; ++a) {
        const double depth = extinction * medium.extent_m[a];
        // Light of a periodic medium differs along x and y by what lies in its voxels alone.
        fewest[a] = medium.grid.periodic && a < 2 ? 1 : std::max(1.0, std::min(depth, kFewest));
        most[a] = std::max(double(medium.grid.size[a]), fewest[a]);
    }
    const auto along = [&](int a) {
        return std::min(std::max(medium.extent_m[a] / spacing, fewest[a]), most[a]);
    };
    // The fewest are within the budget, so this ends.
    static_assert(kFewest * kFewest * kFewest <= kMaxOrdinateNodes,
                  "the fewest nodes are too many");
    while (along(0) * along(1) * along(2) > kMaxOrdinateNodes) spacing *= 1.0625;
    NodeGrid g{};
    for (int a = 0; a < 3; ++a) {
        g.size[a] = std::max(1, int(along(a)));
        g.per_metre[a] = float(g.size[a] / medium.extent_m[a]);
    }
    return g;
}

NodeGrid ordinate_samples(const NodeGrid& grid, const Medium& medium) {
    return sample_grid(grid, samples_within(grid, medium));
}

std::uint64_t max_ordinate_nodes(const Medium& medium) {
    const NodeGrid all = ordinate_grid(medium, 1), none = ordinate_grid(medium, 0);
    for (int a = 0; a < 3; ++a)
        if (all.size[a] != none.size[a]) return std::uint64_t(kMaxOrdinateNodes);
    return node_count(all);
}

std::uint64_t max_ordinate_samples(const Medium& medium) {
    const std::uint64_t all = node_count(ordinate_samples(ordinate_grid(medium, 1), medium));
    const std::uint64_t none = node_count(ordinate_samples(ordinate_grid(medium, 0), medium));
    return all > none ? all : none;
}

OrdinateOptics ordinate_optics(const Optics& optics, int channel, double f) {
    const double albedo = double(optics.albedo[std::size_t(channel)]);
    OrdinateOptics out;
    out.rest = float(1 - albedo * f);
    out.albedo = out.rest > kLeastRest ? float(albedo * (1 - f) / double(out.rest)) : 1.0f;
    double moment[4] = {1, 0, 0, 0};
    for (int l = 1; l < 4 && 1 - f > 1e-6; ++l)
        moment[l] = (double(phase_moment(optics.phase, l)) - f) / (1 - f);
    // Four moments of a lobe are negative somewhere. Of a narrow one straight back they are so far
    // below that iterations would not end: less of it then.
    double least = 0;
    for (int i = 0; i <= 64; ++i) {
        const double x = -1 + i / 32.0;
        least = std::min(least, 3 * moment[1] * x + 2.5 * moment[2] * (3 * x * x - 1) +
                                    3.5 * moment[3] * x * (5 * x * x - 3));
    }
    const double scale = least < -4 ? -4 / least : 1;
    for (int l = 1; l < 4; ++l) out.moment[l] = float(scale * moment[l]);
    return out;
}

Status prepare_ordinates(const Context& context, const Medium& medium, const Majorants& majorants,
                         OrdinateNodes& out) {
    const StageClock clock(context, "ordinates");
    PILEUS_TRY(make_beam(medium, ordinate_peak(), false, BeamTurns::kPeak, context.threads,
                         Stage::kShadow, out.peak));
    double rest = 0;
    for (int c = 0; c < 3; ++c) {
        out.optics[c] = ordinate_optics(medium.optics[0], c, out.peak.share);
        rest = std::max(rest, double(out.optics[c].rest));
    }
    out.grid = ordinate_grid(medium, rest);
    PILEUS_TRY(sample_density(context, medium, majorants, out));
    float thickest = 0, edge = 1 / out.grid.per_metre[0];
    for (std::size_t i = 0; i < out.density.size(); ++i)
        thickest = std::max(thickest, out.density[i]);
    for (float per_metre : out.grid.per_metre) edge = std::min(edge, 1 / per_metre);
    out.depth = rest * double(medium.sigma) * double(thickest) * double(edge);
    return Status::ok();
}

Status reserve_ordinates(OrdinateNodes& out) {
    const std::uint64_t nodes = node_count(out.grid);
    out.sets.reserve(kMaxOrdinateSets);
    PILEUS_TRY(hold(arrays::ordinate_solution(nodes, kMaxOrdinateSets), out.solution));
    return hold(arrays::ordinate_light(nodes, kMaxOrdinateSets, kOrdinateMoments), out.light);
}

Status make_ordinates(const Context& context, const Medium& medium, const Majorants& majorants,
                      const Lighting& lighting, OrdinateNodes& out) {
    const StageClock clock(context, "ordinates");
    set_ordinate_lights(medium, lighting, out.sets);
    const std::uint64_t nodes = node_count(out.grid);
    PILEUS_TRY(hold(arrays::ordinate_solution(nodes, out.sets.size()), out.solution));
    Buffer<float> depths, beam;
    bool shines = false;
    for (const OrdinateSet& set : out.sets) shines |= set.beam > 0;
    if (shines) {
        PILEUS_TRY(sample_sun(context, medium, majorants, lighting,
                              ordinate_samples(out.grid, medium), depths));
        PILEUS_TRY(allocate(arrays::ordinate_nodes(nodes, Stage::kShadow), beam));
    }
    OrdinateSolver solver;
    for (std::size_t s = 0; s < out.sets.size(); ++s) {
        OrdinateSet& set = out.sets[s];
        const OrdinateOptics& optics = out.optics[set.channel];
        if (set.beam > 0)
            light_nodes(context, medium, out, lighting, optics.rest, depths, beam.data());
        PILEUS_TRY(solve_ordinates(context, medium, out, optics, lighting,
                                   set.beam > 0 ? beam.data() : nullptr, solver, set,
                                   out.solution.data() + s * nodes * kOrdinateMoments));
    }
    return Status::ok();
}

Status turn_ordinates(const Context& context, const Medium& medium, const CameraParams& camera,
                      OrdinateNodes& out) {
    const bool turned = seen_from_outside(medium, camera, out.grid);
    out.moments = turned ? 1 : kOrdinateMoments;
    const std::size_t nodes = std::size_t(node_count(out.grid));
    PILEUS_TRY(hold(arrays::ordinate_light(nodes, out.sets.size(), out.moments), out.light));
    const bool periodic = medium.grid.periodic;
    Buffer<float> own;
    if (turned) PILEUS_TRY(allocate(arrays::ordinate_nodes(nodes, Stage::kShadow), own));
    const std::size_t nx = std::size_t(out.grid.size[0]), ny = std::size_t(out.grid.size[1]);
    for (std::size_t s = 0; s < out.sets.size(); ++s) {
        const float* from = out.solution.data() + s * nodes * kOrdinateMoments;
        const OrdinateOptics& optics = out.optics[out.sets[s].channel];
        if (!turned) {
            for (std::size_t m = 0; m < kOrdinateMoments; ++m)
                parallel_each(context.threads, nodes, [&](std::size_t i) {
                    fill_empty(out, periodic, from + m * nodes,
                               out.light.data() + (s * kOrdinateMoments + m) * nodes, i);
                });
            continue;
        }
        parallel_each(context.threads, nodes, [&](std::size_t i) {
            const std::size_t at[3] = {i % nx, i / nx % ny, i / (nx * ny)};
            float d[3], square = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                d[a] = camera.orthographic != 0
                           ? -camera.forward[a]
                           : camera.origin[a] - (float(at[a]) + 0.5f) / out.grid.per_metre[a];
                square += d[a] * d[a];
            }
            const float unit = 1 / __builtin_sqrtf(std::max(square, 1e-20f));
            float harmonic[kOrdinateMoments], sum = 0;
            sh_eval<4>(d[0] * unit, d[1] * unit, d[2] * unit, harmonic);
            for (std::size_t m = 0; m < kOrdinateMoments; ++m)
                sum += from[m * nodes + i] * harmonic[m] * optics.moment[ordinate_degree(int(m))] *
                       optics.albedo;
            own[i] = std::max(sum, 0.0f);
        });
        parallel_each(context.threads, nodes, [&](std::size_t i) {
            fill_empty(out, periodic, own.data(), out.light.data() + s * nodes, i);
        });
    }
    return Status::ok();
}

}  // namespace pileus
