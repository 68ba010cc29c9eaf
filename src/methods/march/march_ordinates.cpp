// SPDX-License-Identifier: Apache-2.0
// Light by discrete ordinates for a marched picture, and what of scenes it does not know.
// in: a view -> out: MarchLight::ordinates.
// docs/ordinates.md
#include <algorithm>

#include "src/methods/march/march_state.h"
#include "src/world/world.h"

namespace pileus {

namespace {

/// What of a scene discrete ordinates do not know; null: they know it all.
const char* beyond_ordinates(const RaymarchSettings& s) {
    if (s.look.powder != RaymarchPowderKind::kNone) return "powder";
    if (s.light.cone) return "light_path = \"cone\"";
    if (s.march.integrator != RaymarchIntegrator::kClosed) return "an integrator but \"closed\"";
    if (s.look.peak_phase) return "phase = \"peak\"";
    if (!s.light.sky_ambient) return "sky_light = \"none\"";
    if (s.look.ambient[0] > 0 || s.look.ambient[1] > 0 || s.look.ambient[2] > 0) return "ambient";
    return nullptr;
}

/// Whether the scene says how octaves should be.
bool has_own_octaves(const RaymarchSettings& s) {
    const RaymarchSettings plain;
    return s.scattering.octaves != plain.scattering.octaves ||
           s.scattering.octave_extinction != plain.scattering.octave_extinction ||
           s.scattering.octave_share != plain.scattering.octave_share ||
           s.scattering.octave_anisotropy != plain.scattering.octave_anisotropy;
}

}  // namespace

Status choose_scattering(const FrameView& view, MarchChoice& choice) {
    RaymarchSettings& s = choice.settings;
    choice.beyond_ordinates = nullptr;
    if (!s.scattering.automatic && !s.scattering.ordinates) return Status::ok();
    const char* beyond = beyond_ordinates(s);
    if (s.scattering.automatic) {
        if (beyond == nullptr && has_own_octaves(s)) beyond = "keys of octaves";
        choice.beyond_ordinates = beyond;
        s.scattering.ordinates = beyond == nullptr;
        return Status::ok();
    }
    if (beyond == nullptr) return Status::ok();
    return Status::bad_input(view.scene.file +
                             ": raymarch.scattering: \"ordinates\" goes with no " + beyond +
                             " so far, allowed: auto, single, forward, octaves, or a scene "
                             "without");
}

const SunDepth* sun_of_nodes(const Medium& medium, const MarchState& state) {
    const bool read = has_thin_voxels(medium) && !state.choice.march_light;
    return read ? &state.light.sun.nodes : nullptr;
}

namespace {

OrdinateAsk ask_of(const Medium& medium, const OwnLight& own, const MarchState& state) {
    OrdinateAsk ask;
    ask.sun = sun_of_nodes(medium, state);
    ask.lamps = &state.light.lamps;
    ask.first_lamp = own.first_lamp;
    ask.lamp_count = own.lamps;
    ask.beside = own.beside;
    ask.emission = own.emission;
    ask.ground = true;
    return ask;
}

/// Of a sky in place, lit by `lighting`.
Status light_sky_levels(const Context& context, const FrameView& view, const Lighting& lighting,
                        int pictures, MarchState& state) {
    const Medium& medium = marched_medium(view, state);
    RaymarchInput in;
    in.medium = &medium;
    in.majorants = &state.media.majorants;
    in.lighting = &lighting;
    in.settings = &state.choice.settings;
    in.march_light = true;
    in.layer = &view.world.layer;
    in.camera = view.camera;
    const RaymarchParams march = raymarch_params(in);
    SkyOrdinateAsk ask;
    ask.march = &march;
    ask.sky = &view.world.layer.params;
    ask.camera = view.camera;
    ask.pictures = pictures;
    return follow_sky_ordinates(context, medium, state.media.majorants, lighting, ask,
                                state.light.ordinates.sky);
}

}  // namespace

bool has_thin_voxels(const Medium& medium) {
    constexpr double kThickVoxel = 1;
    double edge = 0;
    for (float cell : medium.grid.cell_m) edge = std::max(edge, double(cell));
    return max_extinction(medium) * edge < kThickVoxel;
}

bool may_have_lamps(const FrameView& view, const MarchChoice& choice) {
    return kLights && (choice.hosted || !view.scene.lights.empty());
}

bool has_lamp_spots(const FrameView& view, const MarchChoice& choice) {
    return choice.settings.scattering.ordinates && !view.world.direct_sky;
}

OwnLight own_light_of(const FrameView& view, const MarchState& state) {
    // Nodes have the lamps' spots on the ground, too; without a lamp they are of another light.
    const std::size_t lamps = view.lighting.lamps.empty() ? 0 : state.light.lamps.lamps.size();
    return {0, lamps, emits(view.world.medium), -1};
}

Status solve_ordinates_for(const Context& context, const FrameView& view, const Lighting& light,
                           const OwnLight& own, MarchState& state) {
    if (!state.light.ordinates.sky.levels.empty())
        return light_sky_levels(context, view, light, 1, state);
    OrdinateNodes& nodes = state.light.ordinates.nodes;
    if (nodes.density.empty()) return Status::ok();
    const Medium& medium = view.world.medium;
    const OrdinateAsk ask = ask_of(medium, own, state);
    PILEUS_TRY(make_ordinates(context, medium, state.media.majorants, light, ask, nodes));
    return turn_ordinates(context, medium, view.camera, true, nodes);
}

Status reserve_march_ordinates(MarchOrdinates& out) {
    out.slices.reserve();
    PILEUS_TRY(reserve_ordinates(out.nodes));
    return hold(arrays::ordinate_beams(out.nodes.filled.size(), kMaxOrdinateBeams), out.nodes.beam);
}

namespace {

/// What is due of a light that follows the sun by part of the work; false: all of it.
bool follows_slowly(const FrameView& view, const OrdinateAsk& ask, const MarchState& state,
                    const OrdinateFollow& follow) {
    const MarchOrdinates& ordinates = state.light.ordinates;
    return ordinates.followed && state.light.sky.made &&
           follow.due.size() < std::size_t(follow.slices) && ask.sun != nullptr &&
           ordinates.nodes.media == 1 && !view.world.solids.meshes;
}

/// After a picture that made light; `follow`: by part, null: by all.
void note_late(const FrameView& view, const OrdinateFollow* follow, MarchOrdinates& out) {
    if (follow == nullptr) hold_sun(view.lighting.to_sun, out.slices);
    out.ground_late = follow != nullptr && follow->solve;
    out.light_late =
        follow != nullptr && !follow->solve && (out.light_late || !follow->due.empty());
}

}  // namespace

Status light_ordinates(const Context& context, const FrameView& view, double slack_deg,
                       MarchState& state) {
    const Medium& medium = view.world.medium;
    MarchLight& light = state.light;
    // A host that lets light take several pictures has iterations go on from the last solution.
    // Where its sun has stood still for as many, light is what it is without.
    const int refresh = state.choice.hosted ? state.choice.settings.light.refresh : 1;
    if (!light.ordinates.sky.levels.empty())
        return light_sky_levels(context, view, view.lighting, refresh, state);
    if (light.ordinates.nodes.density.empty()) return Status::ok();
    const CameraParams& camera = view.camera;
    OrdinateAsk ask = ask_of(medium, own_light_of(view, state), state);
    // set_view tells of other lights than the sun's direction.
    bool solve = !light.sky.made || light.sky.to_sun != view.lighting.to_sun;
    if (solve) {
        light.ordinates.followed = refresh > 1 && !light.ordinates.nodes.sets.empty();
        light.ordinates.still = 0;
    } else if (light.ordinates.followed) {
        light.ordinates.followed = ++light.ordinates.still < refresh - 1;
        solve = !light.ordinates.followed || unsolved(light.ordinates.nodes) ||
                light.ordinates.light_late || light.ordinates.ground_late;
    }
    if (light.ordinates.followed) ask.iterations = kFollowedIterations;
    ask.keeps_beam = state.choice.hosted;
    OrdinateFollow follow;
    if (refresh > 1) {
        const SunTurn turn = march_turn(view, state);
        follow.slices = turn.slices;
        follow.due = follow_sun(turn, light.ordinates.slices);
        // Light and ground take turns.
        follow.solve = !light.ordinates.ground_late;
        solve = solve || (light.ordinates.followed && !follow.due.empty());
        if (follows_slowly(view, ask, state, follow)) ask.follow = &follow;
    }
    const bool seen = !solve && same_way(medium, slack_deg, light.sky.camera, camera);
    if (seen) return Status::ok();
    light.sky.made = false;
    if (solve)
        PILEUS_TRY(make_ordinates(context, medium, state.media.majorants, view.lighting, ask,
                                  light.ordinates.nodes));
    if (solve) note_late(view, ask.follow, light.ordinates);
    PILEUS_TRY(turn_ordinates(context, medium, camera, true, light.ordinates.nodes));
    light.sky.to_sun = view.lighting.to_sun;
    light.sky.camera = camera;
    light.sky.made = true;
    return Status::ok();
}

}  // namespace pileus
