// SPDX-License-Identifier: Apache-2.0
// A pointer and a count that travel together.
// in: memory owned elsewhere -> out: indexed access, checked in debug builds or in all of them.
#pragma once
#include <cassert>
#include <cstddef>

namespace pileus {

/// Ends the process at once (SIGABRT) with a line on the standard error: `count` elements from
/// `index` on do not lie within `size`. A defect of the program, never an answer to bad input.
[[noreturn]] void stop_out_of_range(std::size_t index, std::size_t count, std::size_t size);

/// operator[] is checked in debug builds only: for indices that the program counts by itself, and
/// for kernels. at() and part() are checked in every build: for indices that depend on the numbers
/// of a file. A reader refuses a bad number before, in a line with its place; should it have
/// forgotten one, these stop the process before memory is read or written that is not the array's.
template <class T>
struct Span {
    T* data = nullptr;
    std::size_t size = 0;

    T& at(std::size_t i) const {
        if (i >= size) stop_out_of_range(i, 1, size);
        return data[i];
    }
    /// `count` elements from `from` on.
    Span part(std::size_t from, std::size_t count) const {
        if (from > size || count > size - from) stop_out_of_range(from, count, size);
        return {data + from, count};
    }
    T& operator[](std::size_t i) const {
        assert(i < size);
        return data[i];
    }
    T* begin() const { return data; }
    T* end() const { return data + size; }
    bool empty() const { return size == 0; }
    operator Span<const T>() const { return {data, size}; }
};

}  // namespace pileus
