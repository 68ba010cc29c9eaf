// SPDX-License-Identifier: Apache-2.0
// What a camera sees of solutions on nodes.
// in: solutions, a camera -> out: light towards it, or moments near it.
// docs/ordinates.md, "The march"
#include <algorithm>

#include "kernels_cpu/core/sh.h"
#include "platform/threads.h"
#include "src/picture/ordinates/ordinates.h"

namespace pileus {
namespace {

/// Calls use(neighbour) for those of a node that hold medium.
template <class Use>
void each_filled_neighbour(const OrdinateNodes& nodes, bool periodic, std::size_t node,
                           const Use& use) {
    const std::int32_t* n = nodes.grid.size;
    const NodePlace at = node_place(nodes.grid, node);
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
                if (nodes.density[other] > 0) use(other);
            }
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

namespace {

/// Nodes without medium have what their neighbours have, by extinction.
void spread_light(const Context& context, const OrdinateNodes& nodes, bool periodic,
                  const float* from, float* to) {
    std::fill_n(to, nodes.density.size(), 0.0f);
    for (const std::int32_t i : nodes.filled.span()) to[std::size_t(i)] = from[std::size_t(i)];
    parallel_each(context.threads, nodes.rim.size(), [&](std::size_t n) {
        const auto i = std::size_t(nodes.rim[n]);
        float light = 0, mass = 0;
        each_filled_neighbour(nodes, periodic, i, [&](std::size_t other) {
            light += nodes.density[other] * from[other];
            mass += nodes.density[other];
        });
        to[i] = light / mass;
    });
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

Status find_rim(const Context& context, bool periodic, OrdinateNodes& out) {
    const std::size_t nodes = out.density.size();
    std::vector<char> beside(nodes, 0);
    parallel_each(context.threads, nodes, [&](std::size_t i) {
        if (out.density[i] > 0) return;
        each_filled_neighbour(out, periodic, i, [&](std::size_t) { beside[i] = 1; });
    });
    std::uint64_t count = 0;
    for (const char b : beside) count += b != 0 ? 1 : 0;
    PILEUS_TRY(allocate(arrays::ordinate_rim(count), out.rim));
    count = 0;
    for (std::size_t i = 0; i < nodes; ++i)
        if (beside[i] != 0) out.rim[count++] = std::int32_t(i);
    return Status::ok();
}

bool sees_moments(const Medium& medium, const CameraParams& camera, const NodeGrid& grid) {
    return !seen_from_outside(medium, camera, grid);
}

float ordinate_per_near(const NodeGrid& grid) {
    float least = grid.per_metre[0];
    for (float per_metre : grid.per_metre) least = std::min(least, per_metre);
    return least / float(kNearNodes);
}

void show_each(OrdinateNodes& nodes) {
    nodes.shown.clear();
    for (std::size_t s = 0; s < nodes.sets.size(); ++s)
        nodes.shown.push_back({nodes.sets[s].colour, nodes.sets[s].channel, int(s)});
}

namespace {

/// Sets by themselves, or where there are more than are shown, or all light is grey, by channel.
void choose_shown(const Medium& medium, bool together, OrdinateNodes& nodes) {
    nodes.shown.clear();
    bool grey = together && medium.channels == 1 && nodes.sets.size() > 1;
    for (const OrdinateSet& set : nodes.sets)
        grey &= set.colour[0] == set.colour[1] && set.colour[0] == set.colour[2];
    if (grey) {
        nodes.shown.push_back({{1, 1, 1}, 0, -1});
        return;
    }
    if (together && nodes.sets.size() > kMaxShown) {
        for (std::size_t c = 0; c < 3; ++c) {
            OrdinateShown one;
            one.colour[c] = 1;
            one.channel = medium.channels > 1 ? int(c) : 0;
            nodes.shown.push_back(one);
        }
        return;
    }
    show_each(nodes);
}

/// Moments of what is shown: one set's, or a sum in `sum`. kLimit: out of memory.
Status moments_of(const Context& context, const OrdinateNodes& nodes, const OrdinateShown& shown,
                  Buffer<float>& sum, const float*& moments) {
    const std::size_t numbers = nodes.filled.size() * kOrdinateMoments;
    moments = nodes.solution.data() + std::size_t(std::max(shown.set, 0)) * numbers;
    if (shown.set >= 0) return Status::ok();
    PILEUS_TRY(allocate_once(arrays::ordinate_together(nodes.filled.size(), true), sum));
    std::size_t c = 0;
    while (!(shown.colour[c] > 0)) ++c;
    parallel_for(context.threads, kOrdinateMoments, [&](std::int64_t m, int) {
        const std::size_t filled = nodes.filled.size(), first = std::size_t(m) * filled;
        std::fill_n(sum.data() + first, filled, 0.0f);
        for (std::size_t s = 0; s < nodes.sets.size(); ++s) {
            const float colour = nodes.sets[s].colour[c];
            const float* const from = nodes.solution.data() + s * numbers;
            for (std::size_t n = first; n < first + filled && colour > 0; ++n)
                sum[n] += colour * from[n];
        }
    });
    moments = sum.data();
    return Status::ok();
}

}  // namespace

Status turn_ordinates(const Context& context, const Medium& medium, const CameraParams& camera,
                      bool together, OrdinateNodes& out) {
    const StageClock clock(context, "ordinates");
    out.has_moments = sees_moments(medium, camera, out.grid);
    // Copies of a medium are seen in directions of their own, however far they are.
    const bool periodic = medium.grid.periodic, copies = periodic && camera.orthographic == 0;
    out.per_near = copies ? 0.0f : ordinate_per_near(out.grid);
    choose_shown(medium, together, out);
    const std::size_t nodes = std::size_t(node_count(out.grid)), count = out.shown.size();
    const auto media = std::size_t(medium.count);
    if (!copies) PILEUS_TRY(hold(arrays::ordinate_light(nodes, count, medium.count), out.light));
    // Moments are the same for all cameras.
    const bool moments = out.has_moments && !out.near_made;
    if (moments) PILEUS_TRY(hold(arrays::ordinate_near(nodes, count, true), out.near));
    Buffer<float> own, sum;
    PILEUS_TRY(allocate(arrays::ordinate_nodes(nodes, Stage::kShadow), own));
    const std::size_t filled = out.filled.size();
    for (std::size_t s = 0; s < count; ++s) {
        const float* from = nullptr;
        PILEUS_TRY(moments_of(context, out, out.shown[s], sum, from));
        for (std::size_t i = 0; i < media && !copies; ++i) {
            turn_solution(context, out, camera, from, out.optics[i][out.shown[s].channel],
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

Status turn_light(const Context& context, const Medium& medium, const CameraParams& camera,
                  OrdinateNodes& nodes) {
    choose_shown(medium, true, nodes);
    const std::size_t count = std::size_t(node_count(nodes.grid));
    PILEUS_TRY(hold(arrays::ordinate_light(count, nodes.shown.size(), 1), nodes.light));
    OrdinateOptics whole;
    for (int l = 1; l < 4; ++l) whole.moment[l] = phase_moment(medium.optics[0].phase, l);
    Buffer<float> own, sum;
    PILEUS_TRY(allocate(arrays::ordinate_nodes(count, Stage::kShadow), own));
    for (std::size_t s = 0; s < nodes.shown.size(); ++s) {
        const float* from = nullptr;
        PILEUS_TRY(moments_of(context, nodes, nodes.shown[s], sum, from));
        turn_solution(context, nodes, camera, from, whole, own.data());
        spread_light(context, nodes, medium.grid.periodic, own.data(),
                     nodes.light.data() + s * count);
    }
    return Status::ok();
}

}  // namespace pileus
