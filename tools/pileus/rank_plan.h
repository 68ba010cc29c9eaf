// SPDX-License-Identifier: Apache-2.0
// What several ranks would hold, send and take, by a stated model.
// in: a plan with its foretold time -> out: a row for each number of ranks. docs/scaling.md
#pragma once
#include <string>
#include <vector>

#include "src/plan/part_light.h"
#include "src/plan/plan.h"

namespace pileus {

/// Of the network: one message takes latency_s + bytes / bytes_per_s.
struct RankLink {
    double latency_s = 2e-6, bytes_per_s = 10e9;
};

struct RankCost {
    int ranks = 1;
    std::uint64_t held = 0;  ///< bytes of each rank but rank 0, which holds what one process does
    std::uint64_t sent = 0;  ///< bytes that come to rank 0, or are added up on their way
    double seconds = 0;      ///< of the first frame
    double efficiency = 1;   ///< time of one process over ranks * seconds
};

/// For 1, 2, 4, ... ranks up to `most`, and that. T(N) = rest + divided / N + link(N): whole
/// numbers are added in log2 N steps of latency and 2 (N - 1) / N of their bytes, rows arrive one
/// after the other.
std::vector<RankCost> rank_costs(const Plan& plan, Division division, const RankLink& link,
                                 int most);

/// "LATENCY_US,GB_PER_S".
Status read_link(const std::string& text, RankLink& link);

std::string rank_lines(const std::vector<RankCost>& costs, const RankLink& link);
std::string rank_json(const std::vector<RankCost>& costs);

}  // namespace pileus
