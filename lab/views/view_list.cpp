// SPDX-License-Identifier: Apache-2.0
// See view_list.h.
#include "lab/views/view_list.h"

#include <array>

#include "src/methods/collectors/collectors_method.h"
#include "src/methods/photon_grid/photon_grid_method.h"

namespace pileus {
namespace {

/// A method with its views.
struct Viewed {
    MethodRow row;
    const ViewRow* views = nullptr;
    int count = 0;
};

std::array<Viewed, 2> methods_with_views() {
    std::array<Viewed, 2> all{{{collectors_row()}, {photon_grid_row()}}};
    all[0].views = collectors_views(all[0].count);
    all[1].views = photon_grid_views(all[1].count);
    return all;
}

void append(const std::string& name, std::string& names) {
    names += (names.empty() ? "" : ", ") + name;
}

std::string names_of_views(const Viewed& listed) {
    std::string names;
    for (int i = 0; i < listed.count; ++i) append(listed.views[i].name, names);
    return names;
}

}  // namespace

Status find_view(const std::string& method, const std::string& name, MethodRow& row) {
    std::string with_views, views;
    for (const Viewed& listed : methods_with_views()) {
        append(listed.row.name, with_views);
        if (!method.empty() && method != listed.row.name) continue;
        append(names_of_views(listed), views);
        for (int i = 0; i < listed.count; ++i) {
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
    for (const Viewed& listed : methods_with_views()) append(names_of_views(listed), names);
    return names;
}

}  // namespace pileus
