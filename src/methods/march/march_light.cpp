// SPDX-License-Identifier: Apache-2.0
// Light of sun, sky and solids' shadows on nodes, before a picture is marched.
// in: a view -> out: MarchLight.
// docs/raymarch.md, "Light"
#include <algorithm>

#include "src/base/angles.h"
#include "src/methods/march/march_state.h"
#include "src/picture/march_view.h"
#include "src/picture/nodes/node_grid.h"
#include "src/picture/nodes/solid_shadow.h"
#include "src/world/world.h"

namespace pileus {
namespace {

constexpr std::uint64_t kComparedNodes = 1024;

/// Nodes serve every frame of the same sun; a sweep is made whole for each.
Status light_nodes(const Context& context, const FrameView& view, MarchState& state) {
    if (state.choice.march_light || !view.lighting.sunlit || view.world.medium.sigma <= 0)
        return Status::ok();
    const auto& to_sun = view.lighting.to_sun;
    PILEUS_TRY(make_lit_medium(context, view, state));
    const MarchMedia& media = state.media;
    MarchLight& light = state.light;
    const bool apart = !media.lit.volume.density.empty();
    const Medium& medium = apart ? media.lit : marched_medium(view, state);
    const Majorants& majorants = apart ? media.lit_majorants : media.majorants;
    if (state.choice.settings.light.kind != RaymarchLightKind::kBuffer) {
        // Coarser densities reach farther than the medium's own.
        const MediumView read = state.choice.levels > 0
                                    ? MediumView{}
                                    : make_medium_view(view.world.medium, media.majorants);
        return follow_sun_depth(
            context, medium, majorants, read,
            media.wide_sun ? wide_sun_depth_nodes(view.world.medium) : sun_depth_nodes(medium),
            march_turn(view, state), light.sun.slices, light.sun.nodes);
    }
    if (!light.sun.nodes.optical_depth.empty() && light.sun.to_sun == to_sun) return Status::ok();
    PILEUS_TRY(
        make_sun_depth(context, medium, majorants, to_sun, SunDepthKind::kSwept, light.sun.nodes));
    // A thousand rays tell what the sweep smears.
    light.sun.difference = {};
    if (light.sun.nodes.swept)
        PILEUS_TRY(sun_depth_difference(context, medium, majorants, to_sun, light.sun.nodes,
                                        kComparedNodes, light.sun.difference));
    light.sun.to_sun = to_sun;
    return Status::ok();
}

/// Light of sky and ground changes with the sun, and with the camera where that is known.
Status light_sky(const Context& context, const FrameView& view, double slack_deg,
                 MarchState& state) {
    const Medium& medium = view.world.medium;
    const RaymarchSettings& settings = state.choice.settings;
    if (!settings.light.sky_ambient || settings.scattering.ordinates || medium.sigma <= 0)
        return Status::ok();
    MarchLight& light = state.light;
    const CameraParams& camera = view.camera;
    const SkyView sky = sky_view(view, state);
    const bool seen = !sky.turned || same_way(medium, slack_deg, light.sky.camera, camera);
    if (light.sky.made && seen && light.sky.to_sun == view.lighting.to_sun) return Status::ok();
    light.sky.made = false;
    light.sky.to_sun = view.lighting.to_sun;
    light.sky.camera = camera;
    PILEUS_TRY(make_sky_nodes(context, medium, state.media.majorants, view.lighting,
                              mean_kept(settings.scattering, medium),
                              octaves_of(settings.scattering), sky, light.sky.nodes));
    light.sky.made = true;
    return Status::ok();
}

/// The shadow of solids, on nodes two voxels apart.
Status shade_by_solids(const Context& context, const FrameView& view, MarchLight& light) {
    const Medium& medium = view.world.medium;
    if (!view.world.solids.meshes || !view.lighting.sunlit || medium.sigma <= 0)
        return Status::ok();
    float coarse = 0;
    for (float cell : medium.grid.cell_m) coarse = cell > coarse ? cell : coarse;
    light.sun.visibility_nodes = make_node_grid(medium.grid, medium.extent_m, 2 * double(coarse));
    return solid_visibility(context, view.world.solids, light.sun.visibility_nodes,
                            view.lighting.to_sun, light.sun.visibility);
}

}  // namespace

bool same_way(const Medium& medium, double slack_deg, const CameraParams& a,
              const CameraParams& b) {
    const bool flat = a.orthographic != 0;
    const float* from = flat ? a.forward : a.origin;
    const float* to = flat ? b.forward : b.origin;
    if (a.orthographic != b.orthographic) return false;
    if (std::equal(from, from + 3, to)) return true;
    if (slack_deg <= 0 || flat) return false;
    double aa = 0, bb = 0, ab = 0, ball = 0;
    for (int i = 0; i < 3; ++i) {
        const double half = 0.5 * medium.extent_m[i];
        const double x = double(from[i]) - half, y = double(to[i]) - half;
        aa += x * x, bb += y * y, ab += x * y, ball += half * half;
    }
    const double least = sincos_deg(slack_deg).cosine;
    return aa > 2 * ball && bb > 2 * ball && ab > 0 && ab * ab > least * least * aa * bb;
}

SunTurn march_turn(const FrameView& view, const MarchState& state) {
    return turn_of_sun(view, state.choice.settings.light.refresh, state.light.turn);
}

SkyView sky_view(const FrameView& view, const MarchState& state) {
    SkyView out;
    const World& world = view.world;
    out.turned = !state.choice.look && !world.medium.grid.periodic &&
                 !(world.direct_sky && world.layer.params.boxed == 0);
    out.camera = view.camera;
    out.anisotropy = float(state.choice.settings.scattering.octave_anisotropy);
    return out;
}

Status light_march(const Context& context, const FrameView& view, double slack_deg,
                   MarchState& state) {
    PILEUS_TRY(light_nodes(context, view, state));
    PILEUS_TRY(shade_by_solids(context, view, state.light));
    PILEUS_TRY(light_sky(context, view, slack_deg, state));
    if (!state.choice.settings.scattering.ordinates) return Status::ok();
    if (!view.lighting.lamps.empty() && view.world.medium.sigma > 0)
        PILEUS_TRY(make_lamp_nodes(context, view.world.medium, state.media.majorants, view.lighting,
                                   has_lamp_spots(view, state.choice), state.light.lamps));
    return light_ordinates(context, view, slack_deg, state);
}

}  // namespace pileus
