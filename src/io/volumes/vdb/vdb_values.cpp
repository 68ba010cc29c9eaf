// SPDX-License-Identifier: Apache-2.0
// Unpacks the values of a node.
// in: a cursor at a node's values -> out: floats.
// OpenVDB 10.0.1, openvdb/io/Compression.h; docs/formats.md
#include "src/io/volumes/vdb/vdb_values.h"

#include "src/io/volumes/vdb/vdb_file.h"

namespace pileus {

namespace {

/// The byte before a node's values: what its inactive entries hold, and whether they are there.
enum NodeFlag : unsigned {
    kOneInactive = 2,
    kMaskOnly = 3,
    kMaskAndOne = 4,
    kMaskAndTwo = 5,
    kAllValues = 6
};

}  // namespace

unsigned vdb_mask_count(const unsigned char* mask, unsigned entries) {
    unsigned count = 0;
    for (unsigned i = 0; i < entries / 8; ++i) count += unsigned(__builtin_popcount(mask[i]));
    return count;
}

Status VdbValues::prepare(const VdbGrid& grid) {
    compression_ = grid.compression;
    value_bytes_ = grid.value_bytes();
    stored_bytes_ = grid.half ? 2 : value_bytes_;
    PILEUS_TRY(unpacked_.resize(kVdbMaxEntries * stored_bytes_, "OpenVDB node"));
    return values_.resize(kVdbMaxEntries, "OpenVDB node");
}

Status VdbValues::single(ByteCursor& in, const char* what, float& value) const {
    const unsigned char* from = nullptr;
    PILEUS_TRY(in.take(value_bytes_, what, from));
    value = packed_number(from, value_bytes_);
    return Status::ok();
}

Status VdbValues::read(ByteCursor& in, const unsigned char* mask, unsigned entries) {
    unsigned flag = 0;
    PILEUS_TRY(in.u8("flag of a node", flag));
    if (flag > kAllValues)
        return in.fault("flag of a node: " + std::to_string(flag) + ", allowed: 0 to 6");

    // Pass the values of inactive entries and the mask that chooses between two of them.
    if (flag == kOneInactive || flag == kMaskAndOne || flag == kMaskAndTwo)
        PILEUS_TRY(
            in.skip(flag == kMaskAndTwo ? 2 * value_bytes_ : value_bytes_, "inactive value"));
    if (flag == kMaskOnly || flag == kMaskAndOne || flag == kMaskAndTwo)
        PILEUS_TRY(in.skip(entries / 8, "mask of inactive values"));

    const bool active_only = (compression_ & kVdbActiveMask) != 0 && flag != kAllValues;
    const unsigned count = active_only ? vdb_mask_count(mask, entries) : entries;
    Span<const unsigned char> from;
    if (count > 0 || stored_bytes_ == value_bytes_)
        PILEUS_TRY(block(in, std::uint64_t(count) * stored_bytes_, from));

    for (unsigned entry = 0, next = 0; entry < entries; ++entry) {
        const bool active = vdb_mask_on(mask, entry);
        values_.at(entry) = 0;
        if (active)
            values_.at(entry) = packed_number(
                from.part(std::size_t(next) * stored_bytes_, stored_bytes_).data, stored_bytes_);
        next += active || !active_only ? 1 : 0;
    }
    return Status::ok();
}

/// A length stands before a block that may be packed; not above 0 it says that it is not.
Status VdbValues::block(ByteCursor& in, std::uint64_t bytes, Span<const unsigned char>& from) {
    from.size = std::size_t(bytes);
    if ((compression_ & (kVdbZip | kVdbBlosc)) == 0) return in.take(bytes, "values", from.data);
    std::uint64_t bits = 0;
    PILEUS_TRY(in.u64("length of values", bits));
    const bool packed = bits != 0 && bits >> 63 == 0;
    if (!packed && 0 - bits != bytes)
        return in.fault("length of values: " + std::to_string(0 - bits) + ", allowed: exactly " +
                        std::to_string(bytes));
    if (!packed) return in.take(bytes, "values", from.data);
    PILEUS_TRY(in.take(bits, "packed values", from.data));
    // Blosc packs no value at all into a header of its own; there is nothing to unpack.
    if (bytes == 0) return Status::ok();
    const bool blosc = (compression_ & kVdbBlosc) != 0;
    const Span<unsigned char> room = unpacked_.span().part(0, std::size_t(bytes));
    PILEUS_TRY(inflate_block(in, blosc, from.data, bits, room.data, bytes));
    from = room;
    return Status::ok();
}

}  // namespace pileus
