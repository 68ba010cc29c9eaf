// SPDX-License-Identifier: Apache-2.0
// The methods that a scene may name, each with the keys of its table.
// in: checked values <-> out: Scene::method.
// docs/scene.md.
#include <array>
#include <utility>

#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

constexpr MethodKeys kMethods[] = {
    {"collectors", collectors_keys}, {"path", path_keys},      {"raymarch", raymarch_keys},
    {"optical-depth", nullptr},      {"photon-grid", nullptr}, {"particles", nullptr},
};

/// Names of the methods of this version, or of the others, parted by '|'.
struct Names {
    char text[128] = {};
};
constexpr Names names_of(bool now) {
    Names names;
    int end = 0;
    for (const MethodKeys& method : kMethods) {
        if ((method.rows != nullptr) != now) continue;
        if (end > 0) names.text[end++] = '|';
        for (const char* c = method.name; *c != 0; ++c) names.text[end++] = *c;
    }
    return names;
}
constexpr Names kNow = names_of(true), kLater = names_of(false);

constexpr std::size_t later_count() {
    std::size_t count = 0;
    for (const MethodKeys& method : kMethods) count += method.rows == nullptr ? 1 : 0;
    return count;
}

constexpr const char* later_name(std::size_t place) {
    for (const MethodKeys& method : kMethods)
        if (method.rows == nullptr && place-- == 0) return method.name;
    return nullptr;
}

/// The table of each later method is left alone.
template <std::size_t... kPlaces>
constexpr std::array<KeyRow, sizeof...(kPlaces)> later_rows(std::index_sequence<kPlaces...>) {
    return {{KeyRow{later_name(kPlaces), KeyKind::kTable, any(), "", "settings of a later method",
                    kNone}...}};
}

}  // namespace

Span<const MethodKeys> all_methods() { return {kMethods, sizeof kMethods / sizeof kMethods[0]}; }

Span<const KeyRow> method_keys() {
    static constexpr KeyRow row{"method.name", field<&Scene::method>,
                                one_of(kNow.text, kLater.text), "",
                                "how the light is computed; each method has a table of its own "
                                "name, and the tables of other methods are left alone"};
    return {&row, 1};
}

Span<const KeyRow> later_keys() {
    static constexpr auto rows = later_rows(std::make_index_sequence<later_count()>());
    return {rows.data(), rows.size()};
}

}  // namespace pileus
