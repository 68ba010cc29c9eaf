// SPDX-License-Identifier: Apache-2.0
// A run of marched pictures: what methods `raymarch` and `optical-depth` have in common.
// in: a scene, settings of the march -> out: an image without noise, as fine as its steps.
// docs/raymarch.md; docs/optical-depth.md
#pragma once
#include "src/march/march.h"
#include "src/methods/methods.h"
#include "src/picture/nodes/ground_shadow.h"
#include "src/picture/nodes/lamp_light.h"
#include "src/picture/nodes/sky_light.h"
#include "src/picture/upsample.h"
#include "src/plan/plan.h"
#include "src/world/camera/view.h"
#include "src/world/majorant/majorants.h"
#include "src/world/world.h"

namespace pileus {

/// Everything one run holds. Each frame has planes of its own, made and freed with it.
struct RaymarchRun : MethodRun {
    RaymarchSettings settings;                     ///< the scene's, with the steps of the budget
    int whole_steps = 0;                           ///< of them, where a time leaves all
    UpsampleSettings whole_thin;                   ///< and pixels, likewise
    OpticalDepthSettings looks;                    ///< the scene's
    const OpticalDepthSettings* simple = nullptr;  ///< those, of method optical-depth alone
    Medium capped;  ///< the medium with its extinction cut; unused where that cuts nothing
    Medium lit;     ///< on the cells that its optical depth is swept over, if they are others
    Majorants lit_majorants;
    Buffer<float> visibility;  ///< what solids leave of the sun, on nodes; empty without solids
    NodeGrid visibility_nodes{};
    Majorants majorants;
    bool march_light = false;  ///< else sunlight comes from nodes
    bool sky_nodes = false;    ///< those of a sky in place; march_light is set, too
    std::string light_why;     ///< and why that is

    Buffer<float> noise;  ///< tile of the jitter; empty: none
    SkyNodes sky;
    SkyNodes single_sky;  ///< of light scattered once, where layer `order` shows it
    LampNodes lamps;
    int levels = 0;                    ///< of detail
    std::vector<DensityLevel> coarse;  ///< their densities
    SunDepth nodes;
    SweepCheck nodes_difference;          ///< of swept nodes to rays
    bool sky_made = false;                ///< its nodes are those of the light as it is
    std::array<float, 3> sky_to_sun{};    ///< the sun that the sky's nodes were made for
    CameraParams sky_camera{};            ///< and the camera
    std::array<float, 3> nodes_to_sun{};  ///< the sun that swept nodes were made for
    SunSlices slices;                     ///< and those of nodes by rays
    SkyLight sky_light;
    std::int64_t turn = 0;  ///< number of the picture, for that
    CameraParams camera{};
    Planes planes;
    UpsampleMemory upsample;
    GroundShadow ground_shadow;
    RaymarchTally tally;  ///< of all frames so far

    Status reserve(LateRows& late) override;
};

/// Steps towards the sun that samples march where nodes of a sky hold the others.
constexpr int kNearSteps = 0;
/// Such nodes are as fine as the pixels that are marched.
int sky_light_bits(const RaymarchRun& run);

namespace arrays {

inline Array<float> capped_density(const Grid& grid) {
    return {"density below the largest extinction", voxel_count(grid), Stage::kMajorants,
            Stage::kWrite};
}
inline Array<float> lit_density(const Grid& grid) {
    return {"density on the cells of the buffer", voxel_count(grid), Stage::kShadow, Stage::kWrite};
}

}  // namespace arrays

/// Whether a scene's largest extinction cuts anything; before values are known: may cut.
bool caps_extinction(const RaymarchRun& run);
/// Whether optical depths are made on cells or of extinctions other than the medium's.
bool has_sun_grid(const RaymarchRun& run);

/// Makes that medium once. kLimit: out of memory.
Status make_lit_medium(const Context& context, RaymarchRun& run);

/// Recipe::budget_used: the steps that a time chose.
void march_budget_used(int frame, const MethodRun& run, const Report& report, Budget& used);

/// LiveMethod::most_units.
Status march_most_units(const FrameWork& work, const MethodRun& run, FrameUnits& out);

/// What is shown and lit: the world's medium, or the capped one.
const Medium& marched_medium(const RaymarchRun& run);
/// Cells of the sun's optical depth.
Grid sun_grid(const RaymarchRun& run);

/// kBadInput: a budget, camera or layer that marched pictures do not have.
Status check_marched(const Scene& scene, const Budget& budget);

/// Chooses lights, notes what runs and what is left out, and weighs memory; `run.settings` are set.
/// kBadInput: a device; kLimit: more than the limits allow.
Status march_outline(const Context& context, RaymarchRun& run);
/// Majorants, coarser densities, and the exact plan.
Status march_prepare(const Context& context, MethodRun& run);

/// Skylight is scattered towards the camera, but to all sides where copies of the medium are seen,
/// each along ways of its own, and by method optical-depth.
SkyView sky_view(const RaymarchRun& run);

/// Chooses where sunlight comes from, notes the plan and weighs it.
Status march_measure(const Context& context, RaymarchRun& run);

/// Sunlight, background and the march of one frame, of number run.turn.
Status march_frame(const FrameStep& step, const Context& context, RaymarchRun& run);

/// The same for a frame of an animation, or a still.
Status march_light(const FrameStep& step, const Context& context, MethodRun& run);

/// The planes as an image; frees them.
Status march_show(const FrameStep& step, const Context& context, MethodRun& run, Image& image);
void march_count(const MethodRun& run, Counts& counters);
void march_report(const MethodRun& run, Report& report);

/// In a session: pictures are all there is, no light is traced.
extern const LiveMethod live_march;

}  // namespace pileus
