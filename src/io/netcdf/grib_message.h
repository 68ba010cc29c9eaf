// SPDX-License-Identifier: Apache-2.0
// Finds the messages of a GRIB file and checks their lengths before a library gets them.
// in: bytes that nobody vouches for -> out: one field at a time, as a sound message of its own.
// WMO, Manual on Codes, FM 92 GRIB, editions 1 and 2; docs/weather.md, "Files"
#pragma once
#include <string>
#include <vector>

#include "platform/file.h"
#include "src/base/buffer.h"
#include "src/base/span.h"
#include "src/base/status.h"

namespace pileus {

/// The sections of one field, each with its own length in front; those that are not there are
/// empty. Edition 1: 1 product, 2 grid, 3 bitmap, 4 data. Edition 2: by their numbers, 1 to 7.
struct GribSections {
    unsigned edition = 0;
    Span<const unsigned char> of[8];
};

/// A number of `bytes` bytes at `at`, big-endian; checked.
std::uint64_t grib_number(Span<const unsigned char> from, std::size_t at, unsigned bytes);

class GribWalk {
public:
    /// Either lives longer than this.
    GribWalk(const std::string& name, const InputFile& file)
        : name_(name), file_(&file), size_(file.size()) {}
    GribWalk(const std::string& name, Span<const char> bytes)
        : name_(name), memory_(bytes), size_(bytes.size) {}

    /// Goes to the next field; `more` false: there is none. kBadInput: whatever is not as the
    /// format wants it: edition, lengths, order of sections, end, bytes between messages.
    Status next(bool& more);

    /// The field as a message of one field, valid up to the next call.
    Span<const unsigned char> message() const { return message_; }
    const GribSections& sections() const { return fields_[field_]; }
    /// Of the message that the field stands in, from 0 on.
    std::size_t number() const { return number_; }

private:
    Status fault(const std::string& line) const;
    Status take(std::uint64_t at, std::uint64_t count, unsigned char* to) const;
    Status find_message(bool& more);
    Status length_of(std::uint64_t& length) const;
    Status long_length(std::uint64_t& length) const;
    Status read_message();
    Status sections_of_1();
    Status sections_of_2();
    Status check_order(unsigned before, unsigned number, std::size_t at) const;
    Status join_field();

    const std::string& name_;
    const InputFile* file_ = nullptr;
    Span<const char> memory_;
    std::uint64_t size_ = 0, at_ = 0;
    std::size_t number_ = 0, field_ = 0;
    bool begun_ = false;
    Buffer<unsigned char> bytes_, own_;  ///< of the message; of one field out of several
    std::vector<GribSections> fields_;   ///< of the message
    Span<const unsigned char> message_;
};

// Whether a field has a time that there is and all its values, before a library looks at them.

/// What is wrong with the grid section, the bitmap or the packed values of a field on a grid of
/// `nx` times `ny` points on rows of equal length: "bits per value: 64, allowed: 0 to 32". Empty:
/// nothing. Packings that are read: simple, complex with and without differences, IEEE floats, JPEG
/// 2000, PNG, CCSDS; of edition 1 simple alone.
std::string grib_values_fault(const GribSections& sections, std::uint64_t nx, std::uint64_t ny);

/// What is wrong with its product, its date or its forecast time: "month: 13, allowed: 1 to 12".
std::string grib_time_fault(const GribSections& sections);

}  // namespace pileus
