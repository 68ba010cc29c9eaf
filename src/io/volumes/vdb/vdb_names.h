// SPDX-License-Identifier: Apache-2.0
// Names of the grids of one file, several of which may be the same.
// in: names in the order of the file -> out: labels that differ; the grids that a word means.
// OpenVDB 10.0.1, openvdb/io/GridDescriptor.cc; docs/formats.md, "OpenVDB"
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace pileus {

struct VdbName {
    std::string name, type;  ///< as people know them
    bool is_number = false;
    std::int64_t number = -1;  ///< of grids of one name, as the file states it; -1: not stated
    std::string label;         ///< "density", or of several "density[1]"
};

/// Sets the labels. Where the file states no number, it is that of the order.
void label_vdb_names(std::vector<VdbName>& names);

/// Which grids `wanted` means, the likeliest first: those of this name, else the one of this label.
/// Without a word those of numbers: "density", and then all in their order.
std::vector<std::size_t> vdb_choices(const std::vector<VdbName>& names, const std::string& wanted);

/// "\"density\" (float), \"v\" (vec3s)", or "none"; beyond 16 of them only a word.
std::string vdb_name_list(const std::vector<VdbName>& names);

}  // namespace pileus
