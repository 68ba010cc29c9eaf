// SPDX-License-Identifier: Apache-2.0
// What the sweep of the sun's optical depth needs: plain structs, and the order of its blocks.
// in: weights made on the host (src/picture/nodes/sweep_taps.h) -> out: the layout of a launch.
// docs/buffer.md
#pragma once
#include <cstdint>

namespace pileus {

/// Rows that become lanes where slices follow one another along x.
constexpr std::int32_t kSweepRows = 16;

/// Weights of what a node's new optical depth is made of. Its ray to the next slice lies over the
/// four neighbours u + 2 v: u and v are 1 a step towards the sun along the two lesser axes.
struct SweepTaps {
    float above[4];  ///< of the optical depth on the slice nearer the sun
    float far[4];    ///< of the density there, times metres and extinction
    float near[4];   ///< of the density on the node's own slice, the same
};

/// SweepParams::taps has one entry for each sum of these: where a step towards the sun leaves the
/// grid along the slices, and along either lesser axis.
constexpr int kSweepTop = 1, kSweepRimU = 2, kSweepRimV = 4;

struct SweepParams {
    std::int32_t size[3];    ///< voxels, which are the nodes
    std::int32_t axis;       ///< 0..2: slices follow one another along it
    std::int32_t step[3];    ///< +1 or -1: towards the sun
    std::int32_t edge[2];    ///< of a block along y and z, voxels
    std::int32_t blocks[2];  ///< along y and z
    std::int32_t diagonal;   ///< that a launch makes: its blocks (y, diagonal - y), told by y
    SweepTaps taps[8];
};

inline std::int32_t diagonals(const SweepParams& k) { return k.blocks[0] + k.blocks[1] - 1; }

/// The y of blocks that lie on k.diagonal, half-open.
struct SweepRange {
    std::uint32_t begin, end;
};
inline SweepRange diagonal_blocks(const SweepParams& k) {
    const std::int32_t first = k.diagonal < k.blocks[1] ? 0 : k.diagonal - k.blocks[1] + 1;
    const std::int32_t last = k.diagonal < k.blocks[0] ? k.diagonal : k.blocks[0] - 1;
    return {std::uint32_t(first), std::uint32_t(last) + 1};
}

/// One neighbour of a periodic sweep, which goes along z; its places wrap around.
struct SweepTap {
    std::int32_t dx, dy;  ///< voxels, 0 <= dx < size[0], 0 <= dy < size[1]
    std::int32_t from;    ///< 0 optical depth above, 1 density above, 2 density of the own slice
    float weight;
};
struct SweepLayerParams {
    std::int32_t size[3];
    std::int32_t plane, above;  ///< slice to make, and its neighbour towards the sun
    std::int32_t taps;
};

struct SweepBuffers {
    const float* density;
    float* optical_depth;
    const SweepTap* taps;  ///< of a periodic sweep
};

}  // namespace pileus
