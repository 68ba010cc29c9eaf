// SPDX-License-Identifier: Apache-2.0
// One page that holds a whole study: words, plots, tables, pictures.
// in: StudyResult, pictures as data URIs -> out: HTML that asks for no other file.
// docs/study.md, "Output"
#include <fmt/format.h>

#include "tools/study/study_report.h"

namespace pileus {

namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light; --ink: #22262e; --soft: #5c6370; --line: #e2e5ea; --paper: #f6f7f9;
  --blue: #0b4a7a; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); line-height: 1.5;
  font: 15px/1.5 "Helvetica Neue", Helvetica, Arial, "Liberation Sans", sans-serif; }
header { background: linear-gradient(#0b3a63, #2f77ad); color: #fff; padding: 38px 24px 30px; }
header > div, main { max-width: 1180px; margin: 0 auto; }
header h1 { margin: 0 0 6px; font-size: 30px; font-weight: 600; letter-spacing: .2px; }
header p { margin: 2px 0; color: #d9e8f5; }
nav { margin-top: 14px; } nav a { color: #fff; margin-right: 16px; white-space: nowrap; }
main { padding: 8px 24px 60px; }
section { background: #fff; border: 1px solid var(--line); border-radius: 8px;
  padding: 20px 24px 22px; margin: 22px 0; }
h2 { margin: 0 0 10px; font-size: 21px; font-weight: 600; color: var(--blue); }
h3 { margin: 22px 0 8px; font-size: 15px; font-weight: 600; }
p, ul { margin: 8px 0; } ul { padding-left: 20px; }
.soft, figcaption, .note { color: var(--soft); font-size: 13px; }
.advice { background: #eef5fb; border-left: 4px solid #2f77ad; padding: 8px 14px;
  border-radius: 0 6px 6px 0; margin: 10px 0 14px; }
.advice ul { margin: 4px 0; }
.plot { overflow-x: auto; } .plot svg { max-width: 100%; height: auto; display: block; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: 13px;
  font-variant-numeric: tabular-nums; }
th { text-align: left; font-weight: 600; color: var(--soft); border-bottom: 2px solid var(--line);
  padding: 6px 10px 6px 0; vertical-align: bottom; }
td { border-bottom: 1px solid var(--line); padding: 5px 10px 5px 0; white-space: nowrap; }
tr.front td:first-child::before { content: "\25CF\00a0"; color: #009e73; }
td b { font-weight: 600; }
details { margin-top: 14px; } summary { cursor: pointer; color: var(--blue); }
.rows { display: grid; grid-template-columns: repeat(4, minmax(0, 1fr)); gap: 10px 12px; }
.rows h4 { grid-column: 1 / -1; margin: 10px 0 -4px; font-size: 14px; font-weight: 600; }
.rows h4 span { font-weight: 400; color: var(--soft); font-size: 13px; margin-left: 8px; }
figure { margin: 0; } figure img { width: 100%; display: block; border-radius: 4px;
  border: 1px solid var(--line); background: #fff; }
figcaption { padding-top: 2px; }
.sw { display: inline-block; width: 11px; height: 11px; border-radius: 3px; margin-right: 7px;
  vertical-align: -1px; }
@media (max-width: 760px) { .rows { grid-template-columns: repeat(2, minmax(0, 1fr)); } }
@media print { body { background: #fff; } section { break-inside: avoid-page; } }
)";

std::string swatch(std::size_t i) {
    const PlotColour c = series_colour(i);
    return fmt::format("<span class=\"sw\" style=\"background:#{:02x}{:02x}{:02x}\"></span>", c[0],
                       c[1], c[2]);
}

std::string figure(const std::string& uri, const std::string& caption) {
    if (uri.empty()) return "";
    return fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
                       uri, escape_xml(caption), escape_xml(caption));
}

std::string list(const std::vector<std::string>& lines) {
    std::string text = "<ul>\n";
    for (const std::string& line : lines) text += "<li>" + escape_xml(line) + "</li>\n";
    return text + "</ul>\n";
}

/// "1 scene", "2 scenes".
std::string counted(std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string header(const Study& study, const StudyResult& result) {
    std::string text = fmt::format(
        "<header><div><h1>{}</h1>\n<p>{}, {}, {} for each picture. pileus {} on {}.</p>\n<nav>",
        escape_xml(study.title), counted(result.scenes.size(), "scene"),
        counted(study.curves.size(), "method"), counted(std::size_t(study.seeds), "seed"),
        escape_xml(result.machine.version),
        escape_xml(result.machine.processor.empty() ? "an unnamed processor"
                                                    : result.machine.processor));
    for (const SceneResult& scene : result.scenes) {
        const StudyScene& of = study.scenes[std::size_t(scene.scene)];
        text += fmt::format("<a href=\"#{}\">{}</a> ", of.name, escape_xml(of.title));
    }
    return text + "</nav></div></header>\n";
}

/// Scenes against methods: the time to one target.
std::string target_table(const Study& study, const StudyResult& result, std::size_t target) {
    std::string text = fmt::format(
        "<h3>CPU time to relMSE {}</h3>\n<div class=\"wide\"><table>\n<tr><th>scene</th>",
        number_short(study.targets[target]));
    for (std::size_t c = 0; c < study.curves.size(); ++c)
        text += "<th>" + swatch(c) + escape_xml(study.curves[c].title) + "</th>";
    text += "</tr>\n";
    for (const SceneResult& scene : result.scenes) {
        if (!scene.fault.empty()) continue;
        // The quickest of those that reach the target stands out.
        const TimeTo* best = nullptr;
        for (const CurveResult& curve : scene.curves) {
            const TimeTo& to = curve.to_target[target];
            if (to.time_s > 0 && (best == nullptr || to.time_s < best->time_s)) best = &to;
        }
        const StudyScene& of = study.scenes[std::size_t(scene.scene)];
        text += fmt::format("<tr><td><a href=\"#{}\">{}</a></td>", of.name, escape_xml(of.title));
        for (std::size_t c = 0; c < study.curves.size(); ++c) {
            std::string words = "-";
            bool bold = false;
            for (const CurveResult& curve : scene.curves)
                if (curve.curve == int(c)) {
                    words = escape_xml(target_text(curve.to_target[target], curve.fit));
                    bold = &curve.to_target[target] == best;
                }
            text += bold ? "<td><b>" + words + "</b></td>" : "<td>" + words + "</td>";
        }
        text += "</tr>\n";
    }
    return text + "</table></div>\n";
}

std::string summary(const Study& study, const StudyResult& result) {
    std::string text = "<section><h2>In short</h2>\n";
    text += target_table(study, result, 0) + target_table(study, result, 1);
    text +=
        "<p class=\"note\">relMSE is the mean over the cloud's pixels and the three colours of "
        "(a &minus; r)&sup2;/(r&sup2; + &epsilon;), with &epsilon; = (0.01 mean r)&sup2;: 0.01 is "
        "a typical error of 10 % in a pixel, 0.0001 one of 1 %. Bold: the quickest. Extrapolated "
        "times follow the fit relMSE = floor + c/(t &minus; t<sub>0</sub>); never: its floor lies "
        "above.</p>\n<h3>How this was made</h3>\n";
    text += list(made_lines(study, result));
    if (!result.faults.empty()) text += "<h3>Left out</h3>\n" + list(result.faults);
    return text + "</section>\n";
}

std::string curve_table(const Study& study, const SceneResult& scene) {
    std::string text = fmt::format(
        "<div class=\"wide\"><table>\n<tr><th>method</th><th>slope</th><th>bias floor of the "
        "fit</th><th>bias&sup2; at the dearest</th><th>fixed CPU time</th><th>best 1/(relMSE "
        "t)</th><th>to relMSE {}</th><th>to relMSE {}</th></tr>\n",
        number_short(study.targets[0]), number_short(study.targets[1]));
    for (const CurveResult& curve : scene.curves) {
        const ErrorSplit& last = curve.points.back().error;
        text += fmt::format(
            "<tr><td>{}{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
            "<td>{}</td></tr>\n",
            swatch(std::size_t(curve.curve)),
            escape_xml(study.curves[std::size_t(curve.curve)].title),
            curve.slope.known ? fmt::format("{:.2f}", curve.slope.slope) : "-",
            floor_text(curve.fit), error_text(last.bias2, last.bias2_error),
            curve.fit.known ? seconds_text(curve.fit.fixed_s) : "-", number_short(curve.merit),
            target_text(curve.to_target[0], curve.fit), target_text(curve.to_target[1], curve.fit));
    }
    return text + "</table></div>\n";
}

std::string point_table(const Study& study, const SceneResult& scene) {
    std::string text =
        "<details><summary>All points</summary><div class=\"wide\"><table>\n<tr><th>method</th>"
        "<th>budget</th><th>CPU</th><th>wall</th><th>memory</th><th>relMSE</th><th>bias&sup2;"
        "</th><th>noise</th><th>mean bias</th><th>RMSE</th><th>FLIP</th></tr>\n";
    for (const CurveResult& curve : scene.curves)
        for (const StudyPoint& p : curve.points)
            text += fmt::format(
                "<tr{}><td>{}{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.0f} MiB</td><td>{}"
                "</td><td>{}</td><td>{}</td><td>{:+.2f} %</td><td>{}</td><td>{}</td></tr>\n",
                p.pareto ? " class=\"front\"" : "", swatch(std::size_t(curve.curve)),
                escape_xml(study.curves[std::size_t(curve.curve)].title), escape_xml(p.budget_text),
                seconds_text(p.cpu_s), seconds_text(p.wall_s), p.peak_bytes / (1 << 20),
                error_text(p.error.relmse, p.error.relmse_error),
                error_text(p.error.bias2, p.error.bias2_error), number_short(p.error.noise),
                100 * p.error.mean_bias, number_short(p.rmse), number_short(p.flip_mean));
    return text +
           "</table></div><p class=\"note\">A green dot: on the Pareto front. relMSE = bias&sup2; "
           "+ noise. &plusmn;: one standard error over the seeds.</p></details>\n";
}

std::string picture_rows(const ScenePictures& pictures) {
    if (pictures.reference.empty()) return "";
    std::string text = "<h3>Pictures, each method at its dearest budget</h3>\n<div class=\"rows\">";
    for (const PictureRow& row : pictures.rows) {
        text += fmt::format("<h4>{}<span>{}</span></h4>\n", escape_xml(row.title),
                            escape_xml(row.note));
        text += figure(pictures.reference, "reference") + figure(row.picture, row.title) +
                figure(row.difference, "signed difference") + figure(row.flip, "HDR-FLIP");
    }
    return text + "</div>\n<p class=\"note\">" + escape_xml(pictures.note) + "</p>\n";
}

std::string scene_section(const Study& study, const SceneResult& scene,
                          const ScenePictures& pictures) {
    const StudyScene& of = study.scenes[std::size_t(scene.scene)];
    std::string text =
        fmt::format("<section id=\"{}\"><h2>{}</h2>\n", of.name, escape_xml(of.title));
    if (!scene.fault.empty())
        return text + "<p>No result: " + escape_xml(scene.fault) + ".</p></section>\n";
    text += "<div class=\"advice\">" + list(advice_lines(study, scene)) + "</div>\n";
    text += "<div class=\"plot\">" + drawing_svg(draw_plot(scene_plot(study, scene))) + "</div>\n";
    text += curve_table(study, scene) + point_table(study, scene) + picture_rows(pictures);
    return text + fmt::format(
                      "<p class=\"note\">Scene {}. Reference ({} for each half): {}.</p>"
                      "</section>\n",
                      escape_xml(of.file), escape_xml(of.reference_budget),
                      escape_xml(reference_text(scene)));
}

}  // namespace

std::string study_page(const Study& study, const StudyResult& result,
                       const std::vector<ScenePictures>& pictures) {
    std::string text = fmt::format(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
        "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n"
        "<style>{}</style>\n</head>\n<body>\n",
        escape_xml(study.title), kStyle);
    text += header(study, result) + "<main>\n" + summary(study, result);
    for (std::size_t i = 0; i < result.scenes.size(); ++i)
        text += scene_section(study, result.scenes[i],
                              i < pictures.size() ? pictures[i] : ScenePictures());
    return text + "</main>\n</body>\n</html>\n";
}

}  // namespace pileus
