// SPDX-License-Identifier: Apache-2.0
// Checks the fields of a scene that no text was read for.
// in: a Scene -> out: faults of values that their rows do not allow; keys as if they were written.
// docs/scene.md.
#include "src/scene/checks/check_keys.h"

namespace pileus {
namespace {

bool allows(const KeyRow& row, const Node& value) {
    FaultList none("", {});
    return check_value(row, value, "", none);
}

/// A default that the row does not allow, or an empty text, is a key left out.
bool is_left_out(const KeyRow& row, const Node& value, bool is_default) {
    if (!has_value(value)) return true;
    if (!is_default || row.required()) return false;
    return !allows(row, value) || (value.is_text() && value.text.empty());
}

}  // namespace

void check_fields(std::vector<std::unique_ptr<Node>>& values, SceneCheck& check) {
    Place nowhere;
    nowhere.line = 0;
    const auto visit = [&](const KeyRow& row, const std::string& path, const KeySource& source) {
        Node value = value_of(row, source);
        const bool is_default = toml_text(value) == toml_text(default_value(row));
        if (is_left_out(row, value, is_default)) return;
        put_at(value, nowhere);
        values.push_back(std::make_unique<Node>(value));
        const bool valid = check_value(row, value, path, check.faults);
        check.found[path] = {values.back().get(), valid, row.required() || !is_default};
    };
    for_each_key(check.scene, visit);
}

}  // namespace pileus
