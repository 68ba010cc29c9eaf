// SPDX-License-Identifier: Apache-2.0
// The methods that a scene may name, each with the keys of its table.
// in: checked values <-> out: Scene::method.
// docs/scene.md.
#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

constexpr MethodKeys kMethods[] = {
    {"collectors", collectors_keys}, {"path", path_keys},      {"raymarch", raymarch_keys},
    {"optical-depth", nullptr},      {"photon-grid", nullptr}, {"particles", nullptr},
};

/// Names of the methods of this version, or of the others, parted by '|'.
std::string names_of(bool now) {
    std::string names;
    for (const MethodKeys& method : kMethods)
        if ((method.rows != nullptr) == now)
            names += (names.empty() ? "" : "|") + std::string(method.name);
    return names;
}

}  // namespace

Span<const MethodKeys> all_methods() { return {kMethods, sizeof kMethods / sizeof kMethods[0]}; }

Span<const KeyRow> method_keys() {
    static const std::string now = names_of(true), later = names_of(false);
    static const KeyRow row{"method.name", field<&Scene::method>,
                            one_of(now.c_str(), later.c_str()), "",
                            "how the light is computed; each method has a table of its own name, "
                            "and the tables of other methods are left alone"};
    return {&row, 1};
}

Span<const KeyRow> later_keys() {
    static const std::vector<KeyRow> rows = [] {
        std::vector<KeyRow> tables;
        for (const MethodKeys& method : kMethods)
            if (method.rows == nullptr)
                tables.push_back(
                    {method.name, KeyKind::kTable, any(), "", "settings of a later method", kNone});
        return tables;
    }();
    return {rows.data(), rows.size()};
}

}  // namespace pileus
