// SPDX-License-Identifier: Apache-2.0
// Several processes that do one work: each traces its share, and has the sums of all afterwards.
// in: numbers of the own share -> out: those of the whole, the same bits everywhere.
// docs/farm.md. Who brings them together, MPI or files, the stages do not know.
#pragma once
#include <cstdint>

#include "kernels_cpu/core/camera.h"
#include "src/base/span.h"
#include "src/base/status.h"
#include "src/plan/part_light.h"

namespace pileus {

class WorkShare {
public:
    WorkShare() = default;
    WorkShare(const WorkShare&) = delete;
    WorkShare& operator=(const WorkShare&) = delete;
    virtual ~WorkShare() = default;

    /// Which share is traced here; index = count: none.
    virtual WorkPart part() const = 0;
    /// Each number becomes the sum of all shares'.
    virtual Status sum(Span<std::int64_t> values) = 0;
    /// Of `values`, rows of `width` numbers, those of owned_run are a share's own; all become
    /// known.
    virtual Status gather(Span<double> values, std::uint64_t width) = 0;
    /// What the first share says counts: times are its own.
    virtual Status decide(std::uint64_t& value) = 0;
    /// Before the first of these calls: whether all shares are ready. One that is not would let the
    /// others wait for ever.
    virtual bool all_ready(bool own) { return own; }
};

struct PartRange {
    std::uint64_t begin, end;
};
/// Of `count` things those that are a part's, one behind the other.
inline PartRange part_range(std::uint64_t count, const WorkPart& part) {
    const auto edge = [&](std::uint64_t i) {
        // No product leaves 64 bits.
        return count / part.count * i + count % part.count * i / part.count;
    };
    if (part.index >= part.count) return {count, count};
    return {edge(part.index), edge(part.index + 1)};
}

/// Of `count` numbers in rows of `width`, the part's run that holds number `at`, or else its next
/// one; {count, count}: none. Runs are bands of rows in turn, so that shares take alike long; of
/// few rows there is one run.
inline PartRange owned_run(std::uint64_t count, std::uint64_t width, const WorkPart& part,
                           std::uint64_t at) {
    const std::uint64_t band = std::uint64_t(kPartRows) * width;
    const PartRange none{count, count};
    if (part.count == 1 || band == 0 || count < 2 * band * part.count) {
        const PartRange all = part_range(count, part);
        return at < all.end ? all : none;
    }
    if (part.index >= part.count || at >= count) return none;
    const std::uint64_t turn = at / band, of = turn % part.count;
    const std::uint64_t begin =
        (turn + (part.index + (part.index < of ? part.count : 0) - of)) * band;
    if (begin >= count) return none;
    return {begin, begin + band < count ? begin + band : count};
}

/// Calls `visit` with each run of a part, in order.
template <typename Visit>
void each_owned_run(std::uint64_t count, std::uint64_t width, const WorkPart& part,
                    const Visit& visit) {
    for (PartRange own = owned_run(count, width, part, 0); own.begin < own.end;
         own = owned_run(count, width, part, own.end))
        visit(own);
}

}  // namespace pileus
