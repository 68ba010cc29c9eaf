// SPDX-License-Identifier: Apache-2.0
// A pointer and a count that travel together.
// in: memory owned elsewhere -> out: indexed access, checked in debug builds.
#pragma once
#include <cassert>
#include <cstddef>

namespace pileus {

template <class T>
struct Span {
    T* data = nullptr;
    std::size_t size = 0;

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
