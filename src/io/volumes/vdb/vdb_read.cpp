// SPDX-License-Identifier: Apache-2.0
// From a .vdb file to a Volume: chooses the grid, bounds the box, fills it.
// in: bytes or a path -> out: see vdb_file.h.
// docs/formats.md
#include "src/base/file.h"
#include "src/io/volumes/vdb/vdb_file.h"
#include "src/io/volumes/vdb/vdb_tree.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {

namespace {

/// A grid, where it is, and what both passes need of it.
struct Found {
    std::vector<VdbGrid> grids;
    VdbGrid grid;
    VdbBox box;
    VolumeHead head;
};

Status find_grid(ByteCursor& in, const std::string& name, Span<const char> bytes,
                 const std::string& grid, const VdbLimits& limits, Found& found) {
    PILEUS_TRY(read_vdb_grids(in, found.grids));
    PILEUS_TRY(choose_vdb_grid(in, found.grids, grid, found.grid));
    PILEUS_TRY(measure_vdb_tree(in, found.grid, found.box));
    return frame_vdb_box(name + ": grid " + quote_text(found.grid.name), bytes.size, limits,
                         found.box, found.grid.scale, found.grid.translation, found.head);
}

std::string compression_text(unsigned flags) {
    const std::string text = vdb_packing_text(flags);
    return flags & kVdbActiveMask ? text + ", active values" : text;
}

}  // namespace

Status decode_vdb(const std::string& name, Span<const char> bytes, const std::string& grid,
                  const VdbLimits& limits, Volume& volume) {
    ByteCursor in(name, bytes);
    Found found;
    PILEUS_TRY(find_grid(in, name, bytes, grid, limits, found));
    PILEUS_TRY(start_vdb_volume(name, found.head, volume));
    return fill_vdb_tree(in, found.grid, found.box, volume);
}

Status decode_vdb_head(const std::string& name, Span<const char> bytes, const std::string& grid,
                       const VdbLimits& limits, VolumeHead& head) {
    ByteCursor in(name, bytes);
    Found found;
    PILEUS_TRY(find_grid(in, name, bytes, grid, limits, found));
    head = found.head;
    head.kind = "OpenVDB fog volume";
    head.detail = "grid " + quote_text(found.grid.name) + " of " + vdb_grid_list(found.grids) +
                  "; " + compression_text(found.grid.compression) + "; " +
                  std::to_string(found.box.active) + " active voxels";
    return Status::ok();
}

Status read_vdb_volume(const std::string& path, const std::string& grid, Volume& volume) {
    Buffer<char> bytes;
    PILEUS_TRY(read_whole_file(path, kMaxVdbFileBytes, bytes));
    return decode_vdb(path, bytes.span(), grid, VdbLimits(), volume);
}

Status read_vdb_head(const std::string& path, const std::string& grid, VolumeHead& head) {
    Buffer<char> bytes;
    PILEUS_TRY(read_whole_file(path, kMaxVdbFileBytes, bytes));
    return decode_vdb_head(path, bytes.span(), grid, VdbLimits(), head);
}

}  // namespace pileus
