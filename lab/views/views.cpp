// SPDX-License-Identifier: Apache-2.0
// See views.h. Which steps a view needs; views_draw.cpp draws them.
// in: a scene -> out: the prepared part of a method, and what its report says.
// docs/how-it-works.md
#include "lab/views/views.h"

#include "src/base/digest.h"
#include "src/photons/photon_report.h"

namespace pileus {
namespace {

const char* name_of(View view) {
    int count = 0;
    return collectors_views(count)[int(view)].name;
}

bool needs_tree(View view) {
    return view == View::kTree || view == View::kLeafDensity || view == View::kCollectors;
}

CollectorSettings shown_settings(const Scene& scene) {
    CollectorSettings settings = scene.collectors;
    settings.display.billboards = true;
    return settings;
}

}  // namespace

ViewMethod::ViewMethod(View what, const MethodInputs& inputs)
    : CollectorsMethod(inputs, shown_settings(inputs.scene)), what_(what) {
    state().error_layer = false;
}

Status ViewMethod::check(const Context& context, const FrameView& view) {
    const bool missing = what_ == View::kGradientSlice || what_ == View::kGradient ||
                         what_ == View::kSamples || what_ == View::kIllumination;
    if (missing && state().settings.closure.camera)
        return Status::bad_input(
            std::string("--show: ") + name_of(what_) +
            ": closure \"camera\" has no such step, allowed: density-slice, "
            "tree, leaf-density, collectors, photons, or another collectors.closure");
    return CollectorsMethod::check(context, view);
}

Status ViewMethod::plan(const Context& context, const FrameView& view, Plan& plan) {
    return ready_ ? Status::ok() : CollectorsMethod::plan(context, view, plan);
}

Status ViewMethod::prepare_step(const Context& context, const FrameView& view) {
    CollectorsState& s = state();
    const Medium& medium = view.world.medium;
    switch (what_) {
        case View::kDensitySlice:
            return Status::ok();
        case View::kGradientSlice:
        case View::kGradient:
            return prepare_sample_field(medium, s.settings, context, field_, stats_);
        case View::kSamples:
            return prepare_sample_set(medium, s.settings, view.scene.seed, context, samples_);
        case View::kPhotons:
            return make_photon_majorants(medium, s.settings.local_tracking, context, s.majorants);
        default:
            return s.camera_cells > 0 ? prepare_cells(medium, s.camera_cells, context, s.prepared)
                                      : prepare_collectors(medium, s.settings, view.scene.seed,
                                                           context, s.prepared);
    }
}

Status ViewMethod::prepare(const Context& context, const FrameView& view) {
    if (what_ == View::kIllumination) return CollectorsMethod::prepare(context, view);
    Plan plan;
    PILEUS_TRY(choose_and_measure(context, view, plan));
    PILEUS_TRY(prepare_step(context, view));
    ready_ = true;
    return Status::ok();
}

/// Only the light of collectors needs photons that stay.
Status ViewMethod::set_view(const Context& context, const FrameView& view,
                            const ViewChange& change) {
    if (what_ != View::kIllumination) return Status::ok();
    return CollectorsMethod::set_view(context, view, change);
}

LightUnits ViewMethod::progress() const {
    return what_ == View::kIllumination ? CollectorsMethod::progress() : LightUnits{};
}

void ViewMethod::count(Counts& counts) const {
    if (what_ == View::kIllumination) return CollectorsMethod::count(counts);
    const bool drawn = what_ == View::kSamples;
    counts.emplace_back("samples_given_up", drawn ? samples_.given_up : state().prepared.rejected);
}

namespace {

/// Says in the plan what the view needs and what it spares.
void note_plan(const FrameView& view, const ViewMethod& of, Plan& plan) {
    const std::string why = std::string("--show ") + name_of(of.what());
    const auto step = [&](const char* name, bool needed) {
        if (needed)
            plan.need(name);
        else
            plan.leave_out(name, why.c_str());
    };
    const bool tree = needs_tree(of.what()), photons = of.what() == View::kPhotons;
    step("gradient", !photons && of.what() != View::kDensitySlice);
    step("samples", tree || of.what() == View::kSamples);
    step("tree", tree);
    step("collectors", tree);
    step("majorants", photons);
    plan.leave_out("photons", why.c_str());
    plan.leave_out("reconstruction", why.c_str());
    const auto take = [&](const char* name, std::uint64_t bytes) {
        plan.memory.add(name, Stage::kDensity, Stage::kWrite, bytes);
    };
    const Medium& medium = view.world.medium;
    const Prepared& p = of.state().prepared;
    const Majorants& majorants = of.state().majorants;
    take("density", medium.volume.density.bytes());
    take("parts of the media", medium.parts.bytes());
    take("gradient", of.field().bytes());
    take("samples", of.samples().samples.bytes());
    take("leaves", p.leaves.bytes());
    take("collectors", p.collectors.bytes());
    take("collector of voxel", p.collector_of_voxel.bytes());
    take("majorants", majorants.tracking.bytes() + majorants.skipping.bytes());
    plan.exact = true;
}

class ViewReport final : public CollectorsReport {
public:
    explicit ViewReport(ViewMethod& of) : CollectorsReport(of), view_(of) {}

    void explain(const Context& context, const FrameView& view, Plan& plan) const override {
        if (!view_.is_ready()) return CollectorsReport::explain(context, view, plan);
        note_plan(view, view_, plan);
        note_collectors_limits(context, view, plan);
    }
    void digest(const FrameView& view, Digests& digests) const override {
        if (is_light()) CollectorsReport::digest(view, digests);
    }
    Status draw(const Context& context, const FrameView& view, Image& image) override {
        Digests& digests = context.report->digests;
        if (is_light()) {
            digest_photon_sums(context, of_, digests);
        } else {
            Digest density;
            density.floats(view.world.medium.volume.density.span());
            digests.emplace(digests.begin(), "density", density.hex());
        }
        return draw_view(context, view, view_, image);
    }
    void report(Report& report) const override {
        if (is_light()) return CollectorsReport::report(report);
        const Prepared& prepared = view_.state().prepared;
        const bool drawn = view_.what() == View::kSamples;
        report.prepared.samples = drawn ? view_.samples().samples.size() : prepared.samples;
        report.prepared.leaves = prepared.leaves.size();
        report.prepared.collectors = prepared.collectors.size();
    }

private:
    bool is_light() const { return view_.what() == View::kIllumination; }

    const ViewMethod& view_;
};

template <View kView>
MadeMethod make(const MethodInputs& inputs) {
    auto method = std::make_unique<ViewMethod>(kView, inputs);
    MadeMethod made;
    made.report = view_report(*method);
    made.method = std::move(method);
    return made;
}

}  // namespace

std::unique_ptr<MethodReport> view_report(ViewMethod& method) {
    return std::make_unique<ViewReport>(method);
}

const ViewRow* collectors_views(int& count) {
    static constexpr ViewRow all[] = {
        {"density-slice", view_is_light(View::kDensitySlice), make<View::kDensitySlice>},
        {"gradient-slice", view_is_light(View::kGradientSlice), make<View::kGradientSlice>},
        {"gradient", view_is_light(View::kGradient), make<View::kGradient>},
        {"samples", view_is_light(View::kSamples), make<View::kSamples>},
        {"tree", view_is_light(View::kTree), make<View::kTree>},
        {"leaf-density", view_is_light(View::kLeafDensity), make<View::kLeafDensity>},
        {"collectors", view_is_light(View::kCollectors), make<View::kCollectors>},
        {"photons", view_is_light(View::kPhotons), make<View::kPhotons>},
        {"illumination", view_is_light(View::kIllumination), make<View::kIllumination>}};
    count = int(sizeof all / sizeof all[0]);
    return all;
}

}  // namespace pileus
