// SPDX-License-Identifier: Apache-2.0
// Numbers and results of a study in words, shared by its tables and its page.
// in: results -> out: short plain texts.
// docs/study.md, "Output"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/study/study_report.h"

namespace pileus {

namespace {

constexpr const char* kUnknownText = "-";

std::string curve_title(const Study& study, int curve) {
    return study.curves[std::size_t(curve)].title;
}

std::string joined(const std::vector<std::string>& words, const char* between = ", ") {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
    return text.empty() ? "none" : text;
}

}  // namespace

std::string number_short(double value) {
    if (!std::isfinite(value)) return kUnknownText;
    const double size = std::fabs(value);
    if (size > 0 && (size < 1e-3 || size >= 1e5)) return fmt::format("{:.2e}", value);
    return fmt::format("{:.3g}", value);
}

std::string seconds_text(double seconds) {
    if (!std::isfinite(seconds)) return kUnknownText;
    if (seconds < 120) return fmt::format("{:.3g} s", seconds);
    if (seconds < 7200) return fmt::format("{:.3g} min", seconds / 60);
    return fmt::format("{:.3g} h", seconds / 3600);
}

std::string error_text(double value, double error) {
    if (!std::isfinite(value)) return kUnknownText;
    if (!std::isfinite(error)) return number_short(value);
    return number_short(value) + " ± " + fmt::format("{:.1e}", error);
}

std::string target_text(const TimeTo& time, const FloorFit& fit) {
    switch (time.kind) {
        case TimeKind::kInterpolated:
            return seconds_text(time.time_s);
        case TimeKind::kAtMost:
            return "at most " + seconds_text(time.time_s);
        case TimeKind::kExtrapolated:
            return "about " + seconds_text(time.time_s) + " (extrapolated)";
        case TimeKind::kNever:
            return "never: floor " + number_short(time.floor);
        case TimeKind::kDoubtful:
            return "not known: floor " + error_text(fit.floor, fit.floor_error);
        case TimeKind::kUnknown:
            break;
    }
    return kUnknownText;
}

std::string floor_text(const FloorFit& fit) {
    if (!fit.known) return kUnknownText;
    // What lies within two standard errors of nothing is only an upper bound.
    if (!fit.found())
        return "none found, below " + fmt::format("{:.0e}", fit.floor + 2 * fit.floor_error);
    return error_text(fit.floor, fit.floor_error);
}

std::string reference_text(const SceneResult& scene) {
    const double cpu = scene.half[0].cpu_s + scene.half[1].cpu_s;
    return fmt::format(
        "two independent halves, {} of CPU time together{}; its own noise is relMSE {}, taken off "
        "all errors; what is left of it in a figure is {} (one standard error); {} pixels of "
        "cloud, mean radiance {}",
        seconds_text(cpu),
        scene.half[0].earlier && scene.half[1].earlier ? " (made by an earlier run)" : "",
        number_short(scene.reference.noise), number_short(scene.reference.resolution),
        scene.reference.cloud_pixels, number_short(scene.reference.mean));
}

std::vector<std::string> advice_lines(const Study& study, const SceneResult& scene) {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < scene.advice.size(); ++i) {
        const Advice& one = scene.advice[i];
        const bool last = i + 1 == scene.advice.size();
        const std::string when =
            "From " + seconds_text(one.from_s) + (last ? " on" : " to " + seconds_text(one.to_s));
        lines.push_back(fmt::format("{}: {} (relMSE {} to {}).", when,
                                    curve_title(study, one.curve), number_short(one.error_from),
                                    number_short(one.error_to)));
    }
    if (lines.empty()) lines.push_back("Nothing here comes below relMSE 0.25.");
    std::vector<std::string> beaten;
    for (const CurveResult& curve : scene.curves) {
        bool chosen = false;
        for (const Advice& one : scene.advice) chosen |= one.curve == curve.curve;
        if (!chosen) beaten.push_back(curve_title(study, curve.curve));
    }
    if (!scene.advice.empty() && !beaten.empty())
        lines.push_back(
            "At every time something else here is better than: " + joined(beaten, "; ") + ".");
    return lines;
}

std::vector<std::string> made_lines(const Study& study, const StudyResult& result) {
    const StudyMachine& m = result.machine;
    std::vector<std::string> lines;
    lines.push_back(fmt::format("Program: pileus {}, built by {}; instruction set {}.", m.version,
                                m.compiler, m.isa.empty() ? "unknown" : m.isa));
    lines.push_back(fmt::format(
        "Machine: {}, {} processors; every run had {} threads, and runs "
        "followed one another.",
        m.processor.empty() ? "unknown processor" : m.processor, m.processors, m.threads));
    lines.push_back(fmt::format(
        "Seeds {} to {}; times are medians over them: the whole process, from its start to the "
        "written picture.",
        study.first_seed, study.first_seed + study.seeds - 1));
    lines.push_back(fmt::format(
        "All runs together: {} of CPU time, {} of wall time. References: {} of CPU time, {} of "
        "wall time ({}; seeds {} and {}).",
        seconds_text(result.runs_cpu_s), seconds_text(result.runs_wall_s),
        seconds_text(result.references_cpu_s), seconds_text(result.references_wall_s),
        joined(study.reference.sets), study.reference.first_seed, study.reference.first_seed + 1));
    return lines;
}

Plot scene_plot(const Study& study, const SceneResult& scene) {
    Plot plot;
    plot.title = study.scenes[std::size_t(scene.scene)].title;
    plot.x_label = "CPU time, seconds";
    plot.y_label = "relMSE";
    plot.level = scene.reference.noise;
    plot.level_label = "noise of the reference";
    plot.mark_label = "on the Pareto front";
    for (const CurveResult& curve : scene.curves) {
        PlotSeries series;
        series.label = curve_title(study, curve.curve);
        // A floor that is not told apart from none is not drawn.
        if (curve.fit.found()) series.floor = curve.fit.floor;
        for (const StudyPoint& point : curve.points) {
            const double half =
                point.seeds > 1 ? student_95(point.seeds - 1) * point.error.relmse_error : 0;
            series.points.push_back({point.cpu_s, point.error.relmse, point.error.relmse - half,
                                     point.error.relmse + half, point.pareto});
        }
        std::sort(series.points.begin(), series.points.end(),
                  [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
        plot.series.push_back(std::move(series));
    }
    return plot;
}

std::string base64(const char* bytes, std::size_t count) {
    static constexpr char kLetters[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((count + 2) / 3 * 4);
    for (std::size_t i = 0; i < count; i += 3) {
        std::uint32_t three = 0;
        for (std::size_t j = 0; j < 3; ++j)
            three = three << 8 | (i + j < count ? static_cast<std::uint8_t>(bytes[i + j]) : 0u);
        for (std::size_t j = 0; j < 4; ++j)
            text += i + j > count ? '=' : kLetters[three >> (18 - 6 * j) & 63];
    }
    return text;
}

}  // namespace pileus
