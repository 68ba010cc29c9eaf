// SPDX-License-Identifier: Apache-2.0
// What a .nvdb file says before its trees: its grids, and for one of them its unpacked bytes.
// in: bytes -> out: a list of grids; a grid's bytes, its transform and its tree's place.
// docs/formats.md
#pragma once
#include <array>
#include <string>
#include <vector>

#include "src/base/buffer.h"
#include "src/io/text/byte_cursor.h"
#include "src/io/volumes/vdb/vdb_names.h"
#include "src/io/volumes/vdb/vdb_transform.h"

namespace pileus {

/// Where a tree's numbers stand: a root's, a tile's and a leaf's parts in bytes from their begin.
struct NvdbLayout {
    unsigned value_bytes = 4;  ///< of tiles and backgrounds
    unsigned code_bits = 0;    ///< a voxel: so many bits of a code; 0 for a whole number
    bool own_bits = false;     ///< each leaf says how many bits
    unsigned background = 28, root_bytes = 64, tile_value = 20, leaf_values = 96;
};

struct NvdbGrid {
    std::string name;
    std::string label;  ///< the same, of several with a number; once chosen
    std::uint32_t type = 0, grid_class = 0;
    std::uint64_t at = 0, packed = 0;  ///< in the file: first byte, number of bytes
    std::uint64_t size = 0;            ///< bytes once unpacked
    unsigned compression = 0;          ///< kVdbZip, kVdbBlosc or 0

    // Filled by open_nvdb_grid.
    VdbTransform transform;
    NvdbLayout layout;
};

constexpr std::uint64_t kNvdbTreeAt = 672;  ///< every grid's tree begins here

/// Reads the heads of all segments of the file.
Status read_nvdb_grids(ByteCursor& in, std::vector<NvdbGrid>& grids);

/// What the grids are called, with labels.
std::vector<VdbName> nvdb_names(const std::vector<NvdbGrid>& grids);

/// Chooses as vdb_choices does, passing over level sets.
Status choose_nvdb_grid(const ByteCursor& in, const std::vector<NvdbGrid>& grids,
                        const std::string& name, NvdbGrid& chosen);

/// Hands out the grid's bytes, unpacked into `room` where they must be. Out of memory: kLimit.
Status unpack_nvdb_grid(ByteCursor& in, const NvdbGrid& grid, Buffer<char>& room,
                        Span<const char>& bytes);

/// Checks the head of these bytes against the list's, and reads the transform.
Status open_nvdb_grid(ByteCursor& in, NvdbGrid& grid);

}  // namespace pileus
