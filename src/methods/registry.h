// SPDX-License-Identifier: Apache-2.0
// The table of methods: a method is its folder and one row here.
// in: a scene, the name of a view -> out: what makes its pictures.
// docs/architecture.md, "Methods"
#pragma once
#include <vector>

#include "src/methods/method.h"
#include "src/methods/method_tools.h"

namespace pileus {

/// A method, and pictures of its steps in place of its result.
struct ListedMethod {
    MethodRow row;
    const ViewRow* views = nullptr;
    int view_count = 0;
    MethodTools tools{};  ///< null members: none
};

/// Every method of this version.
std::vector<ListedMethod> listed_methods();

/// What programs ask of the method of this name; nothing of one that is not in this version.
MethodTools method_tools(const std::string& name);

/// The row of the scene's method. kBadInput: not in this version.
Status find_method(const Scene& scene, MethodRow& row);

/// The row of a view of a method; of any method where `method` is empty. kBadInput: the method
/// has none, or none of that name.
Status find_view(const std::string& method, const std::string& name, MethodRow& row);

/// Names of all views of all methods, separated by commas.
std::string view_names();

}  // namespace pileus
