// SPDX-License-Identifier: Apache-2.0
// From a .vdb file to a Volume: chooses the grid, bounds the box, fills it.
// in: bytes or a path -> out: see vdb_file.h.
// docs/formats.md
#include "src/base/file.h"
#include "src/io/vdb_file.h"
#include "src/io/vdb_tree.h"
#include "src/io/volume_file.h"
#include "src/scene/toml_tree.h"

namespace pileus {

namespace {

constexpr std::uint64_t kMaxFileBytes = std::uint64_t{1} << 36;

/// A grid, where it is, and what both passes need of it.
struct Found {
    std::vector<VdbGrid> grids;
    VdbGrid grid;
    VdbBox box;
    std::array<int, 3> size{};
    std::array<std::array<double, 3>, 2> bounds_m{};
};

/// Bounds the cells by the project's limits and by what so short a file may ask for.
Status check_box(const std::string& name, std::uint64_t bytes, const VdbLimits& limits,
                 Found& found) {
    const VdbBox& box = found.box;
    const std::string where = name + ": grid " + quote_text(found.grid.name);
    if (box.empty()) return Status::bad_input(where + ": no active voxel, allowed: one at least");
    std::array<std::int64_t, 3> size;
    std::uint64_t cells = 1;
    for (std::size_t a = 0; a < 3; ++a) size[a] = box.high[a] - box.low[a] + 1;
    PILEUS_TRY(check_volume_size(where, size));
    for (std::size_t a = 0; a < 3; ++a) cells *= std::uint64_t(size[a]);
    std::uint64_t most = 0;
    if (!checked_multiply(bytes, limits.cells_per_byte, most) || most > limits.max_cells)
        most = limits.max_cells;
    most =
        most + limits.free_cells < limits.max_cells ? most + limits.free_cells : limits.max_cells;
    if (cells > most)
        return Status::limit(where + ": box of the active voxels: too many voxels, " +
                             std::to_string(cells) + ", allowed: at most " + std::to_string(most) +
                             " for a file of " + std::to_string(bytes) + " bytes");
    for (std::size_t a = 0; a < 3; ++a) found.size[a] = int(size[a]);
    return Status::ok();
}

/// Voxel centres lie where the transform says, so the box's faces half a voxel further out.
Status place_box(const std::string& name, Found& found) {
    for (std::size_t a = 0; a < 3; ++a) {
        const double scale = found.grid.scale[a], shift = found.grid.translation[a];
        const double low = scale * (double(found.box.low[a]) - 0.5) + shift;
        const double high = scale * (double(found.box.high[a]) + 0.5) + shift;
        if (!(low < high && low >= -1e12 && high <= 1e12))
            return Status::bad_input(name + ": grid " + quote_text(found.grid.name) +
                                     ": place out of range, " + std::to_string(low) + " to " +
                                     std::to_string(high) + ", allowed: -1e12 to 1e12");
        found.bounds_m[0][a] = low;
        found.bounds_m[1][a] = high;
    }
    return Status::ok();
}

Status find_grid(ByteCursor& in, const std::string& name, Span<const char> bytes,
                 const std::string& grid, const VdbLimits& limits, Found& found) {
    PILEUS_TRY(read_vdb_grids(in, found.grids));
    PILEUS_TRY(choose_vdb_grid(in, found.grids, grid, found.grid));
    PILEUS_TRY(measure_vdb_tree(in, found.grid, found.box));
    PILEUS_TRY(check_box(name, bytes.size, limits, found));
    return place_box(name, found);
}

std::string compression_text(unsigned flags) {
    std::string text = flags & kVdbBlosc ? "blosc" : flags & kVdbZip ? "zip" : "not packed";
    return flags & kVdbActiveMask ? text + ", active values" : text;
}

}  // namespace

Status decode_vdb(const std::string& name, Span<const char> bytes, const std::string& grid,
                  const VdbLimits& limits, Volume& volume) {
    ByteCursor in(name, bytes);
    Found found;
    PILEUS_TRY(find_grid(in, name, bytes, grid, limits, found));
    const std::uint64_t rows = std::uint64_t(found.size[1]) * std::uint64_t(found.size[2]);
    PILEUS_TRY(volume.density.resize(rows * std::uint64_t(found.size[0]), name.c_str()));
    volume.size = found.size;
    volume.knows_bounds = true;
    volume.bounds_m = found.bounds_m;
    volume.in_extinction = false;
    return fill_vdb_tree(in, found.grid, found.box, volume);
}

Status decode_vdb_head(const std::string& name, Span<const char> bytes, const std::string& grid,
                       const VdbLimits& limits, VolumeHead& head) {
    ByteCursor in(name, bytes);
    Found found;
    PILEUS_TRY(find_grid(in, name, bytes, grid, limits, found));
    head.size = found.size;
    head.knows_bounds = true;
    head.bounds_m = found.bounds_m;
    head.in_extinction = false;
    head.kind = "OpenVDB fog volume";
    head.detail = "grid " + quote_text(found.grid.name) + " of " + vdb_grid_list(found.grids) +
                  "; " + compression_text(found.grid.compression) + "; " +
                  std::to_string(found.box.active) + " active voxels";
    return Status::ok();
}

Status read_vdb_volume(const std::string& path, const std::string& grid, Volume& volume) {
    Buffer<char> bytes;
    PILEUS_TRY(read_whole_file(path, kMaxFileBytes, bytes));
    return decode_vdb(path, bytes.span(), grid, VdbLimits(), volume);
}

Status read_vdb_head(const std::string& path, const std::string& grid, VolumeHead& head) {
    Buffer<char> bytes;
    PILEUS_TRY(read_whole_file(path, kMaxFileBytes, bytes));
    return decode_vdb_head(path, bytes.span(), grid, VdbLimits(), head);
}

}  // namespace pileus
