// SPDX-License-Identifier: Apache-2.0
// Runs a fuzz target over stored inputs where libFuzzer is not there.
// in: a target's name, files and folders -> out: exit 0 and the number of inputs; 2 where there are
// none. docs/testing.md, section Fuzzing
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerInitialize(int* count, char*** words);

int main(int count, char** words) {
    LLVMFuzzerInitialize(&count, &words);
    namespace fs = std::filesystem;
    std::vector<fs::path> files;
    for (int i = 1; i < count; ++i) {
        if (!fs::is_directory(words[i])) files.emplace_back(words[i]);
        if (fs::is_directory(words[i]))
            for (const auto& entry : fs::recursive_directory_iterator(words[i]))
                if (entry.is_regular_file()) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    if (files.empty()) {
        std::fprintf(stderr, "replay: no inputs, allowed: files or folders that hold some\n");
        return 2;
    }
    for (const fs::path& path : files) {
        std::ifstream file(path, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(file), {}};
        if (!file) {
            std::fprintf(stderr, "replay: %s: cannot read\n", path.c_str());
            return 2;
        }
        // Name the input before it runs, so that a crash is known by its last line.
        std::printf("%s\n", path.c_str());
        std::fflush(stdout);
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }
    std::printf("replayed %zu inputs\n", files.size());
    return 0;
}
