// SPDX-License-Identifier: Apache-2.0
// Laws between the keys of one medium's phase function, by the rows of the types.
// in: keys that passed their own checks -> out: the path of its file; faults.
// docs/phase.md.
#include "src/scene/checks/check_keys.h"
#include "src/scene/rows/phase_row.h"

namespace pileus {
namespace {

class PhaseCheck {
public:
    PhaseCheck(SceneCheck& check, std::size_t index)
        : check_(check),
          phase_(check.scene.media[index].optics.phase),
          path_("medium." + std::to_string(index) + ".") {}

    void run() {
        const Node* type = check_.valid_key(path_ + "phase.type");
        if (type == nullptr) return;
        const PhaseRow& row = *phase_row_named(phase_.type);
        const bool in_two_ways = row.one_is_enough && given(row.keys[0]) && given(row.keys[1]);
        for (const KeyRow* key : phase_keys()) {
            if (const KeyRow* own = own_key(row, *key)) {
                if (!in_two_ways) required(*type, row, *own);
            } else if (key->path != std::string_view("medium.N.phase.type")) {
                foreign(*type, *key);
            }
        }
        if (in_two_ways) twice(name_of(row.keys[1]), name_of(row.keys[0]));
        file();
        numbers(*type);
    }

private:
    /// "phase.g", as messages have it.
    static std::string name_of(const KeyRow& key) { return key.path + sizeof "medium.N"; }
    bool given(const KeyRow& key) const { return check_.key(path_ + name_of(key)) != nullptr; }
    bool lacks(const KeyRow& key) const { return check_.lacks(path_ + name_of(key)); }
    void fault(const Node& node, const std::string& name, const std::string& text) {
        check_.faults.add(node.at, path_ + name, text);
    }

    static const KeyRow* own_key(const PhaseRow& row, const KeyRow& key) {
        for (const KeyRow& own : row.keys)
            if (std::string_view(own.path) == key.path) return &own;
        return nullptr;
    }

    void required(const Node& type, const PhaseRow& row, const KeyRow& key) {
        if (key.fallback == nullptr || !lacks(key)) return;
        std::string what = key.kind() == KeyKind::kText ? "a path" : "a number";
        if (row.one_is_enough) {
            // Blame the first.
            if (&key != &row.keys[0] || given(row.keys[1])) return;
            what += ", or " + name_of(row.keys[1]);
        }
        fault(type, name_of(key),
              "missing, nothing, allowed: " + what + ", required by " + value_text(type));
    }

    void foreign(const Node& type, const KeyRow& key) {
        if (const Node* node = check_.key(path_ + name_of(key)))
            fault(*node, name_of(key),
                  "conflicts with phase.type " + value_text(type) + ", " + value_text(*node) +
                      ", allowed: left out");
    }

    void twice(const std::string& second, const std::string& first) {
        const Node& node = *check_.key(path_ + second);
        fault(node, second,
              "given twice, " + value_text(node) + ", allowed: " + second + " or " + first);
    }

    void file() {
        const Node* node = check_.valid_key(path_ + "phase.file");
        if (node == nullptr) return;
        if (!node->text.empty())
            check_path(check_, *node, (path_ + "phase.file").c_str(), phase_.file);
        else
            fault(*node, "phase.file", "empty, \"\", allowed: the path of a file");
    }

    /// A struct may hold names that no text could bring.
    void numbers(const Node& type) {
        std::vector<std::string> names;
        std::string list;
        for (const KeyRow* key : phase_keys()) {
            if (key->kind() != KeyKind::kNumber) continue;
            names.push_back(key->path + sizeof "medium.N.phase");
            list += (list.empty() ? "" : ", ") + names.back();
        }
        for (const auto& [name, value] : phase_.numbers) {
            bool known = false;
            for (const std::string& other : names) known |= other == name;
            if (known) continue;
            const std::string near = nearest_name(name, names);
            fault(type, "phase.numbers",
                  "unknown key, " + quote_text(name) + ", allowed: " + list +
                      (near.empty() ? "" : "; did you mean " + near + "?"));
        }
    }

    SceneCheck& check_;
    PhaseSettings& phase_;
    std::string path_;
};

}  // namespace

void check_phase(SceneCheck& check, std::size_t index) { PhaseCheck(check, index).run(); }

}  // namespace pileus
