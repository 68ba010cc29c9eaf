// SPDX-License-Identifier: Apache-2.0
// Light by discrete ordinates for a marched picture, and what of scenes it does not know.
// in: a view whose camera is in state.picture -> out: MarchLight::ordinates.
// docs/ordinates.md
#include "src/methods/march/march_state.h"
#include "src/world/world.h"

namespace pileus {

Status check_ordinates(const FrameView& view, const MarchChoice& choice) {
    const RaymarchSettings& s = choice.settings;
    const World& world = view.world;
    const OutputSettings& output = view.scene.output;
    const char* what = nullptr;
    if (world.medium.count > 1)
        what = "several media";
    else if (world.direct_sky)
        what = "a sky without a grid (medium.N.resolution)";
    else if (world.medium.detail.present())
        what = "detail";
    else if (world.solids.meshes || view.environment.depth.present)
        what = "solids";
    else if (output.layer_light || output.layer_order)
        what = "layers of parts of the light";
    else if (s.powder != RaymarchPowderKind::kNone)
        what = "powder";
    else if (s.light_cone)
        what = "light_path = \"cone\"";
    else if (s.integrator != RaymarchIntegrator::kClosed)
        what = "an integrator but \"closed\"";
    else if (s.peak_phase)
        what = "phase = \"peak\"";
    else if (s.ambient[0] > 0 || s.ambient[1] > 0 || s.ambient[2] > 0)
        what = "ambient";
    if (what == nullptr) return Status::ok();
    return Status::bad_input(view.scene.file +
                             ": raymarch.scattering: \"ordinates\" goes with no " + what +
                             " so far, allowed: single, forward, octaves, or a scene "
                             "without");
}

Status light_ordinates(const Context& context, const FrameView& view, MarchState& state) {
    const Medium& medium = view.world.medium;
    MarchLight& light = state.light;
    if (light.ordinates.density.empty()) return Status::ok();
    // set_view tells of other lights than the sun's direction.
    if (!light.sky_made || light.sky_to_sun != view.lighting.to_sun) {
        light.sky_made = false;
        PILEUS_TRY(
            make_ordinates(context, medium, state.media.majorants, view.lighting, light.ordinates));
        light.sky_to_sun = view.lighting.to_sun;
        light.sky_made = true;
        ++light.ordinates_made;
    }
    return turn_ordinates(context, medium, state.picture.camera, light.ordinates);
}

}  // namespace pileus
