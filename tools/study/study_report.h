// SPDX-License-Identifier: Apache-2.0
// The results of a study as files: numbers, tables, plots, and one page that holds them all.
// in: StudyResult, pictures on the disk -> out: study.json, study.md, plots/, index.html.
// docs/study.md, "Output"
#pragma once
#include <string>
#include <vector>

#include "tools/study/plot.h"
#include "tools/study/study_analysis.h"

namespace pileus {

/// Writes all of the files below into the study's folder. Errors: kIo, kLimit. Without a PNG
/// library there are no .png files and no pictures on the page.
Status write_study(const Study& study, const StudyOptions& options, const StudyResult& result);

/// All numbers, UTF-8, two spaces a level; what is not known is null.
std::string study_json(const Study& study, const StudyResult& result);

/// Tables of all scenes as Markdown, with the plots by name.
std::string study_markdown(const Study& study, const StudyResult& result);

/// The page; `pictures[i]` are those of result.scenes[i].
struct PictureRow {
    std::string title, note;
    std::string picture, difference, flip;  ///< data URIs; empty: none
};
struct ScenePictures {
    std::string reference;
    std::vector<PictureRow> rows;
    std::string note;  ///< how to read the colours
};
std::string study_page(const Study& study, const StudyResult& result,
                       const std::vector<ScenePictures>& pictures);

/// Pictures of a scene as data URIs of PNG: the reference and, for each curve's dearest budget,
/// picture, signed difference and FLIP map; all at the exposure measured on the reference.
Status scene_pictures(const Study& study, const SceneResult& scene, ScenePictures& pictures);

/// Error against CPU time of one scene.
Plot scene_plot(const Study& study, const SceneResult& scene);

// Words that the Markdown and the page share.
std::string seconds_text(double seconds);            ///< "0.42 s", "3.1 min"
std::string number_short(double value);              ///< three digits, "-" where not known
std::string error_text(double value, double error);  ///< "0.0012 ± 0.0003"
std::string target_text(const TimeTo& time, const FloorFit& fit);  ///< with how it was found
std::string floor_text(const FloorFit& fit);
std::string reference_text(const SceneResult& scene);  ///< how made, its noise, its time
std::vector<std::string> advice_lines(const Study& study, const SceneResult& scene);
std::vector<std::string> made_lines(const Study& study, const StudyResult& result);

/// Base64 (RFC 4648, section 4), with padding.
std::string base64(const char* bytes, std::size_t count);

}  // namespace pileus
