// SPDX-License-Identifier: Apache-2.0
// Unpacks the values of a node; the only file that touches zlib and blosc.
// in: a cursor at a node's values -> out: floats.
// OpenVDB 10.0.1, openvdb/io/Compression.h; docs/formats.md
#include "src/io/volumes/vdb/vdb_values.h"

#ifdef PILEUS_WITH_ZLIB
#include <zlib.h>
#endif
#ifdef PILEUS_WITH_BLOSC
#include <blosc.h>
#endif

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

std::uint64_t little_endian(const unsigned char* from, unsigned bytes) {
    std::uint64_t bits = 0;
    for (unsigned i = bytes; i-- > 0;) bits = bits << 8 | from[i];
    return bits;
}

/// Exact: each 16-bit float is a 32-bit one.
float half_to_float(std::uint32_t h) {
    const std::uint32_t sign = (h & 0x8000u) << 16, exponent = h >> 10 & 31, fraction = h & 1023;
    if (exponent == 0) {
        const float small = float(fraction) * (1.0f / 16777216.0f);
        return sign != 0 ? -small : small;
    }
    const std::uint32_t bits =
        sign | (exponent == 31 ? 0x7f800000u : (exponent + 112) << 23) | fraction << 13;
    float value;
    std::memcpy(&value, &bits, 4);
    return value;
}

/// Rounds to the nearest float; what lies beyond becomes infinite.
float narrow(double value) {
    constexpr double kLargest = 3.4028234663852886e38;
    if (value > kLargest || value < -kLargest)
        return value > 0 ? __builtin_inff() : -__builtin_inff();
    return float(value);
}

}  // namespace

float vdb_number(const unsigned char* from, unsigned bytes) {
    const std::uint64_t bits = little_endian(from, bytes);
    if (bytes == 2) return half_to_float(std::uint32_t(bits));
    if (bytes == 4) {
        const std::uint32_t word = std::uint32_t(bits);
        float value;
        std::memcpy(&value, &word, 4);
        return value;
    }
    double value;
    std::memcpy(&value, &bits, 8);
    return narrow(value);
}

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
    value = vdb_number(from, value_bytes_);
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
            values_.at(entry) = vdb_number(
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
    PILEUS_TRY(vdb_inflate(in, blosc, from.data, bits, room.data, bytes));
    from = room;
    return Status::ok();
}

#if defined(PILEUS_WITH_ZLIB) && defined(PILEUS_WITH_BLOSC)
constexpr const char* kLibraries = "zlib yes, blosc yes";
#elif defined(PILEUS_WITH_ZLIB)
constexpr const char* kLibraries = "zlib yes, blosc no";
#elif defined(PILEUS_WITH_BLOSC)
constexpr const char* kLibraries = "zlib no, blosc yes";
#else
constexpr const char* kLibraries = "zlib no, blosc no";
#endif

std::string vdb_library_text() { return kLibraries; }

Status vdb_inflate(const ByteCursor& in, bool blosc, const unsigned char* packed,
                   std::uint64_t count, unsigned char* to, std::uint64_t bytes) {
    bool right = false, there = false;
    (void)packed, (void)count, (void)to;
#ifdef PILEUS_WITH_BLOSC
    if (blosc) {
        there = true;
        std::size_t stated = 0;
        right = blosc_cbuffer_validate(packed, std::size_t(count), &stated) == 0 &&
                stated == bytes &&
                blosc_decompress_ctx(packed, to, std::size_t(bytes), 1) == int(bytes);
    }
#endif
#ifdef PILEUS_WITH_ZLIB
    if (!blosc) {
        there = true;
        uLongf written = uLongf(bytes);
        right = count <= 0x7fffffffu && uncompress(to, &written, packed, uLong(count)) == Z_OK &&
                written == bytes;
    }
#endif
    if (!there)
        return in.fault(std::string("compression: ") + (blosc ? "blosc" : "zip") +
                        " is not in this build, allowed: a build with -DPILEUS_" +
                        (blosc ? "BLOSC" : "ZLIB") + "=ON and the library");
    if (!right)
        return in.fault("packed values: damaged, allowed: a block of " + std::to_string(bytes) +
                        " bytes");
    return Status::ok();
}

std::uint64_t vdb_deflate(const unsigned char* from, std::uint64_t bytes, unsigned char* to,
                          std::uint64_t room) {
#ifdef PILEUS_WITH_ZLIB
    uLongf written = uLongf(room);
    if (compress2(to, &written, from, uLong(bytes), Z_DEFAULT_COMPRESSION) == Z_OK &&
        written < bytes)
        return written;
#endif
    (void)from, (void)bytes, (void)to, (void)room;
    return 0;
}

}  // namespace pileus
