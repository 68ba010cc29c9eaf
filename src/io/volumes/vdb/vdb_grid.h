// SPDX-License-Identifier: Apache-2.0
// What a .vdb file says before its trees: its grids, their metadata and their transforms.
// in: bytes -> out: a list of grids; for one of them the place of its tree.
// docs/formats.md
#pragma once
#include <array>
#include <string>
#include <vector>

#include "src/io/text/byte_cursor.h"
#include "src/io/volumes/vdb/vdb_names.h"
#include "src/io/volumes/vdb/vdb_transform.h"

namespace pileus {

constexpr unsigned kVdbZip = 1, kVdbActiveMask = 2, kVdbBlosc = 4;
constexpr std::uint32_t kVdbOldestVersion = 222, kVdbNewestVersion = 224;

/// One grid of the file. The second block is filled by read_vdb_grid.
struct VdbGrid {
    std::string unique_name;  ///< as stored; grids of one name differ behind a separator
    std::string name;         ///< as people know it
    std::string label;        ///< the same, of several with a number; once chosen
    std::string type;         ///< "Tree_float_5_4_3", without the mark of half floats
    std::string parent;       ///< unique name of the grid whose tree this one shares; or empty
    bool half = false;        ///< voxels are stored as 16-bit floats
    std::uint64_t at = 0, end = 0;

    std::string grid_class;  ///< "fog volume", "level set", ...
    unsigned compression = 0;
    VdbTransform transform;
    std::uint64_t tree_at = 0;

    bool is_number() const { return type == "Tree_float_5_4_3" || type == "Tree_double_5_4_3"; }
    unsigned value_bytes() const { return type == "Tree_double_5_4_3" ? 8 : 4; }
};

/// Reads the file's head and the list of its grids.
Status read_vdb_grids(ByteCursor& in, std::vector<VdbGrid>& grids);

/// Reads compression, metadata and, for a tree of numbers, the transform of one grid.
Status read_vdb_grid(ByteCursor& in, VdbGrid& grid);

/// Chooses as vdb_choices does, passing over level sets; reads the grid by read_vdb_grid, and
/// follows an instance to the tree that it shares.
Status choose_vdb_grid(ByteCursor& in, std::vector<VdbGrid>& grids, const std::string& name,
                       VdbGrid& chosen);

/// What the grids are called, with labels.
std::vector<VdbName> vdb_names(const std::vector<VdbGrid>& grids);

/// "blosc", "zip" or "not packed".
const char* vdb_packing_text(unsigned compression);

}  // namespace pileus
