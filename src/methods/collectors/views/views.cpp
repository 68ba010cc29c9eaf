// SPDX-License-Identifier: Apache-2.0
// See views.h. Which steps a view needs; views_draw.cpp draws them.
// in: a scene -> out: the prepared part of a run, and what its report says.
// docs/how-it-works.md
#include "src/methods/collectors/views/views.h"

#include "src/base/digest.h"

namespace pileus {
namespace {

const char* name_of(View view) {
    int count = 0;
    return collectors_views(count)[int(view)].name;
}

bool needs_tree(View view) {
    return view == View::kTree || view == View::kLeafDensity || view == View::kCollectors;
}

/// Says in the plan what the view needs and what it spares.
void note_plan(ViewRun& out) {
    Plan& plan = out.plan;
    const std::string why = std::string("--show ") + name_of(out.view);
    const auto step = [&](const char* name, bool needed) {
        if (needed)
            plan.need(name);
        else
            plan.leave_out(name, why.c_str());
    };
    const bool tree = needs_tree(out.view), photons = out.view == View::kPhotons;
    plan = Plan{};
    step("gradient", !photons && out.view != View::kDensitySlice);
    step("samples", tree || out.view == View::kSamples);
    step("tree", tree);
    step("collectors", tree);
    step("majorants", photons);
    plan.leave_out("photons", why.c_str());
    plan.leave_out("reconstruction", why.c_str());
    const auto take = [&](const char* name, std::uint64_t bytes) {
        plan.memory.add(name, Stage::kDensity, Stage::kWrite, bytes);
    };
    const Prepared& p = out.prepared;
    take("density", out.world->medium.volume.density.bytes());
    take("parts of the media", out.world->medium.parts.bytes());
    take("gradient", out.field.bytes());
    take("samples", out.samples.samples.bytes());
    take("leaves", p.leaves.bytes());
    take("collectors", p.collectors.bytes());
    take("collector of voxel", p.collector_of_voxel.bytes());
    take("majorants", out.majorants.tracking.bytes() + out.majorants.skipping.bytes());
    plan.exact = true;
}

Status check_closure(const Scene& scene, View view) {
    if (!scene.collectors.camera_closure) return Status::ok();
    const bool missing = view == View::kGradientSlice || view == View::kGradient ||
                         view == View::kSamples || view == View::kIllumination;
    if (!missing) return Status::ok();
    return Status::bad_input(
        std::string("--show: ") + name_of(view) +
        ": closure \"camera\" has no such step, allowed: density-slice, "
        "tree, leaf-density, collectors, photons, or another collectors.closure");
}

Status prepare_step(View view, const Context& context, ViewRun& out) {
    CollectorsRun& run = out;
    const CollectorSettings& settings = run.settings;
    switch (view) {
        case View::kDensitySlice:
            return Status::ok();
        case View::kGradientSlice:
        case View::kGradient:
            return prepare_sample_field(run.world->medium, settings, context, out.field, out.stats);
        case View::kSamples:
            return prepare_sample_set(run.world->medium, settings, run.scene->seed, context,
                                      out.samples);
        case View::kPhotons:
            return make_photon_majorants(run.world->medium, settings.local_tracking, context,
                                         run.majorants);
        default:
            return run.camera_cells > 0
                       ? prepare_cells(run.world->medium, run.camera_cells, context, run.prepared)
                       : prepare_collectors(run.world->medium, settings, run.scene->seed, context,
                                            run.prepared);
    }
}

}  // namespace

Status collectors_view_outline(const Context& context, ViewRun& out) {
    PILEUS_TRY(check_closure(*out.scene, out.view));
    out.shown = *out.scene;
    out.scene = &out.shown;
    // Colours of billboards hold all light; those of the march leave the sun's first scattering
    // and the constant sky to the march.
    out.shown.collectors.billboards = true;
    out.shown.output.layer_error = false;
    return collectors_outline(context, out);
}

Status collectors_view_prepare(const Context& context, ViewRun& out) {
    if (out.view == View::kIllumination) return collectors_prepare(context, out);
    PILEUS_TRY(collectors_weigh(context, out));
    PILEUS_TRY(prepare_step(out.view, context, out));
    note_plan(out);
    collectors_note_limits(context, out);
    return Status::ok();
}

void collectors_view_count(const ViewRun& out, Counts& counters) {
    if (out.view == View::kIllumination) return collectors_count(out, counters);
    const bool drawn = out.view == View::kSamples;
    counters.emplace_back("samples_given_up", drawn ? out.samples.given_up : out.prepared.rejected);
}

void collectors_view_report(const ViewRun& out, Report& report) {
    const CollectorsRun& run = out;
    if (out.view == View::kIllumination) {
        collectors_report(run, report);
        return;
    }
    const bool drawn = out.view == View::kSamples;
    report.prepared.samples = drawn ? out.samples.samples.size() : run.prepared.samples;
    report.prepared.leaves = run.prepared.leaves.size();
    report.prepared.collectors = run.prepared.collectors.size();
    Digest density;
    density.floats(run.world->medium.volume.density.span());
    report.digests.emplace(report.digests.begin(), "density", density.hex());
}

}  // namespace pileus
