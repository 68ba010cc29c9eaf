// SPDX-License-Identifier: Apache-2.0
// The walk through a NanoVDB tree, and from a .nvdb file to a Volume.
// in: bytes or a path -> out: see vdb_file.h.
// NanoVDB 32.4 (OpenVDB 10.0.1), nanovdb/NanoVDB.h; docs/formats.md
#include <algorithm>

#include "src/base/file.h"
#include "src/io/volumes/vdb/nvdb_grid.h"
#include "src/io/volumes/vdb/vdb_box.h"
#include "src/io/volumes/vdb/vdb_file.h"
#include "src/io/volumes/vdb/vdb_grid.h"
#include "src/io/volumes/vdb/vdb_values.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {

namespace {

constexpr std::uint64_t kAlignment = 32, kTreeBytes = 64, kRootTileBytes = 32;
constexpr std::uint64_t kLeafMaskAt = 16, kLeafFlagsAt = 15, kLeafMinimumAt = 80;
constexpr unsigned kLeafVoxels = 512;
constexpr std::int64_t kRootSide = 4096;
constexpr const char* kNodes[3] = {"leaf", "lower node", "upper node"};

/// A table of 2^kLog entries along each axis, each a tile or a child of 2^kChild voxels.
template <unsigned kLog, unsigned kChild>
struct Table {
    static constexpr unsigned log = kLog, child = kChild, entries = 1u << (3 * kLog);
    static constexpr std::uint64_t mask_at = 32, mask_bytes = entries / 8,
                                   values_at = mask_at + 2 * mask_bytes + 32;
};
using Upper = Table<5, 7>;
using Lower = Table<4, 3>;

/// Measures the box of what is active or, given a volume, fills it.
class Walk {
public:
    Walk(ByteCursor in, const NvdbLayout& layout, VdbBox& box, Volume* volume)
        : in_(in), whole_(in.at() + in.left()), layout_(layout), box_(box), volume_(volume) {}

    Status tree();

private:
    using Bytes = Span<const unsigned char>;

    /// Hands out a part of the grid at `at`, which must be within and in step with the others.
    Status part(std::uint64_t at, std::uint64_t size, const char* what, Bytes& from) {
        if (at < kNvdbTreeAt + kTreeBytes || at % kAlignment != 0 || at > whole_ ||
            size > whole_ - at)
            return in_.fault(std::string(what) + ": at byte " + std::to_string(at) +
                             ", allowed: multiples of 32, " + std::to_string(size) +
                             " bytes or more before " + std::to_string(whole_));
        PILEUS_TRY(in_.window(at, whole_, what));
        from.size = std::size_t(size);
        return in_.take(size, what, from.data);
    }
    /// No more nodes than the tree states, so that a child that is shared cannot keep us busy.
    Status count_node(unsigned level) {
        if (seen_[level]++ < nodes_[level]) return Status::ok();
        return in_.fault(std::string(kNodes[level]) +
                         ": more than the tree states, allowed: " + std::to_string(nodes_[level]));
    }
    float number_at(Bytes from, std::size_t at, unsigned bytes) const {
        return packed_number(from.part(at, bytes).data, bytes);
    }
    /// The value stands `value` bytes into the part.
    Status tile(const VdbPlace& at, std::int64_t side, Bytes from, std::size_t value) {
        if (volume_ == nullptr) {
            box_.add_tile(at, side);
            return Status::ok();
        }
        float number = number_at(from, value, layout_.value_bytes);
        PILEUS_TRY(checks_.take(in_, at, number));
        box_.fill_tile(at, side, number, *volume_);
        return Status::ok();
    }
    Status root(std::uint64_t at);
    Status root_tile(std::uint64_t root, Bytes from);
    template <class T>
    Status node(std::uint64_t at, const VdbPlace& origin);
    Status leaf(std::uint64_t at, const VdbPlace& origin);
    float voxel(Bytes leaf, unsigned bits, unsigned n) const;

    ByteCursor in_;
    std::uint64_t whole_;
    NvdbLayout layout_;
    VdbBox& box_;
    Volume* volume_;
    VdbChecks checks_;
    std::uint32_t nodes_[3] = {0, 0, 0}, seen_[3] = {0, 0, 0};  // leaves, lower, upper
};

std::uint64_t little_endian(Span<const unsigned char> from, std::size_t at) {
    std::uint64_t bits = 0;
    for (unsigned i = 8; i-- > 0;) bits = bits << 8 | from.at(at + i);
    return bits;
}

Status Walk::tree() {
    std::uint64_t root_at = 0;
    PILEUS_TRY(in_.window(kNvdbTreeAt, whole_, "tree"));
    PILEUS_TRY(in_.skip(24, "tree"));
    PILEUS_TRY(in_.u64("place of the root", root_at));
    for (std::uint32_t& count : nodes_) PILEUS_TRY(in_.u32("nodes of the tree", count));
    PILEUS_TRY(root(kNvdbTreeAt + root_at));
    for (unsigned level = 0; level < 3; ++level)
        if (seen_[level] != nodes_[level])
            return in_.fault("nodes of the tree: " + std::to_string(seen_[level]) + " of kind " +
                             kNodes[level] + ", allowed: as it states, " +
                             std::to_string(nodes_[level]));
    return volume_ != nullptr ? checks_.finish(*volume_) : Status::ok();
}

Status Walk::root(std::uint64_t at) {
    constexpr std::uint64_t kCountAt = 24;
    Bytes head, table;
    std::uint32_t tiles = 0;
    PILEUS_TRY(part(at, layout_.root_bytes, "root", head));
    const float background = number_at(head, layout_.background, layout_.value_bytes);
    if (background != 0.0f)
        return in_.fault("background: " + std::to_string(background) +
                         ", allowed: 0 (nothing outside the cloud)");
    PILEUS_TRY(in_.window(at + kCountAt, whole_, "root"));
    PILEUS_TRY(in_.u32("tiles of the root", tiles));
    PILEUS_TRY(part(at + layout_.root_bytes, tiles * kRootTileBytes, "tiles of the root", table));

    // The order is free, but a place that came twice would be filled twice.
    Buffer<std::uint64_t> keys;
    PILEUS_TRY(keys.resize(tiles, "NanoVDB root"));
    for (std::uint32_t i = 0; i < tiles; ++i) keys.at(i) = little_endian(table, i * kRootTileBytes);
    const auto from = keys.span().begin(), to = keys.span().end();
    std::sort(from, to);
    if (std::adjacent_find(from, to) != to)
        return in_.fault("tiles of the root: a place comes twice, allowed: once");
    for (std::uint32_t i = 0; i < tiles; ++i)
        PILEUS_TRY(root_tile(at, table.part(i * kRootTileBytes, kRootTileBytes)));
    return Status::ok();
}

/// A key holds x, y and z in 21 bits each, as unsigned multiples of 4096.
Status Walk::root_tile(std::uint64_t root, Bytes from) {
    constexpr std::int64_t kHalf = std::int64_t{1} << 19;
    const std::uint64_t key = little_endian(from, 0), child = little_endian(from, 8);
    VdbPlace origin;
    for (std::size_t a = 0; a < 3; ++a) {
        const std::int64_t field = std::int64_t(key >> (42 - 21 * a) & 0x1fffff);
        if (field >= 2 * kHalf || key >> 63 != 0)
            return in_.fault("tile of the root: its key is none, allowed: three times 20 bits");
        origin[a] = (field < kHalf ? field : field - 2 * kHalf) * kRootSide;
    }
    if (child != 0) return node<Upper>(root + child, origin);
    const bool active = (from.at(16) | from.at(17) | from.at(18) | from.at(19)) != 0;
    return active ? tile(origin, kRootSide, from, layout_.tile_value) : Status::ok();
}

template <class T>
Status Walk::node(std::uint64_t at, const VdbPlace& origin) {
    constexpr unsigned kLevel = T::child == 7 ? 2 : 1, kLow = (1u << T::log) - 1;
    Bytes from;
    PILEUS_TRY(count_node(kLevel));
    PILEUS_TRY(part(at, T::values_at + 8 * T::entries, kNodes[kLevel], from));
    const unsigned char* active = from.part(T::mask_at, T::mask_bytes).data;
    const unsigned char* children = from.part(T::mask_at + T::mask_bytes, T::mask_bytes).data;
    for (unsigned n = 0; n < T::entries; ++n) {
        const std::size_t entry = T::values_at + 8 * n;
        const VdbPlace place{origin[0] + (std::int64_t(n >> (2 * T::log)) << T::child),
                             origin[1] + (std::int64_t(n >> T::log & kLow) << T::child),
                             origin[2] + (std::int64_t(n & kLow) << T::child)};
        if (vdb_mask_on(children, n)) {
            const std::uint64_t child = at + little_endian(from, entry);
            if constexpr (kLevel == 2)
                PILEUS_TRY(node<Lower>(child, place));
            else
                PILEUS_TRY(leaf(child, place));
        } else if (vdb_mask_on(active, n)) {
            PILEUS_TRY(tile(place, std::int64_t{1} << T::child, from, entry));
        }
    }
    return Status::ok();
}

Status Walk::leaf(std::uint64_t at, const VdbPlace& origin) {
    Bytes from;
    PILEUS_TRY(count_node(0));
    PILEUS_TRY(part(at, layout_.leaf_values, kNodes[0], from));
    const unsigned log = from.at(kLeafFlagsAt) >> 5;
    if (layout_.own_bits && log > 4)
        return in_.fault("leaf: 2^" + std::to_string(log) + " bits a voxel, allowed: 1 to 16");
    const unsigned bits = layout_.own_bits ? 1u << log : layout_.code_bits;
    const unsigned stored = bits > 0 ? bits : 8 * layout_.value_bytes;
    PILEUS_TRY(part(at, layout_.leaf_values + kLeafVoxels / 8 * stored, kNodes[0], from));
    const unsigned char* mask = from.part(kLeafMaskAt, kLeafVoxels / 8).data;
    if (volume_ == nullptr) {
        box_.add_leaf(origin, mask);
        return Status::ok();
    }
    for (unsigned n = 0; n < kLeafVoxels; ++n) {
        if (!vdb_mask_on(mask, n)) continue;
        const VdbPlace place{origin[0] + (n >> 6), origin[1] + (n >> 3 & 7), origin[2] + (n & 7)};
        float value = voxel(from, bits, n);
        PILEUS_TRY(checks_.take(in_, place, value));
        volume_->density.at(box_.index(place)) = value;
    }
    return Status::ok();
}

/// A whole number, or a code between the leaf's least and largest value.
float Walk::voxel(Bytes leaf, unsigned bits, unsigned n) const {
    if (bits == 0)
        return number_at(leaf, layout_.leaf_values + n * layout_.value_bytes, layout_.value_bytes);
    const std::size_t first = layout_.leaf_values + n * bits / 8;
    const unsigned word =
        bits == 16 ? leaf.at(first) | unsigned(leaf.at(first + 1)) << 8 : leaf.at(first);
    const unsigned code = word >> (n * bits % 8) & ((1u << bits) - 1);
    const float least = number_at(leaf, kLeafMinimumAt, 4);
    return float(code) * number_at(leaf, kLeafMinimumAt + 4, 4) + least;
}

/// A grid, its bytes, and what both passes need of it.
struct Found {
    std::vector<NvdbGrid> grids;
    NvdbGrid grid;
    std::string where;
    Buffer<char> room;
    Span<const char> bytes;
    VdbBox box;
    VolumeHead head;
};

Status find_grid(const std::string& name, Span<const char> bytes, const std::string& grid,
                 const VdbLimits& limits, Found& found) {
    ByteCursor file(name, bytes);
    PILEUS_TRY(read_nvdb_grids(file, found.grids));
    PILEUS_TRY(choose_nvdb_grid(file, found.grids, grid, found.grid));
    PILEUS_TRY(unpack_nvdb_grid(file, found.grid, found.room, found.bytes));
    found.where = name + ": grid " + quote_text(found.grid.label);
    ByteCursor in(found.where, found.bytes);
    PILEUS_TRY(open_nvdb_grid(in, found.grid));
    PILEUS_TRY(
        Walk(ByteCursor(found.where, found.bytes), found.grid.layout, found.box, nullptr).tree());
    return frame_vdb_box(found.where, bytes.size, limits, found.grid.transform, found.box,
                         found.head);
}

}  // namespace

Status decode_nvdb(const std::string& name, Span<const char> bytes, const std::string& grid,
                   const VdbLimits& limits, Volume& volume) {
    Found found;
    PILEUS_TRY(find_grid(name, bytes, grid, limits, found));
    PILEUS_TRY(start_vdb_volume(name, found.head, volume));
    return Walk(ByteCursor(found.where, found.bytes), found.grid.layout, found.box, &volume).tree();
}

Status decode_nvdb_head(const std::string& name, Span<const char> bytes, const std::string& grid,
                        const VdbLimits& limits, VolumeHead& head) {
    Found found;
    PILEUS_TRY(find_grid(name, bytes, grid, limits, found));
    head = found.head;
    head.unpacked_bytes = found.room.size();
    head.kind = "NanoVDB fog volume";
    head.detail =
        vdb_detail(found.grid.label, nvdb_names(found.grids),
                   vdb_packing_text(found.grid.compression), found.grid.transform, found.box);
    return Status::ok();
}

Status read_nvdb_volume(const std::string& path, const std::string& grid, Volume& volume) {
    Buffer<char> bytes;
    PILEUS_TRY(read_whole_file(path, kMaxVdbFileBytes, bytes));
    return decode_nvdb(path, bytes.span(), grid, VdbLimits(), volume);
}

Status read_nvdb_head(const std::string& path, const std::string& grid, VolumeHead& head) {
    Buffer<char> bytes;
    PILEUS_TRY(read_whole_file(path, kMaxVdbFileBytes, bytes));
    return decode_nvdb_head(path, bytes.span(), grid, VdbLimits(), head);
}

}  // namespace pileus
