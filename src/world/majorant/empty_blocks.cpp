// SPDX-License-Identifier: Apache-2.0
// See majorant.h.
// in: majorants -> out: distances to the nearest block that holds medium, largest axis counted.
// The distance is separable: along x, then the larger of that and the way along y, then z.
#include <cassert>
#include <initializer_list>

#include "platform/threads.h"
#include "src/world/majorant/majorant.h"

namespace pileus {
namespace {

/// Stands for every distance that a leap does not use whole.
constexpr float kFar = kLongestLeap + 1;

/// A line of blocks: its first, the step between them, how many.
struct Line {
    float* first;
    std::size_t step;
    int count;
};

/// Distances are kept as negative numbers, so that positive majorants may stay in their places.
/// Replaces every distance on a line by the least, over all its blocks, of the larger of theirs and
/// the way to them.
void spread(const Line& line) {
    float was[kMaxLine];
    for (int i = 0; i < line.count; ++i) {
        const float v = line.first[std::size_t(i) * line.step];
        was[i] = v > 0 ? 0.0f : -v;
    }
    for (int i = 0; i < line.count; ++i) {
        float least = was[i];
        // Farther blocks than the best so far cannot be better.
        for (int far = 1; float(far) < least; ++far)
            for (int at : {i - far, i + far}) {
                if (at < 0 || at >= line.count) continue;
                const float way = was[at] > float(far) ? was[at] : float(far);
                least = way < least ? way : least;
            }
        float& v = line.first[std::size_t(i) * line.step];
        v = v > 0 ? v : -least;
    }
}

}  // namespace

void mark_empty_blocks(Span<float> blocks, const int count[3], int threads) {
    assert(count[0] <= kMaxLine && count[1] <= kMaxLine && count[2] <= kMaxLine);
    const std::size_t step[3] = {1, std::size_t(count[0]),
                                 std::size_t(count[0]) * std::size_t(count[1])};
    for (float& v : blocks)
        if (!(v > 0)) v = -kFar;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
        parallel_for(threads, count[v], [&](std::int64_t j, int) {
            for (std::size_t i = 0; i < std::size_t(count[u]); ++i)
                spread({blocks.data + i * step[u] + std::size_t(j) * step[v], step[axis],
                        count[axis]});
        });
    }
    // A block next to a full one has none free around it.
    for (float& v : blocks)
        if (!(v > 0)) v += 1.0f;
}

}  // namespace pileus
