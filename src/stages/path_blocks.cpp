// SPDX-License-Identifier: Apache-2.0
// See path_blocks.h.
// in: majorants -> out: distances to the nearest block that holds medium, largest axis counted.
// The distance is separable: along x, then the larger of that and the way along y, then z.
#include "src/stages/path_blocks.h"

#include "kernels_cpu/flight.h"
#include "platform/threads.h"
#include "src/stages/prepare_majorant.h"

namespace pileus {
namespace {

/// Longest leap and one: it bounds the work per block.
constexpr float kFar = 32;

/// A line of blocks: its first index, the step between them, how many.
struct Line {
    std::size_t first, step;
    int count;
};

/// Replaces every distance on a line by the least, over all its blocks, of the larger of theirs and
/// the way to them. `was` has room for the line.
void spread(float* distance, const Line& line, float* was) {
    for (int i = 0; i < line.count; ++i) was[i] = distance[line.first + std::size_t(i) * line.step];
    for (int i = 0; i < line.count; ++i) {
        float least = was[i];
        // Farther blocks than the best so far cannot be better.
        for (int far = 1; float(far) < least; ++far)
            for (int at : {i - far, i + far}) {
                if (at < 0 || at >= line.count) continue;
                const float way = was[at] > float(far) ? was[at] : float(far);
                least = way < least ? way : least;
            }
        distance[line.first + std::size_t(i) * line.step] = least;
    }
}

/// The grid with its ring, along each axis.
struct Ringed {
    std::size_t size[3], step[3];
    explicit Ringed(const std::int32_t counts[3]) {
        for (std::size_t a = 0; a < 3; ++a) size[a] = std::size_t(counts[a]) + 2;
        step[0] = 1, step[1] = size[0], step[2] = size[0] * size[1];
    }
    std::uint64_t total() const { return std::uint64_t(step[2]) * size[2]; }
    std::uint64_t longest() const {
        return std::uint64_t(size[0]) + std::uint64_t(size[1]) + std::uint64_t(size[2]);
    }
};

}  // namespace

std::uint64_t path_blocks_bytes(const Grid& grid, int block, int threads) {
    std::int32_t counts[3];
    block_counts(grid, block, counts);
    const Ringed g(counts);
    return sizeof(float) * (g.total() + g.longest() * std::uint64_t(threads));
}

Status path_blocks(Span<const float> majorants, const std::int32_t counts[3], int threads,
                   Buffer<float>& out) {
    const Ringed g(counts);
    PILEUS_TRY(out.resize(g.total(), "path blocks"));
    for (float& v : out.span()) v = kFar;
    const auto for_blocks = [&](auto use) {
        std::size_t from = 0;
        for (std::size_t z = 1; z + 1 < g.size[2]; ++z)
            for (std::size_t y = 1; y + 1 < g.size[1]; ++y)
                for (std::size_t x = 1; x + 1 < g.size[0]; ++x, ++from)
                    use(out[z * g.step[2] + y * g.step[1] + x], majorants[from]);
    };
    for_blocks([](float& distance, float majorant) {
        if (majorant > 0) distance = 0;
    });
    Buffer<float> lines;
    const std::uint64_t longest = g.longest();
    PILEUS_TRY(lines.resize(longest * std::uint64_t(threads), "path blocks: lines"));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
        parallel_for(threads, std::int64_t(g.size[v]), [&](std::int64_t j, int thread) {
            for (std::size_t i = 0; i < g.size[u]; ++i)
                spread(
                    out.data(),
                    {i * g.step[u] + std::size_t(j) * g.step[v], g.step[axis], int(g.size[axis])},
                    lines.data() + longest * std::uint64_t(thread));
        });
    }
    // The ring may be leapt over, but not stood in.
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::size_t x = i % g.size[0], y = i / g.step[1] % g.size[1], z = i / g.step[2];
        const bool ring = x == 0 || y == 0 || z == 0 || x + 1 == g.size[0] || y + 1 == g.size[1] ||
                          z + 1 == g.size[2];
        out[i] = ring ? kBoundOut : 1.0f - out[i];
    }
    for_blocks([](float& bound, float majorant) {
        if (majorant > 0) bound = majorant;
    });
    return Status::ok();
}

}  // namespace pileus
