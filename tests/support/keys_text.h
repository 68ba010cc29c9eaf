// SPDX-License-Identifier: Apache-2.0
// Scenes and rows of keys as texts: dumps to compare, the tables of docs/scene.md.
// in: a scene; the rows -> out: lines of TOML, Markdown.
// docs/scene.md
#pragma once
#include "src/scene/checks/check_keys.h"
#include "src/scene/checks/key_words.h"
#include "src/scene/keys/all_keys.h"

namespace pileus {

/// Every value of a scene, a line `path = value` each, as TOML writes it; "nothing" where there is
/// none. Scenes with equal dumps are equal but for their text, file and directory.
inline std::string dump_scene(const Scene& scene) {
    std::string text;
    const auto add = [&](const std::string& path, const Node& value) {
        text += path + " = " + toml_text(value) + '\n';
    };
    // These tables mean something by being there.
    add("sun", node_of(scene.sun.present));
    add("sky", node_of(scene.sky.present));
    add("ground", node_of(scene.ground.present));
    add("atmosphere", node_of(scene.atmosphere.present));
    add("animation", node_of(scene.animation.present));
    for_each_key(scene, [&](const KeyRow& row, const std::string& path, const KeySource& source) {
        add(path, value_of(row, source));
    });
    return text;
}

/// "a, b" of "a|b".
inline std::string names_of(const char* choices) {
    std::string text;
    for (std::string_view choice : split_list(choices))
        text += (text.empty() ? "" : ", ") + std::string(choice);
    return text;
}

/// "camera" of "camera.fov_deg", "medium.N" of "medium.N.density.size"; empty at the top.
inline std::string section_of(const KeyRow& row) {
    const std::string path = row.path;
    if (row.kind() == KeyKind::kTable) return "other";
    for (const Span<const KeyRow> keys : {weather_keys(), particle_keys()})
        for (const KeyRow& of_file : keys)
            if (path == of_file.path) return "medium.N.density";
    if (path.compare(0, 13, "medium.N.sky.") == 0) return "medium.N.sky";
    if (path.compare(0, 16, "medium.N.detail.") == 0) return "medium.N.detail";
    if (path.compare(0, 9, "medium.N.") == 0) return "medium.N";
    if (path.compare(0, 8, "solid.N.") == 0) return "solid.N";
    if (path.compare(0, 8, "light.N.") == 0) return "light.N";
    const std::size_t dot = path.find('.');
    return dot == std::string::npos ? "" : path.substr(0, dot);
}

inline std::string heading_of(const std::string& section) {
    if (section.empty()) return "Top level";
    if (section == "other") return "Tables of other methods";
    if (section == "solid.N") return "`[[solid]]`";
    if (section == "light.N") return "`[[light]]`";
    if (section == "medium.N.sky") return "`[[medium]]`, `sky = { ... }`";
    if (section == "medium.N.detail") return "`[[medium]]`, `detail = { ... }`";
    if (section == "medium.N.density") return "`[[medium]]`, `density = { ... }` of weather data";
    return section == "medium.N" ? "`[[medium]]`" : "`[" + section + "]`";
}

inline std::string row_markdown(const KeyRow& row) {
    const std::string fallback = default_text(row);
    std::string text = std::string("| `") + row.path + "` | ";
    text += row.kind() == KeyKind::kLater ? "not in this version" : allowed_text(row);
    text += std::string(" | ") + row.unit + " | ";
    text += row.required() || fallback.empty() ? fallback : "`" + fallback + "`";
    text += " | " + meaning_of(row);
    if (row.allowed.later != nullptr)
        text += "; not in this version: " + names_of(row.allowed.later);
    return text + " |\n";
}

/// The tables of docs/scene.md as Markdown, one for each section of a scene.
inline std::string describe_keys_markdown() {
    std::string text;
    std::string last = "none";
    // Begin a table wherever a new section begins; the rows of a section are neighbours.
    for (const KeyRow* row : all_scene_keys()) {
        const std::string section = section_of(*row);
        if (section != last) {
            text += (text.empty() ? "### " : "\n### ") + heading_of(section) + "\n\n";
            text += "| key | value | unit | default | meaning |\n|---|---|---|---|---|\n";
            last = section;
        }
        text += row_markdown(*row);
    }
    return text;
}

}  // namespace pileus
