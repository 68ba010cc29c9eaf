// SPDX-License-Identifier: Apache-2.0
// What a key of a scene is: one row, which owns its name, type, unit, range, default and field.
// in: nothing -> out: rows that drive reading, checking, overrides, dumps and docs/scene.md.
// docs/scene.md is made from these rows.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "src/base/span.h"
#include "src/scene/keys/key_field.h"
#include "src/scene/number_keys.h"

namespace pileus {

/// As `fallback` of a row: the key must be given wherever its table is.
constexpr const char* kRequired = "required";
/// As `fallback` of a row: what a key means that is left out is said in its text.
constexpr const char* kNoNote = "";

/// What a value may be: numbers within a range, or one of some texts.
struct Allowed {
    KeyRange range;                 ///< of every number in the value
    const char* choices = nullptr;  ///< parted by '|', in the order of the field's enumeration
    const char* later = nullptr;    ///< texts of the format that this version cannot use
    bool moments = false;           ///< a date or a time may stand without quotes
};

constexpr Allowed any() { return {}; }
constexpr Allowed moment_text() { return {{}, nullptr, nullptr, true}; }
constexpr Allowed from_to(double low, double high) { return {{low, high}}; }
/// What hosts may set, too.
template <class Of, class Value>
constexpr Allowed ranged(Value Of::*member) {
    return {range_of(member)};
}
/// Lengths and factors that must not be 0.
constexpr Allowed positive(double high) { return from_to(kMinPositive, high); }
constexpr Allowed one_of(const char* choices, const char* later = nullptr) {
    return {{}, choices, later};
}
/// What one_of takes, made of the names of rows: more than there is room for do not compile.
struct JoinedNames {
    char text[256] = {};
    int end = 0;

    constexpr void add(const char* name) {
        if (end > 0) text[end++] = '|';
        for (const char* c = name; *c != 0; ++c) text[end++] = *c;
    }
};

struct KeyRow;

/// Of a list of tables: the keys of one of them, without its path.
struct RowList {
    Span<const KeyRow> (*keys)();
    /// Key, a number, that is more in each table than in the one before; null: none is.
    const char* rising;
    std::size_t least, most;  ///< tables
};

struct KeyRow {
    const char* path;  ///< e.g. "camera.fov_deg"; an index into an array of tables is "N"
    KeyField field;
    Allowed allowed;
    const char* unit;
    const char* help;
    const char* fallback = nullptr;  ///< null: the default is that of the field in a new Scene
    const RowList* list = nullptr;   ///< of kRows

    /// A flag that is written as one of two texts is a choice.
    constexpr KeyKind kind() const {
        const bool choice = field.kind == KeyKind::kBool && allowed.choices != nullptr;
        return choice ? KeyKind::kChoice : field.kind;
    }
    bool required() const { return fallback != nullptr && fallback == std::string_view(kRequired); }
};

/// The value of a row's field, as it would be written; `kOther` where there is none.
Node value_of(const KeyRow& row, const KeySource& source);
/// The value that the field has in a new Scene.
Node default_value(const KeyRow& row);
/// Puts a checked value into the row's field; nothing where the row has none.
void set_value(const KeyRow& row, const KeyTarget& target, const Node& node);

/// What a row allows, in words: "number in [1e-06, 180)", "best, paper".
std::string allowed_text(const KeyRow& row);

/// Elements of a list parted by '|', and the place of one of them; -1 where it is none.
std::vector<std::string_view> split_list(const char* list);
int place_in(const char* list, std::string_view text);
/// A choice as a text; flags are "true" and "false".
std::string choice_text(const Node& node);

}  // namespace pileus
