// SPDX-License-Identifier: Apache-2.0
// Values below 0 by so little that they are what advection and resampling leave of a 0.
// in: the values of a grid one by one -> out: 0 in their place, a count, or too far below.
// docs/formats.md, "Densities in"
#pragma once
#include <algorithm>
#include <string>

#include "src/base/number_text.h"
#include "src/io/volumes/volume.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {

class Undershoot {
public:
    /// Takes a finite value, and leaves 0 where it is negative. True: it is the lowest so far, so
    /// that its place is the one to name.
    bool take(float& value) {
        largest_ = std::max(largest_, value);
        if (value >= 0) return false;
        const bool lower = value < least_;
        ++count_;
        least_ = std::min(least_, value);
        value = 0;
        return lower;
    }
    /// Whether the lowest value is no rounding. The floor is for grids of next to nothing.
    bool is_fault() const { return double(least_) < -bound(); }
    /// Behind the place of the lowest value.
    std::string text() const {
        return number_text(least_) + ", allowed: a finite number >= 0; down to " +
               number_text(float(-bound())) + ", 1e-05 of the largest, it counts as 0";
    }
    void settle(Volume& volume) const { volume.clamped += count_; }

private:
    double bound() const { return std::max(1e-5 * double(largest_), 1e-9); }

    float largest_ = 0, least_ = 0;
    std::uint64_t count_ = 0;
};

}  // namespace pileus
