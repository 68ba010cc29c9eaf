// SPDX-License-Identifier: Apache-2.0
// See source_grid.h.
#include "src/methods/collectors/photons/source_grid.h"

#include <vector>

#include "kernels_cpu/media/medium.h"
#include "platform/threads.h"

namespace pileus {
namespace {

struct Range {
    int first, last;  ///< nodes, last excluded
};

int wrapped(int node, int size) {
    const int rest = node % size;
    return rest < 0 ? rest + size : rest;
}

Range nodes_within(float centre, float radius, float per_metre, int size, bool wraps) {
    const float low = (centre - radius) * per_metre - 0.5f;
    const float high = (centre + radius) * per_metre - 0.5f;
    // A ball reaches over the faces of a period; its nodes are counted on and wrapped where used.
    if (wraps) return {floor_int(low), floor_int(high) + 1};
    const int first = low <= 0 ? 0 : int(low);
    const int last = high >= float(size - 1) ? size : (high < 0 ? 0 : int(high) + 1);
    return {first < size ? first : size, last};
}

/// Adds every ball's share to the nodes of one slice, in the order of the collectors.
void splat_slice(Span<const Collector> collectors, Span<const float> colour, int channels,
                 const NodeGrid& g, const SplatOptions& options, int z, Span<float> source,
                 float* weights) {
    const bool wraps = options.periodic;
    float coarsest = g.per_metre[0];
    for (float n : g.per_metre) coarsest = n < coarsest ? n : coarsest;
    const float least = 1.2f / coarsest;
    const std::size_t nodes = std::size_t(node_count(g)), count = collectors.size;
    const float pz = (float(z) + 0.5f) / g.per_metre[2];
    for (std::size_t c = 0; c < count; ++c) {
        const Collector& k = collectors[c];
        const float wide = k.radius * options.radius_factor;
        const float radius = wide > least ? wide : least;
        const float dz = pz - k.centre[2], inverse = 1.0f / (radius * radius);
        if (dz * dz >= radius * radius) continue;
        const Range ys = nodes_within(k.centre[1], radius, g.per_metre[1], g.size[1], wraps);
        const Range xs = nodes_within(k.centre[0], radius, g.per_metre[0], g.size[0], wraps);
        for (int y = ys.first; y < ys.last; ++y) {
            const float dy = (float(y) + 0.5f) / g.per_metre[1] - k.centre[1];
            for (int x = xs.first; x < xs.last; ++x) {
                const float dx = (float(x) + 0.5f) / g.per_metre[0] - k.centre[0];
                const float near = 1.0f - (dx * dx + dy * dy + dz * dz) * inverse;
                if (near <= 0) continue;
                const float w = near * near * float(k.mass);
                const int column_x = wraps ? wrapped(x, g.size[0]) : x;
                const int column_y = wraps ? wrapped(y, g.size[1]) : y;
                const std::size_t column =
                    std::size_t(column_y) * std::size_t(g.size[0]) + std::size_t(column_x);
                const std::size_t node =
                    std::size_t(z) * std::size_t(g.size[0]) * std::size_t(g.size[1]) + column;
                weights[column] += w;
                for (int i = 0; i < channels; ++i)
                    source[std::size_t(i) * nodes + node] += w * colour[std::size_t(i) * count + c];
            }
        }
    }
}

/// One level of the pyramid: sums over 2^level nodes along each axis.
struct Level {
    int size[3];
    std::size_t weights, source;  ///< offsets of its [node] and [channel][node] arrays
    std::size_t nodes() const {
        return std::size_t(size[0]) * std::size_t(size[1]) * std::size_t(size[2]);
    }
};

struct Pyramid {
    std::vector<Level> levels;
    Buffer<float> weights, source;
    int channels;
};

std::vector<Level> pyramid_levels(const NodeGrid& g, int channels) {
    std::vector<Level> levels;
    Level level{{g.size[0], g.size[1], g.size[2]}, 0, 0};
    for (;;) {
        levels.push_back(level);
        if (level.nodes() == 1) return levels;
        level.weights += level.nodes();
        level.source = level.weights * std::size_t(channels);
        for (int& n : level.size) n = (n + 1) / 2;
    }
}

Status make_pyramid(const NodeGrid& g, int channels, Pyramid& p) {
    p.channels = channels;
    p.levels = pyramid_levels(g, channels);
    const std::uint64_t nodes = source_nodes(g);
    PILEUS_TRY(allocate(arrays::source_weights(nodes), p.weights));
    return allocate(arrays::source_grid(std::uint64_t(channels), nodes), p.source);
}

/// Adds the eight children of each node of `up` in slice z.
void sum_slice(const Level& fine, const Level& up, int channels, int z, Pyramid& p) {
    const auto add = [&](const float* from, float* to) {
        for (int dz = 2 * z; dz < 2 * z + 2 && dz < fine.size[2]; ++dz)
            for (int y = 0; y < fine.size[1]; ++y)
                for (int x = 0; x < fine.size[0]; ++x)
                    to[(std::size_t(z) * std::size_t(up.size[1]) + std::size_t(y / 2)) *
                           std::size_t(up.size[0]) +
                       std::size_t(x / 2)] +=
                        from[(std::size_t(dz) * std::size_t(fine.size[1]) + std::size_t(y)) *
                                 std::size_t(fine.size[0]) +
                             std::size_t(x)];
    };
    add(p.weights.data() + fine.weights, p.weights.data() + up.weights);
    for (int c = 0; c < channels; ++c)
        add(p.source.data() + fine.source + std::size_t(c) * fine.nodes(),
            p.source.data() + up.source + std::size_t(c) * up.nodes());
}

/// Turns sums into means that lean on the coarser level's where they hold less than `prior`.
void settle_slice(const Level& fine, const Level* up, float prior, bool wraps, int z, Pyramid& p) {
    const float* weights = p.weights.data() + fine.weights;
    for (int y = 0; y < fine.size[1]; ++y)
        for (int x = 0; x < fine.size[0]; ++x) {
            const std::size_t node = (std::size_t(z) * std::size_t(fine.size[1]) + std::size_t(y)) *
                                         std::size_t(fine.size[0]) +
                                     std::size_t(x);
            const float w = weights[node];
            Corners<float> around{};
            if (up != nullptr) {
                const Vec<float> at{(float(x) + 0.5f) * 0.5f, (float(y) + 0.5f) * 0.5f,
                                    (float(z) + 0.5f) * 0.5f};
                around = corners(at, up->size, wraps);
            }
            for (int c = 0; c < p.channels; ++c) {
                float& v = p.source[fine.source + std::size_t(c) * fine.nodes() + node];
                if (up == nullptr) {
                    v = w > 0 ? v / w : 0.0f;
                    continue;
                }
                const float* coarse = p.source.data() + up->source + std::size_t(c) * up->nodes();
                v = (v + prior * interpolate(coarse, around)) / (w + prior);
            }
        }
}

}  // namespace

std::uint64_t source_nodes(const NodeGrid& g) {
    const Level last = pyramid_levels(g, 1).back();
    return last.weights + last.nodes();
}

Status splat_colours(Span<const Collector> collectors, Span<const float> colour, int channels,
                     const NodeGrid& nodes, const SplatOptions& options, int threads,
                     Buffer<float>& source) {
    Pyramid p;
    PILEUS_TRY(make_pyramid(nodes, channels, p));
    const std::size_t slice = std::size_t(nodes.size[0]) * std::size_t(nodes.size[1]);
    parallel_for(threads, nodes.size[2], [&](std::int64_t z, int) {
        splat_slice(collectors, colour, channels, nodes, options, int(z), p.source.span(),
                    p.weights.data() + std::size_t(z) * slice);
    });
    for (std::size_t l = 1; l < p.levels.size(); ++l)
        parallel_for(threads, p.levels[l].size[2], [&](std::int64_t z, int) {
            sum_slice(p.levels[l - 1], p.levels[l], channels, int(z), p);
        });
    // A prior of nothing would divide zero by zero where no collector reaches.
    const float prior = options.prior_mass > 1e-30f ? options.prior_mass : 1e-30f;
    for (std::size_t l = p.levels.size(); l-- > 0;)
        parallel_for(threads, p.levels[l].size[2], [&](std::int64_t z, int) {
            const bool top = l + 1 == p.levels.size();
            settle_slice(p.levels[l], top ? nullptr : &p.levels[l + 1], prior, options.periodic,
                         int(z), p);
        });
    source.swap(p.source);
    return Status::ok();
}

}  // namespace pileus
