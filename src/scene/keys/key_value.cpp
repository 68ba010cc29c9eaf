// SPDX-License-Identifier: Apache-2.0
// See key_value.h.
#include "src/scene/keys/key_value.h"

#include <charconv>

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
    char digits[40];
    double shortest = 0;
    const auto end = std::to_chars(digits, digits + sizeof digits, value);
    std::from_chars(digits, end.ptr, shortest);
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

}  // namespace pileus
