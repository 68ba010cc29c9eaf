// SPDX-License-Identifier: Apache-2.0
// Scenes to start from, each key with its meaning.
// in: a type, or a file of a density -> out: the text of a scene.
// docs/program.md, "new"
#pragma once
#include <string>

#include "src/base/status.h"

namespace pileus {

/// A type a line: its name, what it is.
std::string new_scene_lines();

/// The text of a scene. `type`: a name of the table, or the path of a file with a density, which
/// names start in `folder`; `picture`: name of its picture without an extension. Errors: kBadInput,
/// no such type; those of reading the file.
Status new_scene(const std::string& type, const std::string& folder, const std::string& picture,
                 std::string& text);

/// Whether it is a file that new_scene would read.
bool is_new_scene_file(const std::string& type);

}  // namespace pileus
