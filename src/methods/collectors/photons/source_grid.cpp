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

/// How far each ball reaches, and the numbers of those over each slice, rising: those over slice z
/// begin at first[z].
struct Balls {
    std::vector<float> radius;
    std::vector<std::uint32_t> first, numbers;
};

void list_balls(Span<const Collector> collectors, const NodeGrid& g, const SplatOptions& options,
                Balls& out) {
    float coarsest = g.per_metre[0];
    for (float n : g.per_metre) coarsest = n < coarsest ? n : coarsest;
    const float least = 1.2f / coarsest;
    out.first.assign(std::size_t(g.size[2]) + 1, 0);
    std::vector<Range> slices;
    slices.reserve(collectors.size);
    out.radius.reserve(collectors.size);
    for (const Collector& k : collectors) {
        const float wide = k.radius * options.radius_factor;
        const float radius = wide > least ? wide : least;
        out.radius.push_back(radius);
        slices.push_back(nodes_within(k.centre[2], radius, g.per_metre[2], g.size[2], false));
        for (int z = slices.back().first; z < slices.back().last; ++z)
            ++out.first[std::size_t(z) + 1];
    }
    for (std::size_t z = 1; z < out.first.size(); ++z) out.first[z] += out.first[z - 1];
    out.numbers.resize(out.first.back());
    std::vector<std::uint32_t> next = out.first;
    for (std::size_t c = 0; c < slices.size(); ++c)
        for (int z = slices[c].first; z < slices[c].last; ++z)
            out.numbers[next[std::size_t(z)]++] = std::uint32_t(c);
}

/// Adds every ball's share to the nodes of one slice, in the order of the collectors.
void splat_slice(Span<const Collector> collectors, Span<const float> colour, int channels,
                 const NodeGrid& g, const SplatOptions& options, const Balls& balls, int z,
                 Span<float> source, float* weights, std::vector<Range>& touched) {
    const bool wraps = options.periodic;
    const std::size_t nodes = std::size_t(node_count(g)), count = collectors.size;
    const std::size_t columns = std::size_t(g.size[0]);
    const float pz = (float(z) + 0.5f) / g.per_metre[2];
    for (std::size_t b = balls.first[std::size_t(z)]; b < balls.first[std::size_t(z) + 1]; ++b) {
        const std::size_t c = balls.numbers[b];
        const Collector& k = collectors[c];
        const float radius = balls.radius[c];
        const float dz = pz - k.centre[2], inverse = 1.0f / (radius * radius);
        if (dz * dz >= radius * radius) continue;
        const Range ys = nodes_within(k.centre[1], radius, g.per_metre[1], g.size[1], wraps);
        const Range xs = nodes_within(k.centre[0], radius, g.per_metre[0], g.size[0], wraps);
        for (int y = ys.first; y < ys.last; ++y) {
            const float dy = (float(y) + 0.5f) / g.per_metre[1] - k.centre[1];
            const int row_y = wraps ? wrapped(y, g.size[1]) : y;
            const std::size_t row = std::size_t(row_y) + std::size_t(z) * std::size_t(g.size[1]);
            Range& own = touched[row];
            own.first = wraps ? 0 : (xs.first < own.first ? xs.first : own.first);
            own.last = wraps ? g.size[0] : (xs.last > own.last ? xs.last : own.last);
            for (int x = xs.first; x < xs.last; ++x) {
                const float dx = (float(x) + 0.5f) / g.per_metre[0] - k.centre[0];
                const float near = 1.0f - (dx * dx + dy * dy + dz * dz) * inverse;
                if (near <= 0) continue;
                const float w = near * near * float(k.mass);
                const std::size_t column = std::size_t(wraps ? wrapped(x, g.size[0]) : x);
                weights[row * columns + column] += w;
                for (int i = 0; i < channels; ++i)
                    source[std::size_t(i) * nodes + row * columns + column] +=
                        w * colour[std::size_t(i) * count + c];
            }
        }
    }
}

/// Nodes of each row that a march through the medium can read.
std::vector<Range> rows_to_read(const NodeGrid& g, const SplatOptions& options) {
    const std::size_t rows = std::size_t(g.size[1]) * std::size_t(g.size[2]);
    const MediumView& m = options.medium;
    if (m.density == nullptr || options.periodic)
        return std::vector<Range>(rows, Range{0, g.size[0]});
    std::vector<Range> out(rows, Range{g.size[0], 0});
    // A place at a block's face may be read as lying in either block: a tenth of a voxel holds
    // that.
    constexpr float kAround = 0.1f;
    const auto reach = [&](int block, int axis) {
        const float per_voxel = m.cell[axis] * g.per_metre[axis];
        const float low = (float(block) * m.block - kAround) * per_voxel - 0.5f;
        const float high = (float(block + 1) * m.block + kAround) * per_voxel - 0.5f;
        const int size = g.size[axis], first = floor_int(low), last = floor_int(high) + 2;
        return Range{first < 0 ? 0 : (first < size ? first : size - 1), last < size ? last : size};
    };
    std::size_t n = 0;
    for (int z = 0; z < m.blocks[2]; ++z)
        for (int y = 0; y < m.blocks[1]; ++y) {
            const float* row = m.majorant + n;
            n += std::size_t(m.blocks[0]);
            int first = 0, last = m.blocks[0];
            while (first < last && !(row[first] > 0)) ++first;
            while (last > first && !(row[last - 1] > 0)) --last;
            if (first == last) continue;
            const Range xs{reach(first, 0).first, reach(last - 1, 0).last};
            const Range ys = reach(y, 1), zs = reach(z, 2);
            for (int k = zs.first; k < zs.last; ++k)
                for (int j = ys.first; j < ys.last; ++j) {
                    Range& own = out[std::size_t(k) * std::size_t(g.size[1]) + std::size_t(j)];
                    own.first = xs.first < own.first ? xs.first : own.first;
                    own.last = xs.last > own.last ? xs.last : own.last;
                }
        }
    return out;
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

/// Adds the eight children of each node of `up` in slice z; of each row of `fine` those within
/// `touched`, or all where that is null.
void sum_slice(const Level& fine, const Level& up, const Range* touched, int channels, int z,
               Pyramid& p) {
    const auto add = [&](const float* from, float* to) {
        for (int dz = 2 * z; dz < 2 * z + 2 && dz < fine.size[2]; ++dz)
            for (int y = 0; y < fine.size[1]; ++y) {
                const std::size_t row =
                    std::size_t(dz) * std::size_t(fine.size[1]) + std::size_t(y);
                const std::size_t above =
                    std::size_t(z) * std::size_t(up.size[1]) + std::size_t(y / 2);
                const Range xs = touched != nullptr ? touched[row] : Range{0, fine.size[0]};
                for (int x = xs.first; x < xs.last; ++x)
                    to[above * std::size_t(up.size[0]) + std::size_t(x / 2)] +=
                        from[row * std::size_t(fine.size[0]) + std::size_t(x)];
            }
    };
    add(p.weights.data() + fine.weights, p.weights.data() + up.weights);
    for (int c = 0; c < channels; ++c)
        add(p.source.data() + fine.source + std::size_t(c) * fine.nodes(),
            p.source.data() + up.source + std::size_t(c) * up.nodes());
}

/// Turns sums into means that lean on the coarser level's where they hold less than `prior`; of
/// each row those within `read`, or all where that is null.
void settle_slice(const Level& fine, const Level* up, const Range* read, float prior, bool wraps,
                  int z, Pyramid& p) {
    const float* weights = p.weights.data() + fine.weights;
    for (int y = 0; y < fine.size[1]; ++y) {
        const Range xs = read != nullptr ? read[z * fine.size[1] + y] : Range{0, fine.size[0]};
        for (int x = xs.first; x < xs.last; ++x) {
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
    Balls balls;
    list_balls(collectors, nodes, options, balls);
    const std::size_t rows = std::size_t(nodes.size[1]) * std::size_t(nodes.size[2]);
    std::vector<Range> touched(rows, Range{nodes.size[0], 0});
    parallel_for(threads, nodes.size[2], [&](std::int64_t z, int) {
        splat_slice(collectors, colour, channels, nodes, options, balls, int(z), p.source.span(),
                    p.weights.data(), touched);
    });
    for (std::size_t l = 1; l < p.levels.size(); ++l)
        parallel_for(threads, p.levels[l].size[2], [&](std::int64_t z, int) {
            sum_slice(p.levels[l - 1], p.levels[l], l == 1 ? touched.data() : nullptr, channels,
                      int(z), p);
        });
    // A prior of nothing would divide zero by zero where no collector reaches.
    const float prior = options.prior_mass > 1e-30f ? options.prior_mass : 1e-30f;
    const std::vector<Range> read = rows_to_read(nodes, options);
    for (std::size_t l = p.levels.size(); l-- > 0;)
        parallel_for(threads, p.levels[l].size[2], [&](std::int64_t z, int) {
            const bool top = l + 1 == p.levels.size();
            settle_slice(p.levels[l], top ? nullptr : &p.levels[l + 1],
                         l == 0 ? read.data() : nullptr, prior, options.periodic, int(z), p);
        });
    source.swap(p.source);
    return Status::ok();
}

}  // namespace pileus
