// SPDX-License-Identifier: Apache-2.0
// See vdb_names.h.
#include "src/io/volumes/vdb/vdb_names.h"

#include <map>

#include "src/scene/toml/toml_tree.h"

namespace pileus {

void label_vdb_names(std::vector<VdbName>& names) {
    std::map<std::string, std::int64_t> count, seen;
    for (const VdbName& grid : names) ++count[grid.name];
    for (VdbName& grid : names) {
        const std::int64_t number = grid.number >= 0 ? grid.number : seen[grid.name];
        ++seen[grid.name];
        grid.label = grid.name;
        if (count[grid.name] > 1) grid.label += '[' + std::to_string(number) + ']';
    }
}

std::vector<std::size_t> vdb_choices(const std::vector<VdbName>& names, const std::string& wanted) {
    const auto all = [&](auto&& is_meant) {
        std::vector<std::size_t> found;
        for (std::size_t i = 0; i < names.size(); ++i)
            if (is_meant(names[i])) found.push_back(i);
        return found;
    };
    if (wanted.empty()) {
        const auto is_density = [](const VdbName& grid) { return grid.name == "density"; };
        std::vector<std::size_t> found =
            all([&](const VdbName& grid) { return grid.is_number && is_density(grid); });
        for (const std::size_t i :
             all([&](const VdbName& grid) { return grid.is_number && !is_density(grid); }))
            found.push_back(i);
        return found;
    }
    const std::vector<std::size_t> named =
        all([&](const VdbName& grid) { return grid.name == wanted; });
    if (!named.empty()) return named;
    // "density[0]" of a file with one grid called so is that one, as in OpenVDB.
    return all([&](const VdbName& grid) {
        return grid.label == wanted || (grid.label == grid.name && grid.label + "[0]" == wanted);
    });
}

std::string vdb_name_list(const std::vector<VdbName>& names) {
    constexpr std::size_t kShown = 16;
    std::string list;
    for (std::size_t i = 0; i < names.size() && i < kShown; ++i)
        list += (i > 0 ? ", " : "") + quote_text(names[i].label) + " (" + names[i].type + ")";
    if (names.size() > kShown) list += ", and others";
    return list.empty() ? "none" : list;
}

}  // namespace pileus
