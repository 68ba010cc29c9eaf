// SPDX-License-Identifier: Apache-2.0
// Writes the files of a study, each complete or not at all.
// in: StudyResult -> out: study.json, study.md, plots/, index.html.
// docs/study.md, "Output"
#include "src/base/file.h"
#include "src/io/images/image_file.h"
#include "tools/study/study_report.h"

namespace pileus {

namespace {

Status write_text(const std::string& path, const std::string& text) {
    return write_file(path, {text.data(), text.size()});
}

bool has_png() { return bool(can_write_image("plot.png")); }

Status write_plots(const Study& study, const StudyOptions& options, const SceneResult& scene) {
    if (!scene.fault.empty()) return Status::ok();
    const std::string stem =
        options.folder + "/plots/" + study.scenes[std::size_t(scene.scene)].name;
    return write_drawing(stem, draw_plot(scene_plot(study, scene)));
}

}  // namespace

Status write_study(const Study& study, const StudyOptions& options, const StudyResult& result) {
    std::vector<ScenePictures> pictures(result.scenes.size());
    for (std::size_t i = 0; i < result.scenes.size(); ++i) {
        PILEUS_TRY(write_plots(study, options, result.scenes[i]));
        if (has_png()) PILEUS_TRY(scene_pictures(study, result.scenes[i], pictures[i]));
    }
    PILEUS_TRY(write_text(options.folder + "/study.json", study_json(study, result)));
    PILEUS_TRY(write_text(options.folder + "/study.md", study_markdown(study, result)));
    return write_text(options.folder + "/index.html", study_page(study, result, pictures));
}

}  // namespace pileus
