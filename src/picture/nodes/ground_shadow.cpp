// SPDX-License-Identifier: Apache-2.0
// See ground_shadow.h.
#include "src/picture/nodes/ground_shadow.h"

#include <cmath>

namespace pileus {
namespace {

constexpr std::uint64_t kPixelsPerNode = 2;

/// Cells that the nodes' first and last are multiples of, so that they seldom change.
constexpr double kSnap = 8;

/// Where the box's shadow lies along one axis, in cells, a node wider on either side.
struct Reach {
    double first, count;
};
Reach reach_of(const Medium& medium, double ground_z, const std::array<float, 3>& to_sun,
               std::size_t axis) {
    const double per_height = double(to_sun[axis]) / double(to_sun[2]);
    const double top = medium.extent_m[2] - ground_z, foot = ground_z < 0 ? -ground_z : 0;
    const double a = -per_height * top, b = -per_height * foot;
    const double low = a < b ? a : b, high = medium.extent_m[axis] + (a < b ? b : a);
    const double cell = double(medium.grid.cell_m[axis]);
    const double first = kSnap * std::floor((low / cell - 1) / kSnap);
    return {first, kSnap * std::ceil((high / cell + 1) / kSnap) - first};
}

}  // namespace

std::uint64_t most_ground_nodes(const Medium& medium, const Lighting& lighting,
                                std::uint64_t pixels) {
    const bool wanted = lighting.ground.present && !medium.grid.periodic && !medium.grid.constant;
    return wanted ? pixels / kPixelsPerNode : 0;
}

Status make_ground_shadow(const Context& context, const Medium& medium, const MediumView& view,
                          const Lighting& lighting, const CameraParams& camera, const SunTurn& turn,
                          GroundShadow& out) {
    const std::uint64_t whole =
        std::uint64_t(whole_width(camera)) * std::uint64_t(whole_height(camera));
    const std::uint64_t most = most_ground_nodes(medium, lighting, whole);
    NodeGrid nodes{};
    std::uint64_t count = 0;
    if (most > 0 && lighting.sunlit && medium.sigma > 0 && medium.extent_m[2] > lighting.ground.z) {
        const Reach x = reach_of(medium, lighting.ground.z, lighting.to_sun, 0),
                    y = reach_of(medium, lighting.ground.z, lighting.to_sun, 1);
        if (x.count * y.count <= double(most)) {
            const Reach reach[2] = {x, y};
            count = std::uint64_t(x.count) * std::uint64_t(y.count);
            nodes.size[2] = 1;
            nodes.per_metre[2] = 1;
            for (std::size_t a = 0; a < 2; ++a) {
                const double cell = double(medium.grid.cell_m[a]);
                nodes.size[a] = std::int32_t(reach[a].count);
                nodes.per_metre[a] = float(1 / cell);
                const float origin = float(reach[a].first * cell);
                if (origin != out.origin[a]) out.slices.held.clear();
                out.origin[a] = origin;
            }
            out.origin[2] = float(lighting.ground.z - 0.5);  // the row's middle
        }
    }
    // Room for any sun; beside a part of a picture, whose size it has not, for this one.
    const bool part = camera.more_columns > 0 || camera.more_rows > 0;
    const std::uint64_t room = part ? count : most;
    // Another size of the picture has memory of its own, which holds nothing yet.
    if (out.depth.size() != room) out.slices.held.clear();
    PILEUS_TRY(allocate_once(arrays::ground_shadow(room), out.depth));
    for (int a = 0; a < 2; ++a)
        if (nodes.size[a] != out.nodes.size[a]) out.slices.held.clear();
    if (out.ground_z != lighting.ground.z) out.slices.held.clear();
    out.nodes = nodes;
    out.ground_z = lighting.ground.z;
    const std::vector<int> due = follow_sun(turn, out.slices);
    if (nodes.size[0] == 0) return Status::ok();
    const StageClock clock(context, "shadow");
    ShadowParams k{};
    k.medium = view;
    k.nodes = nodes;
    for (int a = 0; a < 3; ++a) k.origin[a] = out.origin[a];
    for (const int slice : due) {
        for (std::size_t a = 0; a < 3; ++a) k.to_sun[a] = out.slices.held[std::size_t(slice)][a];
        PILEUS_TRY(
            make_shadow_slice(context, k, ShadowBuffers{out.depth.data()}, slice, turn.slices));
    }
    return Status::ok();
}

void read_ground_shadow(const GroundShadow& shadow, BackgroundParams& k, BackgroundBuffers& b) {
    k.shadow = shadow.nodes;
    for (int a = 0; a < 2; ++a) k.shadow_origin[a] = shadow.origin[a];
    b.ground_depth = shadow.depth.data();
}

}  // namespace pileus
