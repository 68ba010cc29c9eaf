// SPDX-License-Identifier: Apache-2.0
// See accumulation.h.
// in: sizes -> out: a choice and a sentence.
// docs/collectors.md, "Accumulation".
#include "src/plan/accumulation.h"

#include "src/plan/memory_table.h"

namespace pileus {
namespace {

/// What private sums may take.
std::uint64_t allowed_bytes(const AccumulationSizes& s) {
    const std::uint64_t share = s.limit / 4, left = s.limit > s.others ? s.limit - s.others : 0;
    return share < left ? share : left;
}

}  // namespace

Accumulation plan_accumulation(AccumulationChoice choice, const AccumulationSizes& sizes) {
    if (sizes.threads <= 1) return {"direct", "one thread adds to the total itself", 0, false};
    if (choice == AccumulationChoice::kShared) return {"shared", "the scene asks for it", 0, true};
    const std::uint64_t needs = bytes_of(sizes.set, sizes.threads), allowed = allowed_bytes(sizes);
    if (choice == AccumulationChoice::kPrivate)
        return {"private", "the scene asks for it", needs, false};
    const std::string why = std::to_string(sizes.threads) + " threads' own sums take " +
                            (sizes.exact ? "" : "at most ") + std::to_string(needs) + " bytes of " +
                            std::to_string(allowed) + " that they may";
    if (needs <= allowed) return {"private", why, needs, false};
    if (sizes.exact) return {"shared", why, 0, true};
    return {"private", why + ": shared, should they take more", allowed, false};
}

}  // namespace pileus
