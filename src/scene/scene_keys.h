// SPDX-License-Identifier: Apache-2.0
// The table of every key a scene may hold: one row drives the reader and the documentation.
// in: nothing -> out: rows with type, unit, default, range and what the key sets in a Scene.
// docs/scene.md is made from this table.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "src/base/span.h"
#include "src/scene/scene.h"
#include "src/scene/toml_tree.h"

namespace pileus {

/// Methods this version can run, and all names that a scene may use; parted by '|'.
constexpr const char* kAvailableMethods = "collectors|path|raymarch";
constexpr const char* kKnownMethods =
    "collectors|raymarch|optical-depth|photon-grid|particles|path";

/// As `fallback` of a row: the key must be given wherever its table is.
constexpr const char* kRequired = "required";

enum class KeyKind {
    kBool,
    kInteger,
    kInteger2,
    kInteger3,
    kNumber,
    kNumber2,
    kNumber3,
    kColor,    ///< a number, or three for red, green, blue
    kBounds,   ///< two corners of a box
    kText,     ///< with `choices`: one of them
    kTexts,    ///< list of texts
    kDensity,  ///< a text or a table
    kTable,    ///< a table whose contents are left alone
    kLater,    ///< a key of the format that this version cannot use
};

struct KeyRange {
    double low = 0, high = 0;
    bool low_open = false, high_open = false;
};

struct KeyTarget {
    Scene& scene;
    MediumSettings& medium;
    SolidSettings& solid;
};

struct KeyRow {
    const char* path;  ///< e.g. "camera.fov_deg"; an index into an array of tables is "N"
    KeyKind kind;
    const char* unit;
    const char* fallback;  ///< default as TOML; kRequired; empty: see help
    KeyRange range;        ///< of every number in the value
    const char* choices;   ///< allowed texts, parted by '|'; null: any
    const char* later;     ///< texts of the format that this version cannot use
    const char* help;
    void (*set)(const Node&, KeyTarget);  ///< called with a checked value; null: set elsewhere
};

/// All rows in the order of the documentation.
std::vector<const KeyRow*> all_scene_keys();

/// What a row allows, in words: "number in (0, 180)", "one of best, paper".
std::string allowed_text(const KeyRow& row);

/// Elements of a list parted by '|'.
std::vector<std::string_view> split_list(const char* list);

/// The tables of docs/scene.md as Markdown, one for each section of a scene.
std::string describe_keys_markdown();

Span<const KeyRow> view_keys();      // seed, camera, sun, sky, ground
Span<const KeyRow> solid_keys();     // solid
Span<const KeyRow> medium_keys();    // medium
Span<const KeyRow> sky_keys();       // medium.sky
Span<const KeyRow> method_keys();    // method, collectors, path
Span<const KeyRow> raymarch_keys();  // raymarch
Span<const KeyRow> output_keys();    // tables of later methods, output, animation

/// Conversions for the setters; the node has been checked against its row.
std::int64_t integer_of(const Node& node);
std::array<double, 3> number3_of(const Node& node);
std::array<double, 2> number2_of(const Node& node);
std::array<float, 3> color_of(const Node& node);
bool texts_hold(const Node& node, std::string_view text);

/// Row makers: a key with a range, with a choice of texts, with neither, of a later version.
constexpr KeyRow range_key(KeyKind kind, const char* path, const char* unit, const char* fallback,
                           KeyRange range, const char* help, void (*set)(const Node&, KeyTarget)) {
    return {path, kind, unit, fallback, range, nullptr, nullptr, help, set};
}
constexpr KeyRow choice_key(KeyKind kind, const char* path, const char* fallback,
                            const char* choices, const char* later, const char* help,
                            void (*set)(const Node&, KeyTarget)) {
    return {path, kind, "", fallback, {}, choices, later, help, set};
}
constexpr KeyRow plain_key(KeyKind kind, const char* path, const char* fallback, const char* help,
                           void (*set)(const Node&, KeyTarget)) {
    return {path, kind, "", fallback, {}, nullptr, nullptr, help, set};
}
constexpr KeyRow later_key(const char* path, const char* help) {
    return {path, KeyKind::kLater, "", "", {}, nullptr, nullptr, help, nullptr};
}

}  // namespace pileus
