// SPDX-License-Identifier: Apache-2.0
// See grib_message.h. ecCodes takes counts and bits of these sections at their word.
// WMO, Manual on Codes, FM 92 GRIB, templates 5.0 to 5.42; ISO 15444-1 A.5.1; PNG 11.2.2
#include <cstring>

#include "src/io/netcdf/grib_message.h"

namespace pileus {
namespace {

using Bytes = Span<const unsigned char>;

constexpr unsigned kMaxBits = 32;   ///< of a packed value
constexpr unsigned kMaxWidth = 31;  ///< of a value within a group

std::string range_fault(const char* what, std::uint64_t value, std::uint64_t least,
                        std::uint64_t most) {
    return std::string(what) + ": " + std::to_string(value) +
           ", allowed: " + (least == most ? "" : std::to_string(least) + " to ") +
           std::to_string(most);
}
std::string short_fault(const char* what, std::uint64_t bytes, std::uint64_t needed) {
    return std::string(what) + ": " + std::to_string(bytes) + " bytes, allowed: at least " +
           std::to_string(needed);
}
std::uint64_t bytes_for(std::uint64_t bits) { return bits / 8 + (bits % 8 != 0 ? 1 : 0); }

/// The first `points` bits of a bitmap that are set.
std::uint64_t points_set(Bytes bits, std::uint64_t points) {
    std::uint64_t count = 0;
    for (std::uint64_t i = 0; i < points / 8; ++i)
        count += unsigned(__builtin_popcount(bits.at(std::size_t(i))));
    for (unsigned i = 0; i < points % 8; ++i)
        count += bits.at(std::size_t(points / 8)) >> (7 - i) & 1;
    return count;
}

/// Reads numbers of a few bits from a place on.
class BitCursor {
public:
    BitCursor(Bytes from, std::uint64_t byte) : from_(from), at_(8 * byte) {}
    std::uint64_t take(unsigned bits) {
        std::uint64_t value = 0;
        for (; bits > 0; --bits, ++at_)
            value = value << 1 | (from_.at(std::size_t(at_ / 8)) >> (7 - at_ % 8) & 1);
        return value;
    }

private:
    Bytes from_;
    std::uint64_t at_;
};

/// Groups of values, each with a reference, a width and a length (templates 5.2 and 5.3).
std::string complex_fault(Bytes s, Bytes data, std::uint64_t count) {
    const std::uint64_t groups = grib_number(s, 31, 4);
    const unsigned bits = s.at(19), least_width = s.at(35), width_bits = s.at(36), step = s.at(41),
                   length_bits = s.at(46);
    const std::uint64_t least_length = grib_number(s, 37, 4), last = grib_number(s, 42, 4);
    std::uint64_t extra = 0;
    if (grib_number(s, 9, 2) == 3) {
        const unsigned order = s.at(47), bytes = s.at(48);
        if (order > 2) return range_fault("order of differences", order, 0, 2);
        if (order > 0 && (bytes < 1 || bytes > 4))
            return range_fault("bytes of a difference", bytes, 1, 4);
        if (order > 0) extra = std::uint64_t(order + 1) * bytes;
    }
    if (s.at(22) > 2) return range_fault("kinds of missing values", s.at(22), 0, 2);
    if (groups > count) return range_fault("groups", groups, 0, count);
    for (const unsigned b : {bits, width_bits, length_bits})
        if (b > kMaxWidth) return range_fault("bits of a group", b, 0, kMaxWidth);
    const std::uint64_t widths = extra + bytes_for(groups * bits),
                        lengths = widths + bytes_for(groups * width_bits),
                        values = lengths + bytes_for(groups * length_bits);
    if (values > data.size) return short_fault("groups", data.size, values);
    BitCursor width_at(data, widths), length_at(data, lengths);
    std::uint64_t sum = 0, all_bits = 0;
    for (std::uint64_t i = 0; i < groups; ++i) {
        const std::uint64_t width = least_width + width_at.take(width_bits);
        std::uint64_t length = least_length + step * length_at.take(length_bits);
        if (i + 1 == groups) length = last;
        if (width > kMaxWidth) return range_fault("width of a group", width, 0, kMaxWidth);
        if (length > count - sum) return range_fault("length of a group", length, 0, count - sum);
        sum += length;
        all_bits += length * width;
    }
    // No group at all: every value is the reference.
    if (groups > 0 && sum != count) return range_fault("values of all groups", sum, count, count);
    if (values + bytes_for(all_bits) > data.size)
        return short_fault("values", data.size, values + bytes_for(all_bits));
    return "";
}

/// SIZ, the second marker of a code stream, says how much is unpacked.
std::string jpeg_fault(Bytes data, std::uint64_t count) {
    constexpr unsigned char kOpening[] = {0xff, 0x4f, 0xff, 0x51};
    if (data.size < 45 || std::memcmp(data.data, kOpening, sizeof kOpening) != 0)
        return "values: no JPEG 2000 code stream, allowed: one";
    const std::uint64_t width = grib_number(data, 8, 4), height = grib_number(data, 12, 4);
    std::uint64_t pixels = 0;
    if (__builtin_mul_overflow(width, height, &pixels) || pixels != count)
        return range_fault("pixels of JPEG 2000", pixels, count, count);
    // Places of the picture and of its tiles are 0, a tile is no smaller than the picture.
    const bool plain = grib_number(data, 16, 8) == 0 && grib_number(data, 24, 4) >= width &&
                       grib_number(data, 28, 4) >= height && grib_number(data, 32, 8) == 0;
    const bool one = grib_number(data, 40, 2) == 1 && data.at(42) < kMaxWidth && data.at(43) == 1 &&
                     data.at(44) == 1;
    if (!plain || !one) return "values: JPEG 2000 of another layout, allowed: one tile, one plane";
    return "";
}

/// Walks through the chunks up to IEND, which must be the last bytes.
std::string png_fault(Bytes data, std::uint64_t count, unsigned bits) {
    constexpr unsigned char kOpening[] = {0x89, 'P', 'N', 'G', '\r', '\n', 26, '\n'};
    constexpr std::size_t kOpens = sizeof kOpening, kAround = 12;  // length, name, checksum
    if (data.size < kOpens + 13 + kAround || std::memcmp(data.data, kOpening, kOpens) != 0)
        return "values: no PNG, allowed: one";
    const std::uint64_t width = grib_number(data, 16, 4), height = grib_number(data, 20, 4);
    std::uint64_t pixels = 0;
    if (__builtin_mul_overflow(width, height, &pixels) || pixels != count)
        return range_fault("pixels of a PNG", pixels, count, count);
    // Grey of 1 to 16 bits, colours of three or four bytes.
    const unsigned depth = data.at(24), colour = data.at(25), rounded = (bits + 7) / 8 * 8;
    const unsigned pixel = colour == 2 ? 24 : colour == 6 ? 32 : depth;
    const bool known = (colour == 0 && (depth == 8 || depth == 16)) ||
                       ((colour == 2 || colour == 6) && depth == 8);
    if (!known || pixel != rounded || data.at(28) != 0)
        return range_fault("bits of a pixel of a PNG", pixel, rounded, rounded);
    for (std::size_t at = kOpens;;) {
        if (data.size - at < kAround) return "values: a PNG that is cut short, allowed: all of it";
        const std::uint64_t length = grib_number(data, at, 4);
        if (length > data.size - at - kAround)
            return short_fault("chunk of a PNG", data.size - at - kAround, length);
        const bool last = std::memcmp(data.data + at + 4, "IEND", 4) == 0;
        if (last != (at + kAround + length == data.size))
            return "values: bytes behind a PNG, allowed: none";
        if (last) return "";
        at += kAround + std::size_t(length);
    }
}

std::string packed_fault_2(const GribSections& field, std::uint64_t count) {
    const Bytes s = field.of[5], data = field.of[7].part(5, field.of[7].size - 5);
    const std::uint64_t packing = grib_number(s, 9, 2);
    struct Row {
        unsigned packing;
        std::size_t length;
    };
    constexpr Row kRows[] = {{0, 21}, {2, 47}, {3, 49}, {4, 12}, {40, 23}, {41, 21}, {42, 25}};
    const Row* row = nullptr;
    for (const Row& r : kRows)
        if (r.packing == packing) row = &r;
    if (row == nullptr)
        return "packing: template 5." + std::to_string(packing) +
               ", allowed: 5.0, 5.2, 5.3, 5.4, 5.40, 5.41, 5.42 (grib_set -r -s "
               "packingType=grid_simple)";
    if (s.size < row->length) return short_fault("section 5: length", s.size, row->length);
    if (packing == 4) {
        const unsigned precision = s.at(11);
        if (precision < 1 || precision > 2) return range_fault("precision", precision, 1, 2);
        if (count * 4 * precision > data.size)
            return short_fault("values", data.size, count * 4 * precision);
        return "";
    }
    const unsigned bits = s.at(19);
    if (bits > kMaxBits) return range_fault("bits per value", bits, 0, kMaxBits);
    if (packing == 2 || packing == 3) return complex_fault(s, data, count);
    // Of a field with one value everywhere there is nothing but that.
    if (bits == 0 || count == 0) return "";
    if (packing == 40) return jpeg_fault(data, count);
    if (packing == 41) return png_fault(data, count, bits);
    if (packing == 42) {
        const unsigned block = s.at(22);
        const std::uint64_t interval = grib_number(s, 23, 2);
        if (block != 8 && block != 16 && block != 32 && block != 64)
            return "block of CCSDS: " + std::to_string(block) + ", allowed: 8, 16, 32 or 64";
        if (interval < 1 || interval > 4096)
            return range_fault("blocks between references of CCSDS", interval, 1, 4096);
        return "";
    }
    if (count * bits > 8 * std::uint64_t(data.size))
        return short_fault("values", data.size, bytes_for(count * bits));
    return "";
}

std::string fault_of_2(const GribSections& field, std::uint64_t nx, std::uint64_t ny) {
    const Bytes grid = field.of[3], bitmap = field.of[6];
    const std::uint64_t points = nx * ny;
    if (grib_number(grid, 12, 2) != 0 || grid.at(10) != 0)
        return "section 3: another grid, allowed: template 3.0 and rows of one length";
    if (grid.size < 72) return short_fault("section 3: length", grid.size, 72);
    if (grib_number(grid, 6, 4) != points || grib_number(grid, 30, 4) != nx ||
        grib_number(grid, 34, 4) != ny)
        return range_fault("section 3: points", grib_number(grid, 6, 4), points, points);
    const std::uint64_t count = grib_number(field.of[5], 5, 4);
    std::uint64_t there = points;
    if (bitmap.at(5) == 0) {
        if (bitmap.size - 6 < bytes_for(points))
            return short_fault("bitmap", bitmap.size - 6, bytes_for(points));
        there = points_set(bitmap.part(6, bitmap.size - 6), points);
    } else if (bitmap.at(5) != 254 && bitmap.at(5) != 255) {
        return "bitmap: number " + std::to_string(bitmap.at(5)) +
               " of a table of the centre, allowed: one in the file, or none";
    }
    if (count != there) return range_fault("packed values", count, there, there);
    return packed_fault_2(field, count);
}

std::string fault_of_1(const GribSections& field, std::uint64_t nx, std::uint64_t ny) {
    const Bytes grid = field.of[2], bitmap = field.of[3], data = field.of[4];
    const std::uint64_t points = nx * ny;
    if (grid.size < 32) return short_fault("section 2: length", grid.size, 32);
    if (grid.at(5) != 0) return range_fault("section 2: kind of grid", grid.at(5), 0, 0);
    if (grib_number(grid, 6, 2) != nx || grib_number(grid, 8, 2) != ny)
        return range_fault("section 2: points", grib_number(grid, 6, 2) * grib_number(grid, 8, 2),
                           points, points);
    std::uint64_t count = points;
    if (bitmap.size > 0) {
        if (grib_number(bitmap, 4, 2) != 0)
            return "bitmap: one of a table of the centre, allowed: one in the file, or none";
        if (bitmap.size - 6 < bytes_for(points + bitmap.at(3)))
            return short_fault("bitmap", bitmap.size - 6, bytes_for(points + bitmap.at(3)));
        count = points_set(bitmap.part(6, bitmap.size - 6), points);
    }
    const unsigned flags = data.at(3) >> 4, unused = data.at(3) & 15, bits = data.at(10);
    // 1 says of values that they are whole numbers.
    if ((flags & ~2u) != 0 || grib_number(data, 4, 2) == 0xffff)
        return "packing: not simple, allowed: simple (grib_set -r -s packingType=grid_simple)";
    if (bits > kMaxBits) return range_fault("bits per value", bits, 0, kMaxBits);
    const std::uint64_t needed = bytes_for(count * bits + (bits > 0 ? unused : 0));
    return data.size - 11 < needed ? short_fault("values", data.size - 11, needed) : "";
}

std::string date_fault(Bytes s, std::size_t at, bool first) {
    const struct {
        const char* what;
        unsigned least, most;
    } kParts[] = {{"month", 1, 12}, {"day", 1, 31}, {"hour", 0, 24}, {"minute", 0, 59}};
    for (const auto& part : kParts) {
        const unsigned value = s.at(at++);
        if (value < part.least || value > part.most)
            return range_fault(part.what, value, part.least, part.most);
    }
    return first || s.at(at) <= 60 ? "" : range_fault("second", s.at(at), 0, 60);
}

/// Seconds of a unit of time (tables 4.4 and, of edition 1, 4); 0: none that has a length, or one
/// whose length is not known.
std::uint64_t seconds_of(unsigned unit, bool first) {
    constexpr unsigned kSeconds[] = {60, 3600, 86400, 0, 0, 0, 0, 0, 0, 0, 10800, 21600, 43200};
    if (unit < sizeof kSeconds / sizeof kSeconds[0]) return kSeconds[unit];
    if (first) return unit == 13 ? 900 : unit == 14 ? 1800 : unit == 254 ? 1 : 0;
    return unit == 13 ? 1 : 0;
}

}  // namespace

/// ecCodes looks a unit up beyond the end of its table, and counts days one by one.
std::string grib_time_fault(const GribSections& sections) {
    constexpr std::uint64_t kMaxSeconds = std::uint64_t{100} * 366 * 86400;
    const bool first = sections.edition == 1;
    const Bytes s = first ? sections.of[1] : sections.of[4];
    const std::string date = date_fault(sections.of[1], first ? 13 : 14, first);
    if (!date.empty()) return date;
    if (!first) {
        // Those whose time stands at the same place: at a time or over one, of one run or of many.
        constexpr unsigned kProducts[] = {0, 1, 2, 8, 11, 12, 60, 61};
        const std::uint64_t product = grib_number(s, 7, 2);
        bool known = false;
        for (const unsigned p : kProducts) known = known || p == product;
        if (!known)
            return "product: template 4." + std::to_string(product) +
                   ", allowed: 4.0, 4.1, 4.2, 4.8, 4.11, 4.12, 4.60, 4.61";
        if (s.size < 34) return short_fault("section 4: length", s.size, 34);
    }
    const std::uint64_t each = seconds_of(s.at(17), first);
    if (each == 0)
        return "unit of time: " + std::to_string(s.at(17)) +
               ", allowed: seconds to days (0, 1, 2, 10 to 13)";
    const std::uint64_t steps = first ? 0 : grib_number(s, 18, 4);
    if (steps > kMaxSeconds / each)
        return range_fault("forecast time", steps, 0, kMaxSeconds / each);
    return "";
}

std::string grib_values_fault(const GribSections& sections, std::uint64_t nx, std::uint64_t ny) {
    // Both editions count points in 32 bits.
    if (nx < 1 || ny < 1 || nx > 0xffffffffu / ny) return "grid: of no size, allowed: points";
    return sections.edition == 1 ? fault_of_1(sections, nx, ny) : fault_of_2(sections, nx, ny);
}

}  // namespace pileus
