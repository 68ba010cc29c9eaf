// SPDX-License-Identifier: Apache-2.0
// See registry.h.
#include "src/methods/registry.h"

#include "src/methods/collectors/collectors.h"
#include "src/methods/collectors/views/views.h"
#include "src/methods/optical_depth/optical_depth.h"
#include "src/methods/particles/particles_method.h"
#include "src/methods/path/path.h"
#include "src/methods/photon_grid/photon_grid.h"
#include "src/methods/raymarch/raymarch.h"

namespace pileus {
namespace {

void append(const std::string& name, std::string& names) {
    names += (names.empty() ? "" : ", ") + name;
}

std::string names_of_views(const MethodRow& row) {
    std::string names;
    for (int i = 0; i < row.view_count; ++i) append(row.views[i].name, names);
    return names;
}

}  // namespace

std::vector<MethodRow> method_rows() {
    MethodRow collectors{&collectors_method()};
    collectors.views = collectors_views(collectors.view_count);
    MethodRow photon_grid{&photon_grid_method()};
    photon_grid.views = photon_grid_views(photon_grid.view_count);
    collectors.tools = collectors_tools;
    photon_grid.tools = photon_grid_tools;
    return {collectors,
            {&path_method(), nullptr, 0, path_tools},
            {&raymarch_method(), nullptr, 0, raymarch_tools},
            {&optical_depth_method(), nullptr, 0, optical_depth_tools},
            photon_grid,
            {&particles_method()}};
}

MethodTools method_tools(const std::string& name) {
    for (const MethodRow& row : method_rows())
        if (name == row.method->name) return row.tools;
    return {};
}

Status find_method(const Scene& scene, const Method*& method) {
    std::string names;
    for (const MethodRow& row : method_rows()) {
        method = row.method;
        if (scene.method == method->name) return Status::ok();
        append(method->name, names);
    }
    return Status::bad_input(scene.file + ": method.name: not in this version, \"" + scene.method +
                             "\", allowed: " + names);
}

Status find_view(const std::string& method, const std::string& name, const Method*& view) {
    std::string with_views, views;
    for (const MethodRow& row : method_rows()) {
        if (row.view_count == 0) continue;
        append(row.method->name, with_views);
        if (!method.empty() && method != row.method->name) continue;
        append(names_of_views(row), views);
        for (int i = 0; i < row.view_count; ++i) {
            view = &row.views[i];
            if (name == view->name) return Status::ok();
        }
    }
    if (views.empty())
        return Status::bad_input("--show: not for method " + method +
                                 ", allowed: method.name = \"" + with_views + "\"");
    return Status::bad_input("--show: no such view, \"" + name + "\", allowed: " + views);
}

std::string view_names() {
    std::string names;
    for (const MethodRow& row : method_rows())
        if (row.view_count > 0) append(names_of_views(row), names);
    return names;
}

}  // namespace pileus
