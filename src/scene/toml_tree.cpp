// SPDX-License-Identifier: Apache-2.0
// Turns TOML into our own tree; the only file that touches the toml++ library.
// in: untrusted text -> out: nodes with line and column, or the first syntax fault.
// TOML 1.0 (https://toml.io/en/v1.0.0); toml++ 3.3, header only, without exceptions.
#include "src/scene/toml_tree.h"

#define TOML_EXCEPTIONS 0
#define TOML_HEADER_ONLY 1
#define TOML_MAX_NESTED_VALUES 64
#include <toml++/toml.h>

#include <charconv>

namespace pileus {
namespace {

constexpr std::size_t kMaxShown = 60;

Place place_of(const toml::source_region& region) {
    Place place;
    place.line = static_cast<int>(region.begin.line);
    place.column = static_cast<int>(region.begin.column);
    return place;
}

void convert(const toml::node& from, Node& to) {
    to.at = place_of(from.source());
    if (const toml::table* table = from.as_table()) {
        to.kind = NodeKind::kTable;
        for (auto&& [key, value] : *table) {
            to.children.emplace_back();
            Node& child = to.children.back();
            child.key = std::string(key.str());
            child.key_at = place_of(key.source());
            convert(value, child);
        }
    } else if (const toml::array* array = from.as_array()) {
        to.kind = NodeKind::kArray;
        to.children.reserve(array->size());
        for (const toml::node& value : *array) {
            to.children.emplace_back();
            convert(value, to.children.back());
            to.children.back().key_at = to.children.back().at;
        }
    } else if (const auto* text = from.as_string()) {
        to.kind = NodeKind::kText;
        to.text = text->get();
    } else if (const auto* integer = from.as_integer()) {
        to.kind = NodeKind::kInteger;
        to.integer = integer->get();
    } else if (const auto* number = from.as_floating_point()) {
        to.kind = NodeKind::kNumber;
        to.number = number->get();
    } else if (const auto* flag = from.as_boolean()) {
        to.kind = NodeKind::kBool;
        to.flag = flag->get();
    } else {
        to.kind = NodeKind::kOther;
        to.text = from.is_time() ? "a time" : "a date";
    }
}

}  // namespace

const Node* Node::find(std::string_view name) const {
    if (kind != NodeKind::kTable) return nullptr;
    for (const Node& child : children)
        if (child.key == name) return &child;
    return nullptr;
}

Node* Node::find(std::string_view name) {
    return const_cast<Node*>(static_cast<const Node*>(this)->find(name));
}

double number_of(const Node& node) {
    return node.kind == NodeKind::kInteger ? static_cast<double>(node.integer) : node.number;
}

std::string number_text(double value) {
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, value);
    return std::string(digits, end.ptr);
}

std::string quote_text(std::string_view text) {
    static const char* const kHex = "0123456789abcdef";
    std::string shown = "\"";
    for (std::size_t i = 0; i < text.size(); ++i) {
        const unsigned char ch = static_cast<unsigned char>(text[i]);
        // Cut between characters only, so that the message stays valid UTF-8.
        if (i >= kMaxShown && (ch & 0xC0) != 0x80) return shown + "...\"";
        if (ch >= 0x20 && ch != 0x7F) {
            shown += text[i];
        } else {
            shown += "\\x";
            shown += kHex[ch >> 4];
            shown += kHex[ch & 15];
        }
    }
    return shown + "\"";
}

std::string value_text(const Node& node) {
    switch (node.kind) {
        case NodeKind::kTable:
            return "a table";
        case NodeKind::kText:
            return quote_text(node.text);
        case NodeKind::kInteger:
            return std::to_string(node.integer);
        case NodeKind::kNumber:
            return number_text(node.number);
        case NodeKind::kBool:
            return node.flag ? "true" : "false";
        case NodeKind::kOther:
            return node.text;
        case NodeKind::kArray:
            break;
    }
    std::string shown = "[";
    for (std::size_t i = 0; i < node.children.size(); ++i) {
        if (i > 0) shown += ", ";
        if (shown.size() > kMaxShown) return shown + "...]";
        shown += value_text(node.children[i]);
    }
    return shown + "]";
}

bool parse_toml(std::string_view text, Node& root, SyntaxFault& fault) {
    if (!nesting_is_bounded(text, fault)) return false;
    const toml::parse_result result = toml::parse(text);
    if (!result) {
        const toml::parse_error& error = result.error();
        const Place place = place_of(error.source());
        fault.line = place.line;
        fault.column = place.column;
        fault.what = std::string(error.description());
        for (char& ch : fault.what)
            if (static_cast<unsigned char>(ch) < 0x20) ch = ' ';
        return false;
    }
    root = Node();
    convert(result.table(), root);
    root.at = Place();
    return true;
}

}  // namespace pileus
