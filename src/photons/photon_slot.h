// SPDX-License-Identifier: Apache-2.0
// What one batch of photons left behind: sums of whole numbers, plain or packed.
// in: sizes of the sums -> out: arrays, and the numbers of one place.
// docs/collectors.md, "The ring of generations"
#pragma once
#include <array>
#include <vector>

#include "kernels_cpu/photons/pack_sums.h"
#include "src/plan/array.h"

namespace pileus {

/// How many numbers a light has in a slot.
struct SlotSize {
    std::uint64_t collectors = 0, channels = 1, coefficients = 1, ground_cells = 0;

    /// A set is what a collector keeps in one channel.
    std::uint64_t sets() const { return bytes_of(collectors, channels); }
    std::uint64_t ground_numbers() const { return bytes_of(ground_cells, channels); }
    std::uint64_t numbers() const {
        return sum_of_bytes(bytes_of(collectors, channels, coefficients), ground_numbers());
    }
};

/// Sums of a generation of a ring. Each set has a power of two of its own, so that its largest
/// number is wrong by 2^-10 of itself at most, and none by more than that.
struct PackedSums {
    Buffer<std::uint8_t> sets;    ///< [light][set], as PackParams tells
    Buffer<std::int64_t> ground;  ///< [light][ground cell][channel], not packed
    std::uint64_t numbers = 0;    ///< of a set; 0: the slot is not packed
    std::uint64_t count = 0;      ///< sets of a light
    std::size_t lights = 0;

    bool empty() const { return numbers == 0; }
    std::uint64_t light_bytes() const { return count * packed_bytes(numbers); }
    std::uint8_t* of_light(std::size_t light) { return sets.data() + light * light_bytes(); }
    const std::uint8_t* of_light(std::size_t light) const {
        return sets.data() + light * light_bytes();
    }
};

/// Sums of all lights of one batch: [light], each [collector][channel][coefficient] and then
/// [ground cell][channel], both with the same binary places, so that one proof bounds them.
struct PhotonSlot {
    Buffer<std::int64_t> sums;  ///< empty where they are packed
    PackedSums packed;
    std::uint64_t generations = 0;  ///< that were added
    std::uint64_t serial = 0;       ///< grows whenever the sums change
    std::uint64_t digest = 0;       ///< of the sums when `serial` was `digested`
    std::uint64_t digested = ~std::uint64_t{0};
    std::int64_t scatterings = 0;  ///< of these generations
    /// Per light, for unit radiance or irradiance: a quantum's, where sums are packed a power of
    /// two.
    std::vector<double> flux_per_photon_m2;
    std::array<float, 3> sun_travel{0, 0, -1};
    std::vector<double> parts;  ///< per light, of a generation that was ended within; empty: none

    /// Generations of a light, parts of one included.
    double generations_of(std::size_t light) const {
        return double(generations) + (parts.empty() ? 0.0 : parts[light]);
    }
};

/// Forgets what was shot into it.
void empty_slot(PhotonSlot& slot, int threads);

/// The `size` numbers of set `set` of a light, `stride` numbers from the light before, into `out`.
template <class Number>
void numbers_of_set(const PhotonSlot& slot, std::size_t light, std::uint64_t stride,
                    std::uint64_t set, int size, Number* out) {
    if (slot.packed.empty()) {
        const std::int64_t* from =
            slot.sums.data() + light * stride + set * std::uint64_t(unsigned(size));
        for (int i = 0; i < size; ++i) out[i] = Number(from[i]);
        return;
    }
    std::int32_t q[kMaxPacked];
    const int power = unpack_set<0>(
        slot.packed.of_light(light) + set * packed_bytes(slot.packed.numbers), size, q);
    for (int i = 0; i < size; ++i) out[i] = Number(std::int64_t(q[i]) * (std::int64_t(1) << power));
}

/// [ground cell][channel] of a light, so many numbers.
inline const std::int64_t* ground_of(const PhotonSlot& slot, std::size_t light, std::size_t lights,
                                     std::size_t numbers) {
    if (!slot.packed.empty()) return slot.packed.ground.data() + light * numbers;
    return slot.sums.data() + (light + 1) * (slot.sums.size() / lights) - numbers;
}

namespace arrays {

/// One slot.
inline Array<std::int64_t> photon_slot(const SlotSize& size, std::uint64_t lights) {
    return {"photon map", bytes_of(size.numbers(), lights), Stage::kPhotons, Stage::kWrite};
}
/// One slot of a ring.
inline Array<std::uint8_t> packed_slot(const SlotSize& size, std::uint64_t lights) {
    return {"photon map", bytes_of(bytes_of(size.sets(), lights), packed_bytes(size.coefficients)),
            Stage::kPhotons, Stage::kWrite};
}
/// And what its ground received.
inline Array<std::int64_t> packed_ground(const SlotSize& size, std::uint64_t lights) {
    return {"photon map", bytes_of(size.ground_numbers(), lights), Stage::kPhotons, Stage::kWrite};
}

}  // namespace arrays

/// Zeros. kLimit: out of memory.
Status allocate_slot(const SlotSize& size, std::uint64_t lights, bool packed, PhotonSlot& slot);

}  // namespace pileus
