// SPDX-License-Identifier: Apache-2.0
// The methods that a scene may name: those with keys, each with its table, and those without any.
// in: checked values <-> out: Scene::method.
// docs/scene.md.
#include <array>
#include <utility>

#include "src/methods/support.h"
#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

constexpr MethodKeys kMethods[] = {
    {"collectors", collectors_keys},   {"path", path_keys},
    {"raymarch", raymarch_keys},       {"optical-depth", optical_depth_keys},
    {"photon-grid", photon_grid_keys}, {"particles", particles_keys}};

/// Methods that the format names and this version has not: their tables are left alone.
constexpr std::array<const char*, 0> kLater{};

constexpr bool same_method(const char* a, const char* b) {
    while (*a != 0 && *a == *b) ++a, ++b;
    return *a == *b;
}
constexpr bool has_key_table(const char* name) {
    for (const MethodKeys& method : kMethods)
        if (same_method(method.name, name)) return true;
    return false;
}

constexpr JoinedNames names_now() {
    JoinedNames names;
    for (const MethodKeys& method : kMethods) names.add(method.name);
    for (const ColumnRow& column : kColumnRows)
        if (column.method && !has_key_table(column.name)) names.add(column.name);
    return names;
}
constexpr JoinedNames names_later() {
    JoinedNames names;
    for (const char* name : kLater) names.add(name);
    return names;
}
constexpr JoinedNames kNowText = names_now(), kLaterText = names_later();

template <std::size_t... kPlaces>
constexpr std::array<KeyRow, sizeof...(kPlaces)> later_rows(std::index_sequence<kPlaces...>) {
    return {KeyRow{kLater[kPlaces], KeyKind::kTable, any(), "", "settings of a later method",
                   kNoNote}...};
}

}  // namespace

Span<const MethodKeys> all_methods() { return {kMethods, sizeof kMethods / sizeof kMethods[0]}; }

Span<const KeyRow> method_keys() {
    static constexpr KeyRow row{"method.name", field<&Scene::method>,
                                one_of(kNowText.text, kLaterText.text), "",
                                "how the light is computed; each method has a table of its own "
                                "name, and the tables of other methods are left alone"};
    return {&row, 1};
}

Span<const KeyRow> later_keys() {
    static constexpr auto rows = later_rows(std::make_index_sequence<kLater.size()>());
    return {rows.data(), rows.size()};
}

}  // namespace pileus
