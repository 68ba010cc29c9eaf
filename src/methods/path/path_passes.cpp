// SPDX-License-Identifier: Apache-2.0
// See path_passes.h.
#include "src/methods/path/path_passes.h"

namespace pileus {
namespace {

constexpr std::uint64_t kFirstCheck = 16;
constexpr double kPassSeconds = 0.5;  // between two looks at the clock, the error and the user

std::uint64_t after(std::uint64_t at) { return at + at / 4; }

std::uint64_t smaller(std::uint64_t a, std::uint64_t b) { return a < b ? a : b; }

}  // namespace

PassRule pass_rule(const PathSettings& settings, const Budget& budget) {
    PassRule rule;
    rule.seconds = budget.seconds;
    rule.error = budget.error > 0 ? budget.error : settings.target_error;
    if (budget.samples >= 0) {
        rule.most = std::uint64_t(budget.samples);
        rule.error = budget.error;  // so many samples, whatever the scene's error
        return rule;
    }
    const bool open = rule.error > 0 || rule.seconds > 0;
    rule.most = std::uint64_t(open ? settings.max_samples_per_pixel : settings.samples_per_pixel);
    return rule;
}

bool is_check(std::uint64_t samples) {
    std::uint64_t at = kFirstCheck;
    while (at < samples) at = after(at);
    return at == samples;
}

std::uint64_t next_check(std::uint64_t samples) {
    std::uint64_t at = kFirstCheck;
    while (at <= samples) at = after(at);
    return at;
}

std::uint64_t pass_samples(const PassRule& rule, std::uint64_t film, std::uint64_t last,
                           double last_s, double left_s) {
    std::uint64_t count = 1;
    if (last > 0) {
        const double each_s = last_s > 0 ? last_s / double(last) : 0;
        const double wanted_s = rule.seconds > 0 && left_s < kPassSeconds ? left_s : kPassSeconds;
        const double fit = each_s > 0 ? wanted_s / each_s : 2 * double(last);
        count = fit < 2 * double(last) ? std::uint64_t(fit) : 2 * last;
        if (count == 0) count = 1;
    }
    if (rule.error > 0) count = smaller(count, next_check(film) - film);
    return smaller(count, rule.most - film);
}

}  // namespace pileus
