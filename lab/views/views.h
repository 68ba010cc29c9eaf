// SPDX-License-Identifier: Apache-2.0
// Pictures of the steps of method `collectors` instead of its result.
// in: a scene and the name of a step -> out: an image; later steps do not run.
// docs/how-it-works.md; Elek 2011, figures 5.1 to 5.7.
#pragma once
#include <string>

#include "lab/views/view_list.h"
#include "src/methods/collectors/collectors_method.h"

namespace pileus {

/// In the order of `collectors_views`.
enum class View {
    kDensitySlice,
    kGradientSlice,
    kGradient,
    kSamples,
    kTree,
    kLeafDensity,
    kCollectors,
    kPhotons,
    kIllumination,
};

/// Whether a view's colours are light that the scene's exposure applies to.
constexpr bool view_is_light(View view) { return view == View::kIllumination; }

/// The method as far as a view needs it. Its display has no march: colours of billboards hold all
/// light, those of the march leave the sun's first scattering and the constant sky to the march.
class ViewMethod final : public CollectorsMethod {
public:
    ViewMethod(View what, const MethodInputs& inputs);

    View what() const { return what_; }
    bool is_ready() const { return ready_; }
    const SampleSet& samples() const { return samples_; }
    const Buffer<float>& field() const { return field_; }
    const FieldStats& stats() const { return stats_; }

    Status plan(const Context& context, const FrameView& view, Plan& plan) override;
    /// The steps up to the view's own. Errors: those of the steps.
    Status prepare(const Context& context, const FrameView& view) override;
    Status set_view(const Context& context, const FrameView& view,
                    const ViewChange& change) override;
    LightUnits progress() const override;
    FrameWork full_work() const override { return {}; }  // a host has no views
    void count(Counts& counts) const override;
    void release(Phase) override {}  // what a step made is shown

protected:
    /// kBadInput: a step that closure "camera" does not have.
    Status check(const Context& context, const FrameView& view) override;

private:
    Status prepare_step(const Context& context, const FrameView& view);

    View what_;
    bool ready_ = false;  ///< `prepare` has ended before photons
    SampleSet samples_;
    Buffer<float> field_;  ///< what samples are drawn from, per voxel
    FieldStats stats_;
};

std::unique_ptr<MethodReport> view_report(ViewMethod& method);

/// Draws the view: channels R G B A, and where a field is shown `value` in its own unit
/// (density, gradient 1/m, or variance).
Status draw_view(const Context& context, const FrameView& view, const ViewMethod& of, Image& image);

}  // namespace pileus
