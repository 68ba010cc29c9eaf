// SPDX-License-Identifier: Apache-2.0
// One frame of a march: light on nodes, background, marched pixels, lamps.
// in: a prepared MarchState -> out: its planes.
// docs/raymarch.md
#include "platform/clock.h"
#include "src/methods/march/march_budget.h"
#include "src/methods/march/march_parts.h"
#include "src/methods/march/march_sea.h"
#include "src/picture/background.h"
#include "src/picture/blue_noise.h"
#include "src/picture/late_rows.h"
#include "src/picture/march_view.h"
#include "src/picture/ordinates/ordinate_ground.h"
#include "src/world/world.h"

namespace pileus {
namespace {

/// Light of [[light]], scattered once or by octaves, and of the media: its own march, in steps of
/// the grid.
Status add_lamps(const Context& context, const FrameView& view, MarchState& state) {
    const Medium& medium = marched_medium(view, state);
    if ((view.lighting.lamps.empty() && !emits(medium)) || state.choice.settings.march.steps == 0)
        return Status::ok();
    LampNodes& lamps = state.light.lamps;
    PILEUS_TRY(make_lamp_nodes(context, medium, state.media.majorants, view.lighting,
                               has_lamp_spots(view, state.choice), lamps));
    return add_lamp_light(context, medium, march_lamps(view, state), lamps, state.picture.planes, 0,
                          lamp_tables(state));
}

/// A trial for a budget of seconds needs any row's depths.
LateRows* late_march(const FrameView& view, LateRows* late, const MarchState& state) {
    if (state.choice.seconds > 0) return nullptr;
    return late_rows_of(late, view.lighting, view.world.medium, state.choice.settings.thin,
                        view.camera, view.frame);
}

/// Empty planes of the layers that are asked for.
Status allocate_picture(const Context& context, const FrameView& view, MarchPicture& picture) {
    // Clearing memory is part of it.
    const StageClock clock(context, "background");
    Planes& planes = picture.planes;
    PILEUS_TRY(allocate_planes(view.camera.width, view.camera.height, 3, view.lighting.opaque(),
                               view.wants_depth(), planes));
    if (view.scene.output.layer_optical_depth)
        PILEUS_TRY(
            allocate(arrays::picture_planes(1, planes.transmittance.size()), planes.optical_depth));
    return Status::ok();
}

}  // namespace

RaymarchInput march_input(const FrameView& view, const MarchState& state) {
    const MarchLight& light = state.light;
    RaymarchInput in;
    in.medium = &marched_medium(view, state);
    in.majorants = &state.media.majorants;
    in.lighting = &view.lighting;
    in.settings = &state.choice.settings;
    in.look = state.choice.look ? &*state.choice.look : nullptr;
    in.nodes.sun = &light.sun.nodes;
    in.nodes.visibility_grid = light.sun.visibility_nodes;
    in.nodes.visibility = light.sun.visibility.data();
    if (state.choice.settings.scattering.ordinates && !light.ordinates.sky.levels.empty()) {
        in.nodes.ordinates = &light.ordinates.sky.front;
        in.nodes.sky_levels = &light.ordinates.sky.view;
    } else if (state.choice.settings.scattering.ordinates && !light.ordinates.nodes.density.empty())
        in.nodes.ordinates = &light.ordinates.nodes;
    else
        in.nodes.sky = &light.sky.nodes;
    if (has_meshes(view.lighting)) in.nodes.surfaces = state.picture.planes.background.data();
    in.nodes.hidden = view.environment.depth.present;
    in.levels = &state.media.coarse;
    in.march_light = state.choice.march_light;
    in.noise = &state.picture.noise;
    // Frame f of an animation has the jitter of the seed f further on.
    in.seed = std::uint64_t(view.scene.seed) + std::uint64_t(view.frame);
    in.layer = view.world.direct_sky ? &view.world.layer : nullptr;
    in.camera = view.camera;
    return in;
}

const float* lamp_tables(const MarchState& state) {
    return state.light.ordinates.nodes.peak.tables.data();
}

LampMarchParams march_lamps(const FrameView& view, const MarchState& state) {
    const Medium& medium = marched_medium(view, state);
    const RaymarchSettings& settings = state.choice.settings;
    const auto& look = state.choice.look;
    LampMarchParams k = lamp_march_params(medium, state.media.majorants, view.lighting, view.camera,
                                          state.light.lamps, settings.march.stop_below);
    k.octaves = octaves_of(settings.scattering);
    set_octaves(settings, medium, k.albedo, k.octave_g, k.octave_source);
    k.octave_depths = octave_depths(k.octaves, medium);
    k.forward = settings.scattering.forward ? 1 : 0;
    (void)keep_forward(settings.scattering, medium, k.kept);
    const OrdinateNodes& nodes = state.light.ordinates.nodes;
    if (settings.scattering.ordinates && !nodes.density.empty()) {
        k.ordinates = medium.channels;
        k.peak_turn = ordinate_peak();
        k.beam_sets = nodes.peak.sets;
        k.beam_points = nodes.peak.points ? 1 : 0;
        for (int c = 0; c < 3; ++c) {
            k.beam_rest[c] = nodes.peak.rest[c];
            k.surface_rest[c] = nodes.mean_rest[c];
            for (int i = 0; i < k.media; ++i) k.rest[i][c] = nodes.optics[i][c].rest;
        }
    }
    for (int i = 0; i < k.media; ++i) {
        float unit = 1;
        if (settings.look.peak_phase) unit = 1.0f / phase_peak(k.phase[i]);
        if (look) {
            // As the sun's light in this method: twice, and with a phase function of its own.
            if (look->g >= -1) k.phase[i] = {kPhaseHg, float(look->g), 0, 1};
            unit = float(2 * look->intensity);
        }
        for (float& albedo : k.albedo[i]) albedo *= unit;
    }
    return k;
}

Status march_background(const Context& context, const FrameView& view, const Lighting& light,
                        MarchState& state, Planes& planes) {
    const Medium& medium = view.world.medium;
    GroundShadow& shadow = state.light.ground_shadow;
    const MediumView read = make_medium_view(medium, state.media.majorants);
    PILEUS_TRY(make_ground_shadow(context, medium, read, view.lighting, view.camera,
                                  march_turn(view, state), shadow));
    const StageClock clock(context, "background");
    BackgroundParams k = background_params(read, view.camera, light);
    BackgroundBuffers b{nullptr, planes.background.data(), planes.opaque_depth.data()};
    read_ground_shadow(shadow, k, b);
    if (state.choice.settings.scattering.ordinates)
        read_ordinate_light(state.light.ordinates.nodes, light, k, b);
    const SeaMirror& mirror = state.picture.mirror;
    if (mirror.map.columns > 0) {
        k.paint.sky = mirror.map;
        k.paint.mirror_m = light.ground.paint.mirror_m;
        for (int a = 0; a < 3; ++a) k.paint.mirror_from[a] = mirror.from[a];
    }
    if (planes.late != nullptr) return leave_background(context, k, b, *planes.late);
    return show_background(context, light, k, b);
}

Status march_frame(const Context& context, const FrameView& view, const RenderAsk& ask,
                   MarchState& state) {
    MarchPicture& picture = state.picture;
    const double start_s = wall_seconds();
    if (state.choice.settings.march.jitter == RaymarchJitterKind::kBlueNoise &&
        picture.noise.empty())
        PILEUS_TRY(make_blue_noise(picture.noise));
    PILEUS_TRY(light_march(context, view, ask.view_slack_deg, state));
    PILEUS_TRY(allocate_picture(context, view, picture));
    picture.planes.late = late_march(view, ask.late, state);
    if (!ask.media_only)
        PILEUS_TRY(mirror_sky(context, view, march_input(view, state), view.lighting, state));
    if (ask.media_only)
        PILEUS_TRY(
            show_nothing_behind(view.lighting, view.camera, context.threads, picture.planes));
    else
        PILEUS_TRY(march_background(context, view, view.lighting, state, picture.planes));
    RaymarchInput in = march_input(view, state);
    UpsampleInput thin;
    thin.camera = view.camera;
    thin.medium = make_medium_view(*in.medium, state.media.majorants);
    thin.to_sun = view.lighting.to_sun;
    thin.march = [&](const PixelLattice& lattice, Planes& planes) {
        in.lattice = lattice;
        return raymarch_picture(context, in, planes, picture.tally);
    };
    if (has_sky_light(view, state)) {
        SkyLight& nodes = state.light.sky.layer;
        PILEUS_TRY(follow_sky_light(context, raymarch_params(in), view.world.layer.params,
                                    sky_light_bits(state.choice), kNearSteps,
                                    march_turn(view, state), nodes));
        in.nodes.sky_light = &nodes.view;
    }
    PILEUS_TRY(choose_march_work(context, view, start_s, thin, state));
    thin.settings = state.choice.settings.thin;
    PILEUS_TRY(upsample_picture(context, thin, view.frame, picture.upsample, picture.planes));
    return add_lamps(context, view, state);
}

}  // namespace pileus
