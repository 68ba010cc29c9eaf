// SPDX-License-Identifier: Apache-2.0
// See grib_message.h. A library that trusts these numbers writes beyond its memory.
// WMO, Manual on Codes, FM 92 GRIB; ecCodes for messages of edition 1 above 2^23 bytes
#include "src/io/netcdf/grib_message.h"

#include <algorithm>
#include <cstring>

#include "src/base/file.h"
#include "src/base/reading_limit.h"

namespace pileus {
namespace {

constexpr std::size_t kHead1 = 8, kHead2 = 16, kEnd = 4;
/// Shortest sections, by number; 0: none of that number.
constexpr std::size_t kShortest1[] = {0, 28, 6, 6, 11};
constexpr std::size_t kShortest2[] = {0, 21, 5, 14, 9, 11, 6, 5};
/// Edition 1: which sections follow, in the eighth byte of section 1.
constexpr unsigned kHasGrid = 0x80, kHasBitmap = 0x40;
/// Edition 1 has 24 bits for a length; with this bit set it may count in pieces of 120 bytes.
constexpr std::uint64_t kLong = 0x800000, kLongPiece = 120;

std::size_t shortest_message(unsigned edition) {
    return edition == 1 ? kHead1 + kShortest1[1] + kShortest1[4] + kEnd
                        : kHead2 + 21 + 14 + 9 + 11 + 6 + 5 + kEnd;
}

bool ends_here(Span<const unsigned char> bytes, std::size_t at) {
    return bytes.size - at >= kEnd && std::memcmp(bytes.data + at, "7777", kEnd) == 0;
}

}  // namespace

std::uint64_t grib_number(Span<const unsigned char> from, std::size_t at, unsigned bytes) {
    std::uint64_t value = 0;
    for (unsigned i = 0; i < bytes; ++i) value = value << 8 | from.at(at + i);
    return value;
}

Status GribWalk::fault(const std::string& line) const {
    return Status::bad_input(name_ + ": GRIB: message " + std::to_string(number_) +
                             ": damaged or cut short, " + line);
}

Status GribWalk::take(std::uint64_t at, std::uint64_t count, unsigned char* to) const {
    if (count > size_ || at > size_ - count)
        return fault("file: ends after " + std::to_string(size_) + " bytes, allowed: at least " +
                     std::to_string(at + count));
    if (file_ == nullptr) {
        std::memcpy(to, memory_.data + at, std::size_t(count));
        return Status::ok();
    }
    const FileResult result = file_->read_at(at, to, std::size_t(count));
    return result ? Status::ok() : read_fault(name_, result);
}

/// Archives pad messages with zeros; nothing else may stand between them.
Status GribWalk::find_message(bool& more) {
    more = false;
    unsigned char piece[4096];
    while (at_ < size_) {
        const std::uint64_t count = std::min<std::uint64_t>(sizeof piece, size_ - at_);
        PILEUS_TRY(take(at_, count, piece));
        const std::uint64_t zeros = std::uint64_t(
            std::find_if(piece, piece + count, [](unsigned char c) { return c != 0; }) - piece);
        at_ += zeros;
        if (zeros == count) continue;
        unsigned char mark[4] = {};
        PILEUS_TRY(take(at_, std::min<std::uint64_t>(4, size_ - at_), mark));
        if (std::memcmp(mark, "GRIB", 4) != 0)
            return fault("byte " + std::to_string(at_) +
                         ": no message begins there, allowed: GRIB, or zeros up to the next one");
        more = true;
        return Status::ok();
    }
    return Status::ok();
}

/// Of a message of edition 1 that may count in pieces: the data section says what is too much.
Status GribWalk::long_length(std::uint64_t& length) const {
    std::uint64_t at = at_ + kHead1, section = 0;
    unsigned char head[8] = {};
    const Span<const unsigned char> bytes{head, sizeof head};
    PILEUS_TRY(take(at, sizeof head, head));
    section = grib_number(bytes, 0, 3);
    const unsigned follow = head[7];
    for (const unsigned flag : {kHasGrid, kHasBitmap}) {
        if ((follow & flag) == 0) continue;
        at += section;
        PILEUS_TRY(take(at, 3, head));
        section = grib_number(bytes, 0, 3);
    }
    PILEUS_TRY(take(at + section, 3, head));
    const std::uint64_t over = grib_number(bytes, 0, 3);
    if (over < kLongPiece) length = (length & (kLong - 1)) * kLongPiece - over + kEnd;
    return Status::ok();
}

Status GribWalk::length_of(std::uint64_t& length) const {
    unsigned char head[kHead2] = {};
    PILEUS_TRY(take(at_, kHead1, head));
    const unsigned edition = head[7];
    if (edition != 1 && edition != 2)
        return fault("edition: " + std::to_string(edition) + ", allowed: 1 or 2");
    if (edition == 1) {
        length = grib_number({head, kHead1}, 4, 3);
        if ((length & kLong) != 0) PILEUS_TRY(long_length(length));
    } else {
        PILEUS_TRY(take(at_, kHead2, head));
        length = grib_number({head, kHead2}, 8, 8);
    }
    const std::uint64_t least = shortest_message(edition), most = size_ - at_;
    if (length >= least && length <= most) return Status::ok();
    return fault("length: " + std::to_string(length) + " bytes, allowed: " + std::to_string(least) +
                 " to the " + std::to_string(most) + " that are left of the file");
}

Status GribWalk::sections_of_1() {
    const Span<const unsigned char> all = bytes_.span();
    GribSections field;
    field.edition = 1;
    std::size_t at = kHead1;
    const std::size_t end = all.size - kEnd;
    unsigned follow = kHasGrid;
    for (unsigned number = 1; number <= 4; ++number) {
        if (number == 2) follow = unsigned(field.of[1].at(7));
        if ((number == 2 && (follow & kHasGrid) == 0) ||
            (number == 3 && (follow & kHasBitmap) == 0))
            continue;
        const std::size_t left = end - at, least = kShortest1[number];
        std::uint64_t length = left >= 3 ? grib_number(all, at, 3) : 0;
        // That of a long message's data is what its own length counts too much.
        if (number == 4 && all.size >= kLong && length < kLongPiece) length = left;
        if (left < least || length < least || length > left || (number == 4 && length != left))
            return fault(
                "section " + std::to_string(number) + ": length: " + std::to_string(length) +
                " bytes, allowed: " +
                (number == 4 && left >= least ? "exactly " : std::to_string(least) + " to ") +
                std::to_string(left));
        field.of[number] = all.part(at, std::size_t(length));
        at += std::size_t(length);
    }
    // Coefficients of levels stand where the grid's fourth and fifth bytes say.
    const Span<const unsigned char> grid = field.of[2];
    if (grid.size > 0 && grid.at(3) > 0 &&
        (grid.at(4) < 7 || grid.at(4) - 1 + 4 * std::size_t(grid.at(3)) > grid.size))
        return fault("section 2: coefficients: " + std::to_string(grid.at(3)) + " at byte " +
                     std::to_string(grid.at(4)) + ", allowed: within its " +
                     std::to_string(grid.size) + " bytes");
    fields_.push_back(field);
    return Status::ok();
}

/// 1, then fields: 2 where there is one, 3 that may be that of the field before, and 4 to 7.
Status GribWalk::check_order(unsigned before, unsigned number, std::size_t at) const {
    const bool next = number == before + 1 || (before == 1 && number == 3);
    const bool again = before == 7 && number >= 2 && number <= 4;
    if (number <= 7 && (next || again)) return Status::ok();
    return fault("byte " + std::to_string(at) + ": section " + std::to_string(number) +
                 " behind section " + std::to_string(before) + ", allowed: 1 to 7 in their order");
}

Status GribWalk::sections_of_2() {
    const Span<const unsigned char> all = bytes_.span();
    GribSections field;
    field.edition = 2;
    Span<const unsigned char> bitmap;
    unsigned before = 0;
    std::size_t at = kHead2;
    const std::size_t end = all.size - kEnd;
    while (at < end) {
        if (end - at < 5)
            return fault("byte " + std::to_string(at) + ": " + std::to_string(end - at) +
                         " bytes left, allowed: a section");
        const std::uint64_t length = grib_number(all, at, 4);
        const unsigned number = all.at(at + 4);
        PILEUS_TRY(check_order(before, number, at));
        if (length < kShortest2[number] || length > end - at)
            return fault("section " + std::to_string(number) +
                         ": length: " + std::to_string(length) + " bytes, allowed: " +
                         std::to_string(kShortest2[number]) + " to " + std::to_string(end - at));
        field.of[number] = all.part(at, std::size_t(length));
        if (number == 4 && 4 * grib_number(all, at + 5, 2) > length - kShortest2[4])
            return fault("section 4: coefficients: " + std::to_string(grib_number(all, at + 5, 2)) +
                         ", allowed: as many as its " + std::to_string(length) + " bytes hold");
        // 254: the bitmap of the field before.
        if (number == 6 && all.at(at + 5) != 254) bitmap = field.of[6];
        if (number == 6) field.of[6] = bitmap;
        if (number == 6 && bitmap.size == 0)
            return fault("section 6: the bitmap of a field before, allowed: one that is there");
        if (number == 7) fields_.push_back(field);
        before = number;
        at += std::size_t(length);
    }
    if (before == 7) return Status::ok();
    return fault("sections: end with " + std::to_string(before) + ", allowed: with 7");
}

Status GribWalk::read_message() {
    std::uint64_t length = 0;
    PILEUS_TRY(length_of(length));
    PILEUS_TRY(check_reading(name_, 2 * length));
    PILEUS_TRY(bytes_.resize(length, "GRIB message"));
    PILEUS_TRY(take(at_, length, bytes_.data()));
    if (!ends_here(bytes_.span(), bytes_.size() - kEnd))
        return fault("end: not there, allowed: 7777 after " + std::to_string(length) + " bytes");
    fields_.clear();
    PILEUS_TRY(bytes_[7] == 1 ? sections_of_1() : sections_of_2());
    at_ += length;
    return Status::ok();
}

/// One of several fields becomes a message of its own.
Status GribWalk::join_field() {
    message_ = bytes_.span();
    const GribSections& field = fields_[field_];
    if (fields_.size() == 1) return Status::ok();
    std::uint64_t length = kHead2 + kEnd;
    for (const Span<const unsigned char>& section : field.of) length += section.size;
    PILEUS_TRY(own_.resize(length, "GRIB message"));
    std::memcpy(own_.data(), bytes_.data(), kHead2);
    for (unsigned i = 0; i < 8; ++i)
        own_[8 + i] = static_cast<unsigned char>(length >> (56 - 8 * i));
    std::size_t at = kHead2;
    for (const Span<const unsigned char>& section : field.of) {
        if (section.size > 0) std::memcpy(own_.data() + at, section.data, section.size);
        at += section.size;
    }
    std::memcpy(own_.data() + at, "7777", kEnd);
    message_ = own_.span();
    return Status::ok();
}

Status GribWalk::next(bool& more) {
    more = true;
    if (begun_ && ++field_ < fields_.size()) return join_field();
    if (begun_) ++number_;
    begun_ = true;
    field_ = 0;
    PILEUS_TRY(find_message(more));
    if (!more) return Status::ok();
    PILEUS_TRY(read_message());
    return join_field();
}

}  // namespace pileus
