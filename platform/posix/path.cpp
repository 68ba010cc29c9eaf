// SPDX-License-Identifier: Apache-2.0
// See path.h.
#include "platform/path.h"

#include <cstdlib>

#include "platform/fs_path.h"

namespace pileus {

bool is_absolute_path(const std::string& path) { return !path.empty() && path[0] == '/'; }

std::size_t folder_length(const std::string& path) { return path.rfind('/') + 1; }

std::string environment_text(const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr ? value : "";
}

std::filesystem::path path_of(const std::string& text) { return text; }
std::string path_text(const std::filesystem::path& path) { return path.string(); }

}  // namespace pileus
