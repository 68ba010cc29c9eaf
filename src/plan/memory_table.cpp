// SPDX-License-Identifier: Apache-2.0
// See memory_table.h.
#include "src/plan/memory_table.h"

namespace pileus {

const char* stage_name(Stage stage) {
    static constexpr const char* names[kStageCount] = {
        "density",   "samples", "tree",    "collectors",  "leaf grid",
        "majorants", "photons", "paths",   "reconstruct", "background",
        "shadow",    "splat",   "display", "layers",      "write"};
    return names[std::size_t(stage)];
}

std::uint64_t MemoryTable::live(Stage stage) const {
    std::uint64_t sum = 0;
    for (const MemoryRow& row : rows_)
        if (row.first <= stage && stage <= row.last && __builtin_add_overflow(sum, row.bytes, &sum))
            return ~std::uint64_t{0};
    return sum;
}

Stage MemoryTable::peak_stage() const {
    Stage peak = Stage::kDensity;
    std::uint64_t most = 0;
    for (std::size_t s = 0; s < kStageCount; ++s) {
        const std::uint64_t bytes = live(Stage(s));
        if (bytes > most) most = bytes, peak = Stage(s);
    }
    return peak;
}

std::uint64_t bytes_of(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    std::uint64_t product = 0;
    if (__builtin_mul_overflow(a, b, &product) || __builtin_mul_overflow(product, c, &product))
        return ~std::uint64_t{0};
    return product;
}

std::uint64_t sum_of_bytes(std::uint64_t a, std::uint64_t b) {
    std::uint64_t sum = 0;
    return __builtin_add_overflow(a, b, &sum) ? ~std::uint64_t{0} : sum;
}

}  // namespace pileus
