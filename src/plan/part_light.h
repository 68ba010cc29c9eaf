// SPDX-License-Identifier: Apache-2.0
// A part of a frame's work, and the light that it leaves behind.
// in: nothing -> out: plain arrays that files and ranks carry. docs/farm.md
#pragma once
#include <cstdint>
#include <vector>

#include "src/base/buffer.h"

namespace pileus {

/// Part `index` of `count`; of one there is nothing to merge.
struct WorkPart {
    std::uint32_t index = 0, count = 1;
    bool given = false;  ///< light alone is wanted, and no picture

    bool is_first() const { return index == 0; }
};

/// How many parts of a frame there may be.
constexpr std::uint32_t kMaxParts = 4096;

/// How a method's work on a frame is divided, so that what is merged has the bits of one run.
enum class Division {
    kRows,     ///< pixels know nothing of one another: rows of the finished picture
    kPaths,    ///< rows of the film
    kPhotons,  ///< each generation's photons; sums are whole numbers
    kFlux      ///< what is traced of a measurement, in the order of its sums
};

/// Light before it is shown.
struct PartLight {
    std::vector<std::uint64_t> same;   ///< alike in all parts, or they are of different works
    std::vector<std::uint64_t> first;  ///< counts that each work has once
    Buffer<std::int64_t> sums;         ///< those of all parts are added up
    Buffer<double> rows;  ///< [plane][pixel of the part], moved to its place; may be empty
};

}  // namespace pileus
