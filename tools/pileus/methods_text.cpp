// SPDX-License-Identifier: Apache-2.0
// See methods_text.h.
#include "tools/pileus/methods_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace pileus {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kNameWidth = 52;

const char* sign_of(const Support& entry) {
    constexpr const char* kSigns[] = {"=", "~", "-", "."};
    return kSigns[std::size_t(entry.level)];
}

/// "bounded: 24 directions"
std::string words_of(const Support& entry) {
    std::string words = level_name(entry.level);
    if (*entry.text != 0) words += std::string(": ") + entry.text;
    return words;
}

std::string note_of(const FeatureRow& row) {
    return *row.note == 0 ? "" : std::string(" (") + row.note + ")";
}

/// Calls `each` with all rows, `head` before the first of a group.
template <class Head, class Each>
void for_rows(const Head& head, const Each& each) {
    FeatureGroup group = FeatureGroup::kCount;
    for (std::size_t i = 0; i < kSupportFeatures; ++i) {
        const FeatureRow& row = feature_row(Feature(i));
        if (row.group != group) head(group_name(row.group));
        group = row.group;
        each(row);
    }
}

Json json_of(const Support& entry) {
    Json json = {{"level", level_name(entry.level)}};
    if (*entry.text != 0) json["text"] = entry.text;
    if (*entry.allowed != 0) json["allowed"] = entry.allowed;
    return json;
}

Json features_json() {
    Json features = Json::array();
    for (std::size_t i = 0; i < kSupportFeatures; ++i) {
        const FeatureRow& row = feature_row(Feature(i));
        Json json = {{"feature", row.name}, {"group", group_name(row.group)}};
        if (*row.key != 0) json["key"] = row.key;
        if (*row.note != 0) json["note"] = row.note;
        for (std::size_t c = 0; c < kMethodColumns; ++c)
            json["by"][method_column_name(MethodColumn(c))] = json_of(row.by[c]);
        features.push_back(json);
    }
    return features;
}

Json runners_json() {
    std::size_t count = 0;
    const RunnerRow* rows = support_runners(count);
    Json runners = Json::array();
    for (std::size_t i = 0; i < count; ++i) {
        Json json = {{"feature", rows[i].feature}};
        for (std::size_t p = 0; p < kRunners; ++p)
            json["by"][runner_name(Runner(p))] = json_of(rows[i].by[p]);
        runners.push_back(json);
    }
    return runners;
}

Json columns_json(unsigned columns) {
    Json names = Json::array();
    for (std::size_t c = 0; c < kMethodColumns; ++c)
        if ((columns >> c & 1u) != 0) names.push_back(method_column_name(MethodColumn(c)));
    return names;
}

std::string names_of(unsigned columns) {
    if (columns == (1u << kMethodColumns) - 1) return "all";
    std::string names;
    for (std::size_t c = 0; c < kMethodColumns; ++c)
        if ((columns >> c & 1u) != 0)
            names += (names.empty() ? "" : ", ") + std::string(method_column_name(MethodColumn(c)));
    return names;
}

std::string pairs_markdown() {
    std::size_t count = 0;
    const PairRow* rows = support_pairs(count);
    std::string text = "| pair | refused by |\n|---|---|\n";
    for (std::size_t i = 0; i < count; ++i)
        text += fmt::format("| {} | {}{}{} |\n", rows[i].pair, names_of(rows[i].columns),
                            *rows[i].note != 0 ? "; " : "", rows[i].note);
    return text;
}

std::string runners_markdown() {
    std::string text = "| feature |", rule = "|---|";
    for (std::size_t p = 0; p < kRunners; ++p) {
        text += fmt::format(" {} |", runner_name(Runner(p)));
        rule += "---|";
    }
    text += "\n" + rule + "\n";
    std::size_t count = 0;
    const RunnerRow* rows = support_runners(count);
    for (std::size_t i = 0; i < count; ++i) {
        text += fmt::format("| {} |", rows[i].feature);
        for (const Support& entry : rows[i].by) text += fmt::format(" {} |", words_of(entry));
        text += "\n";
    }
    return text;
}

}  // namespace

std::string support_lines() {
    std::string text, numbers;
    for (std::size_t c = 0; c < kMethodColumns; ++c) {
        text +=
            fmt::format("{}{} {}", c == 0 ? "" : "  ", c + 1, method_column_name(MethodColumn(c)));
        numbers += fmt::format("  {}", c + 1);
    }
    text += "\n=: exact  ~: bounded  -: refused  .: without effect, told\n";
    for_rows(
        [&](const char* group) { text += fmt::format("\n{:<{}}{}\n", group, kNameWidth, numbers); },
        [&](const FeatureRow& row) {
            std::string name = row.name;
            if (name.size() > kNameWidth - 2) name = name.substr(0, kNameWidth - 5) + "...";
            text += fmt::format("  {:<{}}", name, kNameWidth - 2);
            for (const Support& entry : row.by) text += fmt::format("  {}", sign_of(entry));
            text += "\n";
        });
    return text;
}

std::string support_lines_of(MethodColumn column) {
    std::string text = std::string(method_column_name(column)) + "\n";
    for_rows([&](const char* group) { text += fmt::format("\n{}\n", group); },
             [&](const FeatureRow& row) {
                 const Support& entry = row.by[std::size_t(column)];
                 const char* said = *entry.text != 0 ? ": " : "";
                 text += fmt::format("  {:<7}  {}{}{}{}\n", level_name(entry.level), row.name,
                                     note_of(row), said, entry.text);
             });
    return text;
}

std::string support_markdown() {
    std::string text = "| feature |", rule = "|---|";
    for (std::size_t c = 0; c < kMethodColumns; ++c) {
        text += fmt::format(" {} |", method_column_name(MethodColumn(c)));
        rule += "---|";
    }
    text += "\n" + rule + "\n";
    for_rows(
        [&](const char* group) {
            text += fmt::format("| **{}** |", group);
            for (std::size_t c = 0; c < kMethodColumns; ++c) text += " |";
            text += "\n";
        },
        [&](const FeatureRow& row) {
            text += fmt::format("| {}{} |", row.name, note_of(row));
            for (const Support& entry : row.by) text += fmt::format(" {} |", words_of(entry));
            text += "\n";
        });
    return text + "\n## Features that exclude one another\n\n" + pairs_markdown() +
           "\n## Where the picture is made\n\n" + runners_markdown();
}

std::string support_json() {
    Json columns = Json::array(), pairs = Json::array();
    for (std::size_t c = 0; c < kMethodColumns; ++c)
        columns.push_back(method_column_name(MethodColumn(c)));
    std::size_t count = 0;
    const PairRow* rows = support_pairs(count);
    for (std::size_t i = 0; i < count; ++i)
        pairs.push_back({{"pair", rows[i].pair}, {"refused_by", columns_json(rows[i].columns)}});
    const Json json = {{"columns", columns},
                       {"features", features_json()},
                       {"pairs", pairs},
                       {"runners", runners_json()}};
    return json.dump(2) + "\n";
}

}  // namespace pileus
