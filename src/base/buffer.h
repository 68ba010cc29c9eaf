// SPDX-License-Identifier: Apache-2.0
// Owned array whose allocation can fail with a Status instead of an exception.
// in: a count -> out: zeroed, 64-byte aligned memory of the host (platform/memory.h), freed with
// its owner.
#pragma once
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "platform/memory.h"
#include "src/base/span.h"
#include "src/base/status.h"

namespace pileus {

/// a*b, or false when the product does not fit.
inline bool checked_multiply(std::uint64_t a, std::uint64_t b, std::uint64_t& product) {
    return !__builtin_mul_overflow(a, b, &product);
}

/// Gives `memory` back and takes zeroes for `count` elements of `bytes` each, or nothing for none.
/// `what` names the array in the error line. Errors: kLimit, where `memory` is null afterwards.
Status renew_memory(std::uint64_t count, std::uint64_t bytes, const char* what, void*& memory,
                    const Allocator*& from);

template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable<T>::value, "a Buffer holds plain data");

public:
    Buffer() = default;
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;
    Buffer(Buffer&& other) noexcept { swap(other); }
    Buffer& operator=(Buffer&& other) noexcept {
        swap(other);
        return *this;
    }
    ~Buffer() { give_memory(data_, from_); }

    /// Replaces the contents by `count` zeroed elements, in the same memory where those are as many
    /// as were asked for before, or fewer of memory that keeps. `what` names the array in the error
    /// line.
    Status resize(std::uint64_t count, const char* what) {
        if (data_ != nullptr && does(count)) {
            size_ = static_cast<std::size_t>(count);
            std::memset(static_cast<void*>(data_), 0, (size_ * sizeof(T) + 63) / 64 * 64);
            return Status::ok();
        }
        void* memory = data_;
        Status status = renew_memory(count, sizeof(T), what, memory, from_);
        data_ = static_cast<T*>(memory);
        size_ = taken_ = status ? static_cast<std::size_t>(count) : 0;
        return status;
    }

    /// `count` elements, of any values, in memory for `most`: the next count needs none.
    Status fit(std::uint64_t count, std::uint64_t most, const char* what) {
        assert(count <= most);
        if (data_ == nullptr || !does(most)) {
            Status status = resize(most, what);
            if (!status) return status;
        }
        size_ = static_cast<std::size_t>(count);
        return Status::ok();
    }

    /// Memory for `most` elements, of which none is there.
    Status reserve(std::uint64_t most, const char* what) {
        Status status = resize(most, what);
        size_ = 0;
        return status;
    }

    /// Reads `count` elements in memory of the caller, which outlives this and is never written to.
    void lend(const T* memory, std::size_t count) {
        *this = Buffer();
        data_ = const_cast<T*>(memory);
        size_ = count;  // taken_ stays 0: another size takes memory of its own
        from_ = &kCallersMemory;
    }

    /// Forgets all elements from `count` on; keeps the memory.
    void truncate(std::size_t count) {
        assert(count <= size_);
        size_ = count;
    }

    /// Null where there are no elements, whatever there is memory for.
    T* data() { return size_ > 0 ? data_ : nullptr; }
    const T* data() const { return size_ > 0 ? data_ : nullptr; }
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    std::uint64_t bytes() const { return size_ * sizeof(T); }
    /// Checked in every build: for indices that depend on a file's numbers; see Span.
    T& at(std::size_t i) { return span().at(i); }
    const T& at(std::size_t i) const { return span().at(i); }
    /// Checked in debug builds only: for indices that the program counts by itself, and kernels.
    T& operator[](std::size_t i) {
        assert(i < size_);
        return data_[i];
    }
    const T& operator[](std::size_t i) const {
        assert(i < size_);
        return data_[i];
    }
    Span<T> span() { return {data_, size_}; }
    Span<const T> span() const { return {data_, size_}; }
    void swap(Buffer& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        std::swap(taken_, other.taken_);
        std::swap(from_, other.from_);
    }

private:
    /// Whether the memory that there is serves so many.
    bool does(std::uint64_t count) const {
        return count == taken_ || (count < taken_ && from_ != nullptr && from_->keeps);
    }

    T* data_ = nullptr;
    std::size_t size_ = 0;
    std::size_t taken_ = 0;            ///< elements that there is memory for
    const Allocator* from_ = nullptr;  ///< that the memory goes back to
};

}  // namespace pileus
