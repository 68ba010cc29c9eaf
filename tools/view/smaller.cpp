// SPDX-License-Identifier: Apache-2.0
// See smaller.h.
#include "tools/view/smaller.h"

#include <algorithm>
#include <cstddef>

namespace pileus::view {
namespace {

constexpr int kOne = 256;

/// Two pixels of a line, and how much of the second, in 256ths.
struct Between {
    std::size_t low, high;
    int share;
};
Between between(int at, int size, int small_size) {
    // 256 (2 at + 1) small / (2 size) - 128, held within the middles.
    const std::int64_t place =
        (std::int64_t(2 * at + 1) * small_size * kOne) / (2 * std::int64_t(size)) - kOne / 2;
    const std::int64_t held =
        std::min(std::max(place, std::int64_t(0)), std::int64_t(small_size - 1) * kOne);
    const std::size_t low = std::size_t(held / kOne);
    return {low, std::min(low + 1, std::size_t(small_size - 1)), int(held % kOne)};
}

}  // namespace

void enlarge(const std::vector<std::uint8_t>& small, int small_width, int small_height, int width,
             int height, std::vector<std::uint8_t>& large) {
    large.resize(4 * std::size_t(width) * std::size_t(height));
    std::vector<Between> columns;
    for (int x = 0; x < width; ++x) columns.push_back(between(x, width, small_width));
    std::vector<int> line(4 * std::size_t(small_width));
    std::uint8_t* out = large.data();
    for (int y = 0; y < height; ++y) {
        const Between row = between(y, height, small_height);
        const std::uint8_t* low = &small[4 * row.low * std::size_t(small_width)];
        const std::uint8_t* high = &small[4 * row.high * std::size_t(small_width)];
        for (std::size_t i = 0; i < line.size(); ++i)
            line[i] = kOne * low[i] + row.share * (high[i] - low[i]);
        for (const Between& column : columns)
            for (std::size_t c = 0; c < 4; ++c) {
                const int l = line[4 * column.low + c], h = line[4 * column.high + c];
                *out++ = std::uint8_t((l * kOne + column.share * (h - l) + kOne * kOne / 2) /
                                      (kOne * kOne));
            }
    }
}

}  // namespace pileus::view
