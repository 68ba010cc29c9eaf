// SPDX-License-Identifier: Apache-2.0
// What the kernels of discrete ordinates need: plain structs and pointers.
// in: nodes over a medium's box, directions, light at its faces -> out: the layout of a launch.
// docs/ordinates.md
#pragma once
#include "kernels_cpu/light/sky_map.h"
#include "kernels_cpu/raymarch/raymarch_params.h"

namespace pileus {

constexpr int kOrdinates = 32;        ///< double Gauss in height, 2 + 2, times 8 azimuths
constexpr int kOrdinateMoments = 16;  ///< spherical harmonics up to degree 3
constexpr int kMaxOrdinateSets = 9;   ///< of light: three by channel, six of the ground
constexpr int kOrdinateClasses = 6;   ///< lengths of ways through a node, at most

/// Degree of a moment.
constexpr int ordinate_degree(int moment) {
    return moment == 0 ? 0 : moment < 4 ? 1 : moment < 9 ? 2 : 3;
}

/// How one direction goes through the nodes: slice by slice along `axis`. Rows of a slice run along
/// `along`, which is x but for slices along x.
struct OrdinateSweep {
    std::int32_t axis, along, across;
    std::int32_t up;       ///< 1: from the first slice to the last
    std::int32_t base[2];  ///< nodes back along `along` and `across`, whole part; >= 0 if periodic
    float weight[2][2];    ///< of the slice before: [across][along]
    std::int32_t length;   ///< which class of ways
};

/// A way to a node that solids end, wholly or in part, of one direction.
struct OrdinateWall {
    std::int32_t place;  ///< the node's
    float weight[2][2];  ///< OrdinateSweep::weight, less what solids end
    float sends;         ///< radiance of what ends it, times its share
    float out, mean;     ///< of the node: what leaves it and what is within, while its row is swept
};

struct OrdinatesParams {
    std::int32_t size[3];  ///< nodes
    std::int32_t filled;   ///< of them, those that hold medium
    std::int32_t periodic;
    OrdinateSweep sweep[kOrdinates];
    float harmonic[kOrdinates][kOrdinateMoments];  ///< of its direction
    float weight[kOrdinates];                      ///< solid angle, sr; 4 pi in all
    std::int32_t media;                            ///< 1..kMaxMedia
    float scatter[kMaxMedia][4];        ///< albedo times the phase function's moments, both scaled
    float beam[kMaxMedia][kOrdinates];  ///< share of a beam's light scattered there, 1/sr
    float enters[kOrdinates];           ///< radiance at the faces
    float below[kOrdinates];            ///< of light that goes up, at the lower one
};

struct OrdinatesBuffers {
    const std::int32_t* place;    ///< [filled]: of nodes, x fastest, then y
    const std::int32_t* place_x;  ///< [filled]: where slices are along x: y fastest, then z
    const float* pass;            ///< [class][place]: e^-t of the way through a node
    const float* mean;            ///< [class][place]: (1 - e^-t) / t; 0: empty and beside no solid
    const float* beam;            ///< [filled]: irradiance of the beam; null: none
    const float* fixed;           ///< [direction][filled]: source of lamps and media; null: none
    const float* part;            ///< [medium][filled]: of extinction that counts; null: one medium
    float* radiance;      ///< [direction][place]: source, then mean radiance; 0 in empty nodes
    float* moments;       ///< [moment][filled]
    float* slices;        ///< of one thread: ordinate_slice_floats
    OrdinateWall* walls;  ///< by direction, in the order of its sweep; null: none
    const std::int32_t* first_wall;  ///< [direction + 1]
};

/// Floats of a row of a slice with what lies beyond its ends, and of two slices.
inline std::int64_t ordinate_row(const OrdinatesParams& k, const OrdinateSweep& s) {
    const std::int64_t n = k.size[s.along];
    return k.periodic != 0 ? 2 * n + 1 : n + 2;
}
inline std::int64_t ordinate_slice_floats(const OrdinatesParams& k, const OrdinateSweep& s) {
    return 2 * ordinate_row(k, s) * (k.size[s.across] + 2);
}

constexpr int kMaxOrdinateLevels = 8;

/// Nodes of a sky in place: levels around the camera, each over twice the width of the one before
/// it; all have as many nodes. Heights are shares of the layer's.
struct OrdinateLevelsView {
    std::int32_t count;                      ///< 0: nodes of one grid over the medium's box
    std::int32_t wraps;                      ///< 1: the last level repeats along x and y
    float low[kMaxOrdinateLevels][2];        ///< corner, m, box-local
    float per_metre[kMaxOrdinateLevels][2];  ///< nodes
    float middle[kMaxOrdinateLevels][2];     ///< of the square that is read of a level, m
    float per_reach[kMaxOrdinateLevels][2];  ///< one over half its width, 1/m
};

/// What a march reads of them.
struct OrdinatesMarchParams {
    RaymarchParams march;
    NodeGrid nodes;
    OrdinateLevelsView levels;
    std::int32_t sets;     ///< of light, each of one colour
    std::int32_t moments;  ///< kOrdinateMoments: there are such, read near the camera; 0: none
    float per_near;        ///< of half the distance to where they count no more, 1/m; 0: no end
    float colour[kMaxOrdinateSets][3];              ///< R G B of each set
    float scatter[kMaxOrdinateSets][kMaxMedia][4];  ///< of each set, by degree; with moments alone
    std::int32_t channels;                          ///< 1, or 3 where they absorb differently
    float rest[kMaxMedia][3];  ///< 1 - albedo times the peak's share: of extinction that counts
    float beam_rest[3];        ///< of what the beam's tables are of
    float turn;                ///< 1 - cos of the peak's width
    std::int32_t sunlit;
    float sun[kMaxMedia][3];  ///< irradiance times albedo
    BehindView behind;
};
struct OrdinatesMarchBuffers {
    RaymarchBuffers march;
    const float* light;     ///< [set][medium][node]: scattered towards the camera
    const float* moments;   ///< [set][moment][node], of the finest level; null: none
    const float* beam;      ///< tables of beam.h, [channel]
    const float* surfaces;  ///< [3][pixel] of the whole picture: of what is solid; null: nothing is
    const float* sunward;  ///< [medium][node]: of the optical depth to the sun; null: of one medium
};

}  // namespace pileus
