// SPDX-License-Identifier: Apache-2.0
// What will run, what is left out and why, how much memory each array takes.
// in: a checked scene -> out: lists for people and for the report; the proof of the sums' bounds.
// docs/architecture.md, "Memory and errors"; docs/methods.md 2 "Accumulation".
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace pileus {

struct PlanItem {
    std::string name;
    std::uint64_t bytes = 0;
};
struct LeftOut {
    std::string what, why;
};

struct Plan {
    std::vector<std::string> needed;
    std::vector<LeftOut> left_out;
    std::vector<PlanItem> items;

    void need(const char* what) { needed.emplace_back(what); }
    void leave_out(const char* what, const char* why) { left_out.push_back({what, why}); }
    void take(const char* name, std::uint64_t bytes) { items.push_back({name, bytes}); }
    std::uint64_t total_bytes() const {
        std::uint64_t total = 0;
        for (const PlanItem& item : items) total += item.bytes;
        return total;
    }
};

/// Binary places of the fixed-point sums: the largest s <= 30 for which one deposit fits 31 bits
/// and `deposits` deposits of at most `largest` fit 62. Negative: no s >= 8 does, so refuse.
int fixed_point_places(double deposits, double largest);

}  // namespace pileus
