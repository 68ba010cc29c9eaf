// SPDX-License-Identifier: Apache-2.0
// A raymarched picture: the scene's settings become a launch of the kernel.
// in: a medium, its lights, sunlight on nodes, a camera -> out: planes of pixels, counts.
// docs/raymarch.md.
#pragma once
#include "kernels_cpu/raymarch/raymarch_params.h"
#include "src/picture/layers.h"
#include "src/picture/nodes/sky_nodes.h"
#include "src/picture/nodes/sun_depth.h"
#include "src/picture/ordinates/ordinates.h"
#include "src/run/context.h"
#include "src/world/density/sky_field.h"
#include "src/world/light/lights.h"
#include "src/world/majorant/majorants.h"

namespace pileus {

namespace arrays {

/// What each row of a picture counted.
inline Array<std::int64_t> raymarch_counts(std::uint64_t rows) {
    return {"counts of rows", bytes_of(kRaymarchCounts, rows), Stage::kDisplay, Stage::kDisplay};
}

}  // namespace arrays

/// Light that is made before the march.
struct RaymarchNodes {
    const SunDepth* sun = nullptr;
    NodeGrid visibility_grid{};
    const float* visibility = nullptr;  ///< of solid_shadow.h; null: nothing solid
    const SkyNodes* sky = nullptr;
    const OrdinateNodes* ordinates = nullptr;        ///< in place of octaves and of sky
    const OrdinateLevelsView* sky_levels = nullptr;  ///< of `ordinates` of a layer
    /// [3][pixel] of the whole picture: light of solids, of such scenes and with ordinates alone.
    const float* surfaces = nullptr;
    bool hidden = false;                      ///< a depth image hides some of the picture
    const SkyLightView* sky_light = nullptr;  ///< of the layer; null: each sample marches
};

struct RaymarchInput {
    const Medium* medium = nullptr;
    const Majorants* majorants = nullptr;  ///< blocks to skip
    const Lighting* lighting = nullptr;
    const RaymarchSettings* settings = nullptr;
    const OpticalDepthSettings* look = nullptr;  ///< of method optical-depth; null: of raymarch
    RaymarchNodes nodes;
    const std::vector<DensityLevel>* levels = nullptr;
    const SkyField* layer = nullptr;  ///< a sky marched itself, in place of the grid
    bool march_light = false;
    const Buffer<float>* noise = nullptr;  ///< tile of make_blue_noise, where jitter asks for it
    std::uint64_t seed = 0;                ///< of the frame
    CameraParams camera;
    PixelLattice lattice{};  ///< the pixels to march; every = 0: all of them
};

struct RaymarchTally {
    std::uint64_t samples = 0, light_samples = 0, breaches = 0, cut = 0;
};

/// The steps that a scene asks for.
StepParams raymarch_steps(const RaymarchStepSettings& settings, const CameraParams& camera,
                          const Grid& grid);

/// Levels of detail that no step or pixel of a run goes beyond; 0 where cells are never too fine.
/// The camera is at most `reach_m` away from the medium's far end.
int raymarch_levels(const RaymarchSettings& settings, const CameraParams& camera,
                    const Medium& medium, double reach_m);

/// Share of the light that each medium scatters which goes on as if it were not, by channel.
/// Returns how many channels differ: 1 or 3.
int keep_forward(const RaymarchScatterSettings& settings, const Medium& medium,
                 float (&kept)[kMaxMedia][3]);

/// Share of scattered light that forward scattering keeps, over all media and channels.
double mean_kept(const RaymarchScatterSettings& settings, const Medium& medium);

/// One octave unless scattering = "octaves".
Octaves octaves_of(const RaymarchScatterSettings& settings);

/// Phase functions and albedos, shares in them, of octaves from 1 on: Henyey-Greenstein's, which
/// take albedo and share once more each. `first`: what octave 0 is multiplied by.
void set_octaves(const RaymarchSettings& settings, const Medium& medium, const float (*first)[3],
                 float (*g)[kMaxOctaves], float (*source)[kMaxOctaves][3]);

/// What absorption leaves of them (docs/raymarch.md, "Octaves").
OctaveDepths octave_depths(const Octaves& octaves, const Medium& medium);

/// Everything that a launch reads, but for the pointers to planes.
RaymarchParams raymarch_params(const RaymarchInput& in);

/// And of light by discrete ordinates, in.nodes.ordinates.
OrdinatesMarchParams ordinates_params(const RaymarchInput& in, const RaymarchParams& march);

/// Marches into the planes' transmittance, colour and what else they have room for; ends rays at
/// their opaque depth. kLimit: out of memory.
/// Planes have the size of the lattice.
Status raymarch_picture(const Context& context, const RaymarchInput& in, Planes& planes,
                        RaymarchTally& tally);

}  // namespace pileus
