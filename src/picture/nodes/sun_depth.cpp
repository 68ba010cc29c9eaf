// SPDX-License-Identifier: Apache-2.0
// See sun_depth.h.
#include "src/picture/nodes/sun_depth.h"

#include "kernels_cpu/core/math.h"
#include "src/picture/march_view.h"
#include "src/picture/nodes/node_grid.h"
#include "src/picture/nodes/node_rows.h"
#include "src/picture/nodes/sweep_taps.h"
#include "src/run/device_launch.h"
#include "src/run/on_device.h"

namespace pileus {
namespace {

/// Blocks along a diagonal do not know of one another: those of a diagonal run at once.
Status sweep_open(const Context& context, SweepParams k, const SweepBuffers& b) {
    if (on_device(context.kernels->device)) return sweep_on_device(*context.kernels->device, k, b);
    for (k.diagonal = 0; k.diagonal < diagonals(k); ++k.diagonal) {
        const SweepRange y = diagonal_blocks(k);
        parallel_for(context.threads, y.end - y.begin, [&](std::int64_t piece, int) {
            const std::uint32_t own = y.begin + std::uint32_t(piece);
            context.kernels->sweep_blocks(k, b, own, own + 1);
        });
    }
    return Status::ok();
}

/// One slice after the other, each in pieces of rows.
Status sweep_layers(const Context& context, const Medium& medium, bool upwards,
                    const std::vector<SweepTap>& inner, const std::vector<SweepTap>& top,
                    SweepBuffers b) {
    const std::int32_t slices = medium.grid.size[2];
    const auto layer_at = [&](std::int32_t n) {
        const std::vector<SweepTap>& taps = n == 0 ? top : inner;
        SweepLayer layer{};
        SweepLayerParams& k = layer.k;
        for (int a = 0; a < 3; ++a) k.size[a] = medium.grid.size[a];
        k.plane = upwards ? k.size[2] - 1 - n : n;
        k.above = n == 0 ? k.plane : k.plane + (upwards ? 1 : -1);
        k.taps = std::int32_t(taps.size());
        layer.taps = taps.data();
        return layer;
    };
    if (on_device(context.kernels->device)) {
        std::vector<SweepLayer> layers;
        for (std::int32_t n = 0; n < slices; ++n) layers.push_back(layer_at(n));
        return sweep_on_device(*context.kernels->device, {layers.data(), layers.size()}, b);
    }
    for (std::int32_t n = 0; n < slices; ++n) {
        const SweepLayer layer = layer_at(n);
        const SweepLayerParams& k = layer.k;
        b.taps = layer.taps;
        const std::int32_t pieces = (k.size[1] + kSweepRows - 1) / kSweepRows;
        parallel_for(context.threads, pieces, [&](std::int64_t piece, int) {
            const std::int32_t begin = std::int32_t(piece) * kSweepRows;
            const std::int32_t end =
                begin + kSweepRows < k.size[1] ? begin + kSweepRows : k.size[1];
            context.kernels->sweep_layer_rows(k, b, std::uint32_t(begin), std::uint32_t(end));
        });
    }
    return Status::ok();
}

/// `done`: false where only rays will do.
Status sweep(const Context& context, const Medium& medium, const std::array<float, 3>& to_sun,
             float* optical_depth, bool& done) {
    const SweepBuffers b{medium.volume.density.data(), optical_depth, nullptr};
    const double sigma = double(medium.sigma);
    done = !medium.detail.present();  // slices know grids alone
    if (!done) return Status::ok();
    if (!medium.grid.periodic)
        return sweep_open(context, sweep_params(medium.grid, to_sun, sigma, context.threads), b);
    std::vector<SweepTap> inner, top;
    done = layer_taps(medium.grid, to_sun, sigma, inner, top);
    return done ? sweep_layers(context, medium, to_sun[2] > 0, inner, top, b) : Status::ok();
}

Status cast_rays(const Context& context, const Medium& medium, const Majorants& majorants,
                 const std::array<float, 3>& to_sun, const NodeGrid& nodes, float* optical_depth) {
    ShadowParams k{};
    k.medium = make_medium_view(medium, majorants);
    k.nodes = nodes;
    for (std::size_t a = 0; a < 3; ++a) k.to_sun[a] = to_sun[a];
    return run_rows(context, shadow_kernel(*context.kernels, k.medium), k,
                    ShadowBuffers{optical_depth}, std::uint32_t(nodes.size[1] * nodes.size[2]));
}

/// Of every `apart` nodes along an axis the middle one: an odd number, so coarse nodes lie on fine
/// ones. Axes with fewer nodes keep their first.
struct SparseNodes {
    std::int32_t apart = 1;
    NodeGrid grid{};
};
SparseNodes sparse_nodes(const NodeGrid& fine, std::uint64_t wanted) {
    SparseNodes s;
    for (s.grid = fine; node_count(s.grid) > wanted;) {
        s.apart += 2;
        for (int a = 0; a < 3; ++a) {
            const bool few = fine.size[a] < s.apart;
            s.grid.size[a] = few ? 1 : fine.size[a] / s.apart;
            s.grid.per_metre[a] = fine.per_metre[a] / float(few ? 1 : s.apart);
        }
    }
    return s;
}

/// Index of the fine node on which coarse node `i` lies.
std::size_t fine_node(const NodeGrid& fine, const SparseNodes& s, std::size_t i) {
    std::size_t node = 0, stride = 1;
    for (int a = 0; a < 3; ++a) {
        const std::size_t n = std::size_t(s.grid.size[a]);
        const std::size_t apart = fine.size[a] < s.apart ? 1 : std::size_t(s.apart);
        node += (i % n * apart + apart / 2) * stride;
        stride *= std::size_t(fine.size[a]);
        i /= n;
    }
    return node;
}

}  // namespace

Status make_sun_depth(const Context& context, const Medium& medium, const Majorants& majorants,
                      const std::array<float, 3>& to_sun, SunDepthKind kind, SunDepth& out) {
    const StageClock clock(context, "shadow");
    out.nodes = sun_depth_nodes(medium);
    PILEUS_TRY(
        allocate_once(arrays::sun_depth(node_count(out.nodes), Stage::kWrite), out.optical_depth));
    out.swept = false;
    if (kind == SunDepthKind::kSwept)
        PILEUS_TRY(sweep(context, medium, to_sun, out.optical_depth.data(), out.swept));
    if (out.swept) return Status::ok();
    return cast_rays(context, medium, majorants, to_sun, out.nodes, out.optical_depth.data());
}

NodeGrid sun_depth_nodes(const Medium& medium) {
    return make_sized_grid(medium.grid.size, medium.extent_m);
}

NodeGrid wide_sun_depth_nodes(const Medium& medium) {
    constexpr int kMinNodes = 8;
    int size[3];
    for (int a = 0; a < 3; ++a) {
        const int voxels = medium.grid.size[a];
        size[a] = voxels >= 2 * kMinNodes ? (voxels + 1) / 2 : voxels;
    }
    return make_sized_grid(size, medium.extent_m);
}

Status follow_sun_depth(const Context& context, const Medium& medium, const Majorants& majorants,
                        const MediumView& read, const NodeGrid& nodes, const SunTurn& turn,
                        SunSlices& slices, SunDepth& out) {
    const StageClock clock(context, "shadow");
    out.nodes = nodes;
    out.swept = false;
    if (out.optical_depth.size() != node_count(out.nodes)) slices.held.clear();
    PILEUS_TRY(
        allocate_once(arrays::sun_depth(node_count(out.nodes), Stage::kWrite), out.optical_depth));
    const std::vector<int> due = follow_sun(turn, slices);
    if (due.empty()) return Status::ok();
    ShadowParams k{};
    k.medium = make_medium_view(medium, majorants);
    k.nodes = out.nodes;
    const std::vector<NodeRange> rows = nodes_in_medium(out.nodes, read);
    const ShadowBuffers b{out.optical_depth.data(), rows.data()};
    for (const int slice : due) {
        const SunDirection& sun = slices.held[std::size_t(slice)];
        for (std::size_t a = 0; a < 3; ++a) k.to_sun[a] = sun[a];
        PILEUS_TRY(make_shadow_slice(context, k, b, slice, turn.slices));
    }
    return Status::ok();
}

Status sun_depth_difference(const Context& context, const Medium& medium,
                            const Majorants& majorants, const std::array<float, 3>& to_sun,
                            const SunDepth& depth, std::uint64_t wanted, SweepCheck& out) {
    const StageClock clock(context, "shadow difference");
    const SparseNodes sparse = sparse_nodes(depth.nodes, wanted);
    Buffer<float> rays;
    PILEUS_TRY(rays.resize(node_count(sparse.grid), "sun depth difference"));
    PILEUS_TRY(cast_rays(context, medium, majorants, to_sun, sparse.grid, rays.data()));
    out = {};
    out.nodes = rays.size();
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const float ours = depth.optical_depth[fine_node(depth.nodes, sparse, i)];
        const double off = double(exp_(0.0f - ours)) - double(exp_(0.0f - rays[i]));
        sum += off;
        squares += off * off;
        const double size = off < 0 ? -off : off;
        out.largest = size > out.largest ? size : out.largest;
    }
    out.mean = sum / double(out.nodes);
    out.rms = __builtin_sqrt(squares / double(out.nodes));
    return Status::ok();
}

}  // namespace pileus
