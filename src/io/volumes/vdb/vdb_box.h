// SPDX-License-Identifier: Apache-2.0
// The box of a sparse grid's active voxels, and the dense volume in it.
// in: tiles and leaves as a walk meets them -> out: size, place and bounds of what they ask for.
// docs/formats.md
#pragma once
#include <array>
#include <string>

#include "src/io/text/byte_cursor.h"
#include "src/io/volumes/vdb/vdb_file.h"

namespace pileus {

/// Voxel indices of the file; it never leaves 32 bits by more than a tile's side.
using VdbPlace = std::array<std::int64_t, 3>;

/// Both ends are included; empty while low > high.
struct VdbBox {
    VdbPlace low{1, 1, 1}, high{0, 0, 0};
    std::uint64_t active = 0;     ///< active voxels, those of tiles included
    std::uint64_t values_at = 0;  ///< OpenVDB: where the voxels' values begin in the file

    bool empty() const { return low[0] > high[0]; }
    /// Takes in side^3 active voxels.
    void add_tile(const VdbPlace& at, std::int64_t side);
    /// Takes in the voxels of a leaf of 8^3 whose bits are on; bit x*64 + y*8 + z, 64 bytes.
    void add_leaf(const VdbPlace& origin, const unsigned char* mask);
    /// Where voxel `at` lies in the dense volume of the box.
    std::size_t index(const VdbPlace& at) const;
    /// Writes side^3 equal voxels into that volume.
    void fill_tile(const VdbPlace& at, std::int64_t side, float value, Volume& volume) const;

private:
    void grow(const VdbPlace& from, const VdbPlace& to);
};

/// Refuses what cannot be a density, in a line with the voxel's index.
Status check_vdb_value(const ByteCursor& in, const VdbPlace& at, float value);

/// Bounds the box by the project's limits and by what a file of `bytes` may ask for, and fills the
/// head's size and place; the centre of voxel i lies at scale * i + translation metres. `where`
/// opens each line.
Status frame_vdb_box(const std::string& where, std::uint64_t bytes, const VdbLimits& limits,
                     const VdbBox& box, const std::array<double, 3>& scale,
                     const std::array<double, 3>& translation, VolumeHead& head);

/// Takes memory, all 0, for what the head says: kLimit where there is none.
Status start_vdb_volume(const std::string& name, const VolumeHead& head, Volume& volume);

}  // namespace pileus
