// SPDX-License-Identifier: Apache-2.0
// A Welch comparison in words and as JSON.
// in: WelchResult -> out: text.
// docs/crosscheck.md, "Welch tests"
#define JSON_NOEXCEPTION 1
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "lab/compare/welch.h"

namespace pileus {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kChannels[3] = {"R", "G", "B"};

}  // namespace

std::string welch_lines(const std::string& a, const std::string& b, const WelchResult& r) {
    std::string text = fmt::format("{} against {}\n{} blocks, at least {} and {} passes\n", a, b,
                                   r.blocks, r.passes_a, r.passes_b);
    text += "whole picture          mean       against          z          p  detectable bias\n";
    for (int c = 0; c < 3; ++c) {
        const WelchPicture& p = r.picture[c];
        text += fmt::format("  {:<12} {:>12.6g}  {:>12.6g}  {:>9.3f}  {:>9.3g}  {:>14.3f} %\n",
                            kChannels[c], p.mean_a, p.mean_b, p.z, p.p, 100 * p.detectable);
    }
    const std::size_t idle = 3 * r.blocks - r.tested;
    if (idle > 0)
        text +=
            fmt::format("{} of {} blocks and channels have one value in both, and are no test\n",
                        idle, 3 * r.blocks);
    text += "blocks            mean z^2  p (chi-square, if blocks are independent)\n";
    for (int c = 0; c < 3; ++c)
        text += fmt::format("  {:<12} {:>11.3f}  {:.3g}\n", kChannels[c], r.mean_z_square[c],
                            r.chi_square_p[c]);
    text += fmt::format("  |z| above 2 and 3: {:.4f} and {:.4f} (normal: 0.0455 and 0.0027)\n",
                        r.above_2, r.above_3);
    text += fmt::format("  largest z {:.3f} in block ({}, {}) {}: p {:.3g}, by Holm {:.3g}\n",
                        r.largest_z, r.largest_x, r.largest_y, kChannels[r.largest_channel],
                        r.smallest_p, r.adjusted_p);
    text +=
        fmt::format("  detectable bias of a block, median {:.3g} %\n", 100 * r.detectable_block);
    return text + fmt::format("{} at significance {:g}; rejected blocks and channels: {}\n",
                              r.differ ? "the means differ" : "no difference found", r.significance,
                              r.rejected);
}

std::string welch_json(const std::string& a, const std::string& b, const WelchResult& r) {
    Json channels = Json::object();
    for (int c = 0; c < 3; ++c) {
        const WelchPicture& p = r.picture[c];
        channels[kChannels[c]] = {{"mean", p.mean_a},
                                  {"mean_against", p.mean_b},
                                  {"z", p.z},
                                  {"p", p.p},
                                  {"detectable_bias", p.detectable},
                                  {"blocks_mean_z_square", r.mean_z_square[c]},
                                  {"blocks_chi_square_p", r.chi_square_p[c]}};
    }
    const Json json = {{"a", a},
                       {"against", b},
                       {"blocks", r.blocks},
                       {"tested", r.tested},
                       {"passes", {r.passes_a, r.passes_b}},
                       {"significance", r.significance},
                       {"channels", channels},
                       {"largest_z", r.largest_z},
                       {"largest_at", {r.largest_x, r.largest_y}},
                       {"largest_channel", kChannels[r.largest_channel]},
                       {"smallest_p", r.smallest_p},
                       {"adjusted_p", r.adjusted_p},
                       {"rejected", r.rejected},
                       {"share_above_2", r.above_2},
                       {"share_above_3", r.above_3},
                       {"detectable_bias_of_a_block", r.detectable_block},
                       {"differ", r.differ}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace pileus
