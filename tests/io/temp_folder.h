// SPDX-License-Identifier: Apache-2.0
// A folder of its own for a test, removed with its owner.
// in: nothing -> out: paths in a fresh empty folder, and helpers to fill and count it.
// docs/testing.md
#pragma once
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace pileus {
namespace test {

class TempFolder {
public:
    TempFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "pileus-XXXXXX").string();
        path_ = mkdtemp(name.data()) != nullptr ? name : std::string();
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;
    ~TempFolder() {
        std::error_code ignored;
        if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
    }

    std::string path(const std::string& name) const { return path_ + '/' + name; }

    std::string put(const std::string& name, const std::string& bytes) const {
        std::ofstream(path(name), std::ios::binary) << bytes;
        return path(name);
    }
    std::string get(const std::string& name) const {
        std::ifstream file(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    }
    /// Entries of every kind, at any depth.
    long entries() const {
        namespace fs = std::filesystem;
        return std::distance(fs::recursive_directory_iterator(path_), {});
    }

private:
    std::string path_;
};

inline bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace test
}  // namespace pileus
