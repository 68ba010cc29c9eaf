// SPDX-License-Identifier: Apache-2.0
// See march.h. Preparation; raymarch_show.cpp makes the picture.
// in: scene, budget -> out: a prepared run.
// docs/raymarch.md
#include "src/methods/raymarch/raymarch.h"

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

void choose_light(double sun_elevation_deg, RaymarchRun& run) {
    Plan photons;  // speaks of photons alone
    run.lighting = light_world(*run.scene, sun_elevation_deg, *run.world, run.around, photons);
}

Status outline(const Context& context, MethodRun& method_run) {
    RaymarchRun& run = own(method_run);
    run.settings = run.scene->raymarch;
    if (run.budget.steps >= 0) run.settings.steps = int(run.budget.steps);
    if (context.kernels->device != nullptr)
        return Status::bad_input(std::string("--isa: \"") + context.kernels->name +
                                 "\": method raymarch runs on the host alone, allowed: another, or "
                                 "another method");
    choose_light(sun_at(*run.scene, 0), run);
    return raymarch_measure(context, run);
}

Status prepare(const Context& context, MethodRun& method_run) {
    RaymarchRun& run = own(method_run);
    // The values may show that there is no medium.
    choose_light(sun_at(*run.scene, 0), run);
    PILEUS_TRY(make_majorants(run.world->medium, false, context, run.majorants));
    run.outlined_only = false;
    PILEUS_TRY(make_density_levels(run.world->medium, run.levels, run.majorants.skip_block, context,
                                   run.coarse));
    PILEUS_TRY(raymarch_measure(context, run));
    run.digests = {{"density", density_digest(*run.world)}};
    return Status::ok();
}

/// Nodes of sunlight and sky are made again by the next picture where their light has changed.
Status aim(int, bool anew, const Context&, MethodRun& method_run) {
    RaymarchRun& run = own(method_run);
    const Lighting before = run.lighting;
    choose_light(run.scene->sun.elevation_deg, run);
    const Lighting& now = run.lighting;
    const auto& size = run.scene->camera.resolution;
    if (anew || before.sunlit != now.sunlit || before.sky != now.sky ||
        before.sun_irradiance != now.sun_irradiance || before.ground != now.ground ||
        before.ground_z != now.ground_z || before.ground_albedo != now.ground_albedo) {
        run.sky_to_sun = {};
        run.upsample.ready = false;
    }
    if (run.camera.width != size[0] || run.camera.height != size[1] ||
        before.opaque() != now.opaque())
        run.upsample = UpsampleMemory{};
    return Status::ok();
}

Status advance(std::uint64_t, const Context&, MethodRun&, std::uint64_t& done) {
    done = 0;
    return Status::ok();
}

LightUnits units(const MethodRun&) { return {}; }

Status compose(const FrameStep& step, const Context& context, MethodRun& method_run,
               const Planes*& planes) {
    RaymarchRun& run = own(method_run);
    planes = &run.planes;
    return raymarch_light(step, context, run);
}

}  // namespace

const Method& raymarch_method() {
    static constexpr LiveMethod live{aim, advance, units, compose};
    static constexpr Method method{
        "raymarch",           SkyUse::kInPlace, make,          check,           outline, prepare,
        raymarch_report_plan, raymarch_light,   raymarch_show, raymarch_report, &live};
    return method;
}

}  // namespace pileus
