// SPDX-License-Identifier: Apache-2.0
// Checks lists of tables: the rows of a transfer function, the keys of an animation, clouds.
// in: a list of tables -> out: true, or faults that say what is allowed.
// docs/scene.md, "A transfer function"; docs/animation.md
#include "src/base/number_text.h"
#include "src/scene/checks/check_keys.h"

namespace pileus {
namespace {

/// Known keys within their ranges, and none that is required left out.
bool check_row(const RowList& list, const Node& table, const std::string& path, FaultList& faults) {
    bool good = true;
    std::string names;
    for (const KeyRow& row : list.keys()) {
        names += (names.empty() ? "" : ", ") + std::string(row.path);
        const std::string key = path + "." + row.path;
        if (const Node* value = table.find(row.path)) {
            good = check_value(row, *value, key, faults) && good;
        } else if (row.required()) {
            faults.add(table.at, key, "missing, nothing, allowed: " + allowed_text(row));
            good = false;
        }
    }
    for (const Node& child : table.children) {
        bool known = false;
        for (const KeyRow& row : list.keys()) known |= child.key == row.path;
        if (known) continue;
        faults.add(child.key_at, path,
                   "unknown key, " + quote_text(child.key) + ", allowed: " + names);
        good = false;
    }
    return good;
}

}  // namespace

bool check_rows(const KeyRow& row, const Node& list, const std::string& path, FaultList& faults) {
    bool good = list.is_array();
    for (const Node& child : list.children) good = good && child.is_table();
    if (!good || list.children.size() < row.list->least || list.children.size() > row.list->most) {
        faults.add(list.at, path,
                   std::string(good ? "wrong length" : "wrong type") + ", " +
                       (good ? std::to_string(list.children.size()) + " rows" : value_text(list)) +
                       ", allowed: " + allowed_text(row));
        return false;
    }
    for (std::size_t i = 0; i < list.children.size(); ++i)
        good =
            check_row(*row.list, list.children[i], path + "." + std::to_string(i), faults) && good;
    if (!good || row.list->rising == nullptr) return good;
    for (std::size_t i = 1; i < list.children.size(); ++i) {
        const Node& value = *list.children[i].find(row.list->rising);
        const double before = number_of(*list.children[i - 1].find(row.list->rising));
        // What a file holds is floats.
        if (float(number_of(value)) > float(before)) continue;
        faults.add(value.at, path + "." + std::to_string(i) + "." + row.list->rising,
                   "not rising, " + value_text(value) + ", allowed: more than " +
                       number_text(before) + ", that of the row before");
        return false;
    }
    return true;
}

}  // namespace pileus
