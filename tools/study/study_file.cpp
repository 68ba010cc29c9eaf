// SPDX-License-Identifier: Apache-2.0
// Reads a study: text, tree, keys, the laws between them, and the scenes that it names.
// in: untrusted TOML -> out: a checked Study, or all of its faults.
// docs/study.md, "The file"
#include "tools/study/study_file.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "platform/fp_mode.h"
#include "platform/fs_path.h"
#include "src/base/file.h"
#include "src/base/number_text.h"
#include "src/scene/read_scene.h"
#include "tools/study/study_keys.h"

namespace pileus {

namespace {

constexpr std::size_t kMaxTables = 64;
constexpr std::size_t kMaxCurves = 64;
constexpr double kMaxSeed = 0x1p62;

/// A node that has the kind its row asks for; null after a fault or where it is not given.
const Node* text_at(const Node& table, const char* key) {
    const Node* node = table.find(key);
    return node != nullptr && node->is_text() ? node : nullptr;
}

std::string text_of(const Node& table, const char* key, const std::string& fallback) {
    const Node* node = text_at(table, key);
    return node != nullptr && !node->text.empty() ? node->text : fallback;
}

void append_texts(const Node& table, const char* key, std::vector<std::string>& texts) {
    const Node* node = table.find(key);
    if (node == nullptr || !node->is_array()) return;
    for (const Node& child : node->children)
        if (child.is_text()) texts.push_back(child.text);
}

/// A number from 0 to `most`; the key's own check has told of any other, which is left alone here,
/// since it may not fit an integer.
void take_integer(const Node& table, const char* key, double most, std::int64_t& value) {
    const Node* node = table.find(key);
    if (node == nullptr || !node->is_number()) return;
    if (number_of(*node) >= 0 && number_of(*node) <= most) value = integer_of(*node);
}

bool is_name(const std::string& text) {
    for (char c : text)
        if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-'))
            return false;
    return !text.empty() && text.size() <= 40;
}

class Reader {
public:
    Reader(const std::string& directory, FaultList& faults, Study& study)
        : directory_(directory), faults_(faults), study_(study) {}

    void read(const Node& root) {
        check_study_table(study_top_table(), root, "", faults_);
        study_.title = text_of(root, "title", path_text(path_of(study_.file).stem()));
        std::int64_t seeds = study_.seeds;
        take_integer(root, "seeds", 64, seeds);
        study_.seeds = int(seeds);
        take_integer(root, "first_seed", kMaxSeed, study_.first_seed);
        const Node* targets = root.find("targets");
        if (targets != nullptr && targets->is_array() && targets->children.size() == 2)
            study_.targets = number2_of(*targets);
        reference(root);
        for (const Node* scene : tables(root, "scene", "scene")) add_scene(*scene);
        for (const Node* method : tables(root, "method", "method")) add_method(*method);
    }

private:
    void fault(const Node& at, const std::string& path, const std::string& text) {
        faults_.add(at.at, path, text);
    }

    /// The elements of an array of tables; their place in it is told by `index_of`.
    std::vector<const Node*> tables(const Node& parent, const char* key, const std::string& path) {
        std::vector<const Node*> found;
        const Node* list = parent.find(key);
        bool good = list != nullptr && list->is_array() && !list->children.empty() &&
                    list->children.size() <= kMaxTables;
        if (good)
            for (const Node& child : list->children) good = good && child.is_table();
        if (!good) {
            fault(list != nullptr ? *list : parent, path,
                  "missing, too many or wrong type, " +
                      (list != nullptr ? value_text(*list) : "nothing") +
                      ", allowed: 1 to 64 tables, each headed [[" + path + "]]");
            return found;
        }
        for (const Node& child : list->children) found.push_back(&child);
        return found;
    }

    void reference(const Node& root) {
        const Node* table = root.find("reference");
        if (table != nullptr && !table->is_table()) {
            fault(*table, "reference", "wrong type, " + value_text(*table) + ", allowed: a table");
            return;
        }
        const Node none;
        const Node& node = table != nullptr ? *table : none;
        check_study_table(study_reference_table(), node, "reference", faults_);
        append_texts(node, "set", study_.reference.sets);
        study_.reference.budget = text_of(node, "budget", "");
        if (const Node* budget = text_at(node, "budget"))
            check_budget(*budget, "reference.budget", nullptr);
        take_integer(node, "first_seed", kMaxSeed, study_.reference.first_seed);
    }

    void check_budget(const Node& node, const std::string& path, std::string* kind_of_all) {
        std::string kind;
        double amount = 0;
        if (!split_budget(node.text, kind, amount))
            fault(node, path,
                  "not a budget, " + value_text(node) +
                      ", allowed: photons=N, samples=N, steps=N, seconds=S or error=E");
        else if (kind_of_all != nullptr && !kind_of_all->empty() && *kind_of_all != kind)
            fault(node, path,
                  "another kind, " + value_text(node) + ", allowed: " + *kind_of_all + "=N");
        else if (kind_of_all != nullptr)
            *kind_of_all = kind;
    }

    std::string name_of(const Node& node, const std::string& path,
                        const std::vector<std::string>& others) {
        const Node* name = text_at(node, "name");
        if (name == nullptr) return "";
        if (!is_name(name->text))
            fault(*name, path + ".name",
                  "not a name, " + value_text(*name) + ", allowed: 1 to 40 of a-z 0-9 _ -");
        else if (std::find(others.begin(), others.end(), name->text) != others.end())
            fault(*name, path + ".name",
                  "given twice, " + value_text(*name) + ", allowed: another name");
        return name->text;
    }

    void add_scene(const Node& node) {
        const std::string path = "scene." + std::to_string(study_.scenes.size());
        check_study_table(study_scene_table(), node, path, faults_);
        std::vector<std::string> others;
        for (const StudyScene& other : study_.scenes) others.push_back(other.name);
        StudyScene scene;
        scene.name = name_of(node, path, others);
        scene.title = text_of(node, "title", scene.name);
        scene.file = scene_path(directory_, text_of(node, "file", ""));
        append_texts(node, "set", scene.sets);
        scene.reference_budget = text_of(node, "reference_budget", study_.reference.budget);
        if (const Node* budget = text_at(node, "reference_budget"))
            check_budget(*budget, path + ".reference_budget", nullptr);
        study_.scenes.push_back(std::move(scene));
    }

    void add_method(const Node& node) {
        const std::string path = "method." + std::to_string(methods_.size());
        check_study_table(study_method_table(), node, path, faults_);
        StudyCurve curve;
        curve.name = name_of(node, path, methods_);
        methods_.push_back(curve.name);
        curve.title = text_of(node, "title", curve.name);
        append_texts(node, "set", curve.sets);
        append_texts(node, "budgets", curve.budgets);
        check_budgets(node, path);
        append_texts(node, "scenes", curve.scenes);
        check_scene_names(node, path);
        if (node.find("setting") == nullptr) return add_curve(curve, node, path);
        std::vector<std::string> names;
        for (const Node* setting : tables(node, "setting", "method.setting")) {
            const std::string place = path + ".setting." + std::to_string(names.size());
            check_study_table(study_setting_table(), *setting, place, faults_);
            StudyCurve one = curve;
            names.push_back(name_of(*setting, place, names));
            one.name += "." + names.back();
            one.title += ", " + text_of(*setting, "title", names.back());
            append_texts(*setting, "set", one.sets);
            add_curve(one, *setting, place);
        }
    }

    void add_curve(const StudyCurve& curve, const Node& node, const std::string& path) {
        if (study_.curves.size() < kMaxCurves) return study_.curves.push_back(curve);
        fault(node, path, "too many methods and settings, allowed: at most 64");
    }

    /// One kind, growing: what comes later costs more.
    void check_budgets(const Node& node, const std::string& path) {
        const Node* list = node.find("budgets");
        if (list == nullptr || !list->is_array()) return;
        if (list->children.empty())
            fault(*list, path + ".budgets", "empty, [], allowed: 1 to 16 budgets");
        std::string kind;
        double last = 0;
        for (const Node& budget : list->children) {
            if (!budget.is_text()) continue;
            check_budget(budget, path + ".budgets", &kind);
            std::string ignored;
            double amount = 0;
            if (!split_budget(budget.text, ignored, amount)) continue;
            const bool dearer = last == 0 || (kind == "error" ? amount < last : amount > last);
            if (!dearer)
                fault(budget, path + ".budgets",
                      "not more work than the one before, " + value_text(budget) +
                          ", allowed: cheapest first");
            last = amount;
        }
    }

    void check_scene_names(const Node& node, const std::string& path) {
        const Node* list = node.find("scenes");
        if (list == nullptr || !list->is_array()) return;
        for (const Node& name : list->children) {
            bool known = false;
            for (const StudyScene& scene : study_.scenes) known |= name.text == scene.name;
            if (name.is_text() && !known)
                fault(name, path + ".scenes",
                      "no such scene, " + value_text(name) + ", allowed: a scene's name");
        }
    }

    const std::string& directory_;
    FaultList& faults_;
    Study& study_;
    std::vector<std::string> methods_;
};

/// Whether the scene's text asks for data that this machine was not told of.
bool lacks_data(const std::string& file) {
    const char* folder = std::getenv("PILEUS_DATA_DIR");
    if (folder != nullptr && folder[0] != '\0') return false;
    Buffer<char> bytes;
    if (!read_whole_file(file, kMaxSceneBytes, bytes)) return false;
    const std::string text(bytes.data(), bytes.size());
    return text.find("\"${PILEUS_DATA_DIR}") != std::string::npos;
}

/// Adds the lines that are not there yet: one scene is read once for each method.
void add_lines(const Status& status, std::vector<std::string>& lines) {
    std::string rest = status.message;
    while (!rest.empty()) {
        const std::size_t end = rest.find('\n');
        const std::string line = rest.substr(0, end);
        if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
        rest = end == std::string::npos ? "" : rest.substr(end + 1);
    }
}

Status check_scenes(Study& study) {
    std::vector<std::string> lines;
    Status first;
    for (StudyScene& scene : study.scenes) {
        if (lacks_data(scene.file)) {
            scene.skipped = "environment variable PILEUS_DATA_DIR is not set";
            continue;
        }
        std::vector<const std::vector<std::string>*> all{&study.reference.sets};
        for (const StudyCurve& curve : study.curves) {
            const auto& only = curve.scenes;
            if (only.empty() || std::find(only.begin(), only.end(), scene.name) != only.end())
                all.push_back(&curve.sets);
        }
        for (const auto* more : all) {
            std::vector<std::string> sets = scene.sets;
            sets.insert(sets.end(), more->begin(), more->end());
            Scene read;
            Status status = read_scene_file(scene.file, sets, read);
            if (status && read.clouds.present())
                status = at_key(read, "clouds.kind",
                                Status::bad_input("a study compares methods over media, allowed: "
                                                  "the scene of a kind"));
            if (status) continue;
            if (first) first.code = status.code;
            add_lines(status, lines);
        }
    }
    for (const std::string& line : lines)
        first.message += (first.message.empty() ? "" : "\n") + line;
    return first;
}

}  // namespace

bool split_budget(const std::string& text, std::string& kind, double& amount) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) return false;
    kind = text.substr(0, equals);
    const char* const begin = text.data() + equals + 1;
    const char* const end = text.data() + text.size();
    const std::from_chars_result read = number_from(begin, end, amount);
    const bool known = kind == "photons" || kind == "samples" || kind == "steps" ||
                       kind == "seconds" || kind == "error";
    return known && read.ec == std::errc() && read.ptr == end && amount > 0 && amount < 1e18;
}

Status read_study_text(const std::string& text, const std::string& name,
                       const std::string& directory, Study& out) {
    const FpModeGuard guard;
    FaultList faults(name, {});
    Node root;
    SyntaxFault syntax;
    if (!parse_toml(text, root, syntax)) {
        Place place;
        place.line = syntax.line;
        place.column = syntax.column;
        faults.add(place, "", "not TOML, " + syntax.what);
        return faults.status();
    }
    Study study;
    study.file = name;
    Reader(directory, faults, study).read(root);
    PILEUS_TRY(faults.status());
    out = std::move(study);
    return Status::ok();
}

Status read_study_file(const std::string& path, Study& out) {
    Buffer<char> bytes;
    PILEUS_TRY(read_whole_file(path, kMaxSceneBytes, bytes));
    Study study;
    PILEUS_TRY(read_study_text(std::string(bytes.data(), bytes.size()), path,
                               path_text(path_of(path).parent_path()), study));
    PILEUS_TRY(check_scenes(study));
    out = std::move(study);
    return Status::ok();
}

}  // namespace pileus
