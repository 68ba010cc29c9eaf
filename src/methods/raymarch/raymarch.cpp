// SPDX-License-Identifier: Apache-2.0
// See march.h. Preparation; raymarch_show.cpp makes the picture.
// in: scene, budget -> out: a prepared run.
// docs/raymarch.md
#include "src/methods/raymarch/raymarch.h"

#include "src/base/digest.h"
#include "src/plan/scene_limits.h"
#include "src/world/medium/mix_media.h"
#include "src/world/world.h"

namespace pileus {
namespace {

RaymarchRun& own(MethodRun& run) { return static_cast<RaymarchRun&>(run); }

std::unique_ptr<MethodRun> make() { return std::make_unique<RaymarchRun>(); }

Status check_upsampling(const Scene& scene) {
    const RaymarchSettings& s = scene.raymarch;
    const auto fault = [&](const char* key, int value, const char* allowed) {
        return Status::bad_input(scene.file + ": raymarch." + key + ": " + std::to_string(value) +
                                 ", allowed: " + allowed);
    };
    if (s.scale == 3) return fault("scale", s.scale, "1, 2, 4");
    if (s.temporal == 1 || s.temporal == 3) return fault("temporal", s.temporal, "0, 2, 4");
    if (s.temporal > 0 && s.scale > 1)
        return fault("scale", s.scale, "1 where raymarch.temporal thins out pixels already");
    return Status::ok();
}

Status check(const Scene& scene, const Budget& budget) {
    constexpr const char* kAllowed = "steps=N";
    if (budget.photons >= 0) return unknown_budget("--budget photons", scene.method, kAllowed);
    if (budget.samples >= 0) return unknown_budget("--budget samples", scene.method, kAllowed);
    if (budget.error > 0) return unknown_budget("--budget error", scene.method, kAllowed);
    if (budget.seconds > 0) return unknown_budget("--budget seconds", scene.method, kAllowed);
    if (!budget.state.empty())
        return unknown_budget("--state", scene.method, "method.name = \"path\"");
    if (scene.camera.flux)
        return Status::bad_input(scene.file +
                                 ": camera.projection: \"flux\" sees along no single ray, which "
                                 "method raymarch marches, allowed: perspective, orthographic");
    const RaymarchLightKind light = scene.raymarch.light;
    if (scene.raymarch.light_cone &&
        (light == RaymarchLightKind::kBuffer || light == RaymarchLightKind::kBufferExact))
        return Status::bad_input(scene.file +
                                 ": raymarch.light: nodes hold straight ways, not those of "
                                 "light_path = \"cone\", allowed: auto, march");
    PILEUS_TRY(check_upsampling(scene));
    const OutputSettings& output = scene.output;
    if (output.layer_error || output.layer_light || output.layer_order)
        return Status::bad_input(
            scene.file +
            ": output.layers: method raymarch has no noise and one order of scattering, allowed: "
            "radiance, alpha, depth, cloud, optical_depth, transmittance");
    return Status::ok();
}

void light_world(const Scene& scene, double sun_elevation_deg, RaymarchRun& run) {
    Plan photons;  // speaks of photons alone
    run.lighting =
        plan_lighting(scene, run.medium, sun_elevation_deg, photons, &run.sky_map, &run.solids);
}

Status outline(const Scene& scene, const Budget& budget, const Context& context,
               MethodRun& method_run) {
    RaymarchRun& run = own(method_run);
    run.scene = &scene;
    run.settings = scene.raymarch;
    if (budget.steps >= 0) run.settings.steps = int(budget.steps);
    if (context.kernels->device != nullptr)
        return Status::bad_input(std::string("--isa: \"") + context.kernels->name +
                                 "\": method raymarch runs on the host alone, allowed: another, or "
                                 "another method");
    PILEUS_TRY(check_scene_limits(scene, context.limits));
    PILEUS_TRY(outline_solids(scene, context, run.solids));
    run.direct_sky = is_direct_sky(scene);
    PILEUS_TRY(scene.media.empty() ? empty_medium(scene, run.medium)
               : run.direct_sky
                   ? outline_sky(scene, context.limits, run.medium, run.source)
                   : outline_media(scene, context.limits, std::uint64_t(context.threads),
                                   run.media_plan, run.medium, run.source));
    PILEUS_TRY(read_sky_map(scene, context, run.sky_map));
    light_world(scene, sun_at(scene, 0), run);
    return raymarch_measure(context, run);
}

Status prepare(const Scene& scene, const Budget& budget, const Context& context,
               MethodRun& method_run) {
    RaymarchRun& run = own(method_run);
    PILEUS_TRY(outline(scene, budget, context, run));
    if (!scene.media.empty()) {
        const StageClock clock(context, "density");
        run.media_plan = Plan{};
        PILEUS_TRY(run.direct_sky ? load_sky(scene, context, run.medium, run.layer)
                                  : load_media(scene, context.limits, context.threads,
                                               run.media_plan, run.medium, context.kernels));
        if (!run.direct_sky) run.source.mean_density = mean_density(run.medium);
    }
    PILEUS_TRY(load_solids(scene, run.medium.low_m, context, run.solids));
    // The values may show that there is no medium.
    light_world(scene, sun_at(scene, 0), run);
    PILEUS_TRY(make_majorants(run.medium, false, context, run.majorants));
    run.outlined_only = false;
    PILEUS_TRY(
        make_density_levels(run.medium, run.levels, run.majorants.skip_block, context, run.coarse));
    PILEUS_TRY(raymarch_measure(context, run));
    Digest density;
    density.floats(run.medium.volume.density.span());
    for (const NoiseTexture* noise : {&run.layer.perlin, &run.layer.worley})
        for (const std::int32_t word : noise->words.span()) density.u32(std::uint32_t(word));
    if (run.medium.count > 1) density.floats(run.medium.parts.span());
    run.digests = {{"density", density.hex()}};
    return Status::ok();
}

}  // namespace

const Method& raymarch_method() {
    static constexpr Method method{"raymarch",     make,          check,
                                   outline,        prepare,       raymarch_report_plan,
                                   raymarch_light, raymarch_show, raymarch_report};
    return method;
}

}  // namespace pileus
