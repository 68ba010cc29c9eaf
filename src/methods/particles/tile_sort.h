// SPDX-License-Identifier: Apache-2.0
// Sorts balls into tiles, on several threads, in two passes.
// in: for each ball the tiles that it touches -> out: the balls of each tile, one behind the other.
// docs/particles.md, "Light", "Display".
#pragma once
#include "platform/threads.h"
#include "src/base/buffer.h"
#include "src/run/context.h"

namespace pileus {

/// Runs of balls that are sorted side by side; their number changes no bit.
constexpr std::uint32_t kTileRuns = 8;

/// Sorts numbers below `things` into boxes: each(number, put) calls put(box). Numbers of a box keep
/// their order; those of box i are out[begin[i]] to out[begin[i + 1]]. More than `most` in all do
/// not fit: `out` stays as it is.
template <class Each>
Status sort_into(const Context& context, std::size_t things, std::uint32_t boxes,
                 Buffer<std::uint64_t>& begin, std::uint64_t most, bool& fits,
                 Buffer<std::uint32_t>& out, Each each) {
    Buffer<std::uint64_t> next;
    PILEUS_TRY(next.resize(std::uint64_t(kTileRuns) * boxes, "tiles"));
    PILEUS_TRY(begin.resize(std::uint64_t(boxes) + 1, "tiles"));
    const auto run = [&](auto put) {
        parallel_for(context.threads, kTileRuns, [&](std::int64_t r, int) {
            std::uint64_t* own = next.data() + std::uint64_t(r) * boxes;
            const std::size_t from = things * std::size_t(r) / kTileRuns;
            const std::size_t to = things * std::size_t(r + 1) / kTileRuns;
            for (std::size_t i = from; i < to; ++i)
                each(i, [&](std::uint32_t box) { put(own[box], std::uint32_t(i)); });
        });
    };
    run([](std::uint64_t& n, std::uint32_t) { ++n; });
    std::uint64_t sum = 0;
    for (std::uint32_t box = 0; box < boxes; ++box) {
        begin[box] = sum;
        for (std::uint32_t r = 0; r < kTileRuns; ++r) {
            std::uint64_t& n = next[std::uint64_t(r) * boxes + box];
            const std::uint64_t own = n;
            n = sum;
            sum += own;
        }
    }
    begin[boxes] = sum;
    fits = sum <= most;
    if (!fits) return Status::ok();
    if (out.size() < sum) PILEUS_TRY(out.resize(sum, "tiles"));
    run([&](std::uint64_t& n, std::uint32_t i) { out[n++] = i; });
    return Status::ok();
}

}  // namespace pileus
