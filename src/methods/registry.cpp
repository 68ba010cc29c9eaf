// SPDX-License-Identifier: Apache-2.0
// See registry.h.
#include "src/methods/registry.h"

#include "src/methods/collectors/collectors_method.h"
#include "src/methods/march/march_method.h"
#include "src/methods/particles/particles_method.h"
#include "src/methods/path/path_method.h"
#include "src/methods/photon_grid/photon_grid_method.h"

namespace pileus {
namespace {

void append(const std::string& name, std::string& names) {
    names += (names.empty() ? "" : ", ") + name;
}

}  // namespace

std::vector<ListedMethod> listed_methods() {
    return {{collectors_row(), collectors_tools},   {path_row(), path_tools},
            {raymarch_row(), raymarch_tools},       {optical_depth_row(), optical_depth_tools},
            {photon_grid_row(), photon_grid_tools}, {particles_row()}};
}

MethodTools method_tools(const std::string& name) {
    for (const ListedMethod& listed : listed_methods())
        if (name == listed.row.name) return listed.tools;
    return {};
}

Status find_method(const Scene& scene, MethodRow& row) {
    std::string names;
    for (const ListedMethod& listed : listed_methods()) {
        row = listed.row;
        if (scene.method == row.name) return Status::ok();
        append(row.name, names);
    }
    return Status::bad_input(scene.file + ": method.name: not in this version, \"" + scene.method +
                             "\", allowed: " + names);
}

}  // namespace pileus
