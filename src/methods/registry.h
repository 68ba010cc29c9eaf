// SPDX-License-Identifier: Apache-2.0
// The table of methods: a method is its folder and one row here.
// in: a scene, the name of a view -> out: the recipe to run.
// docs/architecture.md, "Methods are recipes".
#pragma once
#include <vector>

#include "src/methods/method_tools.h"
#include "src/methods/methods.h"

namespace pileus {

/// A method, and pictures of its steps in place of its result: recipes too, without an `outline`.
struct MethodRow {
    const Method* method = nullptr;
    const Method* views = nullptr;
    int view_count = 0;
    MethodTools tools{};  ///< null members: none
};

/// Every method of this version.
std::vector<MethodRow> method_rows();

/// What programs ask of the method of this name; nothing of one that is not in this version.
MethodTools method_tools(const std::string& name);

/// The recipe of the scene's method. kBadInput: not in this version.
Status find_method(const Scene& scene, const Method*& method);

/// The recipe of a view of a method; of any method where `method` is empty. kBadInput: the method
/// has none, or none of that name.
Status find_view(const std::string& method, const std::string& name, const Method*& view);

/// Names of all views of all methods, separated by commas.
std::string view_names();

}  // namespace pileus
