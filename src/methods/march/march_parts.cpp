// SPDX-License-Identifier: Apache-2.0
// Parts of a marched picture's light: of the sun, of each lamp, emitted, scattered once.
// in: MarchState whose picture is marched -> out: planes of the layers light and order.
// docs/formats.md, "Pictures out"; docs/raymarch.md, "Parts of the light". Each is a march of its
// own.
#include "src/methods/march/march_parts.h"

#include <algorithm>

#include "src/methods/march/march_sea.h"
#include "src/picture/whole_rays.h"

namespace pileus {
namespace {

constexpr float kDark[3] = {0, 0, 0};

Status no_light(const MarchState& state, Buffer<float>& out) {
    return allocate(arrays::picture_planes(3, state.picture.planes.transmittance.size()), out);
}

Status allocate_part(const FrameView& view, Planes& part) {
    return allocate_planes(view.camera.width, view.camera.height, 3, view.lighting.opaque(), false,
                           part);
}

void take_opaque_depth(const Planes& from, Planes& part) {
    std::copy_n(from.opaque_depth.data(), from.opaque_depth.size(), part.opaque_depth.data());
}

/// A picture of `in` alone, before the background that `light` shows; null: before none.
Status show_part(const Context& context, const FrameView& view, const RaymarchInput& in,
                 const Lighting* light, MarchState& state, Planes& part) {
    PILEUS_TRY(allocate_part(view, part));
    if (light != nullptr) {
        PILEUS_TRY(mirror_sky(context, view, in, *light, state));
        PILEUS_TRY(march_background(context, view, *light, state, part));
    }
    take_opaque_depth(state.picture.planes, part);
    RaymarchTally counted;  // of the picture's own march alone
    return raymarch_picture(context, in, part, counted);
}

/// What rays bring: the media's light and, through them, the background's.
void lay_over(Planes& part) {
    const std::size_t pixels = part.transmittance.size();
    for (std::size_t i = 0; i < 3 * pixels; ++i)
        part.colour[i] += part.transmittance[i % pixels] * part.background[i];
}

/// Light on nodes under another light; what nodes see of the sky is kept.
Status light_nodes_by(const Context& context, const FrameView& view, const Lighting& light,
                      const OwnLight& own, MarchState& state) {
    const Medium& medium = view.world.medium;
    const RaymarchSettings& settings = state.choice.settings;
    if (settings.scattering.ordinates) return solve_ordinates_for(context, view, light, own, state);
    if (!settings.light.sky_ambient || medium.sigma <= 0) return Status::ok();
    return make_sky_nodes(context, medium, state.media.majorants, light,
                          mean_kept(settings.scattering, medium), octaves_of(settings.scattering),
                          sky_view(view, state), state.light.sky.nodes);
}

Status light_nodes_by_ordinates(const Context& context, const FrameView& view,
                                const Lighting& light, const OwnLight& own, MarchState& state) {
    if (!state.choice.settings.scattering.ordinates) return Status::ok();
    return solve_ordinates_for(context, view, light, own, state);
}

/// The media's light, without their own, under `light` in place of the picture's, before the
/// background that it shows, or before none. Nodes hold what it sends up from the ground, and then
/// all of it again.
Status show_under(const Context& context, const FrameView& view, const RaymarchInput& whole,
                  const Lighting& light, const OwnLight& own, bool background, MarchState& state,
                  Planes& part) {
    RaymarchSettings settings = state.choice.settings;
    std::copy_n(kDark, 3, settings.look.ambient.begin());
    RaymarchInput in = whole;
    in.lighting = &light;
    in.settings = &settings;
    PILEUS_TRY(light_nodes_by(context, view, light, own, state));
    PILEUS_TRY(show_part(context, view, in, background ? &light : nullptr, state, part));
    return light_nodes_by(context, view, view.lighting, own_light_of(view, state), state);
}

Status show_sun(const Context& context, const FrameView& view, const RaymarchInput& whole,
                MarchState& state, Planes& part) {
    PILEUS_TRY(show_under(context, view, whole, sun_alone(view.lighting), {}, true, state, part));
    lay_over(part);
    state.picture.planes.sun.swap(part.colour);
    return Status::ok();
}

Status show_emission(const Context& context, const FrameView& view, const RaymarchInput& whole,
                     MarchState& state, Planes& part) {
    Lighting dark = sun_alone(view.lighting);
    dark.sunlit = false;
    dark.sun_irradiance = dark.ground.diffuse = dark.ground.sun = dark.ground.lamps = {};
    RaymarchInput in = whole;
    in.lighting = &dark;
    in.nodes.sky = nullptr;
    PILEUS_TRY(light_nodes_by_ordinates(context, view, dark, {0, 0, true, -1}, state));
    const bool lights_ground = whole.nodes.ordinates != nullptr;
    PILEUS_TRY(show_part(context, view, in, lights_ground ? &dark : nullptr, state, part));
    if (lights_ground) lay_over(part);
    PILEUS_TRY(
        light_nodes_by_ordinates(context, view, view.lighting, own_light_of(view, state), state));
    if (march_emits(view, state) && state.choice.settings.march.steps > 0) {
        LampMarchParams k = march_lamps(view, state);
        k.lamps = k.ground = 0;
        PILEUS_TRY(add_lamp_light(context, marched_medium(view, state), k, state.light.lamps, part,
                                  0, lamp_tables(state)));
    }
    state.picture.planes.emission.swap(part.colour);
    return Status::ok();
}

/// What the ground sends up of one lamp's light, scattered by the media; with ordinates what these
/// scatter more than once of the lamp's own, too.
Status show_ground_of_lamp(const Context& context, const FrameView& view,
                           const RaymarchInput& whole, std::size_t lamp, const Double3& radiance,
                           MarchState& state, Planes& part) {
    Lighting ground = sun_alone(view.lighting);
    ground.sunlit = false;
    ground.sun_irradiance = ground.ground.sun = {};
    ground.ground.lamps = radiance;
    return show_under(context, view, whole, ground, {lamp, 1, false, state.light.lamps.spot[lamp]},
                      whole.nodes.ordinates != nullptr, state, part);
}

Status show_each_lamp(const Context& context, const FrameView& view, const RaymarchInput& whole,
                      MarchState& state, Planes& part) {
    Planes& planes = state.picture.planes;
    const std::size_t count = view.lighting.lamps.size(), pixels = planes.transmittance.size();
    PILEUS_TRY(allocate(arrays::picture_planes(3 * count, pixels), planes.lamps));
    if (state.choice.settings.march.steps == 0) return Status::ok();
    std::copy_n(planes.transmittance.data(), pixels, part.transmittance.data());
    LampMarchParams k = march_lamps(view, state);
    k.emits = 0;
    k.lamps = 1;
    for (std::size_t i = 0; i < count; ++i) {
        const Double3 ground = ground_of_lamp(view.lighting, view.lighting.lamps[i]);
        const bool nodes = whole.nodes.sky != nullptr || whole.nodes.ordinates != nullptr;
        const bool lit = (ground != Double3{} || whole.nodes.ordinates != nullptr) && nodes &&
                         state.choice.settings.light.sky_ambient && view.world.medium.sigma > 0;
        std::fill_n(part.colour.data(), part.colour.size(), 0.0f);
        if (lit) PILEUS_TRY(show_ground_of_lamp(context, view, whole, i, ground, state, part));
        // The medium's light on the ground is there already.
        if (!lit || whole.nodes.ordinates == nullptr)
            std::fill_n(part.background.data(), part.background.size(), 0.0f);
        const auto add = [&](std::size_t lamp) {
            return add_lamp_light(context, marched_medium(view, state), k, state.light.lamps, part,
                                  lamp, lamp_tables(state));
        };
        PILEUS_TRY(add(i));
        const std::int32_t spot = state.light.lamps.spot[i];
        if (spot >= 0) PILEUS_TRY(add(std::size_t(spot)));
        lay_over(part);
        std::copy_n(part.colour.data(), 3 * pixels, planes.lamps.data() + 3 * pixels * i);
    }
    return Status::ok();
}

/// Light of sun, sky and lamps that the media scattered once, and that met no ground.
Status show_single(const Context& context, const FrameView& view, const RaymarchInput& whole,
                   MarchState& state, Planes& part) {
    RaymarchSettings settings = state.choice.settings;
    settings.scattering.many = settings.scattering.forward = settings.scattering.automatic = false;
    std::copy_n(kDark, 3, settings.look.ambient.begin());
    RaymarchInput in = whole;
    in.settings = &settings;
    in.nodes.ordinates = nullptr;
    if (settings.light.sky_ambient && view.world.medium.sigma > 0) {
        Lighting groundless = view.lighting;
        groundless.ground.diffuse = groundless.ground.sun = groundless.ground.lamps = {};
        PILEUS_TRY(make_sky_nodes(context, view.world.medium, state.media.majorants, groundless, 0,
                                  octaves_of(settings.scattering), sky_view(view, state),
                                  state.light.sky.single));
        in.nodes.sky = &state.light.sky.single;
    }
    PILEUS_TRY(show_part(context, view, in, nullptr, state, part));
    if (!view.lighting.lamps.empty() && settings.march.steps > 0) {
        LampMarchParams k = march_lamps(view, state);
        k.emits = k.ground = 0;
        k.lamps = std::int32_t(view.lighting.lamps.size());
        k.octaves.count = 1;
        k.ordinates = k.beam_sets = 0;
        k.forward = 0;
        PILEUS_TRY(
            add_lamp_light(context, marched_medium(view, state), k, state.light.lamps, part, 0));
    }
    state.picture.planes.single.swap(part.colour);
    return Status::ok();
}

/// Parts of the picture's light.
Status show_parts(const Context& context, const FrameView& view, const RaymarchInput& in,
                  MarchState& state) {
    const OutputSettings& output = view.scene.output;
    Planes part;
    if (output.layer_light) {
        PILEUS_TRY(view.lighting.sunlit ? show_sun(context, view, in, state, part)
                                        : no_light(state, state.picture.planes.sun));
        if (march_emits(view, state)) PILEUS_TRY(show_emission(context, view, in, state, part));
        PILEUS_TRY(allocate_part(view, part));
        if (!view.lighting.lamps.empty()) {
            take_opaque_depth(state.picture.planes, part);
            PILEUS_TRY(show_each_lamp(context, view, in, state, part));
        }
    }
    return output.layer_order ? show_single(context, view, in, state, part) : Status::ok();
}

/// Data of whole rays: after all that looks at where colours end.
Status follow_march(const Context& context, const FrameView& view, const RaymarchInput& whole,
                    MarchState& state) {
    const RaymarchSettings& settings = state.choice.settings;
    const RayEnds ends{settings.march.stop_below, settings.thin.every() > 1};
    const auto march = [&](Planes& rays) {
        // The same steps without light.
        Lighting dark = sun_alone(view.lighting);
        dark.sunlit = false;
        dark.sun_irradiance = {};
        RaymarchSettings own = settings;
        own.march.stop_below = 0;
        own.scattering.many = own.scattering.forward = own.scattering.automatic = false;
        std::copy_n(kDark, 3, own.look.ambient.begin());
        RaymarchInput in = whole;
        in.lighting = &dark;
        in.settings = &own;
        in.nodes.sky = nullptr;
        in.nodes.ordinates = nullptr;
        RaymarchTally counted;  // of the picture's own march alone
        return raymarch_picture(context, in, rays, counted);
    };
    return follow_rays(view.scene.output, ends, march, state.picture.planes);
}

}  // namespace

bool march_emits(const FrameView& view, const MarchState& state) {
    const auto& ambient = state.choice.settings.look.ambient;
    return emits(marched_medium(view, state)) || ambient[0] > 0 || ambient[1] > 0 || ambient[2] > 0;
}

Status add_march_layers(const Context& context, const FrameView& view, MarchState& state) {
    RaymarchInput in = march_input(view, state);
    if (has_sky_light(view, state)) in.nodes.sky_light = &state.light.sky.layer.view;
    PILEUS_TRY(show_parts(context, view, in, state));
    return follow_march(context, view, in, state);
}

std::uint64_t march_part_planes(const FrameView& view, const MarchState& state) {
    const OutputSettings& output = view.scene.output;
    const std::uint64_t lights =
        1 + view.lighting.lamps.size() + (march_emits(view, state) ? 1u : 0u);
    return (output.layer_light ? 3 * lights : 0) + (output.layer_order ? 3u : 0u);
}

}  // namespace pileus
