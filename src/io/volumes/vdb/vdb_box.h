// SPDX-License-Identifier: Apache-2.0
// The box of a sparse grid's active voxels, and the dense volume in it.
// in: tiles and leaves as a walk meets them -> out: size, place and bounds of what they ask for.
// docs/formats.md
#pragma once
#include <array>
#include <optional>
#include <string>

#include "src/io/text/byte_cursor.h"
#include "src/io/volumes/undershoot.h"
#include "src/io/volumes/vdb/vdb_file.h"
#include "src/io/volumes/vdb/vdb_names.h"
#include "src/io/volumes/vdb/vdb_transform.h"

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
    /// Lays the dense volume of the box along the axes of the world.
    void lay(const VdbTransform& transform);
    /// Where voxel `at` lies in that volume.
    std::size_t index(const VdbPlace& at) const;
    /// Writes side^3 equal voxels into it.
    void fill_tile(const VdbPlace& at, std::int64_t side, float value, Volume& volume) const;

private:
    void grow(const VdbPlace& from, const VdbPlace& to);

    std::int64_t first_ = 0;
    std::array<std::int64_t, 3> stride_{};  ///< in the volume, of each axis of indices
};

/// What the voxels of a grid must be: finite, and not negative but for a little.
class VdbChecks {
public:
    /// Leaves 0 for a negative value. Not finite: kBadInput, in a line with the voxel's index.
    Status take(const ByteCursor& in, const VdbPlace& at, float& value);
    /// After the last one: kBadInput where one was too far below 0.
    Status finish(Volume& volume) const;

private:
    Status fault(const ByteCursor& in, const VdbPlace& at, const std::string& text) const;

    Undershoot undershoot_;
    std::optional<ByteCursor> lowest_in_;
    VdbPlace lowest_at_{};
};

/// Bounds the box by the project's limits and by what a file of `bytes` may ask for, lays it, and
/// fills the head's size and place. A box of nothing becomes voxel 0 0 0. `where` opens each line.
Status frame_vdb_box(const std::string& where, std::uint64_t bytes, const VdbLimits& limits,
                     const VdbTransform& transform, VdbBox& box, VolumeHead& head);

/// One line about a grid: "grid \"density\" of ...; zip; 7 active voxels".
std::string vdb_detail(const std::string& label, const std::vector<VdbName>& names,
                       const std::string& packing, const VdbTransform& transform,
                       const VdbBox& box);

/// Takes memory, all 0, for what the head says: kLimit where there is none.
Status start_vdb_volume(const std::string& name, const VolumeHead& head, Volume& volume);

}  // namespace pileus
