// SPDX-License-Identifier: Apache-2.0
// See device_arrays.h.
// in: arrays of the host -> out: the device's, freed with their owner.
// docs/crosscheck.md
#include "src/run/device_arrays.h"

namespace pileus {

DeviceArrays::~DeviceArrays() {
    for (void* memory : owned_) device_.release(memory);
}

void DeviceArrays::fail(const char* what) {
    if (status_)
        status_ = Status::io(std::string("device ") + device_.name + ": " + what +
                             " failed: " + device_.fault());
}

void* DeviceArrays::allocate(std::uint64_t count, std::uint64_t size) {
    std::uint64_t bytes = 0;
    if (!status_ || count == 0) return nullptr;
    void* memory = nullptr;
    if (checked_multiply(count, size, bytes)) memory = device_.allocate(bytes);
    if (memory == nullptr) {
        status_ = Status::limit(std::string("device ") + device_.name + ": out of memory, " +
                                std::to_string(bytes) + " bytes asked for");
        return nullptr;
    }
    owned_.push_back(memory);
    return memory;
}

void DeviceArrays::clear(void* memory, std::uint64_t bytes) {
    static constexpr unsigned char zeros[4096] = {};
    auto* const to = static_cast<unsigned char*>(memory);
    for (std::uint64_t at = 0; memory != nullptr && status_ && at < bytes; at += sizeof zeros) {
        const std::uint64_t own = bytes - at < sizeof zeros ? bytes - at : sizeof zeros;
        if (!device_.upload(to + at, zeros, own)) fail("copy to it");
    }
}

void* DeviceArrays::copy(const void* from, std::uint64_t count, std::uint64_t size) {
    if (from == nullptr) return nullptr;
    void* to = allocate(count, size);
    if (to != nullptr && !device_.upload(to, from, count * size)) fail("copy to it");
    return to;
}

void DeviceArrays::in(const PhaseTable*& table) {
    if (table == nullptr) return;
    PhaseTable t = *table;
    const std::uint64_t cells = std::uint64_t(t.cells), slots = std::uint64_t(t.slots);
    in(t.turn, cells + 1);
    in(t.base, cells);
    in(t.width, cells);
    in(t.density, cells + 1);
    in(t.share, cells + 1);
    in(t.draw_guide, slots + 1);
    in(t.find_guide, slots + 1);
    table = &t;
    in(table, 1);
}

Status DeviceArrays::finish() {
    for (const Back& b : back_)
        if (status_ && !device_.download(b.host, b.copied, b.bytes)) fail("copy from it");
    return status_;
}

}  // namespace pileus
