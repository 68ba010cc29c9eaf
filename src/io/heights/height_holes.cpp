// SPDX-License-Identifier: Apache-2.0
// Samples without a height: counted, refused or filled.
// in: a grid with NaN -> out: a grid without, or one line.
// docs/solids.md, "Height maps": the mean of the nearest samples along rows and columns, weighted
// by one over their distance in samples.
#include "src/base/number_text.h"
#include "src/io/heights/height_map.h"

namespace pileus {
namespace {

bool is_hole(float h) { return h != h; }

std::string sample_name(const HeightGrid& grid, std::size_t index) {
    return "row " + std::to_string(index / std::size_t(grid.columns)) + ", column " +
           std::to_string(index % std::size_t(grid.columns));
}

/// Sums over what is met from a hole along one line of samples.
struct Sums {
    Buffer<float> value, weight;
};

/// Walks along a line from `first` on, `step` apart, and adds to each hole what was met last.
void walk(const HeightGrid& grid, std::size_t first, std::ptrdiff_t step, int count, Sums& sums) {
    float last = 0, away = 0;
    bool met = false;
    for (int i = 0; i < count; ++i) {
        const auto at = std::size_t(std::ptrdiff_t(first) + step * i);
        const float h = grid.height[at];
        away += 1;
        if (!is_hole(h)) {
            last = h, away = 0, met = true;
        } else if (met) {
            sums.value[at] += last / away;
            sums.weight[at] += 1 / away;
        }
    }
}

/// One pass: holes with a height in their row or column get one. Returns how many are left.
std::uint64_t fill_once(HeightGrid& grid, Sums& sums) {
    const int columns = grid.columns, rows = grid.rows;
    for (int r = 0; r < rows; ++r) {
        const std::size_t first = std::size_t(r) * std::size_t(columns);
        walk(grid, first, 1, columns, sums);
        walk(grid, first + std::size_t(columns) - 1, -1, columns, sums);
    }
    const std::size_t last_row = std::size_t(rows - 1) * std::size_t(columns);
    for (int c = 0; c < columns; ++c) {
        walk(grid, std::size_t(c), columns, rows, sums);
        walk(grid, last_row + std::size_t(c), -std::ptrdiff_t(columns), rows, sums);
    }
    std::uint64_t left = 0;
    for (std::size_t i = 0; i < grid.height.size(); ++i) {
        if (!is_hole(grid.height[i])) continue;
        if (sums.weight[i] > 0)
            grid.height[i] = sums.value[i] / sums.weight[i];
        else
            ++left;
    }
    return left;
}

}  // namespace

Status settle_holes(const std::string& name, HoleUse use, HeightGrid& grid) {
    std::uint64_t holes = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < grid.height.size(); ++i) {
        const float h = grid.height[i];
        if (is_hole(h)) {
            if (holes++ == 0) first = i;
        } else if (!(h >= -1e10f && h <= 1e10f)) {
            return Status::bad_input(name + ": samples: " + sample_name(grid, i) + ": too high, " +
                                     number_text(double(h)) + " m, allowed: within 1e10 m");
        }
    }
    if (holes == 0) return Status::ok();
    const std::string what = name + ": samples: " + std::to_string(holes) +
                             " without a height, the first in " + sample_name(grid, first);
    if (holes == grid.height.size())
        return Status::bad_input(what + ", which are all, allowed: one height or more");
    if (use == HoleUse::kRefuse)
        return Status::bad_input(what + ", allowed: none, or holes = \"fill\"");
    // The first pass fills every row that holds a height, the second every column.
    for (std::uint64_t left = holes; left > 0;) {
        Sums sums;
        PILEUS_TRY(sums.value.resize(grid.height.size(), "holes of a map"));
        PILEUS_TRY(sums.weight.resize(grid.height.size(), "holes of a map"));
        left = fill_once(grid, sums);
    }
    return Status::ok();
}

}  // namespace pileus
