// SPDX-License-Identifier: Apache-2.0
// Splits an override into path and value and puts the value into the tree.
// in: "medium.0.albedo=0.9" -> out: the node set, or a fault that names the option.
// TOML 1.0 values; texts may go without quotes, alone or in a list.
#include <charconv>

#include "src/scene/toml/toml_tree.h"

namespace pileus {
namespace {

constexpr std::size_t kMaxSegments = 16;

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    return text;
}

/// Reads a TOML value; false when the text is none.
bool toml_value(std::string_view text, Node& value) {
    if (text.find('\n') != std::string_view::npos) return false;
    Node root;
    SyntaxFault ignored;
    if (!parse_toml("v = " + std::string(text), root, ignored)) return false;
    if (root.children.size() != 1 || root.children[0].key != "v") return false;
    value = root.children[0];
    return true;
}

/// A value as a user types it in a shell: TOML, or a text without quotes.
bool scalar_value(std::string_view text, Node& value) {
    if (toml_value(text, value)) return true;
    if (text.find_first_of("[]{}\"'\n") != std::string_view::npos) return false;
    // A picture keeps its options in its text, which must stay TOML: no control characters there.
    if (printable(text) != text) return false;
    value = Node();
    value.kind = NodeKind::kText;
    value.text = std::string(text);
    return true;
}

bool read_value(std::string_view text, Node& value) {
    if (scalar_value(text, value)) return true;
    const bool list = text.size() >= 2 && text.front() == '[' && text.back() == ']';
    if (!list) return false;
    value = Node();
    value.kind = NodeKind::kArray;
    std::string_view rest = text.substr(1, text.size() - 2);
    for (;;) {
        const std::size_t comma = rest.find(',');
        value.children.emplace_back();
        if (!scalar_value(trimmed(rest.substr(0, comma)), value.children.back())) return false;
        if (comma == std::string_view::npos) return true;
        rest.remove_prefix(comma + 1);
    }
}

bool split_path(std::string_view path, std::vector<std::string>& segments) {
    for (;;) {
        const std::size_t dot = path.find('.');
        const std::string_view part = path.substr(0, dot);
        if (part.empty() || segments.size() == kMaxSegments) return false;
        for (char ch : part) {
            const bool plain = (ch >= 'a' && ch <= 'z') || (ch >= 'A' && ch <= 'Z') ||
                               (ch >= '0' && ch <= '9') || ch == '_' || ch == '-';
            if (!plain) return false;
        }
        segments.emplace_back(part);
        if (dot == std::string_view::npos) return true;
        path.remove_prefix(dot + 1);
    }
}

/// Lists of tables, which may grow.
bool is_list(const std::string& key) { return key == "medium" || key == "solid"; }

/// The element of an array under an index; a list of tables grows by its next element.
Node* element(Node& array, const std::string& segment, bool may_grow, const Place& place,
              std::string& fault) {
    std::size_t index = 0;
    const char* end = segment.data() + segment.size();
    const auto read = std::from_chars(segment.data(), end, index);
    const bool number = read.ec == std::errc() && read.ptr == end;
    const std::size_t size = array.children.size();
    if (number && index == size && may_grow) {
        array.children.emplace_back();
        put_at(array.children.back(), place);
    }
    if (number && index < array.children.size()) return &array.children[index];
    const std::size_t allowed = size + (may_grow ? 1 : 0);
    fault = "no such element, " + segment + ", allowed: ";
    fault += allowed == 0 ? "none, the list is empty" : "0 to " + std::to_string(allowed - 1);
    return nullptr;
}

/// Goes to the node that a path names, making tables on the way; null after setting `fault`.
Node* descend(Node& root, const std::vector<std::string>& path, const Place& place,
              std::string& walked, std::string& fault) {
    Node* node = &root;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const bool in_media = i == 1 && is_list(path[0]);
        if (!node->is_table() && !node->is_array()) {
            fault = "holds a single value, " + value_text(*node) + ", allowed: a table or list";
            return nullptr;
        }
        if (!walked.empty()) walked += '.';
        walked += path[i];
        if (node->is_array()) {
            node = element(*node, path[i], in_media, place, fault);
            if (node == nullptr) return nullptr;
            continue;
        }
        Node* child = node->find(path[i]);
        if (child == nullptr) {
            node->children.emplace_back();
            child = &node->children.back();
            child->key = path[i];
            if (i == 0 && is_list(path[0])) child->kind = NodeKind::kArray;
            put_at(*child, place);
        }
        node = child;
    }
    return node;
}

void apply(const std::string& text, const Place& place, Node& root, FaultList& faults) {
    const std::size_t equals = text.find('=');
    std::vector<std::string> path;
    if (equals == std::string::npos || !split_path(override_key(text), path)) {
        faults.add(place, "", "not an override, " + quote_text(text) + ", allowed: key.path=value");
        return;
    }
    Node value;
    const std::string_view written = trimmed(std::string_view(text).substr(equals + 1));
    if (!read_value(written, value)) {
        faults.add(place, "",
                   "not a value, " + quote_text(written) +
                       ", allowed: a TOML value, or a printable text without quotes");
        return;
    }
    std::string walked, fault;
    Node* node = descend(root, path, place, walked, fault);
    if (node == nullptr) {
        faults.add(place, walked, fault);
        return;
    }
    // Faults of the new value are faults of the option, whatever the file said there.
    value.key = node->key;
    put_at(value, place);
    *node = std::move(value);
}

}  // namespace

std::string_view override_key(std::string_view text) {
    return trimmed(text.substr(0, text.find('=')));
}

void apply_overrides(const std::vector<std::string>& overrides, Node& root, FaultList& faults) {
    for (std::size_t i = 0; i < overrides.size(); ++i) {
        Place place;
        place.override_index = static_cast<int>(i);
        apply(overrides[i], place, root, faults);
    }
}

}  // namespace pileus
