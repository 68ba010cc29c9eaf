// SPDX-License-Identifier: Apache-2.0
// See packed_bytes.h. The only file that touches zlib and blosc.
#include "src/io/text/packed_bytes.h"

#include <algorithm>
#include <cstring>

#include "src/base/reading_limit.h"

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
        uLong used = uLong(count);
        right = count <= 0x7fffffffu && uncompress2(to, &written, packed, &used) == Z_OK &&
                written == bytes;
        if (right && used < count)
            return in.fault("packed values: " + std::to_string(count - used) +
                            " bytes behind their end, allowed: none");
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

enum class GzipEnd { kSound, kDamaged, kTooLarge, kJunk };

/// Unpacks members one after the other, as RFC 1952 joins them.
class GzipWalk {
public:
    explicit GzipWalk(Span<const char> packed) : packed_(packed) {
        made_ = inflateInit2(&stream_, 15 + 16) == Z_OK;
    }
    ~GzipWalk() {
        if (made_) inflateEnd(&stream_);
    }
    GzipWalk(const GzipWalk&) = delete;
    GzipWalk& operator=(const GzipWalk&) = delete;

    /// At most `room` bytes go to `to`; where that is null they are only counted.
    GzipEnd run(unsigned char* to, std::uint64_t room) {
        if (!made_) return GzipEnd::kDamaged;
        for (;;) {
            const GzipEnd end = member(to, room);
            if (end != GzipEnd::kSound || only_zeros()) return end;
            if (packed_.size - taken < 2 || packed_[taken] != '\x1f' ||
                packed_[taken + 1] != '\x8b')
                return GzipEnd::kJunk;
            if (inflateReset(&stream_) != Z_OK) return GzipEnd::kDamaged;
        }
    }
    std::size_t taken = 0;    ///< of the packed bytes
    std::uint64_t bytes = 0;  ///< unpacked

private:
    GzipEnd member(unsigned char* to, std::uint64_t room) {
        constexpr std::uint64_t kMaxAtOnce = std::uint64_t{1} << 30;
        for (int state = Z_OK; state != Z_STREAM_END;) {
            // The end of a member may still have to be read where there is no more room.
            unsigned char passed[1 << 14];
            const std::uint64_t in = std::min<std::uint64_t>(packed_.size - taken, kMaxAtOnce);
            const bool pass = to == nullptr || bytes == room;
            const std::uint64_t out = pass ? sizeof passed : std::min(room - bytes, kMaxAtOnce);
            stream_.next_in =
                reinterpret_cast<Bytef*>(const_cast<char*>(packed_.data + taken));  // only read
            stream_.avail_in = uInt(in);
            stream_.next_out = pass ? passed : to + bytes;
            stream_.avail_out = uInt(out);
            state = inflate(&stream_, Z_NO_FLUSH);
            taken += std::size_t(in - stream_.avail_in);
            bytes += out - stream_.avail_out;
            if (bytes > room) return GzipEnd::kTooLarge;
            if (state != Z_OK && state != Z_STREAM_END) return GzipEnd::kDamaged;
        }
        return GzipEnd::kSound;
    }
    /// Tapes and disks pad with zeros, which gzip passes over as well.
    bool only_zeros() const {
        for (std::size_t i = taken; i < packed_.size; ++i)
            if (packed_[i] != 0) return false;
        return true;
    }

    Span<const char> packed_;
    z_stream stream_{};
    bool made_ = false;
};

Status gzip_fault(const ByteCursor& in, const GzipWalk& walk, GzipEnd end, std::uint64_t most) {
    const std::string at = std::to_string(walk.taken);
    if (end == GzipEnd::kJunk)
        return in.fault("gzip: no member begins at packed byte " + at +
                        ", allowed: members, or zeros up to the end");
    if (end == GzipEnd::kTooLarge) {
        Status status = in.fault("gzip: too large, allowed: at most " + std::to_string(most) +
                                 " bytes unpacked");
        status.code = Code::kLimit;
        return status;
    }
    return in.fault("gzip: damaged or cut off at packed byte " + at);
}

}  // namespace
#endif

Status inflate_gzip(const std::string& name, Span<const char> packed, std::uint64_t most,
                    Buffer<char>& out) {
    const ByteCursor in(name, packed);
#ifdef PILEUS_WITH_ZLIB
    // Its head does not say how much is in it: counted first, so that no memory is taken for a lie.
    const std::uint64_t room = std::min(most, reading_room());
    GzipWalk count(packed);
    const GzipEnd end = count.run(nullptr, room);
    if (end == GzipEnd::kTooLarge) PILEUS_TRY(check_reading(name, count.bytes));
    if (end != GzipEnd::kSound) return gzip_fault(in, count, end, room);
    PILEUS_TRY(out.resize(count.bytes, "unpacked file"));
    GzipWalk walk(packed);
    if (count.bytes > 0 &&
        walk.run(reinterpret_cast<unsigned char*>(out.data()), count.bytes) != GzipEnd::kSound)
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
