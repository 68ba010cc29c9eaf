// SPDX-License-Identifier: Apache-2.0
// What methods `raymarch` and `optical-depth` keep between their calls.
// in: a scene, settings of the march -> out: light on nodes, planes of pixels.
// docs/raymarch.md; docs/optical-depth.md
#pragma once
#include <optional>

#include "src/methods/march/march.h"
#include "src/methods/scenery.h"
#include "src/picture/nodes/ground_shadow.h"
#include "src/picture/nodes/lamp_light.h"
#include "src/picture/nodes/sky_light.h"
#include "src/picture/ordinates/ordinates.h"
#include "src/picture/ordinates/sky_ordinates.h"
#include "src/picture/upsample.h"

namespace pileus {

/// Settings of pictures, and what is chosen by them and by sizes.
struct MarchChoice {
    RaymarchSettings settings;  ///< the scene's, with the steps of the budget, or the look's
    /// Of optical-depth alone, with the steps of the budget: settings are made of it.
    std::optional<OpticalDepthSettings> look;
    int whole_steps = 0;          ///< of settings, where a time leaves all
    UpsampleSettings whole_thin;  ///< and pixels, likewise
    double seconds = 0;           ///< of a picture; 0: no budget of time
    bool hosted = false;          ///< a host moves camera and lights; else frames are a film's
    bool march_light = false;     ///< else sunlight comes from nodes
    bool sky_nodes = false;       ///< those of a sky in place; march_light is set, too
    std::string light_why;        ///< and why that is
    const char* beyond_ordinates = nullptr;  ///< what keeps scattering = "auto" from them; null
    int levels = 0;                          ///< of detail
};

/// What no frame changes.
struct MarchMedia {
    bool outlined_only = true;  ///< sizes are known, values are not
    bool wide_sun = false;      ///< nodes of the sun's depth are two voxels apart
    Majorants majorants;
    std::vector<DensityLevel> coarse;  ///< densities of the levels of detail
    Medium capped;  ///< the medium with its extinction cut; unused where that cuts nothing
    Medium lit;     ///< on the cells that its optical depth is swept over, if they are others
    Majorants lit_majorants;
};

struct MarchSun {
    SunDepth nodes;
    SweepCheck difference;          ///< of swept nodes to rays
    std::array<float, 3> to_sun{};  ///< the sun that swept nodes were made for
    SunSlices slices;               ///< and those of nodes by rays
    Buffer<float> visibility;  ///< what solids leave of the sun, on nodes; empty without solids
    NodeGrid visibility_nodes{};
};

struct MarchSky {
    SkyNodes nodes;
    SkyNodes single;                ///< of light scattered once, where layer `order` shows it
    bool made = false;              ///< its nodes are those of the light as it is
    std::array<float, 3> to_sun{};  ///< the sun that the sky's nodes were made for
    CameraParams camera{};          ///< and the camera
    SkyLight layer;                 ///< of a sky in place
};

struct MarchOrdinates {
    OrdinateNodes nodes;
    int still = 0;  ///< pictures since the sun has moved
    // Where pictures follow the sun by part of the work:
    SunSlices slices;          ///< of nodes' sunlight
    bool light_late = false;   ///< nodes have sunlight that is not solved for
    bool ground_late = false;  ///< light is solved for that the ground has not
    bool followed = false;     ///< they went on from those of another sun
    SkyOrdinates sky;          ///< of a sky in place, instead
};

/// Light on nodes, which frames of the same light share.
struct MarchLight {
    std::int64_t turn = 0;  ///< number of the picture
    MarchSun sun;
    MarchSky sky;
    MarchOrdinates ordinates;
    LampNodes lamps;
    GroundShadow ground_shadow;
};

/// What a sea mirrors, of so many directions.
constexpr int kMirrorColumns = 192, kMirrorRows = 48;
constexpr std::uint64_t kMirrorTexels = std::uint64_t(kMirrorColumns) * kMirrorRows;
struct SeaMirror {
    Planes planes;
    Buffer<float> texels;  ///< [3][row][column]
    SkyMapView map{};      ///< no columns: nothing
    float from[3] = {};    ///< where it was seen from, m, box-local
};

/// The last picture.
struct MarchPicture {
    std::array<int, 2> size{};
    bool opaque = false;  ///< something solid could be in it
    Planes planes;
    UpsampleMemory upsample;
    Buffer<float> noise;  ///< tile of the jitter; empty: none
    RaymarchTally tally;  ///< of all pictures so far
    SeaMirror mirror;
};

struct MarchState {
    MarchChoice choice;
    MarchMedia media;
    MarchLight light;
    MarchPicture picture;
};

/// Steps towards the sun that samples march where nodes of a sky hold the others.
constexpr int kNearSteps = 0;

namespace arrays {

inline Array<float> capped_density(const Grid& grid) {
    return {"density below the largest extinction", voxel_count(grid), Stage::kMajorants,
            Stage::kWrite};
}
inline Array<float> lit_density(const Grid& grid) {
    return {"density on the cells of the buffer", voxel_count(grid), Stage::kShadow, Stage::kWrite};
}

}  // namespace arrays

/// By the scene's settings and the budget.
MarchChoice raymarch_choice(const MethodInputs& inputs);
MarchChoice optical_depth_choice(const MethodInputs& inputs);

/// Why light is marched or not, by samples of the density.
void explain_march_light(double marched, double nodes, MarchChoice& choice);

/// Chooses where sunlight comes from, and the levels of detail.
void choose_march(const FrameView& view, MarchChoice& choice);

/// Such nodes are as fine as the pixels that are marched.
int sky_light_bits(const MarchChoice& choice);

/// Whether the largest extinction of a look cuts anything; before values are known: may cut.
bool caps_extinction(const FrameView& view, const MarchState& state);
/// Whether rays to the sun from wide nodes read means of the medium's cells.
bool has_coarse_sun(const FrameView& view, const MarchState& state);
/// Whether optical depths are made on cells or of extinctions other than the medium's.
bool has_sun_grid(const FrameView& view, const MarchState& state);
/// Cells of the sun's optical depth.
Grid sun_grid(const FrameView& view, const MarchState& state);
/// What is shown and lit: the world's medium, or the capped one.
const Medium& marched_medium(const FrameView& view, const MarchState& state);

/// Whether nodes two voxels apart tell the optical depth to the sun nearly as well as one a voxel:
/// within thin voxels it is linear. Not where medium reaches the box's faces, from which half of
/// the way to the first node has that node's depth.
bool has_wide_sun(const Medium& medium);
/// The medium with no extinction above the largest one asked for. kLimit: out of memory.
Status cap_medium(const FrameView& view, MarchState& state);
/// Makes the medium of the sun's cells once. kLimit: out of memory.
Status make_lit_medium(const Context& context, const FrameView& view, MarchState& state);

/// Chooses discrete ordinates or octaves where the scene leaves that open; refuses what ordinates
/// do not know where it asks for them, in a line.
Status choose_scattering(const FrameView& view, MarchChoice& choice);
/// Solves for them where the light has changed. kLimit: out of memory.
Status light_ordinates(const Context& context, const FrameView& view, double slack_deg,
                       MarchState& state);
/// Memory for any lights and cameras. kLimit: out of memory.
Status reserve_march_ordinates(MarchOrdinates& out);
/// Depths to the sun that ordinates read; null: of thick voxels they are found by rays, at the
/// places that are lit.
const SunDepth* sun_of_nodes(const Medium& medium, const MarchState& state);
/// Whether the optical depth to the sun is nearly linear from voxel to voxel.
bool has_thin_voxels(const Medium& medium);
/// Light that begins in the box: of these lamps, of media that shine.
struct OwnLight {
    std::size_t first_lamp = 0, lamps = 0;
    bool emission = false;
    int beside = -1;  ///< one more lamp; -1: none
};
/// All of it, once the lamps' nodes are made.
OwnLight own_light_of(const FrameView& view, const MarchState& state);
/// Whether lamps shine, or a host may set some.
bool may_have_lamps(const FrameView& view, const MarchChoice& choice);
/// Whether spots of lamps on the ground light the media.
bool has_lamp_spots(const FrameView& view, const MarchChoice& choice);
/// Solves for another light than the view's, whole, and turns it to the picture's camera.
Status solve_ordinates_for(const Context& context, const FrameView& view, const Lighting& light,
                           const OwnLight& own, MarchState& state);
/// Tables of the beam within the peak of a phase function, for add_lamp_light; null: none.
const float* lamp_tables(const MarchState& state);
/// Whether nodes are seen from the same place, or along the same direction; or, from outside,
/// nearly so as seen from the middle of the box.
bool same_way(const Medium& medium, double slack_deg, const CameraParams& a, const CameraParams& b);

/// Skylight is scattered towards the camera, but to all sides where copies of the medium are seen,
/// each along ways of its own, and by method optical-depth.
SkyView sky_view(const FrameView& view, const MarchState& state);

/// The frame that light is made for, and how many share its slices.
SunTurn march_turn(const FrameView& view, const MarchState& state);
/// Light on nodes for the camera of the picture, or one that was within `slack_deg` of it. kLimit:
/// out of memory.
Status light_march(const Context& context, const FrameView& view, double slack_deg,
                   MarchState& state);

/// Sunlight, background and the march of a frame, into state.picture. Errors: kLimit, out of
/// memory; kCheckFailed, interrupted.
Status march_frame(const Context& context, const FrameView& view, const RenderAsk& ask,
                   MarchState& state);

/// Method::worst_case.
Status march_most_units(const FrameView& view, const FrameWork& work, const MarchState& state,
                        FrameUnits& out);

}  // namespace pileus
