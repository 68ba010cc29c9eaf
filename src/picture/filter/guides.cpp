// SPDX-License-Identifier: Apache-2.0
// See guides.h.
#include "src/picture/filter/guides.h"

#include <algorithm>

#include "kernels_cpu/core/math.h"
#include "platform/threads.h"
#include "src/picture/background.h"
#include "src/picture/nodes/lamp_light.h"
#include "src/picture/nodes/node_grid.h"
#include "src/picture/nodes/node_rows.h"
#include "src/picture/nodes/solid_shadow.h"

namespace pileus {
namespace {

NodeGrid guide_grid(const Medium& medium) { return make_half_grid(medium.grid, medium.extent_m); }

/// Light on nodes, side by side: nothing, the two guides, the optical depth.
void pack(const Context& context, const std::vector<NodeRange>& rows, FilterGuides& guides) {
    const NodeGrid& g = guides.nodes;
    const std::size_t ny = std::size_t(g.size[1]), nx = std::size_t(g.size[0]);
    const bool veiled = !guides.visibility.empty();
    parallel_for(context.threads, g.size[2], [&](std::int64_t z, int) {
        for (std::size_t row = std::size_t(z) * ny; row < (std::size_t(z) + 1) * ny; ++row)
            for (int x = rows[row].first; x < rows[row].last; ++x) {
                const std::size_t n = row * nx + std::size_t(x);
                float* quad = guides.quads.data() + 4 * n;
                const float seen = veiled ? guides.visibility[n] : 1.0f;
                const float depth = guides.sun_depth[n];
                for (int i = 0; i < kGuidePlanes - 1; ++i)
                    quad[i + 1] = seen * exp_(-kGuideShares[i] * depth);
                quad[3] = depth;
            }
    });
}

/// Light on nodes for the sun as it stands.
Status light_nodes(const Context& context, const Medium& medium, const MediumView& view,
                   const Lighting& lighting, FilterGuides& guides) {
    const StageClock clock(context, "filter guides");
    guides.nodes = guide_grid(medium);
    const std::uint64_t count = node_count(guides.nodes);
    constexpr const char* kName = "filter's nodes";
    PILEUS_TRY(guides.quads.resize(count * 4, kName));
    if (!lighting.sunlit) return Status::ok();
    PILEUS_TRY(guides.sun_depth.resize(count, kName));
    ShadowParams k{};
    k.medium = view;
    k.nodes = guides.nodes;
    for (std::size_t a = 0; a < 3; ++a) k.to_sun[a] = lighting.to_sun[a];
    const std::vector<NodeRange> rows = nodes_in_medium(k.nodes, k.medium);
    const ShadowBuffers b{guides.sun_depth.data(), rows.data()};
    PILEUS_TRY(run_rows(context, context.kernels->shadow_rows, k, b,
                        std::uint32_t(k.nodes.size[1] * k.nodes.size[2])));
    if (lighting.solids != nullptr)
        PILEUS_TRY(solid_visibility(context, *lighting.solids, guides.nodes, lighting.to_sun,
                                    guides.visibility));
    pack(context, rows, guides);
    return Status::ok();
}

/// One plane has the sun's first order, per irradiance; the others what nodes hold.
MarchParams march_params(const Medium& medium, const MediumView& view, const Lighting& lighting,
                         const CameraParams& camera, const NodeGrid& nodes) {
    MarchParams k{};
    k.medium = view;
    k.camera = camera;
    k.lattice = whole_lattice(camera);
    k.media = medium.count;
    for (std::size_t a = 0; a < 3; ++a) k.sun_travel[a] = -lighting.to_sun[a];
    for (int i = 0; i < medium.count; ++i) {
        const Optics& optics = medium.optics[std::size_t(i)];
        k.phase[i] = optics.phase;
        const float albedo = (optics.albedo[0] + optics.albedo[1] + optics.albedo[2]) / 3;
        k.sun_source[i][0] = lighting.sunlit ? albedo : 0;
    }
    k.shadow = k.source = nodes;
    k.channels = kGuidePlanes;
    k.together = 1;
    return k;
}

/// Alpha, depths and the sun's guides, whose light is on nodes.
Status march_sunlight(const Context& context, const Medium& medium, const MediumView& view,
                      const Lighting& lighting, const CameraParams& camera, bool half_depth,
                      Planes& planes, FilterGuides& guides) {
    const std::uint32_t rows = std::uint32_t(camera.height);
    const std::uint64_t pixels = std::uint64_t(camera.width) * rows;
    const StageClock clock(context, "alpha");
    PILEUS_TRY(allocate(arrays::picture_planes(1, pixels), planes.optical_depth));
    PILEUS_TRY(allocate(arrays::guide_planes(pixels), guides.planes));
    if (lighting.opaque()) {
        BackgroundParams k{};
        k.medium = view;
        k.camera = camera;
        k.ground = lighting.ground.present ? 1 : 0;
        k.ground_z = float(lighting.ground.z);
        const BackgroundBuffers b{nullptr, nullptr, planes.opaque_depth.data()};
        PILEUS_TRY(show_background(context, lighting, k, b));
    }
    const MarchParams k = march_params(medium, view, lighting, camera, guides.nodes);
    MarchBuffers b{};
    b.opaque_depth = planes.opaque_depth.data();
    b.parts = medium.parts.data();
    b.transmittance = planes.transmittance.data();
    b.half_depth = half_depth ? planes.half_depth.data() : nullptr;
    b.ray_depth = planes.optical_depth.data();
    b.colour = guides.planes.data();
    b.quads = guides.quads.data();
    b.optical_depth = guides.sun_depth.data();
    b.visibility = guides.visibility.data();
    PILEUS_TRY(run_rows(context, context.kernels->march_rows, k, b, rows));
    return Status::ok();
}

/// The lamps that light the middle of the box most: of each its nodes are kept while it is marched.
Lighting guiding_lamps(const Lighting& all, const Medium& medium) {
    Lighting out;
    out.lamps = all.lamps;
    if (out.lamps.size() <= kMaxGuidingLamps) return out;
    // No sort of the library: flights have no recursion.
    const auto light = [&](const LampParams& lamp) {
        if (lamp.parallel != 0) return lamp.strength;
        float square = 0;
        for (int a = 0; a < 3; ++a) {
            const float way = lamp.at[a] - 0.5f * float(medium.extent_m[a]);
            square += way * way;
        }
        return lamp.strength / std::max(square, lamp.least_square);
    };
    for (std::size_t i = 0; i < kMaxGuidingLamps; ++i) {
        std::size_t brightest = i;
        for (std::size_t j = i + 1; j < out.lamps.size(); ++j)
            if (light(out.lamps[j]) > light(out.lamps[brightest])) brightest = j;
        std::swap(out.lamps[i], out.lamps[brightest]);
    }
    out.lamps.resize(kMaxGuidingLamps);
    return out;
}

/// The mean of the channels of what lamps bring into a plane of the guides.
Status show_lamps(const Context& context, const Medium& medium, const LampMarchParams& k,
                  const LampNodes& nodes, const Planes& planes, float* guide) {
    const std::size_t pixels = planes.transmittance.size();
    Planes own;
    PILEUS_TRY(allocate(arrays::picture_planes(3, pixels, Stage::kPaths), own.colour));
    PILEUS_TRY(allocate(arrays::picture_planes(1, planes.opaque_depth.size(), Stage::kPaths),
                        own.opaque_depth));
    std::copy_n(planes.opaque_depth.data(), planes.opaque_depth.size(), own.opaque_depth.data());
    // Who ends a step does so between two units.
    PILEUS_TRY(add_lamp_light(context, medium, k, nodes, own, 0, nullptr, true));
    for (std::size_t i = 0; i < pixels; ++i)
        guide[i] = (own.colour[i] + own.colour[pixels + i] + own.colour[2 * pixels + i]) / 3;
    return Status::ok();
}

/// Lamps' light scattered once in place of the last plane; without a sun in place of the first,
/// and what of it gets through a part of the extinction, turned to all sides, in that of the next.
Status guide_by_lamps(const Context& context, const Medium& medium, const Majorants& majorants,
                      const Lighting& lighting, const CameraParams& camera, const Planes& planes,
                      FilterGuides& guides) {
    const Lighting lamps = guiding_lamps(lighting, medium);
    LampNodes nodes;
    PILEUS_TRY(make_lamp_nodes(context, medium, majorants, lamps, false, nodes));
    LampMarchParams k = lamp_march_params(medium, majorants, lamps, camera, nodes, 0);
    k.emits = k.ground = 0;
    const std::size_t pixels = planes.transmittance.size();
    float* const first = guides.planes.data();
    PILEUS_TRY(show_lamps(context, medium, k, nodes, planes,
                          lighting.sunlit ? first + 2 * pixels : first));
    if (lighting.sunlit) return Status::ok();
    for (float& depth : nodes.optical_depth.span()) depth *= kGuideShares[0];
    for (int i = 0; i < k.media; ++i) k.phase[i] = {kPhaseHg, 0, 0, 1};
    return show_lamps(context, medium, k, nodes, planes, first + pixels);
}

/// Nodes are the march's alone, and are given back however it ends.
class NodesOfMarch {
public:
    explicit NodesOfMarch(FilterGuides& guides) : guides_(guides) {}
    ~NodesOfMarch() {
        guides_.quads = Buffer<float>();
        guides_.sun_depth = Buffer<float>();
        guides_.visibility = Buffer<float>();
    }
    NodesOfMarch(const NodesOfMarch&) = delete;
    NodesOfMarch& operator=(const NodesOfMarch&) = delete;

private:
    FilterGuides& guides_;
};

}  // namespace

Array<float> arrays::guide_nodes(const Medium& medium, bool solids) {
    return {"light on nodes for the filter",
            bytes_of(node_count(guide_grid(medium)), solids ? 6 : 5), Stage::kPaths, Stage::kPaths};
}

Array<float> arrays::guide_lamps(const Medium& medium, std::size_t lamps) {
    return {"optical depths to lights for the filter",
            bytes_of(node_count(lamp_node_grid(medium)), std::min(lamps, kMaxGuidingLamps)),
            Stage::kPaths, Stage::kPaths};
}

Status march_guides(const Context& context, const Medium& medium, const Majorants& majorants,
                    const Lighting& lighting, const CameraParams& camera, bool half_depth,
                    Planes& planes, FilterGuides& guides) {
    const MediumView view = make_medium_view(medium, majorants);
    const NodesOfMarch nodes(guides);
    PILEUS_TRY(light_nodes(context, medium, view, lighting, guides));
    PILEUS_TRY(march_sunlight(context, medium, view, lighting, camera, half_depth, planes, guides));
    if (!kLights || lighting.lamps.empty()) return Status::ok();
    return guide_by_lamps(context, medium, majorants, lighting, camera, planes, guides);
}

}  // namespace pileus
