// SPDX-License-Identifier: Apache-2.0
// Reads the segments of a .nvdb file, unpacks one grid, and reads what stands before its tree.
// in: bytes -> out: see nvdb_grid.h.
// NanoVDB 32.4 (OpenVDB 10.0.1), nanovdb/NanoVDB.h and nanovdb/util/IO.h; docs/formats.md
#include "src/io/volumes/vdb/nvdb_grid.h"

#include <algorithm>

#include "src/base/reading_limit.h"
#include "src/io/volumes/vdb/vdb_grid.h"
#include "src/io/volumes/vdb/vdb_values.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {

namespace {

constexpr std::uint64_t kMagic = 0x304244566f6e614e;      // "NanoVDB0", grids and files
constexpr std::uint64_t kMagicGrid = 0x314244566f6e614e;  // "NanoVDB1", from 32.6 on
constexpr std::uint64_t kMagicFile = 0x324244566f6e614e;  // "NanoVDB2", from 32.6 on
constexpr std::uint32_t kMajor = 32, kOldestMinor = 3, kNewestMinor = 9;
constexpr std::size_t kMaxGrids = 4096;
constexpr std::uint32_t kLongestName = 4096, kLevelSet = 1;
constexpr std::uint64_t kChunk = std::uint64_t{1} << 30;

/// Numbers of this table are those of the files; the rest has no name here.
constexpr const char* kTypes[] = {"unknown", "float", "double", "int16",  "int32", "int64", "vec3f",
                                  "vec3d",   "mask",  "half",   "uint32", "bool",  "rgba8", "fp4",
                                  "fp8",     "fp16",  "fpn",    "vec4f",  "vec4d", "index"};
enum Type : std::uint32_t { kFloat = 1, kDouble = 2, kFp4 = 13, kFp8, kFp16, kFpN };

std::string type_name(std::uint32_t type) {
    constexpr std::uint32_t kCount = sizeof kTypes / sizeof kTypes[0];
    return type < kCount ? kTypes[type] : "type " + std::to_string(type);
}

bool is_number(std::uint32_t type) {
    return type == kFloat || type == kDouble || (type >= kFp4 && type <= kFpN);
}

NvdbLayout layout_of(std::uint32_t type) {
    NvdbLayout layout;
    if (type == kDouble) layout = {8, 0, false, 32, 96, 24, 128};
    if (type >= kFp4 && type <= kFp16) layout.code_bits = 4u << (type - kFp4);
    layout.own_bits = type == kFpN;
    return layout;
}

Status read_version(ByteCursor& in, std::uint64_t second_magic) {
    std::uint64_t magic = 0;
    PILEUS_TRY(in.u64("mark of NanoVDB", magic));
    if (magic != kMagic && magic != second_magic)
        return in.fault("mark of NanoVDB: not there, allowed: a NanoVDB file, little-endian");
    if (second_magic == kMagicGrid) PILEUS_TRY(in.skip(8, "checksum"));
    std::uint32_t version = 0;
    PILEUS_TRY(in.u32("version", version));
    const std::uint32_t major = version >> 21, minor = version >> 10 & 2047;
    if (major != kMajor || minor < kOldestMinor || minor > kNewestMinor)
        return in.fault("version: " + std::to_string(major) + '.' + std::to_string(minor) +
                        ", allowed: 32.3 to 32.9");
    return Status::ok();
}

/// 176 bytes of metadata and the name. Statistics, boxes and counts in it are not used.
Status read_metadata(ByteCursor& in, NvdbGrid& grid) {
    std::uint32_t length = 0;
    PILEUS_TRY(in.u64("size of a grid", grid.size));
    PILEUS_TRY(in.u64("packed size of a grid", grid.packed));
    PILEUS_TRY(in.skip(16, "metadata"));
    PILEUS_TRY(in.u32("type of a grid", grid.type));
    PILEUS_TRY(in.u32("class of a grid", grid.grid_class));
    PILEUS_TRY(in.skip(96, "metadata"));
    PILEUS_TRY(in.u32("length of a name", length));
    PILEUS_TRY(in.skip(36, "metadata"));
    if (length < 1 || length > kLongestName)
        return in.fault("length of a name: " + std::to_string(length) + ", allowed: 1 to " +
                        std::to_string(kLongestName));
    const unsigned char* from = nullptr;
    PILEUS_TRY(in.take(length, "name of a grid", from));
    if (from[length - 1] != 0) return in.fault("name of a grid: does not end, allowed: a 0 behind");
    grid.name = reinterpret_cast<const char*>(from);
    return Status::ok();
}

/// Some grids that share one kind of packing: their metadata, and then their bytes.
Status read_segment(ByteCursor& in, std::vector<NvdbGrid>& grids) {
    std::uint32_t count = 0, codec = 0;
    PILEUS_TRY(read_version(in, kMagicFile));
    PILEUS_TRY(in.u16("number of grids", count));
    PILEUS_TRY(in.u16("packing", codec));
    if (codec > 2)
        return in.fault("packing: unknown, " + std::to_string(codec) +
                        ", allowed: 0 none, 1 zip, 2 blosc");
    const std::size_t first = grids.size();
    if (count < 1 || first + count > kMaxGrids)
        return in.fault("number of grids: " + std::to_string(count) +
                        ", allowed: 1 and more, in all at most " + std::to_string(kMaxGrids));
    for (std::uint32_t i = 0; i < count; ++i) {
        NvdbGrid grid;
        PILEUS_TRY(read_metadata(in, grid));
        grid.compression = codec == 1 ? kVdbZip : codec == 2 ? kVdbBlosc : 0;
        grids.push_back(grid);
    }
    for (std::size_t i = first; i < grids.size(); ++i) {
        grids[i].at = in.at();
        PILEUS_TRY(in.skip(grids[i].packed, "grid"));
    }
    return Status::ok();
}

/// zlib gives 1032 bytes for one at the most; tables of empty nodes come near that, clouds do not.
std::uint64_t most_unpacked(std::uint64_t packed) {
    constexpr std::uint64_t kZlib = 1032, kFree = std::uint64_t{1} << 26, kCloud = 64;
    return std::min(packed * kZlib, kFree + packed * kCloud);
}

/// A length, and as many bytes that give exactly `bytes`.
Status unpack_block(ByteCursor& in, bool blosc, unsigned char* to, std::uint64_t bytes) {
    std::uint64_t count = 0;
    const unsigned char* from = nullptr;
    PILEUS_TRY(in.u64("length of packed bytes", count));
    PILEUS_TRY(in.take(count, "packed bytes", from));
    return inflate_block(in, blosc, from, count, to, bytes);
}

}  // namespace

Status read_nvdb_grids(ByteCursor& in, std::vector<NvdbGrid>& grids) {
    do {
        PILEUS_TRY(read_segment(in, grids));
    } while (in.left() > 0);
    return Status::ok();
}

std::vector<VdbName> nvdb_names(const std::vector<NvdbGrid>& grids) {
    std::vector<VdbName> names;
    for (const NvdbGrid& grid : grids)
        names.push_back({grid.name, type_name(grid.type), is_number(grid.type), -1, ""});
    label_vdb_names(names);
    return names;
}

Status choose_nvdb_grid(const ByteCursor& in, const std::vector<NvdbGrid>& grids,
                        const std::string& name, NvdbGrid& chosen) {
    const std::vector<VdbName> names = nvdb_names(grids);
    const VdbName* level_set = nullptr;
    for (const std::size_t i : vdb_choices(names, name)) {
        if (!names[i].is_number)
            return in.fault("grid " + quote_text(name) + ": type " + names[i].type +
                            ", allowed: float, double, fp4, fp8, fp16, fpn; in the file: " +
                            vdb_name_list(names));
        if (grids[i].grid_class != kLevelSet) {
            chosen = grids[i];
            chosen.label = names[i].label;
            return Status::ok();
        }
        if (level_set == nullptr) level_set = &names[i];
    }
    if (level_set != nullptr)
        return in.fault("grid " + quote_text(level_set->label) +
                        ": a level set holds distances, allowed: a fog volume; in the file: " +
                        vdb_name_list(names));
    return in.fault("grid: " + (name.empty() ? "none of floats" : "unknown, " + quote_text(name)) +
                    ", allowed: " + vdb_name_list(names));
}

Status unpack_nvdb_grid(ByteCursor& in, const NvdbGrid& grid, Buffer<char>& room,
                        Span<const char>& bytes) {
    PILEUS_TRY(in.window(grid.at, grid.at + grid.packed, "grid"));
    const unsigned char* from = nullptr;
    const std::uint64_t most = grid.compression == 0 ? grid.packed : most_unpacked(grid.packed);
    if (grid.size > most || (grid.compression == 0 && grid.size != grid.packed))
        return in.fault("size of a grid: " + std::to_string(grid.size) + " bytes, allowed: " +
                        (grid.compression == 0 ? "exactly " : "at most ") + std::to_string(most));
    if (grid.compression == 0) {
        PILEUS_TRY(in.take(grid.size, "grid", from));
        bytes = {reinterpret_cast<const char*>(from), std::size_t(grid.size)};
        return Status::ok();
    }

    // Blosc stands in chunks of 2^30 bytes, zip in one.
    const bool blosc = grid.compression == kVdbBlosc;
    PILEUS_TRY(check_reading(in.name(), grid.size));
    PILEUS_TRY(room.resize(grid.size, "NanoVDB grid"));
    for (std::uint64_t done = 0; done < grid.size;) {
        const std::uint64_t chunk = blosc ? std::min(grid.size - done, kChunk) : grid.size;
        char* to = room.span().part(std::size_t(done), std::size_t(chunk)).data;
        PILEUS_TRY(unpack_block(in, blosc, reinterpret_cast<unsigned char*>(to), chunk));
        done += chunk;
    }
    if (in.left() > 0)
        return in.fault("packed bytes: " + std::to_string(in.left()) + " too many, allowed: none");
    bytes = room.span();
    return Status::ok();
}

Status open_nvdb_grid(ByteCursor& in, NvdbGrid& grid) {
    std::uint64_t size = 0;
    std::uint32_t type = 0, grid_class = 0;
    PILEUS_TRY(read_version(in, kMagicGrid));
    PILEUS_TRY(in.skip(12, "head of a grid"));
    PILEUS_TRY(in.u64("size of a grid", size));
    PILEUS_TRY(in.skip(256, "name of a grid"));

    // Columns are the steps of the axes of indices; the single-precision copies are not used.
    PILEUS_TRY(in.skip(88, "map"));
    std::array<std::array<double, 3>, 3> steps{};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            PILEUS_TRY(in.f64("map", steps[column][row]));
    PILEUS_TRY(set_vdb_axes(in, steps, grid.transform));
    PILEUS_TRY(in.skip(72, "map"));
    for (double& coordinate : grid.transform.translation) PILEUS_TRY(in.f64("map", coordinate));
    PILEUS_TRY(check_vdb_transform(in, grid.transform));

    PILEUS_TRY(in.skip(80, "head of a grid"));
    PILEUS_TRY(in.u32("class of a grid", grid_class));
    PILEUS_TRY(in.u32("type of a grid", type));
    if (size != grid.size || type != grid.type || grid_class != grid.grid_class)
        return in.fault("head of a grid: differs from the file's list, allowed: the same");
    grid.layout = layout_of(type);
    return Status::ok();
}

}  // namespace pileus
