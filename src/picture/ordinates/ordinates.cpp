// SPDX-License-Identifier: Apache-2.0
// See ordinates.h. Nodes, their solutions, and what a camera sees of them.
// docs/ordinates.md
#include "src/picture/ordinates/ordinates.h"

#include <algorithm>

#include "kernels_cpu/core/sh.h"
#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/picture/ordinates/ordinate_half.h"
#include "src/picture/ordinates/ordinate_medium.h"
#include "src/picture/ordinates/ordinate_own.h"
#include "src/picture/ordinates/ordinate_ring.h"
#include "src/picture/ordinates/ordinate_solve.h"

namespace pileus {
namespace {

constexpr double kPeakDeg = 20;
constexpr double kFewest = 32;  // nodes along an axis that optical depth may ask for
constexpr float kLeastRest = 1e-6f;

/// Nodes without medium have what their neighbours have, by extinction.
void fill_empty(const OrdinateNodes& nodes, bool periodic, const float* from, float* to,
                std::size_t node) {
    if (nodes.density[node] > 0) {
        to[node] = from[node];
        return;
    }
    to[node] = 0;
    const std::int32_t* n = nodes.grid.size;
    const NodePlace at = node_place(nodes.grid, node);
    float light = 0, mass = 0;
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                NodePlace p{at[0] + x, at[1] + y, at[2] + z};
                bool outside = p[2] < 0 || p[2] >= n[2];
                for (std::size_t a = 0; a < 2; ++a) {
                    if (periodic) p[a] = (p[a] + n[a]) % n[a];
                    outside |= p[a] < 0 || p[a] >= n[a];
                }
                if (outside) continue;
                const std::size_t other = node_number(nodes.grid, p);
                if (!(nodes.density[other] > 0)) continue;
                light += nodes.density[other] * from[other];
                mass += nodes.density[other];
            }
    if (mass > 0) to[node] = light / mass;
}

/// What is known of a light by the solution that is there for one before it.
void keep_solution(const OrdinateSet& before, OrdinateSet& set) {
    if (before.channel != set.channel || !before.solved) return;
    set.solved = true;
    set.same = set.beam == 0 && before.beam == 0 && set.own == 0 && before.own == 0 &&
               before.enters == set.enters;
    set.iterations = before.iterations;
    set.residual = before.residual;
}

/// Whether nodes are seen along one direction each by rays that read them.
bool seen_from_outside(const Medium& medium, const CameraParams& camera, const NodeGrid& grid) {
    if (camera.orthographic != 0) return true;
    if (medium.grid.periodic) return false;
    for (std::size_t a = 0; a < 3; ++a) {
        const double margin = 2 * kNearNodes / double(grid.per_metre[a]),
                     at = double(camera.origin[a]);
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

namespace {

/// `rest`: the largest.
Status set_optics(const Context& context, const Medium& medium, bool points, OrdinateNodes& out,
                  double& rest) {
    PILEUS_TRY(make_beam(medium, ordinate_peak(), points, BeamTurns::kPeak, context.threads,
                         Stage::kShadow, out.peak));
    out.media = medium.count;
    rest = 0;
    for (int i = 0; i < out.media; ++i)
        for (int c = 0; c < 3; ++c) {
            out.optics[i][c] = ordinate_optics(medium.optics[std::size_t(i)],
                                               medium.channels > 1 ? c : 0, out.peak.shares[i]);
            rest = std::max(rest, double(out.optics[i][c].rest));
        }
    out.sets.clear();
    return Status::ok();
}

}  // namespace

Status prepare_optics(const Context& context, const Medium& medium, bool points,
                      OrdinateNodes& out) {
    const StageClock clock(context, "ordinates");
    double rest = 0;
    return set_optics(context, medium, points, out, rest);
}

Status prepare_ordinates(const Context& context, const Medium& medium, const Majorants& majorants,
                         bool points, OrdinateNodes& out) {
    const StageClock clock(context, "ordinates");
    double rest = 0;
    PILEUS_TRY(set_optics(context, medium, points, out, rest));
    out.grid = ordinate_grid(medium, rest);
    out.periodic = medium.grid.periodic;
    PILEUS_TRY(sample_ordinates(context, medium, majorants, out));
    out.depth = node_depth(medium, out);
    PILEUS_TRY(make_half(out));
    weigh_half(out);
    return Status::ok();
}

double node_depth(const Medium& medium, const OrdinateNodes& out) {
    float thickest = 0, edge = 1 / out.grid.per_metre[0];
    for (std::size_t i = 0; i < out.density.size(); ++i)
        for (int c = 0; c < medium.channels; ++c)
            thickest = std::max(thickest, out.density[i] * ordinate_rest(out, out.parts, c, i));
    for (float per_metre : out.grid.per_metre) edge = std::min(edge, 1 / per_metre);
    return double(medium.sigma) * double(thickest) * double(edge);
}

Status reserve_ordinates(OrdinateNodes& out) {
    out.sets.reserve(kMaxOrdinateSets);
    PILEUS_TRY(hold(arrays::ordinate_solution(out.filled.size(), kMaxOrdinateSets), out.solution));
    PILEUS_TRY(reserve_half(kMaxOrdinateSets, out));
    PILEUS_TRY(
        hold(arrays::ordinate_light(node_count(out.grid), kMaxOrdinateSets, out.media), out.light));
    return hold(arrays::ordinate_near(node_count(out.grid), kMaxOrdinateSets, true), out.near);
}

bool unsolved(const OrdinateNodes& nodes) {
    for (const OrdinateSet& set : nodes.sets)
        if (!set.solved || !(set.residual < kSolvedChange)) return true;
    return false;
}

Status make_ordinates(const Context& context, const Medium& medium, const Majorants& majorants,
                      const Lighting& lighting, const OrdinateAsk& ask, OrdinateNodes& out) {
    const StageClock clock(context, "ordinates");
    std::array<OrdinateSet, kMaxOrdinateSets> before;
    const std::size_t held = out.sets.size();
    std::copy(out.sets.begin(), out.sets.end(), before.begin());
    set_ordinate_lights(medium, lighting, ask, out.sets);
    out.near_made = false;
    const std::uint64_t nodes = out.filled.size();
    if (out.solution.size() < nodes * kOrdinateMoments * out.sets.size()) {
        PILEUS_TRY(allocate(arrays::ordinate_solution(nodes, out.sets.size()), out.solution));
    } else if (held == out.sets.size()) {
        for (std::size_t s = 0; s < held; ++s) keep_solution(before[s], out.sets[s]);
    }
    PILEUS_TRY(reserve_half(out.sets.size(), out));
    Buffer<float> unkept, beam, own, ring;
    Buffer<float>& depths = ask.depths != nullptr ? *ask.depths : unkept;
    bool shines = false;
    for (const OrdinateSet& set : out.sets) shines |= set.beam > 0;
    if (shines) {
        if (!ask.sampled)
            PILEUS_TRY(sample_sun(context, medium, majorants, lighting, ask.sun, out, depths));
        PILEUS_TRY(allocate(arrays::ordinate_nodes(nodes, Stage::kShadow), beam));
    }
    OrdinateSolver solver, larger;
    for (std::size_t s = 0; s < out.sets.size(); ++s) {
        OrdinateSet& set = out.sets[s];
        if (ask.only >= 0 && std::size_t(ask.only) != s) continue;
        if (set.same && set.residual < kSolvedChange) continue;
        if (set.beam > 0)
            light_nodes(context, medium, out, lighting, set.channel, depths, beam.data());
        OrdinateSources from;
        if (set.beam > 0) from.beam = beam.data();
        PILEUS_TRY(own_light(context, medium, out, ask, set, own, from.fixed));
        if (out.ring) PILEUS_TRY(light_ring(context, ask.coarser, s, out, ring, from));
        float* const moments = out.solution.data() + s * nodes * kOrdinateMoments;
        if (from.started || ask.iterations == 0 || !set.solved) {
            PILEUS_TRY(solve_half(context, medium, out, lighting, ask, from, s, larger));
            if (!from.started) start_from_half(context, out, s, moments);
            from.started = true;
        } else {
            take_correction(context, out, s, moments);
            PILEUS_TRY(solve_half(context, medium, out, lighting, ask, from, s, larger));
        }
        PILEUS_TRY(solve_ordinates(context, medium, out, lighting, from, ask.iterations, solver,
                                   set, moments));
        add_correction(context, out, s, moments);
    }
    return Status::ok();
}

namespace {

/// Nodes without medium have what their neighbours have.
void spread_light(const Context& context, const OrdinateNodes& nodes, bool periodic,
                  const float* from, float* to) {
    parallel_each(context.threads, nodes.density.size(),
                  [&](std::size_t i) { fill_empty(nodes, periodic, from, to, i); });
}

/// What a medium scatters of a solution towards the camera, from each node that holds some.
void turn_solution(const Context& context, const OrdinateNodes& nodes, const CameraParams& camera,
                   const float* from, const OrdinateOptics& optics, float* to) {
    const std::size_t filled = nodes.filled.size();
    parallel_each(context.threads, filled, [&](std::size_t n) {
        const auto i = std::size_t(nodes.filled[n]);
        const NodePlace at = node_place(nodes.grid, i);
        float d[3], square = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            d[a] = camera.orthographic != 0
                       ? -camera.forward[a]
                       : camera.origin[a] - (float(at[a]) + 0.5f) / nodes.grid.per_metre[a];
            square += d[a] * d[a];
        }
        const float unit = 1 / __builtin_sqrtf(std::max(square, 1e-20f));
        float harmonic[kOrdinateMoments], sum = 0;
        sh_eval<4>(d[0] * unit, d[1] * unit, d[2] * unit, harmonic);
        for (std::size_t m = 0; m < kOrdinateMoments; ++m)
            sum += from[m * filled + n] * harmonic[m] * optics.moment[ordinate_degree(int(m))] *
                   optics.albedo;
        to[i] = std::max(sum, 0.0f);
    });
}

/// A moment of a solution, from each node that holds medium.
void place_moment(const OrdinateNodes& nodes, const float* from, float* to) {
    for (std::size_t n = 0; n < nodes.filled.size(); ++n)
        to[std::size_t(nodes.filled[n])] = from[n];
}

}  // namespace

bool sees_moments(const Medium& medium, const CameraParams& camera, const NodeGrid& grid) {
    return !seen_from_outside(medium, camera, grid);
}

float ordinate_per_near(const NodeGrid& grid) {
    float least = grid.per_metre[0];
    for (float per_metre : grid.per_metre) least = std::min(least, per_metre);
    return least / float(kNearNodes);
}

Status turn_ordinates(const Context& context, const Medium& medium, const CameraParams& camera,
                      OrdinateNodes& out) {
    out.has_moments = sees_moments(medium, camera, out.grid);
    // Copies of a medium are seen in directions of their own, however far they are.
    const bool periodic = medium.grid.periodic, copies = periodic && camera.orthographic == 0;
    out.per_near = copies ? 0.0f : ordinate_per_near(out.grid);
    const std::size_t nodes = std::size_t(node_count(out.grid)), sets = out.sets.size();
    const auto media = std::size_t(medium.count);
    if (!copies) PILEUS_TRY(hold(arrays::ordinate_light(nodes, sets, medium.count), out.light));
    // Moments are the same for all cameras.
    const bool moments = out.has_moments && !out.near_made;
    if (moments) PILEUS_TRY(hold(arrays::ordinate_near(nodes, sets, true), out.near));
    Buffer<float> own;
    PILEUS_TRY(allocate(arrays::ordinate_nodes(nodes, Stage::kShadow), own));
    const std::size_t filled = out.filled.size();
    for (std::size_t s = 0; s < sets; ++s) {
        const float* from = out.solution.data() + s * filled * kOrdinateMoments;
        for (std::size_t i = 0; i < media && !copies; ++i) {
            turn_solution(context, out, camera, from, out.optics[i][out.sets[s].channel],
                          own.data());
            spread_light(context, out, periodic, own.data(),
                         out.light.data() + (s * media + i) * nodes);
        }
        for (std::size_t m = 0; m < kOrdinateMoments && moments; ++m) {
            place_moment(out, from + m * filled, own.data());
            spread_light(context, out, periodic, own.data(),
                         out.near.data() + (s * kOrdinateMoments + m) * nodes);
        }
    }
    out.near_made |= moments;
    return Status::ok();
}

}  // namespace pileus
