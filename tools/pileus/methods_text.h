// SPDX-License-Identifier: Apache-2.0
// The support table as text, as a page and as JSON.
// in: src/methods/support.h -> out: what pileus methods prints.
// docs/program.md, "methods"
#pragma once
#include <string>

#include "src/methods/support.h"

namespace pileus {

/// A row for each feature, a sign for each column.
std::string support_lines();

/// All that one column does, in words.
std::string support_lines_of(MethodColumn column);

/// What docs/support.md has between its marks.
std::string support_markdown();

std::string support_json();

}  // namespace pileus
