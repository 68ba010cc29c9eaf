// SPDX-License-Identifier: Apache-2.0
// Walks a scene's tree beside the key table.
// in: tree -> out: set fields of the Scene; faults for unknown, missing, ill-typed and wild keys.
// Levenshtein 1966 for the distance between names.
#include "src/scene/checks/check_keys.h"

#include <algorithm>

namespace pileus {

namespace {

constexpr std::size_t kMaxTables = 64;  // of one list
constexpr std::size_t kLongestName = 40;

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({above + 1, row[j - 1] + 1, change});
            diagonal = above;
        }
    }
    return row[b.size()];
}

/// A name without the unit that ends it: "fov" of "fov_deg", "height" of "height_km".
std::string_view without_unit(std::string_view name) {
    // Longer ones first; those that no key has are what users write instead.
    for (const std::string_view unit :
         {"_m_per_s", "_per_km", "_per_m", "_degrees", "_degree", "_radians", "_rad", "_deg",
          "_metres", "_meters", "_km", "_cm", "_mm", "_um", "_nm", "_m", "_s"})
        if (name.size() > unit.size() && name.substr(name.size() - unit.size()) == unit)
            return name.substr(0, name.size() - unit.size());
    return name;
}

std::string joined(const std::string& path, const std::string& key) {
    return path.empty() ? key : path + "." + key;
}

/// A key as it appears in a path: plain names as they are, others quoted and made printable.
std::string shown_key(const std::string& key) {
    for (char ch : key) {
        const bool plain = (ch >= 'a' && ch <= 'z') || (ch >= 'A' && ch <= 'Z') ||
                           (ch >= '0' && ch <= '9') || ch == '_' || ch == '-';
        if (!plain) return quote_text(key);
    }
    return key.empty() || key.size() > kLongestName ? quote_text(key) : key;
}

class Walker {
public:
    explicit Walker(SceneCheck& check) : check_(check), rows_(all_scene_keys()) {}

    /// `path` names the table in messages, `pattern` in the key table ("medium.N" for an index).
    void table(const Node& node, const std::string& path, const std::string& pattern,
               MediumSettings& medium) {
        for (const Node& child : node.children) {
            if (check_.faults.full()) return;
            member(child, joined(path, shown_key(child.key)), joined(pattern, child.key), medium);
        }
        missing(node, path, pattern);
    }

private:
    void member(const Node& child, const std::string& path, const std::string& pattern,
                MediumSettings& medium) {
        const KeyRow* row = row_of(pattern);
        if (row != nullptr) {
            const bool valid = check_value(*row, child, path, check_.faults);
            check_.found[path] = {&child, valid};
            if (!valid) return;
            if (row->kind() == KeyKind::kDensity && child.is_table())
                table(child, path, pattern, medium);
            set_value(*row, {check_.scene, medium, *solid_, *light_}, child);
        } else if (pattern == "medium") {
            list(child, pattern, check_.scene.media, [&](const Node& table_node, std::size_t i) {
                table(table_node, "medium." + std::to_string(i), "medium.N", check_.scene.media[i]);
            });
        } else if (pattern == "solid") {
            list(child, pattern, check_.scene.solids, [&](const Node& table_node, std::size_t i) {
                solid_ = &check_.scene.solids[i];
                table(table_node, "solid." + std::to_string(i), "solid.N", medium);
                solid_ = &nowhere_;
            });
        } else if (pattern == "light") {
            list(child, pattern, check_.scene.lights, [&](const Node& table_node, std::size_t i) {
                light_ = &check_.scene.lights[i];
                table(table_node, "light." + std::to_string(i), "light.N", medium);
                light_ = &dark_;
            });
        } else if (is_section(pattern)) {
            check_.found[path] = {&child, child.is_table()};
            if (child.is_table()) return table(child, path, pattern, medium);
            check_.faults.add(child.at, path,
                              "wrong type, " + value_text(child) + ", allowed: a table");
        } else {
            unknown(child, path, pattern);
        }
    }

    /// A list of tables: as many settings, and `each` table walked.
    template <class Settings, class Each>
    void list(const Node& node, const std::string& name, std::vector<Settings>& settings,
              Each each) {
        bool good = node.is_array() && node.children.size() <= kMaxTables;
        if (node.is_array())
            for (const Node& child : node.children) good = good && child.is_table();
        if (!good) {
            check_.faults.add(node.at, name,
                              "wrong type or too many, " + value_text(node) +
                                  ", allowed: up to 64 tables, each headed [[" + name + "]]");
            return;
        }
        settings.resize(node.children.size());
        for (std::size_t i = 0; i < node.children.size(); ++i) {
            check_.found[name + "." + std::to_string(i)] = {&node.children[i], true};
            each(node.children[i], i);
        }
    }

    const KeyRow* row_of(const std::string& pattern) const {
        for (const KeyRow* row : rows_)
            if (pattern == row->path) return row;
        return nullptr;
    }

    bool is_section(const std::string& pattern) const {
        const std::string start = pattern + ".";
        for (const KeyRow* row : rows_)
            if (std::string_view(row->path).substr(0, start.size()) == start) return true;
        return false;
    }

    /// Names that may stand in the table that `pattern` names.
    std::vector<std::string> names_in(const std::string& pattern) const {
        const std::string start = pattern.empty() ? "" : pattern + ".";
        std::vector<std::string> names;
        for (const KeyRow* row : rows_) {
            const std::string_view path = row->path;
            if (path.substr(0, start.size()) != start) continue;
            const std::string name(
                path.substr(start.size(), path.find('.', start.size()) - start.size()));
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        }
        return names;
    }

    void unknown(const Node& child, const std::string& path, const std::string& pattern) {
        const std::string parent =
            pattern.substr(0, pattern.size() - std::min(pattern.size(), child.key.size() + 1));
        const std::vector<std::string> names = names_in(parent);
        std::string text = "unknown key, " + quote_text(child.key) + ", allowed: ";
        for (std::size_t i = 0; i < names.size(); ++i) text += (i > 0 ? ", " : "") + names[i];
        const std::string near = nearest_name(child.key, names);
        const std::string elsewhere = near.empty() ? other_table(child.key) : near;
        if (!elsewhere.empty()) text += "; did you mean " + elsewhere + "?";
        check_.faults.add(child.key_at, path, text);
    }

    /// The full path of a key of this name in another table, its unit aside; empty if none.
    std::string other_table(const std::string& key) const {
        for (const KeyRow* row : rows_) {
            const std::string_view path = row->path;
            const std::size_t dot = path.rfind('.');
            if (dot != std::string_view::npos &&
                without_unit(path.substr(dot + 1)) == without_unit(key))
                return row->path;
        }
        return "";
    }

    void missing(const Node& node, const std::string& path, const std::string& pattern) {
        const std::string start = pattern.empty() ? "" : pattern + ".";
        for (const KeyRow* row : rows_) {
            const std::string_view full = row->path;
            if (!row->required()) continue;
            if (full.substr(0, start.size()) != start) continue;
            const std::string name(full.substr(start.size()));
            if (name.find('.') != std::string::npos || node.find(name) != nullptr) continue;
            // A place in degrees stands for one in metres.
            const std::string_view bare = without_unit(name);
            if (bare.size() < name.size() && node.find(std::string(bare) + "_deg") != nullptr)
                continue;
            check_.faults.add(node.at, joined(path, name),
                              "missing, nothing, allowed: " + allowed_text(*row));
        }
    }

    SceneCheck& check_;
    std::vector<const KeyRow*> rows_;
    SolidSettings nowhere_;
    LightSettings dark_;
    SolidSettings* solid_ = &nowhere_;  ///< of the table being walked
    LightSettings* light_ = &dark_;     ///< likewise
};

}  // namespace

const Node* SceneCheck::key(const std::string& path) const {
    const auto it = found.find(path);
    return it == found.end() || !it->second.given ? nullptr : it->second.node;
}

const Node* SceneCheck::valid_key(const std::string& path) const {
    const auto it = found.find(path);
    return it == found.end() || !it->second.valid ? nullptr : key(path);
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& names) {
    if (name.size() > kLongestName) return "";
    std::size_t best = std::max<std::size_t>(2, name.size() / 3) + 1;
    std::string nearest;
    for (const std::string& candidate : names) {
        const std::size_t distance =
            std::min(edit_distance(name, candidate),
                     edit_distance(without_unit(name), without_unit(candidate)));
        // A name that would have to be rewritten altogether is no suggestion.
        if (distance < best && distance < name.size()) {
            best = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

void check_keys(const Node& root, SceneCheck& check) {
    Walker walker(check);
    MediumSettings nowhere;
    walker.table(root, "", "", nowhere);
    // A scene needs a camera: an absent table lacks the same keys as an empty one.
    if (root.find("camera") == nullptr) walker.table(Node(), "camera", "camera", nowhere);
}

void add_refusal(SceneCheck& check, const Node& node, const std::string& key,
                 const std::string& what, const std::string& value, const std::string& allowed) {
    check.faults.add(node.at, key, what + ", " + value + ", allowed: " + allowed);
}

void conflict(SceneCheck& check, const std::string& key, const char* with) {
    if (const Node* node = check.key(key))
        check.faults.add(node->key_at, key,
                         std::string("conflicts with ") + with + ", " + value_text(*node) +
                             ", allowed: left out");
}

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
