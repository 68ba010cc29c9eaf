// SPDX-License-Identifier: Apache-2.0
// What one launch of the photon tracer needs: plain structs of fixed-width numbers and pointers.
// in: the plan and the prepared arrays -> out: the layout that a CPU or GPU launch takes.
// docs/methods.md 3. Lengths in metres, box-local; positions inside the kernel in voxels.
#pragma once
#include "kernels_cpu/core/rng.h"
#include "kernels_cpu/light/lamp_params.h"
#include "kernels_cpu/light/sky_map.h"
#include "kernels_cpu/media/optics.h"
#include "kernels_cpu/media/track_grid.h"
#include "kernels_cpu/solids/solids_params.h"

namespace pileus {

enum DepositMode : std::int32_t {
    kDepositNone = 0,      ///< energy ledger only
    kDepositIncident = 1,  ///< SH of the incident direction at every tentative collision
    kDepositOutgoing = 2,  ///< SH of the scattered direction at every real one (the paper)
    kDepositCamera = 3,    ///< phase function towards the camera, one number per cell
    kDepositCosine = 4,    ///< flux, and flux times the cosine to the light's axis; cells only
};

enum LightKind : std::int32_t {
    kLightBeam = 0,
    kLightDiffuse = 1,
    kLightMap = 2,
    kLightLamps = 3,  ///< what they send straight is in no deposit and in no map of the ground
    kLightMedia = 4,  ///< what a medium sends out by itself
};

struct TraceParams {
    TrackGrid grid;         ///< its max_events counts tentative collisions and bounces
    std::int32_t channels;  ///< 1 (achromatic media) or 3
    std::int32_t media;     ///< on the grid, 1..kMaxMedia
    Optics optics[kMaxMedia];

    std::int32_t light;         ///< LightKind
    float direction[3];         ///< of travel, unit; beam only
    std::int32_t hemisphere;    ///< diffuse: 0 all, -1 travelling down only, +1 up only
    SkyMapView map;             ///< light of a sky map only
    const LampEmission* lamps;  ///< light of lamps only
    std::int32_t lamp_count;
    const std::uint32_t* emitted_below;  ///< light of a medium only: [voxel], rising, 2^-32 of all
    float face_cdf[6];           ///< flux share of faces -x +x -y +y -z +z, cumulative; last = 1
    Key key;                     ///< made from (seed, stream of the light, photon index high half)
    std::uint32_t first_photon;  ///< low half of the index of the launch's photon 0
    std::uint32_t shift[2];      ///< of this generation's low-discrepancy points

    std::int32_t ground;  ///< 0: none
    float ground_z;       ///< m, box-local, <= 0
    float ground_albedo;
    float unowed[3];  ///< share of this light that the ground has not, by the air above it
    std::int32_t ground_cells[2];  ///< of the map of light that arrives there; 0: no map
    float ground_origin[2];        ///< m, box-local
    float ground_cells_per_metre[2];

    std::int32_t mode;         ///< DepositMode
    std::int32_t bands;        ///< 1..8
    std::int32_t first_order;  ///< beam light not yet scattered: 0 like all, 1 own slot, 2 left out
    float peak_turn;  ///< 1 - cos of turns by less that keep a photon with its beam; 0: none do
    std::int32_t axis_degrees;  ///< beyond the bands, about each axis
    std::int32_t axes;          ///< that have such numbers; a beam's are the first
    std::int32_t lamp_axis;     ///< number of the first axis of lamps
    std::int32_t coefficients;  ///< numbers per collector and channel
    float scale;                ///< quanta per unit deposit, a power of two
    float path_scale;           ///< quanta per metre of path
    float camera[3];            ///< position, or unit direction towards it when orthographic
    std::int32_t orthographic;
    float axis[3];  ///< the light's, unit: a beam's direction, down or up for diffuse light
    std::int32_t
        cells[3];  ///< of a regular grid that gathers at every tentative collision; 0: none
    float cells_per_voxel[3];
    float cell_density;  ///< least majorant density of blocks that hold medium: a deposit of 1
    SolidsView solids;   ///< without triangles: the launch knows nothing of them
};

/// Steps of the R2 sequence in units of 2^-32 (Roberts 2018): photon i starts at i * kR2 + shift.
constexpr std::uint32_t kR2[2] = {0xC13FA9A9u, 0x91E10DA5u};

/// Ledger unit: one photon of full weight.
constexpr std::int64_t kPhotonQuanta = std::int64_t{1} << 20;

/// Energy in quanta per channel; emitted = sum of the fates, exactly.
struct Fates {
    std::int64_t emitted[3], top[3], bottom[3], sides[3], absorbed[3], ground[3], sky[3],
        terminated[3], solid[3], direct_bottom[3];
};

/// Sums of integers, so that threads and chunks can be added in any order.
struct TraceTally {
    Fates light;   ///< of the photons shot
    Fates shadow;  ///< of the ground's missing light (docs/methods.md 3, step 1), counted positive
    std::int64_t photons, scatterings, tentative, crossings, path, majorant_violations;
    std::int64_t absorption_tests, bounces;  ///< 0 where nothing absorbs, or there is no ground
};

struct TraceBuffers {
    const std::int32_t* collector;  ///< per voxel, -1 where none
    std::int64_t* sums;             ///< collectors * channels * coefficients
    std::int64_t* ground;           ///< ground cells * channels, scaled like the sums
    TraceTally* tally;              ///< this thread's own
    const float* parts;             ///< [medium - 1][voxel]: densities of media 1, 2 ...
    std::int32_t shared_sums;       ///< 0: `sums` and `ground` are this thread's own, too
};

}  // namespace pileus
