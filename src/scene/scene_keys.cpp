// SPDX-License-Identifier: Apache-2.0
// Reads the key table: all rows together, their ranges in words, and the tables of docs/scene.md.
// in: rows -> out: texts for messages and documentation, conversions for the setters.
// docs/scene.md.
#include "src/scene/scene_keys.h"

namespace pileus {
namespace {

std::string bound_text(double value) {
    if (value >= 0x1p63) return "9223372036854775807";
    // Write counts in full; the shortest form of a large power of ten is the readable one.
    const bool count = value >= -1e7 && value <= 1e7 && value == double(std::int64_t(value));
    return count ? std::to_string(std::int64_t(value)) : number_text(value);
}

std::string range_text(const KeyRange& range) {
    return std::string(range.low_open ? "(" : "[") + bound_text(range.low) + ", " +
           bound_text(range.high) + (range.high_open ? ")" : "]");
}

std::string choices_text(const char* choices) {
    std::string text;
    for (std::string_view choice : split_list(choices)) {
        if (!text.empty()) text += ", ";
        text += choice;
    }
    return text;
}

/// "camera" of "camera.fov_deg", "medium.N" of "medium.N.density.size"; empty at the top.
std::string section_of(const KeyRow& row) {
    const std::string path = row.path;
    if (row.kind == KeyKind::kTable) return "other";
    if (path.compare(0, 13, "medium.N.sky.") == 0) return "medium.N.sky";
    if (path.compare(0, 9, "medium.N.") == 0) return "medium.N";
    if (path.compare(0, 8, "solid.N.") == 0) return "solid.N";
    const std::size_t dot = path.find('.');
    return dot == std::string::npos ? "" : path.substr(0, dot);
}

std::string heading_of(const std::string& section) {
    if (section.empty()) return "Top level";
    if (section == "other") return "Tables of other methods";
    if (section == "solid.N") return "`[[solid]]`";
    if (section == "medium.N.sky") return "`[[medium]]`, `sky = { ... }`";
    return section == "medium.N" ? "`[[medium]]`" : "`[" + section + "]`";
}

std::string row_markdown(const KeyRow& row) {
    const std::string fallback = row.fallback;
    std::string text = std::string("| `") + row.path + "` | ";
    text += row.kind == KeyKind::kLater ? "not in this version" : allowed_text(row);
    text += std::string(" | ") + row.unit + " | ";
    text += fallback == kRequired || fallback.empty() ? fallback : "`" + fallback + "`";
    text += std::string(" | ") + row.help;
    if (row.later != nullptr) {
        text += "; not in this version: ";
        std::string names;
        for (std::string_view name : split_list(row.later)) {
            bool now = false;
            for (std::string_view choice : split_list(row.choices)) now = now || choice == name;
            if (!now) names += (names.empty() ? "" : ", ") + std::string(name);
        }
        text += names;
    }
    return text + " |\n";
}

}  // namespace

std::vector<std::string_view> split_list(const char* list) {
    std::vector<std::string_view> parts;
    std::string_view rest = list;
    for (;;) {
        const std::size_t bar = rest.find('|');
        parts.push_back(rest.substr(0, bar));
        if (bar == std::string_view::npos) return parts;
        rest.remove_prefix(bar + 1);
    }
}

std::vector<const KeyRow*> all_scene_keys() {
    std::vector<const KeyRow*> rows;
    for (const KeyRow& row : view_keys()) rows.push_back(&row);
    for (const KeyRow& row : solid_keys()) rows.push_back(&row);
    for (const KeyRow& row : medium_keys()) rows.push_back(&row);
    for (const KeyRow& row : sky_keys()) rows.push_back(&row);
    for (const KeyRow& row : method_keys()) rows.push_back(&row);
    for (const KeyRow& row : raymarch_keys()) rows.push_back(&row);
    for (const KeyRow& row : output_keys()) rows.push_back(&row);
    return rows;
}

std::string allowed_text(const KeyRow& row) {
    const std::string range = " in " + range_text(row.range);
    switch (row.kind) {
        case KeyKind::kBool:
            return "true, false";
        case KeyKind::kInteger:
            return "whole number" + range;
        case KeyKind::kInteger2:
            return "2 whole numbers" + range;
        case KeyKind::kInteger3:
            return "3 whole numbers" + range;
        case KeyKind::kNumber:
            return "number" + range;
        case KeyKind::kNumber2:
            return "2 numbers" + range;
        case KeyKind::kNumber3:
            return "3 numbers" + range;
        case KeyKind::kColor:
            return "number or [r, g, b]" + range;
        case KeyKind::kBounds:
            return "[[x, y, z], [x, y, z]]" + range + ", first below second";
        case KeyKind::kText:
            return row.choices == nullptr ? "text" : choices_text(row.choices);
        case KeyKind::kTexts:
            return row.choices == nullptr ? "list of up to 16 texts"
                                          : "list of " + choices_text(row.choices);
        case KeyKind::kDensity:
            return "text or table";
        case KeyKind::kTable:
            return "table";
        case KeyKind::kLater:
            break;
    }
    return "nothing";
}

std::string describe_keys_markdown() {
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

std::int64_t integer_of(const Node& node) {
    return node.kind == NodeKind::kInteger ? node.integer : static_cast<std::int64_t>(node.number);
}

std::array<double, 3> number3_of(const Node& node) {
    return {number_of(node.children[0]), number_of(node.children[1]), number_of(node.children[2])};
}

std::array<double, 2> number2_of(const Node& node) {
    return {number_of(node.children[0]), number_of(node.children[1])};
}

std::array<float, 3> color_of(const Node& node) {
    std::array<float, 3> color{};
    for (std::size_t i = 0; i < 3; ++i)
        color[i] = static_cast<float>(number_of(node.is_array() ? node.children[i] : node));
    return color;
}

bool texts_hold(const Node& node, std::string_view text) {
    for (const Node& child : node.children)
        if (child.text == text) return true;
    return false;
}

}  // namespace pileus
