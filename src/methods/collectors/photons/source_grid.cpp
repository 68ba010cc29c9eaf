// SPDX-License-Identifier: Apache-2.0
// See source_grid.h.
#include "src/methods/collectors/photons/source_grid.h"

#include <algorithm>
#include <vector>

#include "kernels_cpu/display/lit_nodes.h"
#include "platform/threads.h"
#include "src/base/powers.h"
#include "src/methods/collectors/photons/guided_grid.h"
#include "src/methods/collectors/photons/node_pyramid.h"
#include "src/picture/nodes/node_rows.h"

namespace pileus {
namespace {

int wrapped(int node, int size) {
    const int rest = node % size;
    return rest < 0 ? rest + size : rest;
}

NodeRange nodes_within(float centre, float radius, float per_metre, int size, bool wraps) {
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
    SplatMetric metric;
    std::vector<float> radius;
    std::vector<std::uint32_t> first, numbers;
};

void list_balls(Span<const Collector> collectors, const NodeGrid& g, const SplatOptions& options,
                Balls& out) {
    out.first.assign(std::size_t(g.size[2]) + 1, 0);
    out.metric = splat_metric(g);
    const float up = out.metric.axis[2];
    std::vector<NodeRange> slices;
    slices.reserve(collectors.size);
    out.radius.reserve(collectors.size);
    for (const Collector& k : collectors) {
        const float radius = ball_radius(k, g, options.radius_factor);
        out.radius.push_back(radius);
        slices.push_back(nodes_within(k.centre[2], radius / up, g.per_metre[2], g.size[2], false));
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

/// Colours of each collector side by side, and a one that makes its weight.
Status colours_side_by_side(Span<const float> colour, std::size_t collectors, int channels,
                            Buffer<float>& out) {
    const std::size_t own = std::size_t(channels) + 1;
    PILEUS_TRY(allocate(arrays::splat_colours(own, collectors), out));
    for (std::size_t k = 0; k < collectors; ++k) {
        for (std::size_t c = 0; c + 1 < own; ++c) out[k * own + c] = colour[c * collectors + k];
        out[k * own + own - 1] = 1;
    }
    return Status::ok();
}

/// Adds every ball's share to the nodes of one slice, in the order of the collectors.
void splat_slice(Span<const Collector> collectors, const float* colour, std::size_t own,
                 const NodeGrid& g, const SplatOptions& options, const Balls& balls, int z,
                 float* source, std::vector<NodeRange>& touched) {
    const bool wraps = options.periodic;
    const std::size_t columns = std::size_t(g.size[0]);
    const float pz = (float(z) + 0.5f) / g.per_metre[2];
    for (std::size_t b = balls.first[std::size_t(z)]; b < balls.first[std::size_t(z) + 1]; ++b) {
        const std::size_t c = balls.numbers[b];
        const Collector& k = collectors[c];
        const float radius = balls.radius[c];
        const auto& m = balls.metric.axis;
        const float dz = (pz - k.centre[2]) * m[2], inverse = 1.0f / (radius * radius);
        if (dz * dz >= radius * radius) continue;
        const NodeRange ys =
            nodes_within(k.centre[1], radius / m[1], g.per_metre[1], g.size[1], wraps);
        const NodeRange xs =
            nodes_within(k.centre[0], radius / m[0], g.per_metre[0], g.size[0], wraps);
        for (int y = ys.first; y < ys.last; ++y) {
            const float dy = ((float(y) + 0.5f) / g.per_metre[1] - k.centre[1]) * m[1];
            const int row_y = wraps ? wrapped(y, g.size[1]) : y;
            const std::size_t row = std::size_t(row_y) + std::size_t(z) * std::size_t(g.size[1]);
            NodeRange& reached = touched[row];
            reached.first = wraps ? 0 : (xs.first < reached.first ? xs.first : reached.first);
            reached.last = wraps ? g.size[0] : (xs.last > reached.last ? xs.last : reached.last);
            for (int x = xs.first; x < xs.last; ++x) {
                const float dx = ((float(x) + 0.5f) / g.per_metre[0] - k.centre[0]) * m[0];
                const float near = 1.0f - (dx * dx + dy * dy + dz * dz) * inverse;
                if (near <= 0) continue;
                const std::size_t column = std::size_t(wraps ? wrapped(x, g.size[0]) : x);
                add_scaled(near * near * float(k.mass), colour + c * own, own,
                           source + (row * columns + column) * own);
            }
        }
    }
}

/// Levels of `own` numbers a node: channels and, last, the weight.
struct Pyramid {
    std::vector<NodeLevel> levels;
    std::size_t own;
    float* numbers;
    float* of(const NodeLevel& level) const { return numbers + level.first * own; }
};

/// Means of a node that lean on `prior` of the coarser level's, between its nodes.
void lean(const float* coarse, const Corners<float>& around, float prior, std::size_t own,
          float* numbers) {
    const float weight = numbers[own - 1];
    if (own == 4) {
        float mean[4];
        interpolate_quad(coarse, around, mean);
        const F<4> v =
            (load_quad(numbers) + all<F<4>>(prior) * load_quad(mean)) / all<F<4>>(weight + prior);
        __builtin_memcpy(numbers, &v, sizeof v);
    } else {
        const std::int32_t wide = std::int32_t(own);
        Corners<float> at = around;
        for (std::int32_t* i : {&at.x0, &at.x1, &at.y0, &at.y1, &at.z0, &at.z1}) *i *= wide;
        for (std::size_t c = 0; c + 1 < own; ++c)
            numbers[c] = (numbers[c] + prior * interpolate(coarse + c, at)) / (weight + prior);
    }
}

/// Turns sums into means that lean on the coarser level's where they hold less than `prior`; of
/// each row those within `read`, or all where that is null. `last`: what takes the weight's place.
void settle_slice(const NodeLevel& fine, const NodeLevel* up, const NodeRange* read,
                  const float* last, float prior, bool wraps, int z, const Pyramid& p) {
    // Places along x are the same in each row.
    std::vector<Corners<float>> columns;
    for (int x = 0; x < fine.size[0] && up != nullptr; ++x)
        columns.push_back(corners(Vec<float>{(float(x) + 0.5f) * 0.5f, 0, 0}, up->size, wraps));
    for (int y = 0; y < fine.size[1]; ++y) {
        const std::size_t row = fine.row(y, z);
        const NodeRange xs = read != nullptr ? read[row] : NodeRange{0, fine.size[0]};
        Corners<float> at{};
        if (up != nullptr)
            at = corners(Vec<float>{0, (float(y) + 0.5f) * 0.5f, (float(z) + 0.5f) * 0.5f},
                         up->size, wraps);
        for (int x = xs.first; x < xs.last; ++x) {
            const std::size_t node = fine.node(x, row);
            float* numbers = p.of(fine) + node * p.own;
            if (up == nullptr) {
                const float w = numbers[p.own - 1];
                for (std::size_t c = 0; c + 1 < p.own; ++c)
                    numbers[c] = w > 0 ? numbers[c] / w : 0.0f;
            } else {
                const Corners<float>& column = columns[std::size_t(x)];
                at.x0 = column.x0, at.x1 = column.x1, at.fx = column.fx;
                lean(p.of(*up), at, prior, p.own, numbers);
            }
            numbers[p.own - 1] = last != nullptr ? last[node] : 0.0f;
        }
    }
}

}  // namespace

SplatMetric splat_metric(const NodeGrid& g) {
    float fewest = g.per_metre[0], most = fewest;
    for (const float n : g.per_metre) {
        fewest = n < fewest ? n : fewest;
        most = n > most ? n : most;
    }
    SplatMetric metric;
    if (!(most > 2 * fewest)) return metric;
    double volume = 1;
    for (std::size_t a = 0; a < 3; ++a) {
        metric.axis[a] = g.per_metre[a] / most;
        volume *= double(metric.axis[a]);
    }
    metric.radius = float(cube_root(volume));
    return metric;
}

float ball_radius(const Collector& collector, const NodeGrid& g, float factor) {
    const SplatMetric metric = splat_metric(g);
    float coarsest = g.per_metre[0] / metric.axis[0];
    for (std::size_t a = 1; a < 3; ++a) {
        const float per_metre = g.per_metre[a] / metric.axis[a];
        coarsest = per_metre < coarsest ? per_metre : coarsest;
    }
    return std::max(collector.radius * metric.radius * factor, 1.2f / coarsest);
}

std::vector<NodeLevel> node_levels(const NodeGrid& g) {
    std::vector<NodeLevel> levels;
    NodeLevel level{{g.size[0], g.size[1], g.size[2]}, 0};
    for (;;) {
        levels.push_back(level);
        if (level.nodes() == 1) return levels;
        level.first += level.nodes();
        for (std::int32_t& n : level.size) n = (n + 1) / 2;
    }
}

void sum_children(const NodeLevel& fine, const float* from, const NodeRange* touched,
                  const NodeLevel& up, int z, std::size_t own, float* to) {
    for (int dz = 2 * z; dz < 2 * z + 2 && dz < fine.size[2]; ++dz)
        for (int y = 0; y < fine.size[1]; ++y) {
            const std::size_t row = fine.row(y, dz), above = up.row(y / 2, z);
            const NodeRange xs = touched != nullptr ? touched[row] : NodeRange{0, fine.size[0]};
            for (int x = xs.first; x < xs.last; ++x)
                add_scaled(1, from + fine.node(x, row) * own, own,
                           to + up.node(x / 2, above) * own);
        }
}

std::uint64_t source_nodes(const NodeGrid& g) {
    const NodeLevel last = node_levels(g).back();
    return last.first + last.nodes();
}

Status splat_colours(Span<const Collector> collectors, Span<const float> colour, int channels,
                     const NodeGrid& nodes, const SplatOptions& options, int threads,
                     Buffer<float>& source) {
    Pyramid p{node_levels(nodes), std::size_t(channels) + 1, nullptr};
    const auto numbers = arrays::source_grid(p.own, source_nodes(nodes), Stage::kDisplay);
    PILEUS_TRY(allocate_once(numbers, source));
    p.numbers = source.data();
    Buffer<float> own;
    PILEUS_TRY(colours_side_by_side(colour, collectors.size, channels, own));
    Balls balls;
    list_balls(collectors, nodes, options, balls);
    const NodeLevel& finest = p.levels.front();
    const std::size_t rows = std::size_t(nodes.size[1]) * std::size_t(nodes.size[2]);
    std::vector<NodeRange> touched(rows, NodeRange{nodes.size[0], 0});
    const std::size_t slice = finest.nodes() / std::size_t(nodes.size[2]) * p.own;
    parallel_for(threads, nodes.size[2], [&](std::int64_t z, int) {
        std::fill_n(p.numbers + std::size_t(z) * slice, slice, 0.0f);
        splat_slice(collectors, own.data(), p.own, nodes, options, balls, int(z), p.numbers,
                    touched);
    });
    const std::vector<NodeRange> read = nodes_in_medium(nodes, options.medium);
    if (options.guided)
        return guide_nodes(nodes, options, channels, touched, read, threads, source);
    std::fill(p.numbers + finest.nodes() * p.own, p.numbers + source.size(), 0.0f);
    for (std::size_t l = 1; l < p.levels.size(); ++l)
        parallel_for(threads_of(p.levels[l], threads), p.levels[l].size[2],
                     [&](std::int64_t z, int) {
                         sum_children(p.levels[l - 1], p.of(p.levels[l - 1]),
                                      l == 1 ? touched.data() : nullptr, p.levels[l], int(z), p.own,
                                      p.of(p.levels[l]));
                     });
    // A prior of nothing would divide zero by zero where no collector reaches.
    const float prior = options.prior_mass > 1e-30f ? options.prior_mass : 1e-30f;
    for (std::size_t l = p.levels.size(); l-- > 0;)
        parallel_for(
            threads_of(p.levels[l], threads), p.levels[l].size[2], [&](std::int64_t z, int) {
                const bool top = l + 1 == p.levels.size();
                settle_slice(p.levels[l], top ? nullptr : &p.levels[l + 1],
                             l == 0 ? read.data() : nullptr, l == 0 ? options.beside : nullptr,
                             prior, options.periodic, int(z), p);
            });
    return Status::ok();
}

Status planes_of_nodes(Span<const float> source, int channels, const NodeGrid& nodes, int threads,
                       Buffer<float>& planes) {
    const std::size_t count = std::size_t(node_count(nodes)), own = std::size_t(channels) + 1;
    PILEUS_TRY(allocate_once(arrays::source_planes(std::uint64_t(channels), count), planes));
    const std::size_t slice = count / std::size_t(nodes.size[2]);
    parallel_for(threads, nodes.size[2], [&](std::int64_t z, int) {
        for (std::size_t c = 0; c + 1 < own; ++c)
            for (std::size_t n = std::size_t(z) * slice; n < (std::size_t(z) + 1) * slice; ++n)
                planes[c * count + n] = source[n * own + c];
    });
    return Status::ok();
}

}  // namespace pileus
