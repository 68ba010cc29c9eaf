// SPDX-License-Identifier: Apache-2.0
// See rank_plan.h.
#include "tools/pileus/rank_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/pileus/command.h"
#include "tools/pileus/option_text.h"

namespace pileus {
namespace {

/// Bytes of the plan's arrays of this name.
std::uint64_t bytes_of_item(const Plan& plan, const char* item) {
    std::uint64_t bytes = 0;
    for (const MemoryRow& row : plan.memory.rows())
        if (row.item == item) bytes += row.bytes;
    return bytes;
}

const char* divided_item(Division division) {
    return division == Division::kPhotons ? "photon map"
           : division == Division::kPaths ? "film"
                                          : "picture planes";
}

}  // namespace

std::vector<RankCost> rank_costs(const Plan& plan, Division division, const RankLink& link,
                                 int most) {
    std::vector<RankCost> out;
    const std::uint64_t bytes = bytes_of_item(plan, divided_item(division));
    const bool added = division == Division::kPhotons;
    const ForetoldTime& time = plan.foretold;
    const double rest = std::max(time.first_s - time.divided_s, 0.0);
    for (int n = 1;; n = std::min(2 * n, most)) {
        RankCost cost;
        cost.ranks = n;
        const double others = double(n - 1) / n;
        cost.held = plan.memory.peak();
        // Rows of others are not held; sums are, by all.
        if (!added) cost.held -= std::min(cost.held, std::uint64_t(double(bytes) * others));
        cost.sent = n == 1 ? 0 : std::uint64_t(double(bytes) * (added ? 2 : 1) * others);
        const double messages = added ? std::ceil(std::log2(double(n))) : double(n - 1);
        const double wire = messages * link.latency_s + double(cost.sent) / link.bytes_per_s;
        cost.seconds = rest + time.divided_s / n + wire;
        if (cost.seconds > 0) cost.efficiency = time.first_s / (n * cost.seconds);
        out.push_back(cost);
        if (n >= most) return out;
    }
}

Status read_link(const std::string& text, RankLink& link) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos)
        return Status::bad_input("--link: \"" + text + "\", allowed: LATENCY_US,GB_PER_S");
    double us = 0, gb = 0;
    PILEUS_TRY(read_number("--link LATENCY_US", text.substr(0, comma), 0, 1e6, us));
    PILEUS_TRY(read_number("--link GB_PER_S", text.substr(comma + 1), 1e-6, 1e6, gb));
    link = {us * 1e-6, gb * 1e9};
    return Status::ok();
}

std::string rank_lines(const std::vector<RankCost>& costs, const RankLink& link) {
    std::string text = fmt::format(
        "ranks, where a message takes {:g} us and {:g} GB/s\n"
        "  {:>6} {:>12} {:>12} {:>12} {:>11}\n",
        link.latency_s * 1e6, link.bytes_per_s * 1e-9, "ranks", "each holds", "sent", "seconds",
        "efficiency");
    for (const RankCost& c : costs)
        text += fmt::format("  {:>6} {:>12} {:>12} {:>12.4g} {:>10.1f} %\n", c.ranks,
                            bytes_text(c.held), bytes_text(c.sent), c.seconds, 100 * c.efficiency);
    return text;
}

std::string rank_json(const std::vector<RankCost>& costs) {
    std::string text;
    for (const RankCost& c : costs)
        text += fmt::format(
            "{}{{\"ranks\": {}, \"held_bytes\": {}, \"sent_bytes\": {}, \"seconds\": {:.6g}, "
            "\"efficiency\": {:.6g}}}",
            text.empty() ? "" : ", ", c.ranks, c.held, c.sent, c.seconds, c.efficiency);
    return "[" + text + "]\n";
}

}  // namespace pileus
