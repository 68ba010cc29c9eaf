// SPDX-License-Identifier: Apache-2.0
// See run_context.h: budgets as the report tells them.
#include <fmt/format.h>

#include "src/session/run_context.h"

namespace pileus {

std::string budget_text(const RenderOptions& options) {
    std::string text;
    const auto add = [&](const char* name, bool given, const std::string& number) {
        if (given) text += (text.empty() ? "" : " ") + std::string(name) + "=" + number;
    };
    const auto whole = [](std::int64_t n) { return std::to_string(n); };
    const auto number = [](double n) { return fmt::format("{}", n); };
    add("photons", options.budget_photons >= 0, whole(options.budget_photons));
    add("generations", options.budget_generations > 0, whole(options.budget_generations));
    add("samples", options.budget_samples > 0, whole(options.budget_samples));
    add("steps", options.budget_steps >= 0, whole(options.budget_steps));
    add("error", options.budget_error > 0, number(options.budget_error));
    add("seconds", options.budget_seconds > 0, number(options.budget_seconds));
    return text;
}

}  // namespace pileus
