// SPDX-License-Identifier: Apache-2.0
// What a march is made by: settings of two methods, where sunlight comes from, levels of detail.
// in: scene, budget, sizes of the media -> out: MarchChoice.
// docs/raymarch.md; docs/optical-depth.md
#include "src/methods/march/march_state.h"
#include "src/picture/whole_rays.h"
#include "src/world/camera/view.h"
#include "src/world/world.h"

namespace pileus {
namespace {

/// Cells that a straight way through the grid crosses, about.
double cells_across(const Grid& grid) {
    return (double(grid.size[0]) + double(grid.size[1]) + double(grid.size[2])) / 3;
}

/// Metres that a camera which turns about its target is away from the medium at most.
double reach_of(const Camera& c, const Medium& medium) {
    double from_target = 0, target = 0, diagonal = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        const double arm = c.position_m[a] - c.target_m[a];
        const double off = c.target_m[a] - medium.low_m[a] - 0.5 * medium.extent_m[a];
        from_target += arm * arm;
        target += off * off;
        diagonal += medium.extent_m[a] * medium.extent_m[a];
    }
    return __builtin_sqrt(from_target) + __builtin_sqrt(target) + 0.5 * __builtin_sqrt(diagonal);
}

/// Marching from every sample, or from every node: what takes fewer samples of the density. About
/// 64 samples of a ray lie where light still matters; half a way leads out of the medium.
void choose_light(const FrameView& view, MarchChoice& choice) {
    const RaymarchSettings& s = choice.settings;
    const Grid& grid = view.world.medium.grid;
    choice.sky_nodes = view.world.direct_sky && s.light.kind == RaymarchLightKind::kAuto &&
                       !s.light.cone && s.light.steps > kNearSteps;
    choice.march_light = s.light.kind == RaymarchLightKind::kMarch || s.light.cone;
    choice.light_why = s.light.cone ? "light_path = \"cone\"" : "as the scene asks";
    if (s.light.cone || s.light.kind != RaymarchLightKind::kAuto) return;
    if (view.world.direct_sky) {
        choice.march_light = true;
        choice.light_why = "the sky is evaluated in place";
        if (choice.sky_nodes) choice.light_why = "steps from nodes around the camera";
        return;
    }
    if (grid.constant) {
        choice.march_light = true;
        choice.light_why = "light between the nodes of constant cells is not linear";
        return;
    }
    if (s.scattering.ordinates) {
        choice.march_light = false;
        choice.light_why = "scattering = \"ordinates\"";
        return;
    }
    const double pixels = double(view.scene.camera.whole_pixels());
    const double way = 0.5 * cells_across(grid);
    const double lit = double(s.march.steps < 64 ? s.march.steps : 64) * pixels;
    const double marched = lit * (s.light.steps > 0 ? double(s.light.steps) : way);
    const double nodes = double(voxel_count(grid)) * way;
    choice.march_light = marched < nodes;
    explain_march_light(marched, nodes, choice);
}

/// What both methods have; of settings, where a time leaves all.
void take_inputs(const MethodInputs& inputs, MarchChoice& choice) {
    choice.hosted = inputs.live;
    if (inputs.live) choice.settings.march.stop_below = host_stop(choice.settings.march.stop_below);
    choice.seconds = inputs.budget.seconds;
    choice.whole_steps = choice.settings.march.steps;
    choice.whole_thin = choice.settings.thin;
}

}  // namespace

MarchChoice raymarch_choice(const MethodInputs& inputs) {
    MarchChoice out;
    out.settings = inputs.scene.raymarch;
    if (inputs.budget.steps >= 0) out.settings.march.steps = int(inputs.budget.steps);
    take_inputs(inputs, out);
    return out;
}

MarchChoice optical_depth_choice(const MethodInputs& inputs) {
    MarchChoice out;
    OpticalDepthSettings look = inputs.scene.optical_depth;
    const bool unseen = inputs.budget.steps == 0;
    if (inputs.budget.steps >= 0) look.steps = int(inputs.budget.steps);
    RaymarchSettings& s = out.settings;
    s.scattering.many = s.scattering.automatic = false;
    s.march.spacing =
        look.steps > 0 || unseen ? RaymarchSpacing::kUniform : RaymarchSpacing::kVoxel;
    s.march.steps = look.steps > 0 || unseen ? look.steps : 1;
    s.light.kind = look.exact ? RaymarchLightKind::kBufferExact : RaymarchLightKind::kBuffer;
    s.look.ambient = look.ambient;
    s.light.sky_ambient = false;
    s.march.stop_below = look.stop_below;
    out.look = look;
    take_inputs(inputs, out);
    return out;
}

void choose_march(const FrameView& view, MarchChoice& choice) {
    const Medium& medium = view.world.medium;
    const Camera& camera = view.scene.camera;
    choose_light(view, choice);
    choice.levels = raymarch_levels(choice.settings, make_camera(camera, 0, medium.low_m), medium,
                                    reach_of(camera, medium));
}

int sky_light_bits(const MarchChoice& choice) {
    return choice.settings.thin.every() > 1 ? kMaxSkyLightBits - 1 : kMaxSkyLightBits;
}

}  // namespace pileus
