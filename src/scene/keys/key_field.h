// SPDX-License-Identifier: Apache-2.0
// Binds a key to the member of the Scene that it sets, by pointers to members.
// in: members -> out: the kind of the value, and functions that read and write it.
// The kind follows from the member's type; what a kind may hold: docs/scene.md.
#pragma once
#include <type_traits>

#include "src/scene/keys/key_value.h"
#include "src/scene/scene.h"

namespace pileus {

enum class KeyKind {
    kBool,
    kInteger,
    kInteger2,
    kInteger3,
    kInteger4,
    kNumber,
    kNumber2,
    kNumber3,
    kColor,        ///< a number, or three for red, green, blue
    kBounds,       ///< two corners of a box
    kRectangle,    ///< two corners on the map
    kText,         ///< with choices: one of them
    kTexts,        ///< list of texts
    kChoice,       ///< one of the row's texts; the field holds its place among them
    kIndexOrText,  ///< a whole number or a text
    kDensity,      ///< a text or a table
    kRows,         ///< a list of tables, whose keys have rows of their own
    kTable,        ///< a table whose contents are left alone
    kLater,        ///< a key of the format that this version cannot use
};

/// Numbers of a value of that kind; 0: it is no number, or may be something else.
constexpr int numbers_of(KeyKind kind) {
    switch (kind) {
        case KeyKind::kNumber:
        case KeyKind::kInteger:
            return 1;
        case KeyKind::kNumber2:
        case KeyKind::kInteger2:
            return 2;
        case KeyKind::kNumber3:
        case KeyKind::kInteger3:
        case KeyKind::kColor:
            return 3;
        case KeyKind::kInteger4:
        case KeyKind::kRectangle:
            return 4;
        case KeyKind::kBounds:
            return 6;
        default:
            return 0;
    }
}

/// Where values stand: in the scene, or in the element of a list that the path's N counts.
struct KeyTarget {
    Scene& scene;
    MediumSettings& medium;
    SolidSettings& solid;
    LightSettings& light;
};
struct KeySource {
    const Scene& scene;
    const MediumSettings& medium;
    const SolidSettings& solid;
    const LightSettings& light;
};

struct KeyField {
    KeyKind kind;
    Node (*get)(const KeySource&) = nullptr;  ///< null: there is no field
    void (*set)(const KeyTarget&, const Node&) = nullptr;

    constexpr KeyField(KeyKind of) : kind(of) {}
    constexpr KeyField(KeyKind of, Node (*read)(const KeySource&),
                       void (*write)(const KeyTarget&, const Node&))
        : kind(of), get(read), set(write) {}
};

namespace key_field {

template <class Value>
inline constexpr KeyKind kKind = KeyKind::kChoice;  // enumerations
template <>
inline constexpr KeyKind kKind<bool> = KeyKind::kBool;
template <>
inline constexpr KeyKind kKind<int> = KeyKind::kInteger;
template <>
inline constexpr KeyKind kKind<std::int64_t> = KeyKind::kInteger;
template <>
inline constexpr KeyKind kKind<std::array<int, 2>> = KeyKind::kInteger2;
template <>
inline constexpr KeyKind kKind<std::array<int, 3>> = KeyKind::kInteger3;
template <>
inline constexpr KeyKind kKind<std::array<int, 4>> = KeyKind::kInteger4;
template <>
inline constexpr KeyKind kKind<double> = KeyKind::kNumber;
template <>
inline constexpr KeyKind kKind<std::array<double, 2>> = KeyKind::kNumber2;
template <>
inline constexpr KeyKind kKind<Double3> = KeyKind::kNumber3;
template <>
inline constexpr KeyKind kKind<Float3> = KeyKind::kColor;
template <>
inline constexpr KeyKind kKind<std::array<Double3, 2>> = KeyKind::kBounds;
template <>
inline constexpr KeyKind kKind<std::array<std::array<double, 2>, 2>> = KeyKind::kRectangle;
template <>
inline constexpr KeyKind kKind<std::string> = KeyKind::kText;
template <>
inline constexpr KeyKind kKind<std::vector<std::string>> = KeyKind::kTexts;

template <class Places>
auto& root(const Places& places, const Description*) {
    return places.scene;
}
template <class Places>
auto& root(const Places& places, const FrameState*) {
    return places.scene;
}
template <class Places>
auto& root(const Places& places, const MethodTables*) {
    return places.scene;
}
template <class Places>
auto& root(const Places& places, const MediumSettings*) {
    return places.medium;
}
template <class Places>
auto& root(const Places& places, const SolidSettings*) {
    return places.solid;
}
template <class Places>
auto& root(const Places& places, const LightSettings*) {
    return places.light;
}

template <class Class, class Value>
Class class_of(Value Class::*);

template <auto First, auto... Rest, class From>
auto& follow(From& from) {
    if constexpr (sizeof...(Rest) == 0)
        return from.*First;
    else
        return follow<Rest...>(from.*First);
}

template <auto First, auto... Rest>
struct Member {
    template <class Places>
    static auto& in(const Places& places) {
        const decltype(class_of(First))* which = nullptr;
        return follow<First, Rest...>(root(places, which));
    }
    using Value = std::decay_t<decltype(in(std::declval<const KeyTarget&>()))>;

    static Node get(const KeySource& source) { return node_of(in(source)); }
    static void set(const KeyTarget& target, const Node& node) { take(node, in(target)); }
};

}  // namespace key_field

/// The field that a chain of members leads to: field<&Scene::camera, &Camera::fov_deg>.
template <auto... Members>
constexpr KeyField field{key_field::kKind<typename key_field::Member<Members...>::Value>,
                         key_field::Member<Members...>::get, key_field::Member<Members...>::set};

}  // namespace pileus
