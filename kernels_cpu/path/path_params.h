// SPDX-License-Identifier: Apache-2.0
// What one launch of the path tracer needs: plain structs of fixed-width numbers and pointers.
// in: the scene's stages -> out: the layout that a CPU or GPU launch takes.
// docs/path.md. Lengths in metres, box-local; positions inside the kernel in voxels.
#pragma once
#include "kernels_cpu/core/camera.h"
#include "kernels_cpu/core/rng.h"
#include "kernels_cpu/light/ground_params.h"
#include "kernels_cpu/light/lamp_params.h"
#include "kernels_cpu/light/sky_sample.h"
#include "kernels_cpu/light/sun_heights_params.h"
#include "kernels_cpu/media/optics.h"
#include "kernels_cpu/media/track_grid.h"
#include "kernels_cpu/path/importance_params.h"
#include "kernels_cpu/solids/solids_params.h"

namespace pileus {

/// Groups of three channels that a sample is stored in.
enum PathPart : std::int32_t {
    kPathTotal = 0,   ///< all light
    kPathSun = 1,     ///< that started at the sun
    kPathSingle = 2,  ///< scattered once by the media, and reflected by nothing
    kPathCloud = 3,   ///< last turned by the media; what is left is the background
};
constexpr int kPathParts = 4;

/// Shadow rays that bring less than this per irradiance, 1/sr, play Russian roulette: 1.6 times
/// what an isotropic medium would bring (measured: docs/path.md, "Costs").
constexpr float kLightRoulette = 1.0f / 8.0f;

/// Branches towards the sun: directions of Henyey-Greenstein within a cone about it.
struct GuideParams {
    std::int32_t on;  ///< 0: no branches
    float g;          ///< above 0
    float cone;       ///< 1 - cos of its half angle
    float share;      ///< of Henyey-Greenstein's light that turns by less
    float unit;       ///< 1 / share
    float worth;      ///< branches are as rare as that each brings about this per irradiance, 1/sr
};

struct PathParams {
    TrackGrid grid;         ///< majorants of src/methods/path/path_blocks.h
    float extent[3];        ///< box edges, m
    std::int32_t channels;  ///< 1 (achromatic media) or 3
    std::int32_t media;     ///< on the grid, 1..kMaxMedia
    Optics optics[kMaxMedia];
    const float* parts;  ///< [medium - 1][voxel]: densities of media 1, 2 ...

    CameraParams camera;
    std::int32_t jitter;  ///< 0: rays through the middles of pixels, 1: spread over them

    std::int32_t sunlit;     ///< 0: no sun
    float to_sun[3];         ///< unit
    float sun[3];            ///< irradiance on a plane facing it
    SunHeights sun_heights;  ///< with rows in place of `sun`
    float sun_disc;          ///< 1 - cos of its radius; 0: a point. Read by trace_paths_full alone
    GuideParams guide;       ///< as sun_disc
    float sky[3];            ///< radiance, where there is no map of it
    std::int32_t sky_lit;    ///< 0: the sky is black
    SkyMapView map;          ///< no columns: none
    SkySampler sampler;      ///< of the map
    std::int32_t ground;     ///< 0: none
    float ground_z;          ///< m
    float ground_albedo;
    GroundPaint paint;

    std::int32_t max_depth;  ///< scatterings after which light is not followed; >= 1
    Key key;                 ///< made from (seed, stream, high half of the sample's number)
    std::uint32_t pixels;    ///< of the film
    /// Launch sample s belongs to pixel first_pixel + s / per_pixel, where its number, low half, is
    /// first_sample + s % per_pixel; number * pixels fits 32 bits.
    std::uint32_t first_pixel, first_sample, per_pixel;
    std::int32_t parts_wanted;  ///< 0: the total alone is stored
    float light_roulette;       ///< kLightRoulette; 0: every shadow ray flies
    SolidsView solids;          ///< read by trace_paths_full alone, as is
    const float* camera_depth;  ///< [pixel], m along the ray; null: no such image

    // Read by trace_paths_full alone.
    std::int32_t lamp_count;  ///< 0: none
    const LampParams* lamps;
    std::int32_t lamp_spheres;  ///< 0: none of them is a sphere
    float lamp_near;     ///< m: nearer to a lamp, light is found between vertices, else at them
    std::int32_t emits;  ///< 0: no medium shines by itself

    const ImportanceParams* importance;  ///< read by trace_paths_importance alone; null: none
};

/// Sums of integers, so that threads and chunks can be added in any order.
struct PathTally {
    std::int64_t paths, scatterings, bounces;  ///< bounces: off the ground
    std::int64_t tentative, crossings;         ///< of both kinds of flight
    std::int64_t shadow_rays;                  ///< flights towards lights, sun and map
    std::int64_t shadow_tentative;             ///< tentative collisions on them
    std::int64_t terminated;  ///< paths given up after max_events draws, flights that would not end
    std::int64_t nan;         ///< samples that were no finite number, stored as 0
    std::int64_t majorant_violations;
    std::int64_t splits;   ///< copies of particles besides the first
    std::int64_t unsplit;  ///< vertices where too many waited already
};

struct PathBuffers {
    float* radiance;       ///< [part][channel][sample], each `stride` long
    std::uint64_t stride;  ///< samples
    PathTally* tally;      ///< this thread's own
};

}  // namespace pileus
