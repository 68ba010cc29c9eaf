// SPDX-License-Identifier: Apache-2.0
// What the marching kernels need: plain structs and pointers.
// in: the plan and the lit grids -> out: the layout of a launch.
// docs/methods.md 3, repairs 3 and 4.
#pragma once
#include "kernels_cpu/core/camera.h"
#include "kernels_cpu/light/ground_params.h"
#include "kernels_cpu/light/lamp_params.h"
#include "kernels_cpu/light/sky_map.h"
#include "kernels_cpu/media/detail_params.h"
#include "kernels_cpu/media/optics.h"

namespace pileus {

/// The density grid and its majorants as the marching kernels see it.
struct MediumView {
    std::int32_t size[3];    ///< voxels
    float cell[3];           ///< voxel edges, m
    float extent[3];         ///< box edges, m
    std::int32_t blocks[3];  ///< majorant blocks, used to skip empty space
    float block;             ///< block edge, voxels
    float sigma;             ///< extinction at density 1, 1/m
    float step;              ///< m
    const float* density;
    const float* majorant;
    std::int32_t periodic;  ///< 1: the box, and every grid over it, repeats along x and y
    std::int32_t constant;  ///< 1: a voxel has one density; 0: trilinear between centres
    const DetailView*
        detail;  ///< for kernels of the group Detail, which no others read; null: none
};

/// A grid of nodes at (i + 1/2) * spacing over the same box.
struct NodeGrid {
    std::int32_t size[3];
    float per_metre[3];  ///< nodes per metre along each axis
};

/// Some of the nodes of a grid, around a camera within it.
struct NearNodes {
    std::int32_t first[3];
    std::int32_t size[3];  ///< 0: none
    float reach;           ///< m from the camera to where they no longer count
    float every;           ///< m along a ray from one look at them to the next
};

/// Pixel (i, j) of the marched ones is pixel (first + every * (i, j)) of the picture.
struct PixelLattice {
    std::int32_t every;
    std::int32_t first[2];
    std::int32_t width, height;  ///< marched pixels, all of them within the picture
};

/// Every pixel.
inline PixelLattice whole_lattice(const CameraParams& c) { return {1, {0, 0}, c.width, c.height}; }

struct ShadowParams {
    MediumView medium;
    NodeGrid nodes;
    float origin[3];  ///< of the nodes, m, box-local
    float to_sun[3];
};
/// Nodes along x, the last excluded; none where first >= last.
struct NodeRange {
    std::int32_t first, last;
};
struct ShadowBuffers {
    float* optical_depth;             ///< nodes
    const NodeRange* rows = nullptr;  ///< those of each row that are wanted; null: all
};

/// Harmonics of a node are stored in groups of so many, the last one filled up with zeros.
constexpr int kHarmonicsAbreast = 16;
constexpr int kMaxHarmonics = 96;

static_assert(kMaxHarmonics % kHarmonicsAbreast == 0, "whole groups");

/// A beam's light by angle and optical depth: what scatterings within its peak add to what is left
/// of it. Angles even near both ends, depths as tau / (tau + kBeamDepth).
constexpr int kBeamAngles = 1024, kBeamDepths = 32;
constexpr float kBeamDepth = 4;
constexpr int kBeamNumbers = (kBeamAngles + 1) * (kBeamDepths + 1);

constexpr int kWiderSteps = 3;

/// What lies behind media, as light that turns within the peak of a phase function brings it.
constexpr int kHorizon = 17;
struct BehindView {
    float sky[3];     ///< radiance
    SkyMapView map;   ///< or of a map
    float ground[3];  ///< of rays that go down
    std::int32_t has_ground;
    /// Share of what turns within the peak that comes from above the horizon, by the sine of the
    /// ray's height, from 0 to that of the peak's width.
    float horizon[kHorizon];
    float per_horizon;  ///< entries of it in a sine of 1
    /// 1: what sends nothing is a depth image, which hides things from the camera alone: sky and
    /// ground behind it shine on what stands before.
    std::int32_t hidden;
};

struct MarchParams {
    MediumView medium;
    CameraParams camera;
    PixelLattice lattice;  ///< the pixels of it that are marched; planes are of its size
    std::int32_t media;    ///< on the grid, 1..kMaxMedia
    PhaseParams phase[kMaxMedia];
    float sun_travel[3];
    float sun_source[kMaxMedia][3];  ///< irradiance times albedo; all zero: no direct sunlight
    float constant[3];  ///< source everywhere in the media: sky by the furnace identity
    float least[3];  ///< of what nodes beside the camera send, that with the constant none is < 0
    NodeGrid shadow, source;
    std::int32_t channels;  ///< planes of `source` and of `colour`: 3, or 3*(1+batches)
    std::int32_t bands;     ///< 0; or nodes hold bands*bands harmonics of what goes each way
    std::int32_t degrees;   ///< and so many more of what is even about each axis
    std::int32_t axes;
    LightAxis axis[kMaxAxes];
    std::int32_t harmonics;  ///< stored per set and node
    std::int32_t sets;       ///< 1..3 of such harmonics
    float set_colour[3][3];  ///< R G B of each
    NearNodes near;          ///< of `source`, those that hold harmonics; else all do, with bands
    float cut;               ///< stop below this transmittance
    /// Below these transmittances, falling, steps are 2, 4 and 8 times as long; 0: they are not.
    float wider[kWiderSteps];
    std::int32_t together;  ///< 1: quads hold the optical depths, too
    std::int32_t
        beam_sets;       ///< tables of the sun's light that stays in its beam: 0, 1 or a channel
    float beam_rest[3];  ///< share of extinction that takes light out of the beam, by channel
    /// Light on nodes is what turns by more than the peak of the phase function, and the beam's
    /// tables are of turns within it alone: channels of what is left where these do not count, 1
    /// or 3; 0: nodes and tables have all turns.
    std::int32_t apart;
    float rest[kMaxMedia][3];  ///< 1 - albedo times the peak's share: of extinction that counts
    float peak_turn;           ///< 1 - cos of the peak's width
    BehindView behind;
};
struct MarchBuffers {
    const float* optical_depth;  ///< shadow nodes; unused without direct sunlight
    const float* source;  ///< [channel][node], scattered light towards the camera; with bands and
                          ///< no near nodes: [node][set][harmonic], scattered light per direction
    const float* opaque_depth;  ///< [pixel], m along the ray; null: nothing opaque
    const float* parts;         ///< [medium - 1][voxel]: densities of media 1, 2 ...
    float* transmittance;       ///< [pixel]
    float* half_depth;          ///< [pixel], m; infinity where transmittance stays above 1/2;
                                ///< null: not wanted
    float* colour;              ///< [channel][pixel], premultiplied
    float* ray_depth;           ///< [pixel], optical depth along the ray; null: not wanted
    const float* beam;          ///< [set][angle][depth], 1/sr; src/world/light/beam.h
    const float* visibility;    ///< shadow nodes, share of the sun that no solid hides; null: all
    /// [node][R, G, B, optical depth to the sun] in place of `source`, and, where the shadow nodes
    /// are the same, of `optical_depth`; null: none. For three channels without bands.
    const float* quads;
    const float* near;      ///< [channel / 3][near node][set][harmonic]; null: none
    const float* surfaces;  ///< [3][pixel] of the whole picture: of what is solid; null: nothing is
};

struct BackgroundParams {
    MediumView medium;
    CameraParams camera;
    float sky[3];  ///< radiance, where there is no map of it
    SkyMapView sky_map;
    std::int32_t ground;      ///< 0: none
    float ground_z;           ///< m, box-local
    float ground_diffuse[3];  ///< radiance under the sky alone
    float ground_sun[3];      ///< radiance added by the unshadowed sun
    float sun_rest[3];        ///< of the extinction, what keeps sunlight from surfaces
    NodeGrid map;             ///< of light scattered onto the ground; size 0: none
    float map_origin[2];      ///< m, box-local
    /// 1 over the ground's, of a map that no solid darkens; of photons' maps and black grounds 0.
    float map_per_albedo;
    float to_sun[3];
    NodeGrid shadow;         ///< of optical depths on the ground; size 0: rays look for themselves
    float shadow_origin[2];  ///< m, box-local
    GroundPaint paint;
};

/// Light that falls on a surface from all around but the sun, over pi: harmonics of its normal.
constexpr int kAroundTerms = 9;

/// That light around nodes beside solids.
struct AroundNodes {
    NodeGrid nodes;  ///< over the medium's box; size 0: none
    std::int32_t periodic;
    std::int32_t count;          ///< nodes that it is known of
    const std::int32_t* number;  ///< [node]: among them; -1: not
    const float* light;          ///< [3][kAroundTerms][count]
};

struct BackgroundBuffers {
    const float* map;     ///< [3][cell], radiance
    float* colour;        ///< [3][pixel]; null: not wanted
    float* opaque_depth;  ///< [pixel], m; infinity for the sky; null: nothing solid
    /// [pixel]: of what stands at opaque_depth, which then is read; null: not wanted.
    float* shadow = nullptr;
    const float* ground_depth = nullptr;  ///< nodes of BackgroundParams::shadow, towards the sun
    AroundNodes around{};
};

}  // namespace pileus
