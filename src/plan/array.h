// SPDX-License-Identifier: Apache-2.0
// One declaration of an array: what the plan counts is what the stage allocates.
// in: a name, a number of elements, the stages it lives in -> out: a row of the plan, a Buffer.
// docs/contributing.md, "Add an array"
#pragma once
#include "src/base/buffer.h"
#include "src/plan/memory_table.h"

namespace pileus {

/// An array of a run. It lives from the start of `first` to the end of `last`. The functions that
/// make these are in namespace `arrays`, in the header of the stage that allocates the array.
template <class T>
struct Array {
    const char* name = "";
    std::uint64_t count = 0;  ///< elements; the largest number where a product overflows
    Stage first = Stage::kDensity, last = Stage::kWrite;

    std::uint64_t bytes() const { return bytes_of(count, sizeof(T)); }
};

/// `number` arrays of the same kind, as one declaration for the plan.
template <class T>
Array<T> several(std::uint64_t number, Array<T> array) {
    array.count = bytes_of(array.count, number);
    return array;
}

/// The same array under another name and in other stages, where two uses of a stage differ.
template <class T>
Array<T> renamed(const Array<T>& array, const char* name, Stage first, Stage last) {
    return {name, array.count, first, last};
}

/// Adds one row to the plan. Of several arrays it has the name and the stages of the first, and the
/// bytes of all.
template <class First, class... More>
void add(MemoryTable& table, const Array<First>& first, const Array<More>&... more) {
    std::uint64_t bytes = first.bytes();
    ((bytes = sum_of_bytes(bytes, more.bytes())), ...);
    table.add(first.name, first.first, first.last, bytes);
}

/// Replaces the buffer's contents by `array.count` zeroed elements. kLimit: out of memory.
template <class T>
Status allocate(const Array<T>& array, Buffer<T>& buffer) {
    return buffer.resize(array.count, array.name);
}

/// The same, but keeps a buffer of that size as it is, contents included.
template <class T>
Status allocate_once(const Array<T>& array, Buffer<T>& buffer) {
    return buffer.size() == array.count ? Status::ok() : allocate(array, buffer);
}

}  // namespace pileus
