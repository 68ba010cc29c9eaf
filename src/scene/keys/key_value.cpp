// SPDX-License-Identifier: Apache-2.0
// See key_value.h.
#include "src/scene/keys/key_value.h"

#include <algorithm>

#include "src/base/number_text.h"

namespace pileus {
namespace {

/// A basic string of TOML: what a line cannot show is written as \u00XX.
std::string toml_string(const std::string& text) {
    static const char* const kHex = "0123456789ABCDEF";
    std::string shown = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x20 || code == 0x7F) {
            shown += "\\u00";
            shown += kHex[code >> 4];
            shown += kHex[code & 15];
            continue;
        }
        if (c == '"' || c == '\\') shown += '\\';
        shown += c;
    }
    return shown + '"';
}

}  // namespace

Node no_value() {
    Node node;
    node.kind = NodeKind::kOther;
    node.text = "nothing";
    return node;
}

bool has_value(const Node& node) { return node.kind != NodeKind::kOther; }

Node node_of(bool value) {
    Node node;
    node.kind = NodeKind::kBool;
    node.flag = value;
    return node;
}

Node node_of(std::int64_t value) {
    Node node;
    node.kind = NodeKind::kInteger;
    node.integer = value;
    return node;
}

Node node_of(double value) {
    Node node;
    node.kind = NodeKind::kNumber;
    node.number = value;
    return node;
}

Node node_of(float value) {
    const std::string digits = number_text(value);
    double shortest = 0;
    number_from(digits.data(), digits.data() + digits.size(), shortest);
    return node_of(shortest);
}

Node node_of(const std::string& value) {
    Node node;
    node.kind = NodeKind::kText;
    node.text = value;
    return node;
}

Node node_of(const Double3& value) {
    return node_of(std::array<double, 3>{value.x, value.y, value.z});
}

std::int64_t integer_of(const Node& node) {
    return node.kind == NodeKind::kInteger ? node.integer : static_cast<std::int64_t>(node.number);
}

Double3 number3_of(const Node& node) {
    return {number_of(node.children[0]), number_of(node.children[1]), number_of(node.children[2])};
}

std::array<double, 2> number2_of(const Node& node) {
    return {number_of(node.children[0]), number_of(node.children[1])};
}

bool texts_hold(const Node& node, std::string_view text) {
    for (const Node& child : node.children)
        if (child.text == text) return true;
    return false;
}

std::string toml_text(const Node& node) {
    if (node.is_text()) return toml_string(node.text);
    // A date or a time means what the same text does.
    if (node.kind == NodeKind::kOther && !node.written.empty()) return toml_string(node.written);
    if (node.is_table()) {
        std::string shown = "{";
        for (const Node& child : node.children)
            shown += (shown.size() > 1 ? ", " : " ") + child.key + " = " + toml_text(child);
        return shown + " }";
    }
    if (!node.is_array()) return value_text(node);
    std::string shown = "[";
    for (std::size_t i = 0; i < node.children.size(); ++i)
        shown += (i > 0 ? ", " : "") + toml_text(node.children[i]);
    return shown + "]";
}

namespace {

bool is_table_list(const Node& node) {
    for (const Node& child : node.children)
        if (!child.is_table()) return false;
    return node.is_array() && !node.children.empty();
}

/// By their keys, as the parser has them: what overrides added stands at the end.
std::vector<const Node*> in_order(const Node& table) {
    std::vector<const Node*> members;
    for (const Node& child : table.children) members.push_back(&child);
    std::sort(members.begin(), members.end(),
              [](const Node* a, const Node* b) { return a->key < b->key; });
    return members;
}

std::string members_text(const Node& table) {
    std::string text;
    for (const Node* child : in_order(table)) text += child->key + " = " + toml_text(*child) + '\n';
    return text;
}

}  // namespace

std::string toml_document(const Node& root) {
    std::string values, tables;
    for (const Node* child : in_order(root)) {
        if (child->is_table())
            tables += "\n[" + child->key + "]\n" + members_text(*child);
        else if (!is_table_list(*child))
            values += child->key + " = " + toml_text(*child) + '\n';
        else
            for (const Node& element : child->children)
                tables += "\n[[" + child->key + "]]\n" + members_text(element);
    }
    return values + tables;
}

}  // namespace pileus
