// SPDX-License-Identifier: Apache-2.0
// See photon_slot.h.
#include "src/photons/photon_slot.h"

#include "platform/threads.h"

namespace pileus {
namespace {

template <class T>
void clear(Buffer<T>& buffer, int threads) {
    constexpr std::uint64_t kPiece = std::uint64_t{1} << 18;  // bytes
    const std::uint64_t bytes = buffer.bytes();
    auto* data = reinterpret_cast<unsigned char*>(buffer.data());
    parallel_for(threads, std::int64_t((bytes + kPiece - 1) / kPiece), [&](std::int64_t p, int) {
        const std::uint64_t begin = std::uint64_t(p) * kPiece, left = bytes - begin;
        std::memset(data + begin, 0, std::size_t(left < kPiece ? left : kPiece));
    });
}

}  // namespace

void empty_slot(PhotonSlot& slot, int threads) {
    clear(slot.sums, threads);
    clear(slot.packed.sets, threads);
    clear(slot.packed.ground, threads);
    slot.generations = 0;
    slot.scatterings = 0;
    slot.parts.clear();
    ++slot.serial;
}

Status allocate_slot(const SlotSize& size, std::uint64_t lights, bool packed, PhotonSlot& slot) {
    if (!packed) return allocate(arrays::photon_slot(size, lights), slot.sums);
    PILEUS_TRY(allocate(arrays::packed_slot(size, lights), slot.packed.sets));
    slot.packed.numbers = size.coefficients;
    slot.packed.count = size.sets();
    slot.packed.lights = std::size_t(lights);
    return allocate(arrays::packed_ground(size, lights), slot.packed.ground);
}

}  // namespace pileus
