// SPDX-License-Identifier: Apache-2.0
// Rows in words: what they allow; values of fields.
// in: rows -> out: texts for messages, nodes.
// docs/scene.md.
#include "src/base/number_text.h"
#include "src/scene/keys/all_keys.h"
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

std::string choice_text(const Node& node) {
    if (node.kind != NodeKind::kBool) return node.text;
    return node.flag ? "true" : "false";
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
    if (place >= names.size()) return value;
    const std::string name(names[place]);
    return name == "true" || name == "false" ? node_of(name == "true") : node_of(name);
}

Node default_value(const KeyRow& row) {
    return value_of(row, {Scene(), MediumSettings(), SolidSettings(), LightSettings()});
}

void set_value(const KeyRow& row, const KeyTarget& target, const Node& node) {
    if (row.field.set == nullptr) return;
    if (row.kind() != KeyKind::kChoice) return row.field.set(target, node);
    Node place = node_of(place_in(row.allowed.choices, choice_text(node)));
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
        case KeyKind::kInteger4:
            return "4 whole numbers" + range;
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
        case KeyKind::kRectangle:
            return "[[x, y], [x, y]]" + range + ", first below second";
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

}  // namespace pileus
