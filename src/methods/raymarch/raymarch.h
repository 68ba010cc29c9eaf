// SPDX-License-Identifier: Apache-2.0
// Method `raymarch`: sunlight scattered once, or forward many times, added up along each ray.
// in: a scene -> out: an image without noise, as fine as its steps.
// Palenik 2016; docs/raymarch.md
#pragma once
#include "src/methods/methods.h"
#include "src/methods/raymarch/march.h"
#include "src/methods/raymarch/upsample.h"
#include "src/plan/plan.h"
#include "src/world/camera/view.h"
#include "src/world/majorant/majorants.h"
#include "src/world/world.h"

namespace pileus {

/// Everything one run holds. Each frame has planes of its own, made and freed with it.
struct RaymarchRun : MethodRun {
    RaymarchSettings settings;  ///< the scene's, with the steps of the budget
    Buffer<float> visibility;   ///< what solids leave of the sun, on nodes; empty without solids
    NodeGrid visibility_nodes{};
    Majorants majorants;
    bool march_light = false;  ///< else sunlight comes from nodes
    std::string light_why;     ///< and why that is

    Buffer<float> noise;  ///< tile of the jitter; empty: none
    SkyNodes sky;
    int levels = 0;                    ///< of detail
    std::vector<DensityLevel> coarse;  ///< their densities
    SunDepth nodes;
    SunDepthDifference nodes_difference;  ///< of swept nodes to rays
    std::array<float, 3> sky_to_sun{};    ///< the sun that the sky's nodes were made for
    std::array<float, 3> nodes_to_sun{};  ///< the sun that the nodes were made for
    CameraParams camera{};
    Planes planes;
    UpsampleMemory upsample;
    RaymarchTally tally;  ///< of all frames so far
};

/// The recipe.
const Method& raymarch_method();

/// Notes what runs and what is left out, chooses where sunlight comes from, and weighs memory.
/// kLimit: more than the limits allow.
Status raymarch_measure(const Context& context, RaymarchRun& run);
void raymarch_report_plan(const MethodRun& run, const Context& context, Report& report);

/// Sunlight, background and the march of one frame.
Status raymarch_light(const FrameStep& step, const Context& context, MethodRun& run);

/// The planes as an image; frees them.
Status raymarch_show(const FrameStep& step, const Context& context, MethodRun& run, Image& image);
void raymarch_report(const MethodRun& run, Report& report);

}  // namespace pileus
