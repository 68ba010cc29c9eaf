// SPDX-License-Identifier: Apache-2.0
// What the kernel of method `raymarch` needs: plain structs and pointers.
// in: the plan, the density, sunlight on nodes -> out: the layout of a launch.
// docs/raymarch.md; Palenik 2016.
#pragma once
#include "kernels_cpu/display/march_params.h"
#include "kernels_cpu/display/upsample_params.h"

namespace pileus {

/// How one panel of the integral along a ray is added up.
enum RaymarchRule : std::int32_t {
    kRuleClosed = 0,     ///< S (1 - e^-tau), density and light from the middle
    kRuleRiemann = 1,    ///< (3.6), (3.7): density and light from the start
    kRuleTrapezoid = 2,  ///< (4.3)
    kRuleSimpson = 3,    ///< (4.5), two steps a panel
    kRuleSimpson38 = 4,  ///< (4.7), three steps a panel
};

enum RaymarchPowder : std::int32_t {
    kPowderNone = 0,
    kPowderAlone = 1,        ///< (3.13)
    kPowderBeer = 2,         ///< (3.14)
    kPowderDirectional = 3,  ///< (3.15)
    kPowderSimple = 4,       ///< Maerkl 2018, (3.1): a share of it, by the way to the sun
    kPowderLocal = 5,        ///< the same by the extinction at the place; his 5.1.6
};

/// How far rays begin before the medium, so that their samples do not line up.
enum RaymarchJitter : std::int32_t {
    kJitterNone = 0,
    kJitterHash = 1,
    kJitterTile = 2,  ///< from a tile that repeats over the picture
};
constexpr std::int32_t kNoiseTile = 64;  ///< pixels of its edge

/// Steps of a panel, each of which takes one sample.
constexpr int rule_steps(std::int32_t rule) {
    return rule == kRuleSimpson ? 2 : rule == kRuleSimpson38 ? 3 : 1;
}

/// Where steps along a ray lie. Step n begins at first (growth^n - 1) / (growth - 1) metres; as
/// many or fewer than `most` reach through the medium.
struct StepParams {
    float most;                ///< steps a ray; 0: none
    float least_m;             ///< no first step is shorter
    std::int32_t grows;        ///< 0: all alike
    std::int32_t by_distance;  ///< 1: growth - 1 is `pixel`, or what `most` steps need
    float growth;              ///< of one step over the one before
    float series;              ///< sum of growth^n over `most` steps
    float pixel;               ///< edge of a pixel at distance 1
    float near_m;              ///< distance below which steps stay alike
    std::int32_t jitter;       ///< a RaymarchJitter
    float jitter_share;        ///< of a panel, at most
    std::uint32_t key[2];      ///< of the hash; of the tile, the place of its corner
    float grid_m;              ///< > 0: lattices begin at planes across the view so far apart
    std::int32_t stretch;      ///< 1: steps adapt to what stands behind (4.1), (4.2)
};

/// Directions that a fuzzy way to the sun takes in turn.
constexpr int kLightTurns = 16;

constexpr int kMaxOctaves = 8;

/// Several scatterings as weaker and weaker copies of the first (Wrenninge, Kulla, Lundqvist 2013):
/// octave n sees extinction^n of the extinction, has share^n of the light and a phase function
/// of anisotropy^n of the mean cosine.
struct Octaves {
    std::int32_t count;  ///< 1: the first scattering alone
    float extinction, share;
};

/// Share of the extinction that octave n sees of the way to a light where media absorb: no less
/// than that by which light fades that was scattered often.
struct OctaveDepths {
    std::int32_t channels;  ///< of these; 0: no medium absorbs, all are octaves.extinction^n
    float thinner[kMaxMedia][kMaxOctaves][3];
};

/// How sunlight finds its way to a place.
struct RaymarchLight {
    std::int32_t march;  ///< 0: from nodes
    NodeGrid nodes;      ///< of optical depths towards the sun
    std::int32_t steps;  ///< of a march; 0: as many of `first_m` as the way takes
    float first_m;       ///< 0: steps share the way
    float growth;        ///< of one step over the one before
    float series;        ///< sum of growth^n over `steps`
    std::int32_t turns;  ///< 0: straight; else so many directions one after the other
    float direction[kLightTurns][3];
    std::int32_t powder;    ///< a RaymarchPowder
    float powder_strength;  ///< k of (3.13); powderDepth of Maerkl's (3.1)
    float powder_share;     ///< powderStrength of Maerkl's (3.1)
    std::int32_t channels;  ///< 1, or 3 where the light kept differs by channel
    std::int32_t forward;   ///< 1: some light is kept
    Octaves octaves;
    float octave_g[kMaxMedia][kMaxOctaves];  ///< of Henyey-Greenstein; from octave 1 on
    float kept[kMaxMedia][3];  ///< share of scattered light that goes on as if unscattered
};

/// Skylight on nodes: sets of brightness, each of one colour.
struct RaymarchSky {
    NodeGrid nodes;
    std::int32_t sets;   ///< 0: none
    float colour[3][3];  ///< R G B of each set
};

/// Coarser grids of the density, each of half the cells along each axis.
constexpr int kMaxLevels = 12;

struct RaymarchParams {
    MediumView medium;
    std::int32_t levels;           ///< coarser grids; 0: none
    MediumView level[kMaxLevels];  ///< of them, the finest first
    CameraParams camera;           ///< of the whole picture
    PixelLattice lattice;          ///< the pixels of it that are marched
    std::int32_t media;            ///< on the grid, 1..kMaxMedia
    std::int32_t rule;             ///< a RaymarchRule
    PhaseParams phase[kMaxMedia];
    float phase_scale[kMaxMedia];  ///< 1, or one over the phase function's peak
    float to_sun[3];
    float sun_source[kMaxMedia][3];                  ///< irradiance times albedo
    float octave_source[kMaxMedia][kMaxOctaves][3];  ///< that of octave n, its share in it
    OctaveDepths octave_depths;
    float albedo[kMaxMedia][3];
    RaymarchSky sky;
    std::int32_t sunlit;  ///< 0: all of them are zero
    float ambient[3];     ///< emission over extinction, everywhere in the media
    StepParams step;
    RaymarchLight light;
    float cut;            ///< stop below this transmittance
    NodeGrid visibility;  ///< nodes of what solids leave of the sun
};

/// Counted per launch row; a block's counts go to its first row.
enum RaymarchCount {
    kCountSamples = 0,       ///< densities read along rays
    kCountLightSamples = 1,  ///< densities read towards the sun
    kCountBreaches = 2,      ///< pixels whose sum exceeded its own bound
    kCountCut = 3,           ///< rays that were given up before their end
    kRaymarchCounts = 4,
};

struct SkyLightView;

struct RaymarchBuffers {
    const float* optical_depth;  ///< light nodes; unused by a march
    const float* sky;            ///< [set][node]; unused without skylight
    const float* opaque_depth;   ///< [pixel], m along the ray; null: nothing opaque
    const float* noise;          ///< [kNoiseTile][kNoiseTile] in [0, 1); of its jitter alone
    const float* parts;          ///< [medium - 1][voxel]: densities of media 1, 2 ...
    float* transmittance;        ///< [pixel]
    float*
        half_depth;    ///< [pixel], m; infinity where transmittance stays above 1/2; null: unwanted
    float* colour;     ///< [3][pixel], premultiplied
    float* ray_depth;  ///< [pixel], optical depth along the ray; null: not wanted
    std::int64_t* counts;           ///< [row][kRaymarchCounts], added to
    const float* visibility;        ///< its nodes, share of the sun that no solid hides; null: all
    const SkyLightView* sky_light;  ///< of a sky in place; null: its samples march to the sun
};

}  // namespace pileus
