// SPDX-License-Identifier: Apache-2.0
// The table of methods: a method is its folder and one row here.
// in: a scene -> out: what makes its pictures.
// docs/architecture.md, "Methods"
#pragma once
#include <vector>

#include "src/methods/method.h"
#include "src/methods/method_tools.h"

namespace pileus {

/// A method, and what programs ask of it.
struct ListedMethod {
    MethodRow row;
    MethodTools tools{};  ///< null members: none
};

/// Every method of this version.
std::vector<ListedMethod> listed_methods();

/// What programs ask of the method of this name; nothing of one that is not in this version.
MethodTools method_tools(const std::string& name);

/// The row of the scene's method. kBadInput: not in this version.
Status find_method(const Scene& scene, MethodRow& row);

}  // namespace pileus
