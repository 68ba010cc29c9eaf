// SPDX-License-Identifier: Apache-2.0
// Several processes that do one work: each traces its share, and has the sums of all afterwards.
// in: numbers of the own share -> out: those of the whole, the same bits everywhere.
// docs/farm.md. Who brings them together, MPI or files, the stages do not know.
#pragma once
#include <cstdint>
#include <vector>

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
    /// Of `values`, rows of `width` numbers, those of owned_runs are a share's own; all become
    /// known.
    virtual Status gather(Span<double> values, std::uint64_t width) = 0;
    /// What the first share says counts: times are its own.
    virtual Status decide(std::uint64_t& value) = 0;
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

/// Of `count` numbers in rows of `width` those that are a part's, in order: bands of rows in turn,
/// so that shares take alike long; of few rows one run.
std::vector<PartRange> owned_runs(std::uint64_t count, std::uint64_t width, const WorkPart& part);

}  // namespace pileus
