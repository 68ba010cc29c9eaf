// SPDX-License-Identifier: Apache-2.0
// See budget.h.
#include "src/plan/budget.h"

#include <fmt/format.h>

namespace pileus {

std::string budget_text(const Budget& budget) {
    std::string text;
    const auto add = [&](const char* name, bool given, const std::string& number) {
        if (given) text += (text.empty() ? "" : " ") + std::string(name) + "=" + number;
    };
    const auto whole = [](std::int64_t n) { return std::to_string(n); };
    const auto number = [](double n) { return fmt::format("{}", n); };
    add("photons", budget.photons >= 0, whole(budget.photons));
    add("generations", budget.generations > 0, whole(budget.generations));
    add("samples", budget.samples > 0, whole(budget.samples));
    add("steps", budget.steps >= 0, whole(budget.steps));
    add("error", budget.error > 0, number(budget.error));
    add("seconds", budget.seconds > 0, number(budget.seconds));
    return text;
}

}  // namespace pileus
