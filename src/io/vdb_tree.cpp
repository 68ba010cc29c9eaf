// SPDX-License-Identifier: Apache-2.0
// The walk through a tree: root, nodes of 32^3 and 16^3 entries, leaves of 8^3 voxels.
// in: a cursor -> out: see vdb_tree.h.
// Museth 2013, ACM TOG 32(3); OpenVDB 10.0.1, openvdb/tree; docs/formats.md
#include "src/io/vdb_tree.h"

#include "src/io/vdb_values.h"

namespace pileus {

namespace {

using Place = std::array<std::int64_t, 3>;

constexpr unsigned kLeafSide = 8, kLeafVoxels = 512, kLeafMask = 64;
constexpr std::int64_t kRootSide = 4096;

/// Says why a value cannot be a density, or nothing.
Status check_value(const ByteCursor& in, const Place& at, float value) {
    if (value >= 0.0f && value <= 3.402823466e38f) return Status::ok();
    return in.fault("voxel " + std::to_string(at[0]) + ' ' + std::to_string(at[1]) + ' ' +
                    std::to_string(at[2]) + ": " + std::to_string(value) +
                    ", allowed: a finite number >= 0");
}

/// Collects the box of all that is active.
class Measure {
public:
    explicit Measure(VdbBox& box) : box_(box) {}

    Status tile(const ByteCursor& in, const Place& low, std::int64_t side, float value) {
        PILEUS_TRY(check_value(in, low, value));
        grow(low, {low[0] + side - 1, low[1] + side - 1, low[2] + side - 1});
        box_.active += std::uint64_t(side) * std::uint64_t(side) * std::uint64_t(side);
        return Status::ok();
    }

    /// Bit x*64 + y*8 + z of a leaf's mask: byte x*8 + y, bit z.
    Status leaf(const Place& origin, const unsigned char* mask) {
        unsigned any_x = 0, any_y = 0, any_z = 0;
        for (unsigned i = 0; i < kLeafMask; ++i) {
            if (mask[i] == 0) continue;
            any_x |= 1u << (i / kLeafSide);
            any_y |= 1u << (i % kLeafSide);
            any_z |= mask[i];
        }
        box_.active += vdb_mask_count(mask, kLeafVoxels);
        if (any_x == 0) return Status::ok();
        Place low = origin, high = origin;
        const unsigned any[3] = {any_x, any_y, any_z};
        for (std::size_t a = 0; a < 3; ++a) {
            low[a] += __builtin_ctz(any[a]);
            high[a] += 31 - __builtin_clz(any[a]);
        }
        grow(low, high);
        return Status::ok();
    }

private:
    void grow(const Place& low, const Place& high) {
        const bool first = box_.empty();
        for (std::size_t a = 0; a < 3; ++a) {
            if (first || low[a] < box_.low[a]) box_.low[a] = low[a];
            if (first || high[a] > box_.high[a]) box_.high[a] = high[a];
        }
    }
    VdbBox& box_;
};

/// Writes tiles and leaves into the dense grid; a second cursor walks along the leaves' values.
class Fill {
public:
    Fill(ByteCursor values, const VdbBox& box, VdbValues& unpack, Volume& volume)
        : in_(values), box_(box), unpack_(unpack), volume_(volume) {}

    Status tile(const ByteCursor&, const Place& low, std::int64_t side, float value) {
        for (std::int64_t z = low[2]; z < low[2] + side; ++z)
            for (std::int64_t y = low[1]; y < low[1] + side; ++y) {
                float* row = volume_.density.data() + index({low[0], y, z});
                for (std::int64_t x = 0; x < side; ++x) row[x] = value;
            }
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
            PILEUS_TRY(check_value(in_, at, unpack_.at(n)));
            volume_.density[index(at)] = unpack_.at(n);
        }
        return Status::ok();
    }

private:
    std::size_t index(const Place& at) const {
        const std::int64_t x = at[0] - box_.low[0], y = at[1] - box_.low[1],
                           z = at[2] - box_.low[2];
        return std::size_t((z * volume_.size[1] + y) * volume_.size[0] + x);
    }
    ByteCursor in_;
    const VdbBox& box_;
    VdbValues& unpack_;
    Volume& volume_;
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

}  // namespace

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

Status fill_vdb_tree(ByteCursor& in, const VdbGrid& grid, const VdbBox& box, Volume& volume) {
    VdbValues values, unpack;
    PILEUS_TRY(values.prepare(grid));
    PILEUS_TRY(unpack.prepare(grid));
    PILEUS_TRY(in.window(box.values_at, grid.end, "values of the tree"));
    Fill fill(in, box, unpack, volume);
    PILEUS_TRY(in.window(grid.tree_at, grid.end, "tree"));
    return Walk<Fill>(in, values, fill).root();
}

}  // namespace pileus
