// SPDX-License-Identifier: Apache-2.0
// See guided_grid.h.
// in: sums per node -> out: means that lean on fits over a pyramid.
// docs/collectors.md, "The filter of nodes"; push-pull: Gortler et al. 1996.
#include "src/methods/collectors/photons/guided_grid.h"

#include <algorithm>

#include "kernels_cpu/core/math.h"
#include "kernels_cpu/display/lit_nodes.h"
#include "platform/threads.h"
#include "src/methods/collectors/photons/node_pyramid.h"

namespace pileus {
namespace {

constexpr float kMeanPrior = 64, kSlopePrior = 4;  // times the mass of eight scatterings
constexpr int kReach = 3;                          // nodes that "around" goes to each side

/// What a filter of nodes works on. A coarser node has the blocks [own] of sums, of sums times the
/// first and of sums times the second guide, each with the weight last, and [4] sums of weights
/// times both guides' squares and product. Once it is fitted they hold means and the first guide's
/// mean, slopes over the first guide and the second one's mean, slopes over the second.
struct Nodes {
    std::vector<NodeLevel> levels;
    std::size_t own = 0, wide = 0;
    float* finest = nullptr;
    float* coarser = nullptr;
    const float* guide[2] = {};
    float prior = 0, slope_prior = 0;
    float spread[2] = {};  ///< variance of each guide over all nodes
    bool wraps = false;

    float* of(const NodeLevel& level) const {
        return coarser + (level.first - levels.front().nodes()) * wide;
    }
};

NodeRange overlap(const NodeRange& a, const NodeRange& b) {
    return {std::max(a.first, b.first), std::min(a.last, b.last)};
}

/// Sums of the eight nodes below each node of slice z of the first coarser level.
void sum_finest(const Nodes& n, const std::vector<NodeRange>& touched,
                const std::vector<NodeRange>& read, int z) {
    const NodeLevel& fine = n.levels[0];
    const NodeLevel& up = n.levels[1];
    for (int dz = 2 * z; dz < 2 * z + 2 && dz < fine.size[2]; ++dz)
        for (int y = 0; y < fine.size[1]; ++y) {
            const std::size_t row = fine.row(y, dz), above = up.row(y / 2, z);
            const NodeRange xs = overlap(touched[row], read[row]);
            for (int x = xs.first; x < xs.last; ++x) {
                const std::size_t node = fine.node(x, row);
                const float* from = n.finest + node * n.own;
                float* to = n.of(up) + up.node(x / 2, above) * n.wide;
                const float a = n.guide[0][node], b = n.guide[1][node], w = from[n.own - 1];
                add_scaled(1, from, n.own, to);
                add_scaled(a, from, n.own, to + n.own);
                add_scaled(b, from, n.own, to + 2 * n.own);
                float* squares = to + 3 * n.own;
                squares[0] += w * a * a;
                squares[1] += w * a * b;
                squares[2] += w * b * b;
            }
        }
}

/// Variance of the guides over all medium. One that hardly varies guides nothing.
void find_spread(Nodes& n) {
    const float* top = n.of(n.levels.back());
    const float w = top[n.own - 1];
    for (std::size_t k = 0; k < 2; ++k) {
        const float mean = w > 0 ? top[(k + 1) * n.own + n.own - 1] / w : 0;
        const float square = w > 0 ? top[3 * n.own + 2 * k] / w - mean * mean : 0;
        n.spread[k] = square > 1e-6f ? square : 0;
    }
}

/// Eight nodes of the coarser level around a place, and their shares.
struct Around {
    const float* of[8];
    float share[8];
};

Around around(const Nodes& n, const NodeLevel& up, int x, int y, int z) {
    const Corners<float> c = corners(
        Vec<float>{(float(x) + 0.5f) * 0.5f, (float(y) + 0.5f) * 0.5f, (float(z) + 0.5f) * 0.5f},
        up.size, n.wraps);
    const std::int32_t xs[2] = {c.x0, c.x1}, ys[2] = {c.y0, c.y1}, zs[2] = {c.z0, c.z1};
    const float fx[2] = {1 - c.fx, c.fx}, fy[2] = {1 - c.fy, c.fy}, fz[2] = {1 - c.fz, c.fz};
    Around a;
    for (std::size_t i = 0; i < 8; ++i) {
        const std::size_t u = i & 1, v = i >> 1 & 1, w = i >> 2;
        a.of[i] = n.of(up) + std::size_t(xs[u] + ys[v] + zs[w]) * n.wide;
        a.share[i] = fx[u] * fy[v] * fz[w];
    }
    return a;
}

/// Blocks of a fit between nodes, [3 own].
void mix(const Around& a, std::size_t count, float* fit) {
    if (count == 12) {
        F<4> sum[3] = {};
        for (std::size_t i = 0; i < 8; ++i)
            for (std::size_t q = 0; q < 3; ++q)
                sum[q] = sum[q] + all<F<4>>(a.share[i]) * load_quad(a.of[i] + 4 * q);
        __builtin_memcpy(fit, sum, sizeof sum);
        return;
    }
    std::fill_n(fit, count, 0.0f);
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t c = 0; c < count; ++c) fit[c] += a.share[i] * a.of[i][c];
}

/// Slopes of every channel of one node, of which `up` is the coarser level's fit, or null.
void fit_slopes(const Nodes& n, const float* up, float* node) {
    const std::size_t own = n.own;
    const float w = node[own - 1], one = w > 0 ? 1 / w : 0;
    const float* squares = node + 3 * own;
    const float a = node[2 * own - 1], b = node[3 * own - 1];
    // A little of all weight keeps two guides apart that say the same.
    const float mass = (up != nullptr ? n.slope_prior : 0.0f) + 1e-3f * w + 1e-30f;
    const float lean[2] = {mass * n.spread[0], mass * n.spread[1]};
    const float aa = std::max(squares[0] - a * a * one, 0.0f) + lean[0];
    const float bb = std::max(squares[2] - b * b * one, 0.0f) + lean[1];
    const float ab = squares[1] - a * b * one;
    const float scale = aa * bb - ab * ab;
    const bool both = n.spread[0] > 0 && n.spread[1] > 0 && scale > 1e-6f * aa * bb;
    for (std::size_t c = 0; c + 1 < own; ++c) {
        const float sum = node[c] * one;
        float ca = node[own + c] - sum * a, cb = node[2 * own + c] - sum * b;
        if (up != nullptr) ca += lean[0] * up[own + c], cb += lean[1] * up[2 * own + c];
        if (both) {
            node[own + c] = (ca * bb - cb * ab) / scale;
            node[2 * own + c] = (cb * aa - ca * ab) / scale;
        } else {
            node[own + c] = n.spread[0] > 0 ? ca / aa : 0.0f;
            node[2 * own + c] = n.spread[0] > 0 || !(n.spread[1] > 0) ? 0.0f : cb / bb;
        }
    }
}

/// Sums of a coarser node become its fit.
void fit_node(const Nodes& n, const float* up, float* node) {
    const std::size_t own = n.own;
    const float w = node[own - 1], prior = up != nullptr ? n.prior : 1e-30f;
    const float scale = 1 / (w + prior);
    // Guides are known where anything was met; what leans there is the coarser fit at that place.
    const float a = w > 0 ? node[2 * own - 1] / w : (up != nullptr ? up[own - 1] : 0.0f);
    const float b = w > 0 ? node[3 * own - 1] / w : (up != nullptr ? up[2 * own - 1] : 0.0f);
    fit_slopes(n, up, node);
    for (std::size_t c = 0; c + 1 < own; ++c) {
        float ahead = 0;
        if (up != nullptr)
            ahead =
                up[c] + up[own + c] * (a - up[own - 1]) + up[2 * own + c] * (b - up[2 * own - 1]);
        node[c] = (node[c] + prior * ahead) * scale;
    }
    node[own - 1] = a;
    node[2 * own - 1] = b;
    node[3 * own - 1] = 0;
}

void fit_slice(const Nodes& n, std::size_t level, int z, std::vector<float>& fit) {
    const NodeLevel& l = n.levels[level];
    const bool top = level + 1 == n.levels.size();
    for (int y = 0; y < l.size[1]; ++y)
        for (int x = 0; x < l.size[0]; ++x) {
            if (!top) mix(around(n, n.levels[level + 1], x, y, z), 3 * n.own, fit.data());
            fit_node(n, top ? nullptr : fit.data(), n.of(l) + l.node(x, l.row(y, z)) * n.wide);
        }
}

/// Sums of the finest nodes that are read become means.
void settle_finest(const Nodes& n, const std::vector<NodeRange>& read, const SplatOptions& options,
                   int z, std::vector<float>& fit) {
    const float* last = options.beside;
    const NodeLevel& l = n.levels.front();
    const std::size_t own = n.own;
    for (int y = 0; y < l.size[1]; ++y) {
        const std::size_t row = l.row(y, z);
        for (int x = read[row].first; x < read[row].last; ++x) {
            const std::size_t node = l.node(x, row);
            float* numbers = n.finest + node * own;
            const float w = numbers[own - 1];
            const bool top = n.levels.size() == 1;
            if (!top) mix(around(n, n.levels[1], x, y, z), 3 * own, fit.data());
            const float prior = top ? 1e-30f : n.prior, scale = 1 / (w + prior);
            const float a = top ? 0 : n.guide[0][node] - fit[own - 1];
            const float b = top ? 0 : n.guide[1][node] - fit[2 * own - 1];
            for (std::size_t c = 0; c + 1 < own; ++c) {
                const float ahead = top ? 0 : fit[c] + fit[own + c] * a + fit[2 * own + c] * b;
                const float v = (numbers[c] + prior * ahead) * scale;
                numbers[c] = int(c) < options.bounded ? std::max(v, options.least[c]) : v;
            }
            numbers[own - 1] = last != nullptr ? last[node] : 0.0f;
        }
    }
}

/// Numbers of nodes from one of them along a line, `step` apart.
struct Line {
    const float* first;
    std::size_t step;
};

/// out[x] += numbers of the line at x + shift, where it has such a node.
void add_shifted(const Line& line, int shift, int size, bool wraps, float* out) {
    const int begin = std::max(0, -shift), end = std::min(size, size - shift);
    for (int x = begin; x < end; ++x) out[x] += line.first[std::size_t(x + shift) * line.step];
    for (int x = 0; x < size && wraps; ++x)
        if (x < begin || x >= end)
            out[x] += line.first[std::size_t(((x + shift) % size + size) % size) * line.step];
}

/// Sums over nodes to each side along one axis.
void blur(const float* from, std::size_t step, const NodeGrid& g, int axis, bool wraps, int threads,
          float* to) {
    const std::size_t nx = std::size_t(g.size[0]);
    parallel_for(threads, g.size[2], [&](std::int64_t slice, int) {
        for (int y = 0; y < g.size[1]; ++y) {
            float* out = to + (std::size_t(slice) * std::size_t(g.size[1]) + std::size_t(y)) * nx;
            std::fill_n(out, nx, 0.0f);
            for (int r = -kReach; r <= kReach; ++r) {
                int at[3] = {0, y, int(slice)};
                if (axis > 0) at[axis] += r;
                const int size = g.size[axis];
                if (wraps && axis > 0) at[axis] = (at[axis] % size + size) % size;
                if (axis > 0 && (at[axis] < 0 || at[axis] >= size)) continue;
                const std::size_t row =
                    std::size_t(at[2]) * std::size_t(g.size[1]) + std::size_t(at[1]);
                add_shifted({from + row * nx * step, step}, axis == 0 ? r : 0, g.size[0],
                            wraps && axis == 0, out);
            }
        }
    });
}

/// How much medium is around each node, and e^-(fades depth) of the sun where it is read.
Status make_guides(const NodeGrid& g, const SplatOptions& options,
                   const std::vector<NodeRange>& read, int threads, const float* weight,
                   std::size_t own, Buffer<float>& guides) {
    const std::size_t nodes = std::size_t(node_count(g));
    PILEUS_TRY(allocate(arrays::node_guides(nodes), guides));
    float* sun = guides.data();
    float* mass = sun + nodes;
    const std::size_t nx = std::size_t(g.size[0]), ny = std::size_t(g.size[1]);
    const bool wraps = options.periodic;
    blur(weight, own, g, 0, wraps, threads, mass);
    blur(mass, 1, g, 1, wraps, threads, sun);
    blur(sun, 1, g, 2, false, threads, mass);
    float most = 0;
    for (std::size_t i = 0; i < nodes; ++i) most = mass[i] > most ? mass[i] : most;
    const float scale = most > 0 ? 1 / most : 0;
    parallel_for(threads, g.size[2], [&](std::int64_t z, int) {
        const std::size_t begin = std::size_t(z) * nx * ny;
        for (std::size_t i = begin; i < begin + nx * ny; ++i) mass[i] *= scale, sun[i] = 1;
        for (std::size_t row = std::size_t(z) * ny; row < std::size_t(z + 1) * ny; ++row)
            for (int x = read[row].first; x < read[row].last && options.sun_depth != nullptr; ++x) {
                const std::size_t i = row * nx + std::size_t(x);
                sun[i] = exp_(-(options.sun_fades * options.sun_depth[i]));
            }
    });
    return Status::ok();
}

}  // namespace

Status guide_nodes(const NodeGrid& g, const SplatOptions& options, int channels,
                   const std::vector<NodeRange>& touched, const std::vector<NodeRange>& read,
                   int threads, Buffer<float>& source) {
    Nodes n;
    n.levels = node_levels(g);
    n.own = std::size_t(channels) + 1;
    n.wide = 3 * n.own + 4;
    n.finest = source.data();
    n.wraps = options.periodic;
    const float mass = options.prior_mass > 1e-30f ? options.prior_mass : 1e-30f;
    n.prior = kMeanPrior * mass;
    n.slope_prior = kSlopePrior * mass;
    Buffer<float> guides, coarser;
    PILEUS_TRY(make_guides(g, options, read, threads, n.finest + channels, n.own, guides));
    const std::size_t nodes = n.levels.front().nodes();
    n.guide[0] = guides.data();
    n.guide[1] = guides.data() + nodes;
    const NodeLevel& top = n.levels.back();
    const std::size_t above = top.first + top.nodes() - nodes;
    PILEUS_TRY(allocate(arrays::guided_sums(n.own, above), coarser));
    n.coarser = coarser.data();
    for (std::size_t l = 1; l < n.levels.size(); ++l)
        parallel_for(threads_of(n.levels[l], threads), n.levels[l].size[2],
                     [&](std::int64_t z, int) {
                         if (l == 1)
                             sum_finest(n, touched, read, int(z));
                         else
                             sum_children(n.levels[l - 1], n.of(n.levels[l - 1]), nullptr,
                                          n.levels[l], int(z), n.wide, n.of(n.levels[l]));
                     });
    if (n.levels.size() > 1) find_spread(n);
    for (std::size_t l = n.levels.size(); l-- > 1;)
        parallel_for(threads_of(n.levels[l], threads), n.levels[l].size[2],
                     [&](std::int64_t z, int) {
                         std::vector<float> fit(3 * n.own);
                         fit_slice(n, l, int(z), fit);
                     });
    parallel_for(threads, g.size[2], [&](std::int64_t z, int) {
        std::vector<float> fit(3 * n.own);
        settle_finest(n, read, options, int(z), fit);
    });
    return Status::ok();
}

}  // namespace pileus
