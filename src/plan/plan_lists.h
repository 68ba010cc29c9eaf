// SPDX-License-Identifier: Apache-2.0
// Lists of a plan for people: a flight, which has no people, is compiled with a header in place of
// this. in: what methods note -> out: what runs, what does not and why. docs/report.md, "Plan"
#pragma once
#include <string>
#include <vector>

namespace pileus {

struct LeftOut {
    std::string what, why;
};

struct PlanLists {
    std::vector<std::string> needed;
    std::vector<LeftOut> left_out;

    void need(const char* what) { needed.emplace_back(what); }
    void leave_out(const char* what, const char* why) { left_out.push_back({what, why}); }
};

}  // namespace pileus
