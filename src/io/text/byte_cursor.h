// SPDX-License-Identifier: Apache-2.0
// Walks through bytes that nobody vouches for; every step is checked against their end.
// in: the bytes of a binary file -> out: little-endian numbers and texts, or a line with the place.
// docs/formats.md
#pragma once
#include <cstdint>
#include <cstring>
#include <string>

#include "src/base/span.h"
#include "src/base/status.h"

namespace pileus {

class ByteCursor {
public:
    ByteCursor(const std::string& file, Span<const char> bytes)
        : file_(&file), bytes_(bytes), end_(bytes.size) {}

    const std::string& name() const { return *file_; }
    std::uint64_t at() const { return at_; }
    std::uint64_t left() const { return end_ - at_; }

    /// "file: byte 12: line".
    Status fault(const std::string& line) const {
        return Status::bad_input(*file_ + ": byte " + std::to_string(at_) + ": " +
                                 printable_line(line));
    }
    /// Passes `count` bytes and hands them out.
    Status take(std::uint64_t count, const char* what, const unsigned char*& from) {
        if (count > left())
            return fault(std::string(what) + ": ends too early, " + std::to_string(left()) +
                         " bytes left, allowed: at least " + std::to_string(count));
        from = reinterpret_cast<const unsigned char*>(bytes_.data) + at_;
        at_ += count;
        return Status::ok();
    }
    Status skip(std::uint64_t count, const char* what) {
        const unsigned char* passed;
        return take(count, what, passed);
    }
    /// Goes to `at` and takes `end` for the end of the bytes; both must lie within them.
    Status window(std::uint64_t at, std::uint64_t end, const char* what) {
        if (at > end || end > bytes_.size)
            return fault(std::string(what) + ": outside the file, bytes " + std::to_string(at) +
                         " to " + std::to_string(end) + ", allowed: within 0 to " +
                         std::to_string(bytes_.size));
        at_ = at;
        end_ = end;
        return Status::ok();
    }

    Status u8(const char* what, unsigned& value) { return number(what, 1, value); }
    Status u16(const char* what, std::uint32_t& value) { return number(what, 2, value); }
    Status u32(const char* what, std::uint32_t& value) { return number(what, 4, value); }
    Status u64(const char* what, std::uint64_t& value) { return number(what, 8, value); }
    Status i32(const char* what, std::int32_t& value) {
        std::uint32_t bits = 0;
        Status status = u32(what, bits);
        std::memcpy(&value, &bits, 4);
        return status;
    }
    Status f64(const char* what, double& value) {
        std::uint64_t bits = 0;
        Status status = u64(what, bits);
        std::memcpy(&value, &bits, 8);
        return status;
    }
    /// A count of 32 bits, then as many characters.
    Status text(const char* what, std::string& value) {
        constexpr std::uint32_t kLongest = 4096;
        std::uint32_t length = 0;
        PILEUS_TRY(u32(what, length));
        if (length > kLongest)
            return fault(std::string(what) + ": too long, " + std::to_string(length) +
                         ", allowed: at most " + std::to_string(kLongest));
        const unsigned char* from = nullptr;
        PILEUS_TRY(take(length, what, from));
        value.assign(reinterpret_cast<const char*>(from), length);
        return Status::ok();
    }

private:
    template <class Number>
    Status number(const char* what, unsigned count, Number& value) {
        const unsigned char* from = nullptr;
        value = 0;
        PILEUS_TRY(take(count, what, from));
        for (unsigned i = count; i-- > 0;) value = Number(std::uint64_t(value) << 8 | from[i]);
        return Status::ok();
    }

    const std::string* file_;
    Span<const char> bytes_;
    std::uint64_t at_ = 0, end_;
};

}  // namespace pileus
