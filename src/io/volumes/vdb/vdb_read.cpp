// SPDX-License-Identifier: Apache-2.0
// From a .vdb file to a Volume: chooses the grid, walks its tree to bound the box, fills it.
// in: bytes or a path -> out: see vdb_file.h.
// Tree: root, nodes of 32^3 and 16^3 entries, leaves of 8^3 voxels. Museth 2013, ACM TOG 32(3);
// OpenVDB 10.0.1, openvdb/tree; docs/formats.md
#include "src/base/file.h"
#include "src/io/volumes/vdb/vdb_box.h"
#include "src/io/volumes/vdb/vdb_file.h"
#include "src/io/volumes/vdb/vdb_grid.h"
#include "src/io/volumes/vdb/vdb_values.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {

namespace {

using Place = VdbPlace;

constexpr unsigned kLeafVoxels = 512, kLeafMask = 64;
constexpr std::int64_t kRootSide = 4096;

/// Collects the box of all that is active.
class Measure {
public:
    explicit Measure(VdbBox& box) : box_(box) {}

    Status tile(const ByteCursor&, const Place& low, std::int64_t side, float) {
        box_.add_tile(low, side);
        return Status::ok();
    }
    Status leaf(const Place& origin, const unsigned char* mask) {
        box_.add_leaf(origin, mask);
        return Status::ok();
    }

private:
    VdbBox& box_;
};

/// Writes tiles and leaves into the dense grid; a second cursor walks along the leaves' values.
class Fill {
public:
    Fill(ByteCursor values, const VdbBox& box, VdbValues& unpack, Volume& volume)
        : in_(values), box_(box), unpack_(unpack), volume_(volume) {}

    Status tile(const ByteCursor& in, const Place& low, std::int64_t side, float value) {
        PILEUS_TRY(checks_.take(in, low, value));
        box_.fill_tile(low, side, value, volume_);
        return Status::ok();
    }

    Status leaf(const Place& origin, const unsigned char* mask) {
        const unsigned char* again = nullptr;
        PILEUS_TRY(in_.take(kLeafMask, "mask of a leaf", again));
        if (std::memcmp(again, mask, kLeafMask) != 0)
            return in_.fault("mask of a leaf: differs from the tree's, allowed: the same");
        PILEUS_TRY(unpack_.read(in_, mask, kLeafVoxels));
        for (unsigned n = 0; n < kLeafVoxels; ++n) {
            if (!vdb_mask_on(mask, n)) continue;
            const Place at{origin[0] + (n >> 6), origin[1] + (n >> 3 & 7), origin[2] + (n & 7)};
            float value = unpack_.at(n);
            PILEUS_TRY(checks_.take(in_, at, value));
            volume_.density.at(box_.index(at)) = value;
        }
        return Status::ok();
    }
    Status finish() const { return checks_.finish(volume_); }

private:
    ByteCursor in_;
    const VdbBox& box_;
    VdbValues& unpack_;
    Volume& volume_;
    VdbChecks checks_;
};

/// One kind of walk for both passes, so that what was measured is what is filled.
template <class Visitor>
class Walk {
public:
    Walk(ByteCursor& in, VdbValues& values, Visitor& visitor)
        : in_(in), values_(values), visitor_(visitor) {}

    Status root() {
        std::uint32_t buffers = 0, tiles = 0, children = 0;
        float background = 0;
        PILEUS_TRY(in_.u32("buffers of the tree", buffers));
        if (buffers != 1)
            return in_.fault("buffers of the tree: " + std::to_string(buffers) + ", allowed: 1");
        PILEUS_TRY(values_.single(in_, "background", background));
        if (background != 0.0f)
            return in_.fault("background: " + std::to_string(background) +
                             ", allowed: 0 (nothing outside the cloud)");
        PILEUS_TRY(in_.u32("tiles of the root", tiles));
        PILEUS_TRY(in_.u32("children of the root", children));
        for (std::uint32_t i = 0; i < tiles; ++i) PILEUS_TRY(root_tile(i == 0));
        for (std::uint32_t i = 0; i < children; ++i) {
            PILEUS_TRY(origin("child of the root", i == 0));
            PILEUS_TRY((node<5, 7>(last_)));
        }
        return Status::ok();
    }

private:
    /// Places of the root stand in ascending order, so that none comes twice.
    Status origin(const char* what, bool first) {
        Place place;
        for (std::int64_t& coordinate : place) {
            std::int32_t value = 0;
            PILEUS_TRY(in_.i32(what, value));
            coordinate = value;
            if (coordinate % kRootSide != 0)
                return in_.fault(std::string(what) + ": origin " + std::to_string(coordinate) +
                                 ", allowed: multiples of 4096");
        }
        if (!first && !(last_ < place))
            return in_.fault(std::string(what) + ": out of order or twice, allowed: ascending");
        last_ = place;
        return Status::ok();
    }

    Status root_tile(bool first) {
        float value = 0;
        unsigned active = 0;
        PILEUS_TRY(origin("tile of the root", first));
        PILEUS_TRY(values_.single(in_, "tile of the root", value));
        PILEUS_TRY(in_.u8("tile of the root", active));
        return active != 0 ? visitor_.tile(in_, last_, kRootSide, value) : Status::ok();
    }

    /// A table of 2^kLog entries along each axis, each a tile or a child of 2^kChild voxels.
    template <unsigned kLog, unsigned kChild>
    Status node(const Place& origin) {
        constexpr unsigned kEntries = 1u << (3 * kLog), kLow = (1u << kLog) - 1;
        const unsigned char *children = nullptr, *active = nullptr;
        PILEUS_TRY(in_.take(kEntries / 8, "mask of children", children));
        PILEUS_TRY(in_.take(kEntries / 8, "mask of tiles", active));
        PILEUS_TRY(values_.read(in_, active, kEntries));
        const auto place = [&](unsigned n) {
            return Place{origin[0] + (std::int64_t(n >> (2 * kLog)) << kChild),
                         origin[1] + (std::int64_t(n >> kLog & kLow) << kChild),
                         origin[2] + (std::int64_t(n & kLow) << kChild)};
        };
        // Use up the tiles first: the children read into the same memory.
        for (unsigned n = 0; n < kEntries; ++n) {
            if (!vdb_mask_on(active, n)) continue;
            if (vdb_mask_on(children, n))
                return in_.fault("mask of tiles: a tile stands where a child is, allowed: one");
            PILEUS_TRY(visitor_.tile(in_, place(n), std::int64_t{1} << kChild, values_.at(n)));
        }
        for (unsigned n = 0; n < kEntries; ++n)
            if (vdb_mask_on(children, n)) PILEUS_TRY(child<kChild>(place(n)));
        return Status::ok();
    }

    template <unsigned kChild>
    Status child(const Place& origin) {
        if constexpr (kChild == 7) {
            return node<4, 3>(origin);
        } else {
            const unsigned char* mask = nullptr;
            PILEUS_TRY(in_.take(kLeafMask, "mask of a leaf", mask));
            return visitor_.leaf(origin, mask);
        }
    }

    ByteCursor& in_;
    VdbValues& values_;
    Visitor& visitor_;
    Place last_{};
};

/// Walks the masks and tiles of a grid that choose_vdb_grid gave.
Status measure_vdb_tree(ByteCursor& in, const VdbGrid& grid, VdbBox& box) {
    VdbValues values;
    PILEUS_TRY(values.prepare(grid));
    box = VdbBox();
    Measure measure(box);
    PILEUS_TRY(in.window(grid.tree_at, grid.end, "tree"));
    PILEUS_TRY((Walk<Measure>(in, values, measure).root()));
    box.values_at = in.at();
    return Status::ok();
}

/// Writes tiles and voxels into `volume`, whose size is the box's and whose values are 0.
Status fill_vdb_tree(ByteCursor& in, const VdbGrid& grid, const VdbBox& box, Volume& volume) {
    VdbValues values, unpack;
    PILEUS_TRY(values.prepare(grid));
    PILEUS_TRY(unpack.prepare(grid));
    PILEUS_TRY(in.window(box.values_at, grid.end, "values of the tree"));
    Fill fill(in, box, unpack, volume);
    PILEUS_TRY(in.window(grid.tree_at, grid.end, "tree"));
    PILEUS_TRY((Walk<Fill>(in, values, fill).root()));
    return fill.finish();
}

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
    return frame_vdb_box(name + ": grid " + quote_text(found.grid.label), bytes.size, limits,
                         found.grid.transform, found.box, found.head);
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
    head.detail =
        vdb_detail(found.grid.label, vdb_names(found.grids),
                   compression_text(found.grid.compression), found.grid.transform, found.box);
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
