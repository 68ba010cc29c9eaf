// SPDX-License-Identifier: Apache-2.0
// Paths as texts: UTF-8 on Windows, whatever bytes they are elsewhere.
// in: a path, the name of a variable -> out: its parts, its value.
// docs/scene.md, "Files"; docs/windows.md
#pragma once
#include <cstddef>
#include <string>

namespace pileus {

/// Whether it says by itself where it begins: "/a"; on Windows "C:/a", "C:\a" and "\a" as well.
bool is_absolute_path(const std::string& path);

/// Of the path's folder, the last separator included; 0: a name alone.
std::size_t folder_length(const std::string& path);

/// The value of an environment variable; empty where there is none.
std::string environment_text(const char* name);

}  // namespace pileus
