// SPDX-License-Identifier: Apache-2.0
// See registry.h.
#include "src/methods/registry.h"

#include "src/methods/collectors/views/views.h"
#include "src/methods/march/march_method.h"
#include "src/methods/particles/particles_method.h"
#include "src/methods/path/path_method.h"
#include "src/methods/photon_grid/photon_grid_method.h"

namespace pileus {
namespace {

void append(const std::string& name, std::string& names) {
    names += (names.empty() ? "" : ", ") + name;
}

std::string names_of_views(const ListedMethod& listed) {
    std::string names;
    for (int i = 0; i < listed.view_count; ++i) append(listed.views[i].name, names);
    return names;
}

}  // namespace

std::vector<ListedMethod> listed_methods() {
    ListedMethod collectors{collectors_row()};
    collectors.views = collectors_views(collectors.view_count);
    ListedMethod photon_grid{photon_grid_row()};
    photon_grid.views = photon_grid_views(photon_grid.view_count);
    collectors.tools = collectors_tools;
    photon_grid.tools = photon_grid_tools;
    return {collectors,
            {path_row(), nullptr, 0, path_tools},
            {raymarch_row(), nullptr, 0, raymarch_tools},
            {optical_depth_row(), nullptr, 0, optical_depth_tools},
            photon_grid,
            {particles_row()}};
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

Status find_view(const std::string& method, const std::string& name, MethodRow& row) {
    std::string with_views, views;
    for (const ListedMethod& listed : listed_methods()) {
        if (listed.view_count == 0) continue;
        append(listed.row.name, with_views);
        if (!method.empty() && method != listed.row.name) continue;
        append(names_of_views(listed), views);
        for (int i = 0; i < listed.view_count; ++i) {
            row = listed.row;
            row.name = listed.views[i].name;
            row.make = listed.views[i].make;
            row.shows_light = listed.views[i].shows_light;
            if (name == row.name) return Status::ok();
        }
    }
    if (views.empty())
        return Status::bad_input("--show: not for method " + method +
                                 ", allowed: method.name = \"" + with_views + "\"");
    return Status::bad_input("--show: no such view, \"" + name + "\", allowed: " + views);
}

std::string view_names() {
    std::string names;
    for (const ListedMethod& listed : listed_methods())
        if (listed.view_count > 0) append(names_of_views(listed), names);
    return names;
}

}  // namespace pileus
