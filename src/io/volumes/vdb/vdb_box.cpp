// SPDX-License-Identifier: Apache-2.0
// Bounds the box of a sparse grid, places it in the world, and fills it.
// in: active voxels and a transform -> out: see vdb_box.h.
// docs/formats.md
#include "src/io/volumes/vdb/vdb_box.h"

#include <utility>

#include "src/base/number_text.h"
#include "src/io/volumes/vdb/vdb_values.h"
#include "src/io/volumes/volume_file.h"

namespace pileus {

void VdbBox::grow(const VdbPlace& from, const VdbPlace& to) {
    const bool first = empty();
    for (std::size_t a = 0; a < 3; ++a) {
        if (first || from[a] < low[a]) low[a] = from[a];
        if (first || to[a] > high[a]) high[a] = to[a];
    }
}

void VdbBox::add_tile(const VdbPlace& at, std::int64_t side) {
    grow(at, {at[0] + side - 1, at[1] + side - 1, at[2] + side - 1});
    active += std::uint64_t(side) * std::uint64_t(side) * std::uint64_t(side);
}

/// Bit x*64 + y*8 + z of a leaf's mask: byte x*8 + y, bit z.
void VdbBox::add_leaf(const VdbPlace& origin, const unsigned char* mask) {
    constexpr unsigned kSide = 8, kBytes = 64;
    unsigned any[3] = {0, 0, 0};
    for (unsigned i = 0; i < kBytes; ++i) {
        if (mask[i] == 0) continue;
        any[0] |= 1u << (i / kSide);
        any[1] |= 1u << (i % kSide);
        any[2] |= mask[i];
    }
    if (any[0] == 0) return;
    active += vdb_mask_count(mask, 8 * kBytes);
    VdbPlace from = origin, to = origin;
    for (std::size_t a = 0; a < 3; ++a) {
        from[a] += __builtin_ctz(any[a]);
        to[a] += 31 - __builtin_clz(any[a]);
    }
    grow(from, to);
}

void VdbBox::lay(const VdbTransform& transform) {
    std::array<std::int64_t, 3> size{}, step{};
    for (std::size_t a = 0; a < 3; ++a)
        size[std::size_t(transform.world[a])] = high[a] - low[a] + 1;
    step = {1, size[0], size[0] * size[1]};
    first_ = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        stride_[a] = step[std::size_t(transform.world[a])];
        if (transform.scale[a] > 0) continue;
        first_ += stride_[a] * (high[a] - low[a]);
        stride_[a] = -stride_[a];
    }
}

std::size_t VdbBox::index(const VdbPlace& at) const {
    std::int64_t index = first_;
    for (std::size_t a = 0; a < 3; ++a) index += stride_[a] * (at[a] - low[a]);
    return std::size_t(index);
}

void VdbBox::fill_tile(const VdbPlace& at, std::int64_t side, float value, Volume& volume) const {
    for (std::int64_t z = at[2]; z < at[2] + side; ++z)
        for (std::int64_t y = at[1]; y < at[1] + side; ++y)
            for (std::int64_t x = at[0]; x < at[0] + side; ++x)
                volume.density.at(index({x, y, z})) = value;
}

Status VdbChecks::fault(const ByteCursor& in, const VdbPlace& at, const std::string& text) const {
    return in.fault("voxel " + std::to_string(at[0]) + ' ' + std::to_string(at[1]) + ' ' +
                    std::to_string(at[2]) + ": " + text);
}

Status VdbChecks::take(const ByteCursor& in, const VdbPlace& at, float& value) {
    constexpr float kLargest = 3.402823466e38f;
    if (!(value >= -kLargest && value <= kLargest))
        return fault(in, at, number_text(double(value)) + ", allowed: a finite number >= 0");
    if (undershoot_.take(value)) lowest_in_ = in, lowest_at_ = at;
    return Status::ok();
}

Status VdbChecks::finish(Volume& volume) const {
    if (lowest_in_ && undershoot_.is_fault())
        return fault(*lowest_in_, lowest_at_, undershoot_.text());
    undershoot_.settle(volume);
    return Status::ok();
}

namespace {

/// Bounds the cells by the project's limits and by what so short a file may ask for.
Status check_size(const std::string& where, std::uint64_t bytes, const VdbLimits& limits,
                  const VdbTransform& transform, const VdbBox& box, VolumeHead& head) {
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
    for (std::size_t a = 0; a < 3; ++a) head.size[std::size_t(transform.world[a])] = int(size[a]);
    return Status::ok();
}

}  // namespace

Status frame_vdb_box(const std::string& where, std::uint64_t bytes, const VdbLimits& limits,
                     const VdbTransform& transform, VdbBox& box, VolumeHead& head) {
    // A sky without a cloud, as the first frame of a simulation: one voxel of nothing.
    if (box.empty()) box.low = box.high = {0, 0, 0};
    PILEUS_TRY(check_size(where, bytes, limits, transform, box, head));
    box.lay(transform);

    // Voxel centres lie where the transform says, so the box's faces half a voxel further out.
    for (std::size_t a = 0; a < 3; ++a) {
        const int w = transform.world[a];
        const double shift = transform.translation[std::size_t(w)], scale = transform.scale[a];
        double low = scale * (double(box.low[a]) - 0.5) + shift;
        double high = scale * (double(box.high[a]) + 0.5) + shift;
        if (scale < 0) std::swap(low, high);
        if (!(low < high && low >= -1e12 && high <= 1e12))
            return Status::bad_input(where + ": place out of range, " + number_text(low) + " to " +
                                     number_text(high) + ", allowed: -1e12 to 1e12");
        head.bounds_m[0][w] = low;
        head.bounds_m[1][w] = high;
    }
    head.knows_bounds = true;
    head.in_extinction = false;
    return Status::ok();
}

std::string vdb_detail(const std::string& label, const std::vector<VdbName>& names,
                       const std::string& packing, const VdbTransform& transform,
                       const VdbBox& box) {
    std::string text = "grid " + quote_text(label) + " of " + vdb_name_list(names) + "; " + packing;
    if (!transform.is_straight()) text += "; " + transform.axes_text();
    return text + "; " + std::to_string(box.active) + " active voxels" +
           (box.active == 0 ? ", clear air" : "");
}

Status start_vdb_volume(const std::string& name, const VolumeHead& head, Volume& volume) {
    const std::uint64_t rows = std::uint64_t(head.size[1]) * std::uint64_t(head.size[2]);
    PILEUS_TRY(volume.density.resize(rows * std::uint64_t(head.size[0]), name.c_str()));
    volume.size = head.size;
    volume.knows_bounds = head.knows_bounds;
    volume.bounds_m = head.bounds_m;
    volume.in_extinction = head.in_extinction;
    volume.missing = volume.clamped = 0;
    return Status::ok();
}

}  // namespace pileus
