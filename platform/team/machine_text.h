// SPDX-License-Identifier: Apache-2.0
// What the system says of a process, as text.
// in: a file of /proc or /sys -> out: all of it; empty where there is none.
#pragma once
#include <cstdio>
#include <string>

namespace pileus {

inline std::string machine_text(const std::string& path) {
    std::string text;
    if (std::FILE* file = std::fopen(path.c_str(), "re")) {
        char block[4096];
        for (std::size_t got; (got = std::fread(block, 1, sizeof block, file)) > 0;)
            text.append(block, got);
        (void)std::fclose(file);
    }
    return text;
}

}  // namespace pileus
