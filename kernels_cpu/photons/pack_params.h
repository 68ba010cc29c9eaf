// SPDX-License-Identifier: Apache-2.0
// Where sums of photons lie before and after they are packed: plain structs.
// in: a light's sums, one block per thread -> out: the layout that a launch takes.
// docs/collectors.md, "The ring of generations"
#pragma once
#include <cstdint>

namespace pileus {

/// Numbers that belong together, as those of a collector, are whole multiples of one power of two:
/// `numbers` bytes of high digits, signed, then the low four of each, two a byte, then the power.
struct PackParams {
    std::int32_t numbers = 0;        ///< of a set
    std::int32_t blocks = 1;         ///< sums that are added up, one block per thread
    std::uint64_t block_stride = 0;  ///< numbers from one block to the next
    double scale = 1;          ///< the numbers' unit over the packed ones', above 1/2, at most 1
    std::int32_t coarser = 0;  ///< the total's unit is 2^coarser packed ones
    std::int32_t old_coarser = 0;  ///< of what is packed so far
    bool replaces = false;         ///< the total holds what is packed so far, which leaves it
    bool exact = false;            ///< the total takes the numbers as they were before packing
};

struct PackBuffers {
    std::int64_t* sums = nullptr;    ///< [block][set][number]; zeros are left behind
    std::uint8_t* packed = nullptr;  ///< [set]
    std::int64_t* total = nullptr;   ///< [set][number]; null: nothing is added up
};

/// Bytes of a set.
constexpr std::uint64_t packed_bytes(std::uint64_t numbers) {
    return numbers + (numbers + 1) / 2 + 1;
}

}  // namespace pileus
