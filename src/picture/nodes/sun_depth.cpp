// SPDX-License-Identifier: Apache-2.0
// See sun_depth.h.
#include "src/picture/nodes/sun_depth.h"

#include "kernels_cpu/core/math.h"
#include "src/picture/march_view.h"
#include "src/picture/nodes/node_rows.h"
#include "src/picture/nodes/sweep_taps.h"

namespace pileus {
namespace {

/// Blocks along a diagonal do not know of one another: those of a diagonal run at once.
void sweep_open(const Context& context, const SweepParams& k, const SweepBuffers& b) {
    const std::int32_t across = k.blocks[0], up = k.blocks[1];
    for (std::int32_t diagonal = 0; diagonal < across + up - 1; ++diagonal) {
        const std::int32_t first = diagonal < up ? 0 : diagonal - up + 1;
        const std::int32_t last = diagonal < across ? diagonal : across - 1;
        parallel_for(context.threads, last - first + 1, [&](std::int64_t piece, int) {
            const std::int32_t y = first + std::int32_t(piece);
            context.kernels->sweep_block(k, b, std::uint32_t((diagonal - y) * across + y));
        });
    }
}

/// One slice after the other, each in pieces of rows.
void sweep_layers(const Context& context, const Medium& medium, bool upwards,
                  const std::vector<SweepTap>& inner, const std::vector<SweepTap>& top,
                  SweepBuffers b) {
    SweepLayerParams k{};
    for (int a = 0; a < 3; ++a) k.size[a] = medium.grid.size[a];
    for (std::int32_t n = 0; n < k.size[2]; ++n) {
        const std::vector<SweepTap>& taps = n == 0 ? top : inner;
        k.plane = upwards ? k.size[2] - 1 - n : n;
        k.above = n == 0 ? k.plane : k.plane + (upwards ? 1 : -1);
        k.taps = std::int32_t(taps.size());
        b.taps = taps.data();
        const std::int32_t pieces = (k.size[1] + kSweepRows - 1) / kSweepRows;
        parallel_for(context.threads, pieces, [&](std::int64_t piece, int) {
            const std::int32_t begin = std::int32_t(piece) * kSweepRows;
            const std::int32_t end =
                begin + kSweepRows < k.size[1] ? begin + kSweepRows : k.size[1];
            context.kernels->sweep_layer_rows(k, b, std::uint32_t(begin), std::uint32_t(end));
        });
    }
}

/// False where only rays will do.
bool sweep(const Context& context, const Medium& medium, const std::array<float, 3>& to_sun,
           float* optical_depth) {
    const SweepBuffers b{medium.volume.density.data(), optical_depth, nullptr};
    const double sigma = double(medium.sigma);
    if (medium.detail.present()) return false;  // slices know grids alone
    if (!medium.grid.periodic) {
        sweep_open(context, sweep_params(medium.grid, to_sun, sigma, context.threads), b);
        return true;
    }
    std::vector<SweepTap> inner, top;
    if (!layer_taps(medium.grid, to_sun, sigma, inner, top)) return false;
    sweep_layers(context, medium, to_sun[2] > 0, inner, top, b);
    return true;
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
    PILEUS_TRY(allocate_once(arrays::sun_depth(medium.grid, Stage::kWrite), out.optical_depth));
    out.swept =
        kind == SunDepthKind::kSwept && sweep(context, medium, to_sun, out.optical_depth.data());
    if (out.swept) return Status::ok();
    return cast_rays(context, medium, majorants, to_sun, out.nodes, out.optical_depth.data());
}

NodeGrid sun_depth_nodes(const Medium& medium) {
    NodeGrid nodes{};
    for (int a = 0; a < 3; ++a) {
        nodes.size[a] = medium.grid.size[a];
        nodes.per_metre[a] = float(medium.grid.size[a] / medium.extent_m[a]);
    }
    return nodes;
}

Status follow_sun_depth(const Context& context, const Medium& medium, const Majorants& majorants,
                        const MediumView& read, const SunTurn& turn, SunSlices& slices,
                        SunDepth& out) {
    const StageClock clock(context, "shadow");
    out.nodes = sun_depth_nodes(medium);
    out.swept = false;
    if (out.optical_depth.size() != node_count(out.nodes)) slices.held.clear();
    PILEUS_TRY(allocate_once(arrays::sun_depth(medium.grid, Stage::kWrite), out.optical_depth));
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
