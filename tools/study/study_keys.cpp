// SPDX-License-Identifier: Apache-2.0
// Rows of the study's keys, and their check.
// in: a node of the tree -> out: faults; Markdown for the documentation.
// docs/study.md, "The file"
#include "tools/study/study_keys.h"

#include "src/scene/checks/check_keys.h"
#include "tools/study/study_file.h"

namespace pileus {

namespace {

constexpr double kMax = 0x1p62;

const KeyRow kTop[] = {
    {"title", KeyKind::kText, any(), "", "heading of the page; left out: the file's name", kNoNote},
    {"seeds", KeyKind::kInteger, from_to(1, 64), "",
     "times that every picture is made, each with a seed of its own; 3 and more tell bias "
     "and noise apart with a standard error",
     "3"},
    {"first_seed", KeyKind::kInteger, from_to(0, kMax), "", "the first of them; the others follow",
     "1"},
    {"targets", KeyKind::kNumber2, positive(1), "",
     "the two errors (relMSE) for which the time is asked", "[0.01, 0.001]"},
};

const KeyRow kReference[] = {
    {"set", KeyKind::kTexts, any(), "", "settings of the reference, as after `--set`", "[]"},
    {"budget", KeyKind::kText, any(), "",
     "of each of its two halves, as after `--budget`: `samples=256`", kRequired},
    {"first_seed", KeyKind::kInteger, from_to(0, kMax), "",
     "seed of the first half; the second has the next one", "1_000_001"},
};

const KeyRow kScene[] = {
    {"name", KeyKind::kText, any(), "", "short name: a-z 0-9 _ -", kRequired},
    {"title", KeyKind::kText, any(), "", "in words; left out: the name", kNoNote},
    {"file", KeyKind::kText, any(), "", "scene file, relative to the study's folder", kRequired},
    {"set", KeyKind::kTexts, any(), "", "changes to the scene, as after `--set`", "[]"},
    {"reference_budget", KeyKind::kText, any(), "", "instead of the reference's own", kNoNote},
};

const KeyRow kMethod[] = {
    {"name", KeyKind::kText, any(), "", "short name: a-z 0-9 _ -", kRequired},
    {"title", KeyKind::kText, any(), "", "in words; left out: the name", kNoNote},
    {"set", KeyKind::kTexts, any(), "", "the method and its settings, as after `--set`", "[]"},
    {"budgets", KeyKind::kTexts, any(), "",
     "growing amounts of work, as after `--budget`, all of one kind", kRequired},
    {"scenes", KeyKind::kTexts, any(), "", "names of the scenes; left out: all", kNoNote},
};

const KeyRow kSetting[] = {
    {"name", KeyKind::kText, any(), "", "short name: a-z 0-9 _ -", kRequired},
    {"title", KeyKind::kText, any(), "", "in words; left out: the name", kNoNote},
    {"set", KeyKind::kTexts, any(), "", "further settings, after those of the method", "[]"},
};

template <std::size_t N>
Span<const KeyRow> rows_of(const KeyRow (&rows)[N]) {
    return {rows, N};
}

std::vector<std::string> names_in(const StudyTable& table) {
    std::vector<std::string> names;
    for (const KeyRow& row : table.rows) names.push_back(row.path);
    if (table.tables[0] != '\0')
        for (std::string_view name : split_list(table.tables)) names.emplace_back(name);
    return names;
}

const KeyRow* row_of(const StudyTable& table, const std::string& name) {
    for (const KeyRow& row : table.rows)
        if (name == row.path) return &row;
    return nullptr;
}

void add_unknown(const StudyTable& table, const Node& child, const std::string& path,
                 FaultList& faults) {
    const std::vector<std::string> names = names_in(table);
    std::string text = "unknown key, " + quote_text(child.key) + ", allowed: ";
    for (std::size_t i = 0; i < names.size(); ++i) text += (i > 0 ? ", " : "") + names[i];
    const std::string near = nearest_name(child.key, names);
    if (!near.empty()) text += "; did you mean " + near + "?";
    faults.add(child.key_at, path, text);
}

}  // namespace

StudyTable study_top_table() { return {"Top level", rows_of(kTop), "reference|scene|method"}; }
StudyTable study_reference_table() { return {"`[reference]`", rows_of(kReference), ""}; }
StudyTable study_scene_table() { return {"`[[scene]]`", rows_of(kScene), ""}; }
StudyTable study_method_table() { return {"`[[method]]`", rows_of(kMethod), "setting"}; }
StudyTable study_setting_table() { return {"`[[method.setting]]`", rows_of(kSetting), ""}; }

std::string study_path(const std::string& path, const std::string& name) {
    return path.empty() ? name : path + "." + name;
}

void check_study_table(const StudyTable& table, const Node& node, const std::string& path,
                       FaultList& faults) {
    for (const Node& child : node.children) {
        if (faults.full()) return;
        const KeyRow* row = row_of(table, child.key);
        bool is_table = false;
        if (table.tables[0] != '\0')
            for (std::string_view name : split_list(table.tables)) is_table |= child.key == name;
        // A name that is not known is quoted in the text, where it cannot break the line.
        if (row != nullptr)
            (void)check_value(*row, child, study_path(path, child.key), faults);
        else if (!is_table)
            add_unknown(table, child, path, faults);
    }
    for (const KeyRow& row : table.rows)
        if (row.required() && node.find(row.path) == nullptr)
            faults.add(node.at, study_path(path, row.path),
                       "missing, nothing, allowed: " + allowed_text(row));
}

std::string describe_study_keys_markdown() {
    std::string text;
    for (const StudyTable& table : {study_top_table(), study_reference_table(), study_scene_table(),
                                    study_method_table(), study_setting_table()}) {
        text += (text.empty() ? "### " : "\n### ") + std::string(table.heading) + "\n\n";
        text += "| key | value | default | meaning |\n|---|---|---|---|\n";
        for (const KeyRow& row : table.rows) {
            const std::string fallback = row.fallback;
            text += std::string("| `") + row.path + "` | " + allowed_text(row) + " | ";
            text += fallback == kRequired || fallback.empty() ? fallback : "`" + fallback + "`";
            text += std::string(" | ") + row.help + " |\n";
        }
    }
    return text;
}

}  // namespace pileus
