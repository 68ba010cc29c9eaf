// SPDX-License-Identifier: Apache-2.0
// A TOML document as a small tree of our own, so that the parser is touched in one file only.
// in: untrusted text -> out: nodes that know where they were written, or the first syntax fault.
// TOML 1.0 (https://toml.io/en/v1.0.0); limits in docs/scene.md.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pileus {

class FaultList;

/// Where a value was written: in the scene file, or in the override with that index.
struct Place {
    int override_index = -1;   ///< -1: the scene file
    int line = 1, column = 1;  ///< line 0: nowhere
};

enum class NodeKind { kTable, kArray, kText, kInteger, kNumber, kBool, kOther };

struct Node {
    NodeKind kind = NodeKind::kTable;
    std::string key;  ///< name within its table; empty for the root and for elements of arrays
    Place key_at, at;
    bool flag = false;
    std::int64_t integer = 0;
    double number = 0;
    std::string text;            ///< kText: the value; kOther: what it is
    std::string written;         ///< kOther: a date or a time without a zone, as texts have it
    std::vector<Node> children;  ///< members of a table, elements of an array

    bool is_table() const { return kind == NodeKind::kTable; }
    bool is_array() const { return kind == NodeKind::kArray; }
    bool is_text() const { return kind == NodeKind::kText; }
    bool is_number() const { return kind == NodeKind::kNumber || kind == NodeKind::kInteger; }

    /// Member of a table by name; null when there is none.
    const Node* find(std::string_view name) const;
    Node* find(std::string_view name);
};

/// Puts a node and all that it holds at one place.
void put_at(Node& node, const Place& place);

/// The number in a kNumber or kInteger node, as it is used: 0 where single precision has no other.
double number_of(const Node& node);

/// A value as one short printable line for messages: at most about 60 bytes, no control characters.
std::string value_text(const Node& node);

/// `text` in double quotes and printable, cut to about 60 bytes.
std::string quote_text(std::string_view text);

struct SyntaxFault {
    int line = 1, column = 1;
    std::string what;
};

/// Parses a whole document. Returns false and fills `fault` at the first syntax fault; text nested
/// deeper than 32 brackets or 32 dots of one key is refused before parsing.
bool parse_toml(std::string_view text, Node& root, SyntaxFault& fault);

/// Looks, without recursion, for what the parser cannot take: nesting beyond the limits, and
/// characters outside ASCII where TOML has none. False and `fault` when found.
bool is_parsable(std::string_view text, SyntaxFault& fault);

/// The key of an override "key.path=value", without blanks around it; all of a text without '='.
std::string_view override_key(std::string_view text);

/// Applies `--set key.path=value` options to a scene's tree before it is checked, in order, and
/// adds what is wrong with them; a later one wins. Tables on the way are made where missing, and so
/// is the next element of `medium`; any other index must exist.
void apply_overrides(const std::vector<std::string>& overrides, Node& root, FaultList& faults);

}  // namespace pileus
