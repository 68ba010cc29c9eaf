// SPDX-License-Identifier: Apache-2.0
// Pictures of the steps of method `collectors` instead of its result.
// in: a scene and the name of a step -> out: an image; later steps do not run.
// docs/how-it-works.md; Elek 2011, figures 5.1 to 5.7.
#pragma once
#include <string>

#include "src/methods/collectors/collectors.h"

namespace pileus {

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

/// One recipe for each view, in the order of View; src/methods/registry.cpp lists them.
const Recipe* collectors_views(int& count);

/// Whether a view's colours are light that the scene's exposure applies to.
constexpr bool view_is_light(View view) { return view == View::kIllumination; }

/// A run as far as its view needs it.
struct ViewRun : CollectorsRun {
    ViewRun() = default;
    explicit ViewRun(View v) : view(v) {}

    View view = View::kGradient;
    Scene shown;  ///< the scene that the view renders: its display has no march
    SampleSet samples;
    Buffer<float> field;  ///< what samples are drawn from, per voxel
    FieldStats stats;
};

/// From sizes alone, with the scene as the view shows it. `out` must not move afterwards.
/// kBadInput: a view of a step that closure "camera" does not have; kLimit.
Status collectors_view_outline(const Context& context, ViewRun& out);

/// Runs the steps up to the view's own; photons are shot by `collectors_shoot` where the view is
/// kIllumination. Errors: those of the steps.
Status collectors_view_prepare(const Context& context, ViewRun& out);

/// Draws the view: channels R G B A, and where a field is shown `value` in its own unit
/// (density, gradient 1/m, or variance).
Status collectors_view_show(double orbit_deg, const Context& context, ViewRun& run, Image& image);

void collectors_view_count(const ViewRun& run, Counts& counters);
/// Fills the report: what was prepared and traced.
void collectors_view_report(const ViewRun& run, Report& report);

}  // namespace pileus
