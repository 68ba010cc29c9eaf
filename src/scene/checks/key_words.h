// SPDX-License-Identifier: Apache-2.0
// What rows of keys say: defaults and meanings.
// in: rows -> out: texts for docs/scene.md and for scenes that `pileus new` writes.
// docs/scene.md
#pragma once
#include "src/scene/checks/check_keys.h"
#include "src/scene/keys/all_keys.h"
#include "src/scene/rows/phase_row.h"

namespace pileus {

/// Long numbers in groups of three digits, one colour for three equal ones.
inline std::string short_toml(const KeyRow& row, const Node& node) {
    const auto& parts = node.children;
    if (row.kind() == KeyKind::kColor && toml_text(parts[0]) == toml_text(parts[1]) &&
        toml_text(parts[1]) == toml_text(parts[2]))
        return toml_text(parts[0]);
    std::string text = toml_text(node);
    if (node.kind == NodeKind::kInteger && text.size() > 4)
        for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, "_");
    return text;
}

/// The default as TOML, "required", or empty.
inline std::string default_text(const KeyRow& row) {
    if (row.fallback != nullptr) return row.fallback;
    const Node value = default_value(row);
    FaultList none("", {});
    // A field begins with what its key does not allow where leaving it out says something else.
    if (!has_value(value) || !check_value(row, value, "", none)) return "";
    return short_toml(row, value);
}

/// What a key means, by its row; a key that phase functions share has a word of each.
inline std::string meaning_of(const KeyRow& row) {
    std::string text = row.help;
    std::vector<const KeyRow*> said{&row};
    for (const NamedPhase& type : phase_rows())
        for (const KeyRow& key : type.row->keys) {
            if (std::string_view(key.path) != row.path) continue;
            // Types of one file may have the very same row.
            bool known = false;
            for (const KeyRow* other : said) known |= other == &key;
            if (known) continue;
            said.push_back(&key);
            text += std::string("; ") + key.help;
        }
    return text;
}

}  // namespace pileus
