// SPDX-License-Identifier: Apache-2.0
// Copies of arrays in a device's memory, for one launch.
// in: pointers of the host and counts -> out: the same pointers, now the device's; copied back.
// docs/crosscheck.md
#pragma once
#include <vector>

#include "kernels_cpu/media/phase_table.h"
#include "platform/device.h"
#include "src/base/buffer.h"

namespace pileus {

/// Owns the copies. After the first failure all calls do nothing, and `finish` reports it.
class DeviceArrays {
public:
    explicit DeviceArrays(const Device& device) : device_(device) {}
    ~DeviceArrays();
    DeviceArrays(const DeviceArrays&) = delete;
    DeviceArrays& operator=(const DeviceArrays&) = delete;

    /// Replaces a pointer to `count` numbers of the host by one to their copy; null stays null.
    template <class T>
    void in(const T*& pointer, std::uint64_t count) {
        pointer = static_cast<const T*>(copy(pointer, count, sizeof(T)));
    }
    /// The same of an array that the launch changes: `finish` copies it back.
    template <class T>
    void both(T*& pointer, std::uint64_t count) {
        void* host = pointer;
        void* copied = copy(pointer, count, sizeof(T));
        pointer = static_cast<T*>(copied);
        if (copied != nullptr) back_.push_back({host, copied, count * sizeof(T)});
    }
    /// Memory that only the launch uses.
    template <class T>
    void scratch(T*& pointer, std::uint64_t count) {
        pointer = static_cast<T*>(allocate(count, sizeof(T)));
    }
    /// The same, filled with zeros.
    template <class T>
    void zeros(T*& pointer, std::uint64_t count) {
        scratch(pointer, count);
        clear(pointer, count * sizeof(T));
    }
    /// A phase function's table, with all that it points to.
    void in(const PhaseTable*& table);

    /// One thread per item of [begin, end).
    template <class Params, class Buffers>
    void launch(const void* kernel, const Params& params, const Buffers& buffers,
                std::uint32_t begin, std::uint32_t end) {
        if (!status_) return;
        if (!device_.launch(kernel, &params, &buffers, begin, end)) fail("launch");
    }

    /// Copies back what the launch changed.
    Status finish();

private:
    struct Back {
        void* host;
        const void* copied;
        std::uint64_t bytes;
    };
    void fail(const char* what);
    void* allocate(std::uint64_t count, std::uint64_t size);
    void clear(void* memory, std::uint64_t bytes);
    void* copy(const void* from, std::uint64_t count, std::uint64_t size);

    const Device& device_;
    Status status_;
    std::vector<void*> owned_;
    std::vector<Back> back_;
};

}  // namespace pileus
