// SPDX-License-Identifier: Apache-2.0
// See work_share.h.
#include "src/run/work_share.h"

#include "kernels_cpu/core/camera.h"

namespace pileus {

std::vector<PartRange> owned_runs(std::uint64_t count, std::uint64_t width, const WorkPart& part) {
    const std::uint64_t band = std::uint64_t(kPartRows) * width;
    if (part.count == 1 || width == 0 || count < 2 * band * part.count)
        return {part_range(count, part)};
    std::vector<PartRange> runs;
    // A part beyond the last has none.
    for (std::uint64_t at = part.index * band; part.index < part.count && at < count;
         at += part.count * band)
        runs.push_back({at, at + band < count ? at + band : count});
    return runs;
}

}  // namespace pileus
