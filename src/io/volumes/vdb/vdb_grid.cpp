// SPDX-License-Identifier: Apache-2.0
// Reads the head of a .vdb file, the list of its grids, and what stands before a tree.
// in: bytes -> out: see vdb_grid.h.
// OpenVDB 10.0.1, openvdb/io/Archive.cc and openvdb/math/Maps.h; docs/formats.md
#include "src/io/volumes/vdb/vdb_grid.h"

#include <charconv>

#include "src/scene/toml/toml_tree.h"

namespace pileus {

namespace {

constexpr std::uint64_t kMagic = 0x56444220;
constexpr std::uint32_t kMaxGrids = 4096;
constexpr std::size_t kUuidLength = 36;
constexpr const char* kHalfMark = "_HalfFloat";
constexpr char kSuffixMark = '\x1e';

/// Names, types and sizes of metadata; the values of a few texts are kept.
Status read_metadata(ByteCursor& in, std::string* grid_class) {
    std::uint32_t count = 0;
    PILEUS_TRY(in.u32("number of metadata", count));
    for (std::uint32_t i = 0; i < count; ++i) {
        std::string name, type;
        PILEUS_TRY(in.text("name of metadata", name));
        PILEUS_TRY(in.text("type of metadata", type));
        if (grid_class != nullptr && name == "class" && type == "string") {
            PILEUS_TRY(in.text("class", *grid_class));
            continue;
        }
        std::uint32_t length = 0;
        PILEUS_TRY(in.u32("length of metadata", length));
        PILEUS_TRY(in.skip(length, "metadata"));
    }
    return Status::ok();
}

Status read_file_head(ByteCursor& in) {
    std::uint64_t magic = 0;
    std::uint32_t version = 0, library = 0;
    unsigned has_offsets = 0;
    PILEUS_TRY(in.u64("mark of an OpenVDB file", magic));
    if (magic != kMagic)
        return in.fault("mark of an OpenVDB file: not there, allowed: an OpenVDB file");
    PILEUS_TRY(in.u32("format version", version));
    if (version < kVdbOldestVersion || version > kVdbNewestVersion)
        return in.fault("format version: " + std::to_string(version) + ", allowed: 222 to 224");
    PILEUS_TRY(in.u32("version of the library", library));
    PILEUS_TRY(in.u32("version of the library", library));
    PILEUS_TRY(in.u8("mark of offsets", has_offsets));
    if (has_offsets != 1)
        return in.fault("mark of offsets: " + std::to_string(has_offsets) +
                        ", allowed: 1 (a file, not a stream without offsets)");
    PILEUS_TRY(in.skip(kUuidLength, "identifier of the file"));
    return read_metadata(in, nullptr);
}

/// The tree's type as people say it: "float", "half", "vec3s".
std::string short_type(const VdbGrid& grid) {
    std::string text = grid.type;
    if (text.compare(0, 5, "Tree_") == 0) text.erase(0, 5);
    const std::size_t dims = text.find('_');
    if (dims != std::string::npos && text.compare(dims, std::string::npos, "_5_4_3") == 0)
        text.erase(dims);
    return grid.half ? text + " as half" : text;
}

Status read_vector(ByteCursor& in, const char* what, std::array<double, 3>& value) {
    for (double& coordinate : value) PILEUS_TRY(in.f64(what, coordinate));
    return Status::ok();
}

/// Four rows of a matrix that multiplies row vectors; no perspective.
Status read_affine(ByteCursor& in, VdbTransform& transform) {
    std::array<std::array<double, 3>, 3> steps{};
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t column = 0; column < 4; ++column) {
            double value = 0;
            PILEUS_TRY(in.f64("transform", value));
            if (row < 3 && column < 3)
                steps[row][column] = value;
            else if (row == 3 && column < 3)
                transform.translation[column] = value;
            else if (value != (row == column ? 1.0 : 0.0))
                return in.fault(
                    "transform: with perspective, allowed: scale and translation along the axes");
        }
    return set_vdb_axes(in, steps, transform);
}

/// How voxels become places. A scale stands in the file with four derived vectors behind it.
Status read_transform(ByteCursor& in, VdbGrid& grid) {
    std::string map;
    PILEUS_TRY(in.text("kind of transform", map));
    const bool scales = map == "ScaleMap" || map == "UniformScaleMap";
    const bool both = map == "ScaleTranslateMap" || map == "UniformScaleTranslateMap";
    if (both || map == "TranslationMap")
        PILEUS_TRY(read_vector(in, "translation", grid.transform.translation));
    if (both || scales) {
        std::array<double, 3> derived;
        PILEUS_TRY(read_vector(in, "scale", grid.transform.scale));
        for (int i = 0; i < 4; ++i) PILEUS_TRY(read_vector(in, "scale", derived));
    } else if (map == "AffineMap" || map == "UnitaryMap") {
        PILEUS_TRY(read_affine(in, grid.transform));
    } else if (map != "TranslationMap") {
        return in.fault("kind of transform: " + quote_text(map) +
                        ", allowed: scale and translation along the axes");
    }
    return check_vdb_transform(in, grid.transform);
}

const VdbGrid* find_unique(const std::vector<VdbGrid>& grids, const std::string& name) {
    for (const VdbGrid& grid : grids)
        if (grid.unique_name == name) return &grid;
    return nullptr;
}

/// An instance keeps its own metadata and transform, and stands for another grid's tree.
Status follow_parent(ByteCursor& in, const std::vector<VdbGrid>& grids, VdbGrid& grid) {
    const VdbGrid* found = find_unique(grids, grid.parent);
    if (found == nullptr || !found->parent.empty())
        return in.fault("grid " + quote_text(grid.name) + ": shares the tree of " +
                        quote_text(grid.parent) + ", allowed: a grid with a tree of its own");
    VdbGrid parent = *found;
    PILEUS_TRY(read_vdb_grid(in, parent));
    if (parent.type != grid.type)
        return in.fault("grid " + quote_text(grid.name) + ": shares a tree of another type, " +
                        quote_text(parent.type) + ", allowed: " + quote_text(grid.type));
    grid.half = parent.half;
    grid.compression = parent.compression;
    grid.tree_at = parent.tree_at;
    grid.end = parent.end;
    return Status::ok();
}

}  // namespace

Status read_vdb_grids(ByteCursor& in, std::vector<VdbGrid>& grids) {
    PILEUS_TRY(read_file_head(in));
    std::uint32_t count = 0;
    PILEUS_TRY(in.u32("number of grids", count));
    if (count > kMaxGrids)
        return in.fault("number of grids: too many, " + std::to_string(count) +
                        ", allowed: at most " + std::to_string(kMaxGrids));
    const std::uint64_t whole = in.at() + in.left();
    for (std::uint32_t i = 0; i < count; ++i) {
        VdbGrid grid;
        std::uint64_t blocks = 0;
        PILEUS_TRY(in.text("name of a grid", grid.unique_name));
        PILEUS_TRY(in.text("type of a grid", grid.type));
        PILEUS_TRY(in.text("parent of a grid", grid.parent));
        PILEUS_TRY(in.u64("offset of a grid", grid.at));
        PILEUS_TRY(in.u64("offset of a grid", blocks));
        PILEUS_TRY(in.u64("offset of a grid", grid.end));
        grid.name = grid.unique_name.substr(0, grid.unique_name.find(kSuffixMark));
        const std::size_t mark = grid.type.rfind(kHalfMark);
        if (mark != std::string::npos && mark + std::strlen(kHalfMark) == grid.type.size()) {
            grid.half = true;
            grid.type.erase(mark);
        }
        // Offsets only lead onwards, so that no chain of them can turn back.
        if (grid.at < in.at() || grid.end < grid.at || grid.end > whole)
            return in.fault("offset of a grid: bytes " + std::to_string(grid.at) + " to " +
                            std::to_string(grid.end) + ", allowed: onwards, within " +
                            std::to_string(in.at()) + " to " + std::to_string(whole));
        PILEUS_TRY(in.window(grid.end, whole, "offset of a grid"));
        grids.push_back(grid);
    }
    return Status::ok();
}

Status read_vdb_grid(ByteCursor& in, VdbGrid& grid) {
    PILEUS_TRY(in.window(grid.at, grid.end, "offset of a grid"));
    std::uint32_t flags = 0;
    PILEUS_TRY(in.u32("compression", flags));
    if (flags > (kVdbZip | kVdbActiveMask | kVdbBlosc))
        return in.fault("compression: unknown flags, " + std::to_string(flags) +
                        ", allowed: 0 to 7 (zip 1, active mask 2, blosc 4)");
    grid.compression = flags;
    PILEUS_TRY(read_metadata(in, &grid.grid_class));
    if (grid.is_number()) PILEUS_TRY(read_transform(in, grid));
    grid.tree_at = in.at();
    return Status::ok();
}

/// A stored name may end in a mark and a number that tells grids of one name apart.
std::vector<VdbName> vdb_names(const std::vector<VdbGrid>& grids) {
    std::vector<VdbName> names;
    for (const VdbGrid& grid : grids) {
        names.push_back({grid.name, short_type(grid), grid.is_number(), -1, ""});
        const std::size_t mark = grid.unique_name.find(kSuffixMark);
        if (mark == std::string::npos) continue;
        const char* from = grid.unique_name.data() + mark + 1;
        const char* to = grid.unique_name.data() + grid.unique_name.size();
        std::int64_t number = -1;
        if (std::from_chars(from, to, number).ptr == to) names.back().number = number;
    }
    label_vdb_names(names);
    return names;
}

const char* vdb_packing_text(unsigned compression) {
    return compression & kVdbBlosc ? "blosc" : compression & kVdbZip ? "zip" : "not packed";
}

Status choose_vdb_grid(ByteCursor& in, std::vector<VdbGrid>& grids, const std::string& name,
                       VdbGrid& chosen) {
    const std::vector<VdbName> names = vdb_names(grids);
    const VdbName* level_set = nullptr;
    for (const std::size_t i : vdb_choices(names, name)) {
        VdbGrid& grid = grids[i];
        if (!grid.is_number())
            return in.fault("grid " + quote_text(name) + ": type " + quote_text(grid.type) +
                            ", allowed: float or double with nodes 5_4_3; in the file: " +
                            vdb_name_list(names));
        PILEUS_TRY(read_vdb_grid(in, grid));
        if (grid.grid_class == "level set") {
            if (level_set == nullptr) level_set = &names[i];
            continue;
        }
        chosen = grid;
        chosen.label = names[i].label;
        return chosen.parent.empty() ? Status::ok() : follow_parent(in, grids, chosen);
    }
    if (level_set != nullptr)
        return in.fault("grid " + quote_text(level_set->label) +
                        ": a level set holds distances, allowed: a fog volume; in the file: " +
                        vdb_name_list(names));
    return in.fault("grid: " + (name.empty() ? "none of floats" : "unknown, " + quote_text(name)) +
                    ", allowed: " + vdb_name_list(names));
}

}  // namespace pileus
