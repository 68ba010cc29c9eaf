// SPDX-License-Identifier: Apache-2.0
// See stop_rule.h.
#include "src/session/stop_rule.h"

#include <algorithm>

namespace pileus {
namespace {

constexpr double kPassSeconds = 0.5;  // between two looks at the clock, the error and the user

std::uint64_t look_after(const LightGoal& goal, std::uint64_t at) {
    return at + (goal.doubles ? at : at / 4);
}

/// Units that take about `wanted_s`, at most twice the last ones.
std::uint64_t fitting(const LightPass& last, double wanted_s) {
    const double twice = 2 * double(last.units);
    const double fit = last.seconds > 0 ? wanted_s / (last.seconds / double(last.units)) : twice;
    return fit < twice ? std::max(std::uint64_t(fit), std::uint64_t{1}) : 2 * last.units;
}

}  // namespace

bool StopRule::is_look(std::uint64_t units) const {
    std::uint64_t at = goal_.first_look;
    while (at < units) at = look_after(goal_, at);
    return at == units;
}

std::uint64_t StopRule::next_look(std::uint64_t units) const {
    std::uint64_t at = goal_.first_look;
    while (at <= units) at = look_after(goal_, at);
    return at;
}

bool StopRule::wants_error(const LightUnits& light) const {
    return goal_.error > 0 && is_look(light.held) && (goal_.doubles || light.held < goal_.most);
}

bool StopRule::met(const LightUnits& light, double error) const {
    if (light.held >= goal_.most) return true;
    if (!wants_error(light)) return false;
    // Doubled once more it would be over the most.
    return error <= goal_.error || (goal_.doubles && next_look(light.held) > goal_.most);
}

std::uint64_t StopRule::next(const LightUnits& light, double spent_s, const LightPass& last) const {
    const double left_s = goal_.seconds - spent_s;
    const double each_s = last.units > 0 ? last.seconds / double(last.units) : 0;
    if (goal_.seconds > 0 && light.held > 0 && left_s <= goal_.early * each_s) return 0;
    if (!light.in_passes) return 1;
    std::uint64_t units = 1;
    if (last.units > 0)
        units = fitting(last, goal_.seconds > 0 ? std::min(left_s, kPassSeconds) : kPassSeconds);
    if (goal_.error > 0) units = std::min(units, next_look(light.held) - light.held);
    return std::min(units, goal_.most - light.held);
}

double StopRule::share_done(const LightUnits& light, double spent_s) const {
    const double units = double(light.held) / double(goal_.most);
    return goal_.seconds > 0 ? std::max(units, spent_s / goal_.seconds) : units;
}

}  // namespace pileus
