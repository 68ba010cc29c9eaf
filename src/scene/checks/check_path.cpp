// SPDX-License-Identifier: Apache-2.0
// Paths of files that a scene reads.
// in: a text of the scene -> out: a path relative to the scene file, or absolute; faults.
// docs/scene.md, sections Media and Sky map.
#include "platform/fs_path.h"
#include "platform/path.h"
#include "src/scene/checks/check_keys.h"

namespace pileus {

bool check_path(SceneCheck& check, const Node& node, const char* key, std::string& file) {
    static constexpr std::string_view kVariable = "${PILEUS_DATA_DIR}";
    file = node.text;
    if (std::string_view(file).substr(0, kVariable.size()) == kVariable) {
        const std::string folder = environment_text("PILEUS_DATA_DIR");
        if (folder.empty()) {
            check.faults.add(node.at, key,
                             "environment variable PILEUS_DATA_DIR is not set, " +
                                 value_text(node) +
                                 ", allowed: set it to the folder that holds the data");
            return false;
        }
        // The variable counts from the working directory, not from the scene's folder.
        std::error_code error;
        const std::filesystem::path whole = std::filesystem::absolute(path_of(folder), error);
        file = (error ? folder : path_text(whole)) + node.text.substr(kVariable.size());
    }
    if (file.find("${") != std::string::npos) {
        check.faults.add(
            node.at, key,
            "unknown variable, " + value_text(node) + ", allowed: ${PILEUS_DATA_DIR} at the front");
        return false;
    }
    return true;
}

void check_picture(SceneCheck& check, const Node& node, const char* key,
                   bool (*use)(const PictureFormat&), std::string& file) {
    if (!check_path(check, node, key, file)) return;
    const PictureFormat* format = picture_format_of(file);
    if (format != nullptr && use(*format)) return;
    add_refusal(check, node, key, "unknown kind of picture", value_text(node),
                picture_extensions(use));
}

}  // namespace pileus
