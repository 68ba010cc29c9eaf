// SPDX-License-Identifier: Apache-2.0
// Values of scene keys as nodes of a tree, and back.
// in: a field's value -> out: a node; in: a node that was checked -> out: the value.
// docs/scene.md, "Keys".
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "src/base/vectors.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {

/// Stands for a value that is not there.
Node no_value();
bool has_value(const Node& node);

Node node_of(bool value);
Node node_of(std::int64_t value);
Node node_of(double value);
/// The double of the shortest decimal text, so that 0.2f is written 0.2.
Node node_of(float value);
Node node_of(const std::string& value);
Node node_of(const Double3& value);
inline Node node_of(int value) { return node_of(std::int64_t{value}); }
/// As a member of a table.
inline Node named(const char* name, Node node) {
    node.key = name;
    return node;
}

/// Enumerations as their number, lists element by element.
template <class Enum, std::enable_if_t<std::is_enum_v<Enum>, int> = 0>
Node node_of(Enum value) {
    return node_of(std::int64_t(value));
}
template <class List, class = typename List::value_type, class = decltype(List().begin())>
Node node_of(const List& list) {
    Node node;
    node.kind = NodeKind::kArray;
    for (const auto& value : list) node.children.push_back(node_of(value));
    return node;
}

std::int64_t integer_of(const Node& node);
std::array<double, 2> number2_of(const Node& node);
Double3 number3_of(const Node& node);
bool texts_hold(const Node& node, std::string_view text);

inline void take(const Node& node, bool& value) { value = node.flag; }
inline void take(const Node& node, std::int64_t& value) { value = integer_of(node); }
inline void take(const Node& node, int& value) { value = static_cast<int>(integer_of(node)); }
inline void take(const Node& node, double& value) { value = number_of(node); }
inline void take(const Node& node, float& value) { value = static_cast<float>(number_of(node)); }
inline void take(const Node& node, std::string& value) {
    value = node.written.empty() ? node.text : node.written;
}
inline void take(const Node& node, std::vector<std::string>& value) {
    value.clear();
    for (const Node& child : node.children) value.push_back(child.text);
}
template <class Enum, std::enable_if_t<std::is_enum_v<Enum>, int> = 0>
void take(const Node& node, Enum& value) {
    value = static_cast<Enum>(node.integer);
}
inline void take(const Node& node, Double3& value) { value = number3_of(node); }
/// One number stands for all of a colour's.
template <class Value, std::size_t N>
void take(const Node& node, std::array<Value, N>& values) {
    for (std::size_t i = 0; i < N; ++i) take(node.is_array() ? node.children[i] : node, values[i]);
}

/// A whole value as TOML, on one line.
std::string toml_text(const Node& node);
/// A document: values first, then each table and each list of tables.
std::string toml_document(const Node& root);

}  // namespace pileus
