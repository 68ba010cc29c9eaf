// SPDX-License-Identifier: Apache-2.0
// Texts for std::filesystem, which takes plain ones on Windows for some code page's.
// in: a path as text -> out: the same for the library, and back, with '/' between names.
#pragma once
#include <filesystem>
#include <string>

namespace pileus {

std::filesystem::path path_of(const std::string& text);
std::string path_text(const std::filesystem::path& path);

}  // namespace pileus
