// SPDX-License-Identifier: Apache-2.0
// See packed_bytes.h. The only file that touches zlib and blosc.
#include "src/io/text/packed_bytes.h"

#include <algorithm>
#include <cstring>

#ifdef PILEUS_WITH_ZLIB
#include <zlib.h>
#endif
#ifdef PILEUS_WITH_BLOSC
#include <blosc.h>
#endif

namespace pileus {
namespace {

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

float packed_number(const unsigned char* from, unsigned bytes) {
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

#if defined(PILEUS_WITH_ZLIB) && defined(PILEUS_WITH_BLOSC)
constexpr const char* kLibraries = "zlib yes, blosc yes";
#elif defined(PILEUS_WITH_ZLIB)
constexpr const char* kLibraries = "zlib yes, blosc no";
#elif defined(PILEUS_WITH_BLOSC)
constexpr const char* kLibraries = "zlib no, blosc yes";
#else
constexpr const char* kLibraries = "zlib no, blosc no";
#endif

std::string packing_library_text() { return kLibraries; }

Status inflate_block(const ByteCursor& in, bool blosc, const unsigned char* packed,
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

#ifdef PILEUS_WITH_ZLIB
namespace {

/// How many bytes come out, at most `room`; `to` null: they are only counted. False: damaged, cut
/// off, or more than `room`.
bool unpack_gzip(Span<const char> packed, unsigned char* to, std::uint64_t room,
                 std::uint64_t& bytes) {
    constexpr std::uint64_t kMostAtOnce = std::uint64_t{1} << 30;
    unsigned char passed[1 << 14];
    z_stream stream{};
    if (inflateInit2(&stream, 15 + 16) != Z_OK) return false;
    std::uint64_t taken = 0;
    int state = Z_OK;
    bytes = 0;
    while (state == Z_OK) {
        const std::uint64_t in = std::min(packed.size - taken, kMostAtOnce);
        const std::uint64_t out =
            to == nullptr ? sizeof passed : std::min(room - bytes, kMostAtOnce);
        stream.next_in =
            reinterpret_cast<Bytef*>(const_cast<char*>(packed.data + taken));  // only read
        stream.avail_in = uInt(in);
        stream.next_out = to == nullptr ? passed : to + bytes;
        stream.avail_out = uInt(out);
        state = inflate(&stream, Z_NO_FLUSH);
        taken += in - stream.avail_in;
        bytes += out - stream.avail_out;
        if (bytes > room) state = Z_BUF_ERROR;
    }
    inflateEnd(&stream);
    return state == Z_STREAM_END;
}

}  // namespace
#endif

Status inflate_gzip(const ByteCursor& in, Span<const char> packed, std::uint64_t most,
                    Buffer<char>& out) {
#ifdef PILEUS_WITH_ZLIB
    // Its head does not say how much is in it: counted first, so that no memory is taken for a lie.
    std::uint64_t bytes = 0;
    if (!unpack_gzip(packed, nullptr, most, bytes))
        return in.fault("gzip: damaged, cut off or too large, allowed: at most " +
                        std::to_string(most) + " bytes unpacked");
    PILEUS_TRY(out.resize(bytes, "unpacked file"));
    if (bytes > 0 &&
        !unpack_gzip(packed, reinterpret_cast<unsigned char*>(out.data()), bytes, bytes))
        return in.fault("gzip: damaged");
    return Status::ok();
#else
    (void)packed, (void)most, (void)out;
    return in.fault(
        "compression: gzip is not in this build, allowed: a build with -DPILEUS_ZLIB=ON and the "
        "library");
#endif
}

std::uint64_t deflate_block(const unsigned char* from, std::uint64_t bytes, unsigned char* to,
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
