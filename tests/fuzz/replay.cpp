// SPDX-License-Identifier: Apache-2.0
// Runs a fuzz target over stored inputs where libFuzzer is not there, and over changes of them.
// in: a target's name, files and folders, libFuzzer's -runs (0), -max_total_time, -seed, -max_len
// and -artifact_prefix -> out: exit 0 and the number of inputs; 2 where there are none.
// docs/testing.md, section Fuzzing
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerInitialize(int* count, char*** words);

namespace {

namespace fs = std::filesystem;

void run(const std::string& bytes) {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

/// Changes stored inputs at random; unlike libFuzzer it does not know which of them led to new
/// code.
class Changes {
public:
    Changes(const std::vector<std::string>& stored, std::uint64_t seed, std::size_t longest)
        : stored_(stored), longest_(longest), random_(seed) {}

    std::string next() {
        std::string bytes = any();
        for (std::size_t left = 1 + below(4); left > 0; --left) change(bytes);
        if (bytes.size() > longest_) bytes.resize(longest_);
        return bytes;
    }

private:
    std::size_t below(std::size_t count) { return std::size_t(random_() % count); }
    const std::string& any() { return stored_[below(stored_.size())]; }
    /// A place and a length, of which most are short.
    std::pair<std::size_t, std::size_t> span(const std::string& bytes) {
        const std::size_t at = below(bytes.size() + 1);
        const std::size_t most = std::size_t{1} << below(8);
        return {at, std::min(bytes.size() - at, 1 + below(most))};
    }
    void change(std::string& bytes) {
        // Numbers at whose edges readers err: signs, ends of types, counts of nothing.
        constexpr std::uint64_t kNumbers[] = {0,
                                              1,
                                              0x7F,
                                              0x80,
                                              0xFF,
                                              0x7FFF,
                                              0x8000,
                                              0xFFFF,
                                              0x7FFFFFFF,
                                              0x80000000,
                                              0xFFFFFFFF,
                                              0x7F800000,
                                              0x7FC00000,
                                              ~std::uint64_t{0},
                                              std::uint64_t{1} << 63};
        const auto [at, length] = span(bytes);
        switch (below(6)) {
            case 0:
                if (at < bytes.size()) bytes[at] = char(bytes[at] ^ (1 << below(8)));
                break;
            case 1:
                bytes.erase(at, length);
                break;
            case 2:
                bytes.insert(at, bytes.substr(at, length));
                break;
            case 3: {
                std::uint64_t number = kNumbers[below(std::size(kNumbers))];
                const std::size_t width = std::size_t{1} << below(4);
                const bool reversed = below(2) == 1;
                for (std::size_t k = 0; k < width && at + k < bytes.size(); ++k) {
                    const std::size_t digit = reversed ? width - 1 - k : k;
                    bytes[at + k] = char(number >> (8 * digit));
                }
                break;
            }
            case 4: {
                const std::string& other = any();
                const auto [from, count] = span(other);
                bytes.insert(at, other, from, count);
                break;
            }
            default:
                bytes.resize(at);
                break;
        }
    }

    const std::vector<std::string>& stored_;
    std::size_t longest_;
    std::mt19937_64 random_;
};

/// Makes `bytes` all that a file holds.
void keep(int file, const std::string& bytes) {
    if (pwrite(file, bytes.data(), bytes.size(), 0) == ssize_t(bytes.size()) &&
        ftruncate(file, off_t(bytes.size())) == 0)
        return;
    std::fprintf(stderr, "replay: cannot keep a changed input\n");
    std::exit(2);
}

/// What stands after `key` in one of the options, or `fallback`.
std::string value_of(const std::vector<std::string>& options, const std::string& key,
                     const std::string& fallback) {
    for (const std::string& option : options)
        if (option.compare(0, key.size(), key) == 0) return option.substr(key.size());
    return fallback;
}

/// Runs so many changed inputs, and fewer where time ends; their number. Each lies in a file before
/// it runs, so that one that ends the process is kept.
std::size_t search(const std::vector<std::string>& stored,
                   const std::vector<std::string>& options) {
    const auto number = [&](const char* key, const char* fallback) {
        return std::strtoull(value_of(options, key, fallback).c_str(), nullptr, 10);
    };
    const std::size_t most = number("-runs=", "0");
    if (most == 0) return 0;
    const std::chrono::seconds allowed(number("-max_total_time=", "0"));
    Changes changes(stored, number("-seed=", "1"), number("-max_len=", "4096"));
    const std::string kept = value_of(options, "-artifact_prefix=", "fuzz-") + "changed";
    const int file = open(kept.c_str(), O_CREAT | O_RDWR, 0644);
    const auto start = std::chrono::steady_clock::now();
    std::size_t runs = 0;
    for (; runs < most; ++runs) {
        if (allowed.count() > 0 && std::chrono::steady_clock::now() - start >= allowed) break;
        const std::string bytes = changes.next();
        keep(file, bytes);
        run(bytes);
    }
    close(file);
    fs::remove(kept);
    return runs;
}

}  // namespace

int main(int count, char** words) {
    LLVMFuzzerInitialize(&count, &words);
    std::vector<fs::path> files;
    std::vector<std::string> options;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        if (word[0] == '-') {
            options.push_back(word);
        } else if (!fs::is_directory(word)) {
            files.emplace_back(word);
        } else {
            for (const auto& entry : fs::recursive_directory_iterator(word))
                if (entry.is_regular_file()) files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    if (files.empty()) {
        std::fprintf(stderr, "replay: no inputs, allowed: files or folders that hold some\n");
        return 2;
    }
    std::vector<std::string> stored;
    for (const fs::path& path : files) {
        std::ifstream file(path, std::ios::binary);
        stored.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
        if (!file) {
            std::fprintf(stderr, "replay: %s: cannot read\n", path.c_str());
            return 2;
        }
        // Name the input before it runs, so that a crash is known by its last line.
        std::printf("%s\n", path.c_str());
        std::fflush(stdout);
        run(stored.back());
    }
    std::printf("replayed %zu inputs\n", files.size());

    std::printf("stat::number_of_executed_units: %zu\n", files.size() + search(stored, options));
    return 0;
}
