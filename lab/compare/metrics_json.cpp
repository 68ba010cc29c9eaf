// SPDX-License-Identifier: Apache-2.0
// Writes the figures of a comparison under fixed names.
// in: Metrics, FlipResult -> out: JSON or lines.
// docs/compare.md, "Figures"
#define JSON_NOEXCEPTION 1
#include "lab/compare/metrics_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace pileus {

namespace {

using Json = nlohmann::ordered_json;

Json picture(const std::string& file, const std::string& said, double mean, bool error_layer) {
    return {{"file", file}, {"read_as", said}, {"mean", mean}, {"error_layer", error_layer}};
}

Json z_of(const Metrics& m) {
    if (m.z_count == 0) return nullptr;
    return {{"values", m.z_count},
            {"unknown", m.z_unknown},
            {"share_above_2", m.z_above_2},
            {"share_above_3", m.z_above_3},
            {"mean_square", m.z_square_mean}};
}

Json flip_of(const FlipResult* flip) {
    if (flip == nullptr) return nullptr;
    return {{"mean", flip->mean},       {"percentile_99", flip->percentile_99},
            {"largest", flip->largest}, {"exposures", flip->exposures},
            {"start", flip->start},     {"stop", flip->stop}};
}

std::string line(const char* name, const std::string& value) {
    return fmt::format("{:<14} {}\n", name, value);
}

std::string counted_text(const ComparisonText& text, const Metrics& m) {
    std::string how = "all of the picture";
    if (!m.has_alpha)
        how += ", for the reference has no alpha";
    else if (text.alpha_least >= 0)
        how = fmt::format("alpha of the reference above {:g}", text.alpha_least);
    std::string counted = fmt::format("{} of {} pixels of {} x {}: {}", m.cloud_pixels, m.pixels,
                                      text.width, text.height, how);
    if (m.not_finite > 0) counted += fmt::format("; {} not finite, left out", m.not_finite);
    return counted;
}

std::string relmse_lines(const ComparisonText& text, const Metrics& m) {
    std::string how = "the reference's noise is not known and still in it";
    if (m.identical)
        how = "the counted pixels are the same, their noise too";
    else if (m.has_error_reference)
        how = fmt::format("{:.5g} less {:.5g}, the reference's noise by {}", m.relmse_raw,
                          m.relmse_reference_noise, text.halves ? "two halves" : "its error layer");
    std::string lines = line("relMSE", fmt::format("{:.5g}  ({})", m.relmse, how));
    if (m.has_error_a)
        lines += line("  of it noise",
                      fmt::format("{:.5g}  (the picture's own error layer)", m.relmse_own_noise));
    return lines +
           line("  trimmed", fmt::format("{:.5g}  (without the largest 0.1 %)", m.relmse_trimmed));
}

/// Pixels that do not count, where they differ.
std::string aside_line(const ComparisonText& text, const Metrics& m) {
    if (!(m.uncounted_largest > 0) && m.uncounted_not_finite == 0) return "";
    std::string lines;
    if (m.uncounted_largest > 0)
        lines = fmt::format("largest {:.5g} at pixel {}, {}", m.uncounted_largest, m.uncounted_x,
                            m.uncounted_y);
    if (m.uncounted_not_finite > 0)
        lines += fmt::format("{}{} not finite", lines.empty() ? "" : ", ", m.uncounted_not_finite);
    return line("not counted", fmt::format("{}, where alpha is at most {:g}; --all-pixels counts "
                                           "them",
                                           lines, text.alpha_least));
}

std::string bias_line(const Metrics& m) {
    std::string text = fmt::format("{:.5g}", m.bias);
    const double share = m.bias / m.mean_reference;
    if (std::isfinite(share)) text += fmt::format(" = {:.4g} % of the mean", 100 * share);
    if (std::isfinite(m.bias_standard_error))
        text += fmt::format(", standard error {:.3g} to {:.3g}, z {:.3g} to {:.3g}",
                            m.bias_standard_error, m.bias_standard_error_most, m.bias_z_least,
                            m.bias_z);
    return line("bias", text);
}

}  // namespace

std::string metrics_json(const ComparisonText& text, const Metrics& m, const FlipResult* flip) {
    const Json json = {
        {"a", picture(text.a, text.said_a, m.mean_a, m.has_error_a)},
        {"reference",
         picture(text.reference, text.said_reference, m.mean_reference, m.has_error_reference)},
        {"halves", text.halves},
        {"width", text.width},
        {"height", text.height},
        {"pixels", m.pixels},
        {"cloud_pixels", m.cloud_pixels},
        {"not_finite", m.not_finite},
        {"identical", m.identical},
        {"alpha", m.has_alpha},
        {"alpha_least", text.alpha_least},
        {"rmse", m.rmse},
        {"relmse", m.relmse},
        {"relmse_raw", m.relmse_raw},
        {"relmse_reference_noise", m.has_error_reference ? Json(m.relmse_reference_noise) : Json()},
        {"relmse_own_noise", m.has_error_a ? Json(m.relmse_own_noise) : Json()},
        {"relmse_trimmed", m.relmse_trimmed},
        {"largest", m.largest},
        {"largest_at", {m.largest_x, m.largest_y}},
        {"uncounted_largest", m.uncounted_largest},
        {"uncounted_largest_at", {m.uncounted_x, m.uncounted_y}},
        {"uncounted_not_finite", m.uncounted_not_finite},
        {"percentile_999", m.percentile_999},
        {"relative_percentile_999", m.relative_percentile_999},
        {"bias", m.bias},
        {"bias_standard_error", m.bias_standard_error},
        {"bias_standard_error_most", m.bias_standard_error_most},
        {"bias_z", m.bias_z},
        {"bias_z_least", m.bias_z_least},
        {"z", z_of(m)},
        {"flip", flip_of(flip)}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string metrics_lines(const ComparisonText& text, const Metrics& m, const FlipResult* flip) {
    std::string lines;
    if (!text.said_a.empty()) lines += line("picture", text.a + ": " + text.said_a);
    if (!text.said_reference.empty())
        lines += line("reference", text.reference + ": " + text.said_reference);
    lines += line("compared", counted_text(text, m));
    lines += line("mean", fmt::format("{:.6g}, reference {:.6g}", m.mean_a, m.mean_reference));
    lines += relmse_lines(text, m);
    lines += line("RMSE", fmt::format("{:.5g}", m.rmse));
    lines += line("largest", fmt::format("{:.5g} at pixel {}, {}; 99.9 % below {:.5g}, relative "
                                         "{:.5g}",
                                         m.largest, m.largest_x, m.largest_y, m.percentile_999,
                                         m.relative_percentile_999));
    lines += aside_line(text, m);
    lines += bias_line(m);
    if (m.z_count > 0)
        lines += line("z", fmt::format("{:.2f} % above 2, {:.3f} % above 3, mean square {:.4g} "
                                       "(noise alone: 4.55 %, 0.270 %, 1)",
                                       100 * m.z_above_2, 100 * m.z_above_3, m.z_square_mean));
    if (m.z_unknown > 0)
        lines += line("", fmt::format("{} values differ without a standard error", m.z_unknown));
    if (flip != nullptr)
        lines += line("FLIP", fmt::format("mean {:.5g}, 99 % below {:.4g}, largest {:.4g}; {} "
                                          "exposures from {:.3g} to {:.3g} stops",
                                          flip->mean, flip->percentile_99, flip->largest,
                                          flip->exposures, flip->start, flip->stop));
    return lines;
}

}  // namespace pileus
