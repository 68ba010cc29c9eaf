// SPDX-License-Identifier: Apache-2.0
// Pictures of a method's steps in place of its result: which there are.
// in: the name of a view -> out: what makes it, for RenderOptions::find_view.
// docs/how-it-works.md
#pragma once
#include <string>

#include "src/methods/method.h"

namespace pileus {

/// A picture of a method's steps in place of its result, made from copies of its settings.
struct ViewRow {
    const char* name = "";
    bool shows_light = false;  ///< as of a MethodRow
    MadeMethod (*make)(const MethodInputs&) = nullptr;
};

/// The row of a view of a method; of any method where `method` is empty. kBadInput: the method
/// has none, or none of that name.
Status find_view(const std::string& method, const std::string& name, MethodRow& row);

/// Names of all views of all methods, separated by commas.
std::string view_names();

/// Those of a method, in the order of messages.
const ViewRow* collectors_views(int& count);
const ViewRow* photon_grid_views(int& count);

}  // namespace pileus
