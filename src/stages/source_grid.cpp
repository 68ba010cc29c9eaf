// SPDX-License-Identifier: Apache-2.0
// See source_grid.h.
#include "src/stages/source_grid.h"

#include "platform/threads.h"

namespace pileus {
namespace {

constexpr int kFillRings = 4;

struct Range {
    int first, last;  ///< nodes, last excluded
};
Range nodes_within(float centre, float radius, float per_metre, int size) {
    const float low = (centre - radius) * per_metre - 0.5f;
    const float high = (centre + radius) * per_metre - 0.5f;
    const int first = low <= 0 ? 0 : int(low);
    const int last = high >= float(size - 1) ? size : (high < 0 ? 0 : int(high) + 1);
    return {first < size ? first : size, last};
}

/// Adds every ball's share to the nodes of one slice, in the order of the collectors.
void splat_slice(Span<const Collector> collectors, Span<const float> colour, int channels,
                 const NodeGrid& g, float factor, int z, Span<float> source, float* weights) {
    const float least = 1.2f / (g.per_metre[0] < g.per_metre[1]
                                    ? (g.per_metre[0] < g.per_metre[2] ? g.per_metre[0]
                                                                       : g.per_metre[2])
                                    : (g.per_metre[1] < g.per_metre[2] ? g.per_metre[1]
                                                                       : g.per_metre[2]));
    const std::size_t nodes = std::size_t(node_count(g)), count = collectors.size;
    const float pz = (float(z) + 0.5f) / g.per_metre[2];
    for (std::size_t c = 0; c < count; ++c) {
        const Collector& k = collectors[c];
        const float radius = k.radius * factor > least ? k.radius * factor : least;
        const float dz = pz - k.centre[2], inverse = 1.0f / (radius * radius);
        if (dz * dz >= radius * radius) continue;
        const Range ys = nodes_within(k.centre[1], radius, g.per_metre[1], g.size[1]);
        const Range xs = nodes_within(k.centre[0], radius, g.per_metre[0], g.size[0]);
        for (int y = ys.first; y < ys.last; ++y) {
            const float dy = (float(y) + 0.5f) / g.per_metre[1] - k.centre[1];
            for (int x = xs.first; x < xs.last; ++x) {
                const float dx = (float(x) + 0.5f) / g.per_metre[0] - k.centre[0];
                const float near = 1.0f - (dx * dx + dy * dy + dz * dz) * inverse;
                if (near <= 0) continue;
                const float w = near * near * float(k.mass);
                const std::size_t column = std::size_t(y) * std::size_t(g.size[0]) + std::size_t(x);
                const std::size_t node =
                    std::size_t(z) * std::size_t(g.size[0]) * std::size_t(g.size[1]) + column;
                weights[column] += w;
                for (int i = 0; i < channels; ++i)
                    source[std::size_t(i) * nodes + node] += w * colour[std::size_t(i) * count + c];
            }
        }
    }
}

struct Neighbour {
    std::size_t node;
    bool inside;
};

/// Gives empty nodes next to filled ones the mean of these. Reads the marks of the ring before.
void fill_slice(const NodeGrid& g, int z, int channels, Span<const std::uint8_t> before,
                Span<std::uint8_t> after, Span<float> source) {
    const std::size_t nx = std::size_t(g.size[0]), ny = std::size_t(g.size[1]);
    const std::size_t nodes = std::size_t(node_count(g));
    for (std::size_t y = 0; y < ny; ++y)
        for (std::size_t x = 0; x < nx; ++x) {
            const std::size_t node = (std::size_t(z) * ny + y) * nx + x;
            if (before[node] != 0) continue;
            const Neighbour around[6] = {
                {node - 1, x > 0},          {node + 1, x + 1 < nx},
                {node - nx, y > 0},         {node + nx, y + 1 < ny},
                {node - nx * ny, z > 0},    {node + nx * ny, z + 1 < g.size[2]},
            };
            int found = 0;
            for (const Neighbour& n : around)
                if (n.inside && before[n.node] != 0) ++found;
            if (found == 0) continue;
            for (int i = 0; i < channels; ++i) {
                const std::size_t plane = std::size_t(i) * nodes;
                float sum = 0;
                for (const Neighbour& n : around)
                    if (n.inside && before[n.node] != 0) sum += source[plane + n.node];
                source[plane + node] = sum / float(found);
            }
            after[node] = 1;
        }
}

}  // namespace

NodeGrid make_node_grid(const Grid& grid, const double (&extent_m)[3], double spacing_m) {
    NodeGrid g{};
    for (int a = 0; a < 3; ++a) {
        const double wanted = spacing_m > 0 ? extent_m[a] / spacing_m + 0.5 : 1;
        int n = wanted > grid.size[a] ? grid.size[a] : int(wanted);
        if (n < 1) n = 1;
        g.size[a] = n;
        g.per_metre[a] = float(n / extent_m[a]);
    }
    return g;
}

Status splat_colours(Span<const Collector> collectors, Span<const float> colour, int channels,
                     const NodeGrid& nodes, float radius_factor, int threads,
                     Buffer<float>& source) {
    const std::uint64_t count = node_count(nodes);
    PILEUS_TRY(source.resize(count * std::uint64_t(channels), "source grid"));
    Buffer<float> weights;
    Buffer<std::uint8_t> filled, next;
    PILEUS_TRY(weights.resize(count, "source weights"));
    PILEUS_TRY(filled.resize(count, "source marks"));
    PILEUS_TRY(next.resize(count, "source marks"));
    const std::size_t slice = std::size_t(nodes.size[0]) * std::size_t(nodes.size[1]);
    parallel_for(threads, nodes.size[2], [&](std::int64_t z, int) {
        float* own = weights.data() + std::size_t(z) * slice;
        splat_slice(collectors, colour, channels, nodes, radius_factor, int(z), source.span(), own);
        for (std::size_t i = 0; i < slice; ++i) {
            if (!(own[i] > 0)) continue;
            const std::size_t node = std::size_t(z) * slice + i;
            filled[node] = next[node] = 1;
            for (int c = 0; c < channels; ++c) source[std::size_t(c) * count + node] /= own[i];
        }
    });
    for (int ring = 0; ring < kFillRings; ++ring) {
        parallel_for(threads, nodes.size[2], [&](std::int64_t z, int) {
            fill_slice(nodes, int(z), channels, filled.span(), next.span(), source.span());
        });
        std::memcpy(filled.data(), next.data(), std::size_t(count));
    }
    return Status::ok();
}

}  // namespace pileus
