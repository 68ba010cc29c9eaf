// SPDX-License-Identifier: Apache-2.0
// Noise volumes on disk: read back bit for bit; damaged, foreign or forbidden files only cost time.
// in: folders -> out: pass or fail.
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "kernels_cpu/isa/kernels.h"
#include "src/world/density/noise_volume.h"

using namespace pileus;
namespace fs = std::filesystem;

namespace {

constexpr NoiseParams kParams{kNoisePerlin, 16, 2, 2, 0.5f, 3u};

struct Folder {
    fs::path path = fs::temp_directory_path() / "pileus_noise_cache_test";
    Folder() { fs::remove_all(path); }
    ~Folder() { fs::remove_all(path); }
    fs::path file() const { return path / noise_file_name(kParams); }
};

std::string bytes_of(const Buffer<std::uint8_t>& texels) {
    return {reinterpret_cast<const char*>(texels.data()), texels.size()};
}

std::string load(const std::string& folder, NoiseOrigin wanted) {
    Buffer<std::uint8_t> texels;
    NoiseOrigin origin;
    REQUIRE(load_noise(kParams, folder, *kernel_table(nullptr), 1, texels, origin));
    CHECK(int(origin) == int(wanted));
    return bytes_of(texels);
}

std::string read_file(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_bytes(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

}  // namespace

TEST_CASE("a volume is made once and read afterwards") {
    const Folder folder;
    const std::string first = load(folder.path, NoiseOrigin::kMade);
    CHECK(first == load(folder.path, NoiseOrigin::kRead));
    CHECK(read_file(folder.file()).size() == 40 + 16 * 16 * 16);
    NoiseParams other = kParams;
    other.gain = 0.25f;
    CHECK(noise_file_name(other) != noise_file_name(kParams));
}

TEST_CASE("a damaged file is made anew and replaced") {
    const Folder folder;
    const std::string first = load(folder.path, NoiseOrigin::kMade);
    const std::string whole = read_file(folder.file());
    std::string flipped = whole, longer = whole + "x", head = whole, foreign(whole.size(), 'z');
    std::string older = whole;
    older[7] = '1';  // of the version before
    flipped[2000] = char(flipped[2000] ^ 1);
    head[12] = char(head[12] ^ 1);
    for (const std::string& bad : {whole.substr(0, 1000), whole.substr(0, 10), std::string(),
                                   flipped, longer, head, foreign, older}) {
        write_bytes(folder.file(), bad);
        CHECK(first == load(folder.path, NoiseOrigin::kMade));
        CHECK(read_file(folder.file()) == whole);
    }
}

TEST_CASE("a folder in its place and no folder at all are no errors") {
    const Folder folder;
    const std::string first = load("", NoiseOrigin::kMadeUnkept);
    fs::create_directories(folder.file());
    CHECK(first == load(folder.path, NoiseOrigin::kMadeUnkept));
    // No folder can be made below a file, whoever asks.
    const fs::path file = folder.path / "file";
    write_bytes(file, "x");
    CHECK(first == load(file / "below", NoiseOrigin::kMadeUnkept));
    fs::remove_all(folder.file());
    fs::permissions(folder.path, fs::perms::owner_read | fs::perms::owner_exec);
    Buffer<std::uint8_t> texels;
    NoiseOrigin origin;  // kept only by those whom permissions do not bind
    REQUIRE(load_noise(kParams, folder.path, *kernel_table(nullptr), 1, texels, origin));
    CHECK(first == bytes_of(texels));
    fs::permissions(folder.path, fs::perms::owner_all);
}

TEST_CASE("the folder follows the environment") {
    const char* home = std::getenv("HOME");
    const std::string before = home != nullptr ? home : "";
    unsetenv("PILEUS_CACHE_DIR"), unsetenv("XDG_CACHE_HOME"), setenv("HOME", "/h", 1);
    CHECK(cache_folder() == "/h/.cache/pileus");
    setenv("XDG_CACHE_HOME", "relative", 1);
    CHECK(cache_folder() == "/h/.cache/pileus");
    setenv("XDG_CACHE_HOME", "/x", 1);
    CHECK(cache_folder() == "/x/pileus");
    setenv("PILEUS_CACHE_DIR", "/own", 1);
    CHECK(cache_folder() == "/own");
    unsetenv("PILEUS_CACHE_DIR"), unsetenv("XDG_CACHE_HOME"), unsetenv("HOME");
    CHECK(cache_folder().empty());
    if (!before.empty()) setenv("HOME", before.c_str(), 1);
}
