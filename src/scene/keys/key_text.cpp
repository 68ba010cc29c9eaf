// SPDX-License-Identifier: Apache-2.0
// Rows in words: what they allow, their defaults, the tables of docs/scene.md; values of fields.
// in: rows -> out: texts for messages and documentation, nodes.
// docs/scene.md.
#include "src/scene/checks/check_keys.h"
#include "src/scene/keys/all_keys.h"
#include "src/scene/media/transfer.h"
#include "src/scene/rows/density_row.h"

namespace pileus {
namespace {

std::string bound_text(double value) {
    if (value >= 0x1p63) return "9223372036854775807";
    // Write counts in full; the shortest form of a large power of ten is the readable one.
    const bool count = value >= -1e7 && value <= 1e7 && value == double(std::int64_t(value));
    return count ? std::to_string(std::int64_t(value)) : number_text(value);
}

std::string range_text(const KeyRange& range) {
    return "[" + bound_text(range.low) + ", " + bound_text(range.high) +
           (range.high_open ? ")" : "]");
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

std::string heading_of(const std::string& section) {
    if (section.empty()) return "Top level";
    if (section == "other") return "Tables of other methods";
    if (section == "solid.N") return "`[[solid]]`";
    if (section == "light.N") return "`[[light]]`";
    if (section == "medium.N.sky") return "`[[medium]]`, `sky = { ... }`";
    if (section == "medium.N.detail") return "`[[medium]]`, `detail = { ... }`";
    if (section == "medium.N.density") return "`[[medium]]`, `density = { ... }` of weather data";
    return section == "medium.N" ? "`[[medium]]`" : "`[" + section + "]`";
}

std::string row_markdown(const KeyRow& row) {
    const std::string fallback = default_text(row);
    std::string text = std::string("| `") + row.path + "` | ";
    text += row.kind() == KeyKind::kLater ? "not in this version" : allowed_text(row);
    text += std::string(" | ") + row.unit + " | ";
    text += row.required() || fallback.empty() ? fallback : "`" + fallback + "`";
    text += " | " + meaning_of(row);
    if (row.allowed.later != nullptr)
        text += "; not in this version: " + choices_text(row.allowed.later);
    return text + " |\n";
}

/// Long numbers in groups of three digits, one colour for three equal ones.
std::string short_toml(const KeyRow& row, const Node& node) {
    const auto& parts = node.children;
    if (row.kind() == KeyKind::kColor && toml_text(parts[0]) == toml_text(parts[1]) &&
        toml_text(parts[1]) == toml_text(parts[2]))
        return toml_text(parts[0]);
    std::string text = toml_text(node);
    if (node.kind == NodeKind::kInteger && text.size() > 4)
        for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, "_");
    return text;
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

int place_in(const char* list, std::string_view text) {
    int place = 0;
    for (std::string_view part : split_list(list)) {
        if (part == text) return place;
        ++place;
    }
    return -1;
}

Node value_of(const KeyRow& row, const KeySource& source) {
    if (row.field.get == nullptr) return no_value();
    const Node value = row.field.get(source);
    if (row.kind() != KeyKind::kChoice || !has_value(value)) return value;
    const std::vector<std::string_view> names = split_list(row.allowed.choices);
    const std::size_t place =
        value.kind == NodeKind::kBool ? std::size_t(value.flag) : std::size_t(value.integer);
    return place < names.size() ? node_of(std::string(names[place])) : value;
}

Node default_value(const KeyRow& row) {
    return value_of(row, {Scene(), MediumSettings(), SolidSettings(), LightSettings()});
}

void set_value(const KeyRow& row, const KeyTarget& target, const Node& node) {
    if (row.field.set == nullptr) return;
    if (row.kind() != KeyKind::kChoice) return row.field.set(target, node);
    Node place = node_of(place_in(row.allowed.choices, node.text));
    place.flag = place.integer > 0;
    row.field.set(target, place);
}

std::string allowed_text(const KeyRow& row) {
    const std::string range = " in " + range_text(row.allowed.range);
    const char* choices = row.allowed.choices;
    switch (row.kind()) {
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
        case KeyKind::kChoice:
            return choices == nullptr ? "text" : choices_text(choices);
        case KeyKind::kTexts:
            return choices == nullptr ? "list of up to 16 texts"
                                      : "list of " + choices_text(choices);
        case KeyKind::kIndexOrText:
            return "text, or whole number" + range;
        case KeyKind::kDensity:
            return density_names() + ", the path of a file, or a table";
        case KeyKind::kRows: {
            std::string keys;
            for (const KeyRow& key : row.list->keys())
                keys += (keys.empty() ? "" : ", ") + std::string(key.path);
            return "list of " + std::to_string(row.list->least) + " to " +
                   std::to_string(row.list->most) + " tables of " + keys;
        }
        case KeyKind::kTable:
            return "table";
        case KeyKind::kLater:
            break;
    }
    return "nothing";
}

std::string default_text(const KeyRow& row) {
    if (row.fallback != nullptr) return row.fallback;
    const Node value = default_value(row);
    FaultList none("", {});
    // A field begins with what its key does not allow where leaving it out says something else.
    if (!has_value(value) || !check_value(row, value, "", none)) return "";
    return short_toml(row, value);
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

}  // namespace pileus
