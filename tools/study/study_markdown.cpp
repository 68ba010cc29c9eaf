// SPDX-License-Identifier: Apache-2.0
// The tables of a study as Markdown.
// in: StudyResult -> out: text; plots are named, not held.
// docs/study.md, "Output"
#include <fmt/format.h>

#include "tools/study/study_report.h"

namespace pileus {

namespace {

/// A cell must not end its row.
std::string cell(const std::string& text) {
    std::string out;
    for (const char c : text) out += c == '|' ? '/' : c;
    return out;
}

std::string curve_rows(const Study& study, const SceneResult& scene) {
    std::string text = fmt::format(
        "| method | slope | bias floor of the fit | bias^2 at the dearest | 1/(relMSE t), best | "
        "to relMSE {} | to relMSE {} |\n|---|---|---|---|---|---|---|\n",
        number_short(study.targets[0]), number_short(study.targets[1]));
    for (const CurveResult& curve : scene.curves) {
        const StudyPoint& last = curve.points.back();
        text +=
            fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n",
                        cell(study.curves[std::size_t(curve.curve)].title),
                        curve.slope.known ? fmt::format("{:.2f}", curve.slope.slope) : "-",
                        floor_text(curve.fit), error_text(last.error.bias2, last.error.bias2_error),
                        number_short(curve.merit), target_text(curve.to_target[0], curve.fit),
                        target_text(curve.to_target[1], curve.fit));
    }
    return text;
}

std::string point_rows(const Study& study, const SceneResult& scene) {
    std::string text =
        "| method | budget | CPU s | wall s | MiB | relMSE | bias^2 | noise | mean bias | FLIP | "
        "front |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const CurveResult& curve : scene.curves)
        for (const StudyPoint& p : curve.points)
            text += fmt::format(
                "| {} | {} | {} | {} | {:.0f} | {} | {} | {} | {:+.2f} % | {} | {} |\n",
                cell(study.curves[std::size_t(curve.curve)].title), cell(p.budget_text),
                number_short(p.cpu_s), number_short(p.wall_s), p.peak_bytes / (1 << 20),
                error_text(p.error.relmse, p.error.relmse_error),
                error_text(p.error.bias2, p.error.bias2_error), number_short(p.error.noise),
                100 * p.error.mean_bias, number_short(p.flip_mean), p.pareto ? "yes" : "");
    return text;
}

std::string scene_text(const Study& study, const SceneResult& scene) {
    const StudyScene& of = study.scenes[std::size_t(scene.scene)];
    std::string text = fmt::format("\n## {}\n\n", cell(of.title));
    if (!scene.fault.empty()) return text + "No result: " + scene.fault + ".\n";
    text += fmt::format("![{}](plots/{}.png)\n\n", of.title, of.name);
    for (const std::string& line : advice_lines(study, scene)) text += "- " + line + "\n";
    text += fmt::format("\nReference ({} for each half): {}.\n\n", of.reference_budget,
                        reference_text(scene));
    return text + curve_rows(study, scene) + "\n" + point_rows(study, scene);
}

}  // namespace

std::string study_markdown(const Study& study, const StudyResult& result) {
    std::string text = fmt::format("# {}\n\n", study.title);
    for (const std::string& line : made_lines(study, result)) text += line + "\n";
    text +=
        "\nrelMSE is the mean over the cloud's pixels (alpha of the reference above 0.02) and the "
        "three colours of (a - r)^2/(r^2 + eps), eps = (0.01 mean r)^2. relMSE = bias^2 + noise: "
        "bias^2 is what the mean over all seeds would keep, noise is the variance of one picture. "
        "± is one standard error over the seeds. Times are CPU seconds.\n";
    for (const std::string& fault : result.faults) text += "\nNote: " + fault + "\n";
    for (const SceneResult& scene : result.scenes) text += scene_text(study, scene);
    return text;
}

}  // namespace pileus
