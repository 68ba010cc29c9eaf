// SPDX-License-Identifier: Apache-2.0
// Parts of a marched picture's light: of the sun, of each lamp, emitted, scattered once.
// in: RaymarchRun whose picture is marched -> out: planes of the layers light and order.
// docs/formats.md, "Pictures out"; docs/raymarch.md, "Parts of the light". Each is a march of its
// own.
#include "src/march/march_parts.h"

#include <algorithm>

#include "src/scene/method_column.h"

namespace pileus {
namespace {

constexpr float kDark[3] = {0, 0, 0};

Status no_light(const RaymarchRun& run, Buffer<float>& out) {
    return allocate(arrays::picture_planes(3, run.planes.transmittance.size()), out);
}

/// A picture of `in` alone, before the background that `light` shows; null: before none.
Status show_part(const Context& context, const RaymarchInput& in, const Lighting* light,
                 RaymarchRun& run, Planes& part) {
    PILEUS_TRY(allocate_planes(run.camera.width, run.camera.height, 3, run.lighting.opaque(), false,
                               part));
    if (light != nullptr) PILEUS_TRY(march_background(context, *light, run, part));
    std::copy_n(run.planes.opaque_depth.data(), run.planes.opaque_depth.size(),
                part.opaque_depth.data());
    RaymarchTally counted;  // of the picture's own march alone
    return raymarch_picture(context, in, part, counted);
}

/// What rays bring: the media's light and, through them, the background's.
void lay_over(Planes& part) {
    const std::size_t pixels = part.transmittance.size();
    for (std::size_t i = 0; i < 3 * pixels; ++i)
        part.colour[i] += part.transmittance[i % pixels] * part.background[i];
}

/// Light of lamps from `first` on, as many as `k` says, or what is emitted, into empty planes.
Status show_lamps(const Context& context, const LampMarchParams& k, std::size_t first,
                  RaymarchRun& run, Planes& part) {
    std::fill_n(part.colour.data(), part.colour.size(), 0.0f);
    std::fill_n(part.background.data(), part.background.size(), 0.0f);
    return add_lamp_light(context, marched_medium(run), k, run.lamps, part, first);
}

/// Skylight on nodes under another light; what nodes see of the sky is kept.
Status light_nodes_by(const Context& context, const Lighting& light, RaymarchRun& run) {
    const Medium& medium = run.world->medium;
    if (!run.settings.sky_ambient || medium.sigma <= 0) return Status::ok();
    return make_sky_nodes(context, medium, run.majorants, light, mean_kept(run.settings, medium),
                          octaves_of(run.settings), sky_view(run), run.sky);
}

Status show_sun(const Context& context, const RaymarchInput& whole, RaymarchRun& run,
                Planes& part) {
    const Lighting sun = sun_alone(run.lighting);
    RaymarchSettings settings = run.settings;
    std::copy_n(kDark, 3, settings.ambient.begin());
    RaymarchInput in = whole;
    in.lighting = &sun;
    in.settings = &settings;
    // Nodes hold what the ground sends up of the sun's light, and then all of it again.
    PILEUS_TRY(light_nodes_by(context, sun, run));
    PILEUS_TRY(show_part(context, in, &sun, run, part));
    PILEUS_TRY(light_nodes_by(context, run.lighting, run));
    lay_over(part);
    run.planes.sun.swap(part.colour);
    return Status::ok();
}

Status show_emission(const Context& context, const RaymarchInput& whole, RaymarchRun& run,
                     Planes& part) {
    Lighting dark = sun_alone(run.lighting);
    dark.sunlit = false;
    dark.sun_irradiance = {};
    RaymarchInput in = whole;
    in.lighting = &dark;
    in.sky = nullptr;
    PILEUS_TRY(show_part(context, in, nullptr, run, part));
    if (march_emits(run) && run.settings.steps > 0) {
        LampMarchParams k = march_lamps(run);
        k.lamps = k.ground = 0;
        PILEUS_TRY(add_lamp_light(context, marched_medium(run), k, run.lamps, part, 0));
    }
    run.planes.emission.swap(part.colour);
    return Status::ok();
}

Status show_each_lamp(const Context& context, RaymarchRun& run, Planes& part) {
    const std::size_t count = run.lighting.lamps.size(), pixels = run.planes.transmittance.size();
    PILEUS_TRY(allocate(arrays::picture_planes(3 * count, pixels), run.planes.lamps));
    if (run.settings.steps == 0) return Status::ok();
    std::copy_n(run.planes.transmittance.data(), pixels, part.transmittance.data());
    LampMarchParams k = march_lamps(run);
    k.emits = 0;
    k.lamps = 1;
    for (std::size_t i = 0; i < count; ++i) {
        PILEUS_TRY(show_lamps(context, k, i, run, part));
        lay_over(part);
        std::copy_n(part.colour.data(), 3 * pixels, run.planes.lamps.data() + 3 * pixels * i);
    }
    return Status::ok();
}

/// Light of sun, sky and lamps that the media scattered once, and that met no ground.
Status show_single(const Context& context, const RaymarchInput& whole, RaymarchRun& run,
                   Planes& part) {
    RaymarchSettings settings = run.settings;
    settings.many = settings.forward = false;
    std::copy_n(kDark, 3, settings.ambient.begin());
    RaymarchInput in = whole;
    in.settings = &settings;
    if (settings.sky_ambient && run.world->medium.sigma > 0) {
        Lighting groundless = run.lighting;
        groundless.ground_diffuse = groundless.ground_sun = {};
        PILEUS_TRY(make_sky_nodes(context, run.world->medium, run.majorants, groundless, 0,
                                  octaves_of(settings), sky_view(run), run.single_sky));
        in.sky = &run.single_sky;
    }
    PILEUS_TRY(show_part(context, in, nullptr, run, part));
    if (!run.lighting.lamps.empty() && settings.steps > 0) {
        LampMarchParams k = march_lamps(run);
        k.emits = k.ground = 0;
        k.octaves.count = 1;
        PILEUS_TRY(add_lamp_light(context, marched_medium(run), k, run.lamps, part, 0));
    }
    run.planes.single.swap(part.colour);
    return Status::ok();
}

}  // namespace

bool march_emits(const RaymarchRun& run) {
    const auto& ambient = run.settings.ambient;
    return emits(marched_medium(run)) || ambient[0] > 0 || ambient[1] > 0 || ambient[2] > 0;
}

Status march_parts(const Context& context, const RaymarchInput& whole, RaymarchRun& run) {
    const OutputSettings& output = run.scene->output;
    RaymarchInput in = whole;
    in.lattice = PixelLattice{};
    Planes part;
    if (output.layer_light) {
        PILEUS_TRY(run.lighting.sunlit ? show_sun(context, in, run, part)
                                       : no_light(run, run.planes.sun));
        if (march_emits(run)) PILEUS_TRY(show_emission(context, in, run, part));
        PILEUS_TRY(allocate_planes(run.camera.width, run.camera.height, 3, run.lighting.opaque(),
                                   false, part));
        if (!run.lighting.lamps.empty()) {
            std::copy_n(run.planes.opaque_depth.data(), run.planes.opaque_depth.size(),
                        part.opaque_depth.data());
            PILEUS_TRY(show_each_lamp(context, run, part));
        }
    }
    return output.layer_order ? show_single(context, in, run, part) : Status::ok();
}

std::uint64_t march_part_planes(const RaymarchRun& run) {
    const OutputSettings& output = run.scene->output;
    const std::uint64_t lights = 1 + run.lighting.lamps.size() + (march_emits(run) ? 1u : 0u);
    return (output.layer_light ? 3 * lights : 0) + (output.layer_order ? 3u : 0u);
}

Status check_march_parts(const Scene& scene) {
    const OutputSettings& output = scene.output;
    const UpsampleSettings& thin = scene.raymarch.thin;
    const bool thins = refused(scene, Feature::kThinning) == nullptr && thin.every() > 1;
    if (!thins || !(output.layer_light || output.layer_order)) return Status::ok();
    return Status::bad_input(scene.file + ": raymarch." +
                             (thin.temporal > 0 ? "temporal" : "scale") + ": the layer \"" +
                             (output.layer_light ? "light" : "order") +
                             "\" has every pixel marched, allowed: none of both, or no such layer");
}

}  // namespace pileus
