// SPDX-License-Identifier: Apache-2.0
// Bare-number volumes, the dispatch by format, and the turn from y up to z up.
// in: small files -> out: pass or fail.
// docs/testing.md, label io
#include <doctest/doctest.h>

#include <limits>

#include "src/io/volumes/volume_file.h"
#include "tests/io/temp_folder.h"

using namespace pileus;
using test::holds;

namespace {

std::string float_bytes(std::initializer_list<float> values, bool big_endian) {
    std::string bytes;
    for (const float value : values) {
        std::uint32_t bits;
        std::memcpy(&bits, &value, 4);
        for (int i = 0; i < 4; ++i) bytes += char(bits >> 8 * (big_endian ? 3 - i : i) & 255);
    }
    return bytes;
}

}  // namespace

TEST_CASE("raw volume: types and byte orders") {
    const test::TempFolder folder;
    Volume v;
    REQUIRE(read_raw_volume(folder.put("a", std::string("\x00\xff\x33", 3)), RawType::kUint8,
                            {3, 1, 1}, false, v));
    CHECK(v.size == std::array<int, 3>{3, 1, 1});
    CHECK(v.density[0] == 0.0f);
    CHECK(v.density[1] == 1.0f);
    CHECK(v.density[2] == 51.0f / 255.0f);

    const std::string words("\x01\x00\xff\xff", 4);
    REQUIRE(read_raw_volume(folder.put("b", words), RawType::kUint16, {1, 2, 1}, false, v));
    CHECK(v.density[0] == 1.0f / 65535.0f);
    CHECK(v.density[1] == 1.0f);
    REQUIRE(read_raw_volume(folder.put("b", words), RawType::kUint16, {1, 2, 1}, true, v));
    CHECK(v.density[0] == 256.0f / 65535.0f);

    for (const bool big : {false, true}) {
        const std::string floats = float_bytes({0.1f, 3e38f, 1e-45f}, big);
        REQUIRE(read_raw_volume(folder.put("c", floats), RawType::kFloat32, {1, 1, 3}, big, v));
        CHECK(v.density[0] == 0.1f);
        CHECK(v.density[1] == 3e38f);
        CHECK(v.density[2] == 1e-45f);
    }
    CHECK_FALSE(v.knows_bounds);
}

TEST_CASE("raw volume: longer than one piece of the reader keeps its order") {
    const test::TempFolder folder;
    std::string bytes(100 * 100 * 20, '\0');
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = char(i * 7 % 251);
    Volume v;
    REQUIRE(read_raw_volume(folder.put("a", bytes), RawType::kUint8, {100, 100, 20}, false, v));
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
        wrong += v.density[i] != float(i * 7 % 251) / 255.0f ? 1 : 0;
    CHECK(wrong == 0);
}

TEST_CASE("raw volume: each fault has its line") {
    const test::TempFolder folder;
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Volume v;
    const std::string four = folder.put("four", "1234");
    const auto read = [&](const std::string& path, RawType type, std::array<int, 3> size) {
        return read_raw_volume(path, type, size, false, v);
    };
    struct Row {
        Status status;
        Code code;
        const char* line;
    };
    const auto f32 = RawType::kFloat32;
    const Row rows[] = {
        {read(folder.path("none"), f32, {1, 1, 1}), Code::kBadInput, "no such file"},
        {read(folder.path(""), f32, {1, 1, 1}), Code::kBadInput, "is a folder"},
        {read(four, f32, {2, 1, 1}), Code::kBadInput, "4 bytes, allowed: exactly 8"},
        {read(four, RawType::kUint8, {3, 1, 1}), Code::kBadInput, "4 bytes, allowed: exactly 3"},
        {read(four, f32, {0, 1, 1}), Code::kBadInput, "nx: out of range, 0, allowed: 1 to 4096"},
        {read(four, f32, {1, 1, 10000}), Code::kBadInput, "nz: out of range, 10000"},
        {read(four, f32, {4096, 4096, 4096}), Code::kLimit, "too many voxels, 68719476736"},
        {read(four, f32, {2048, 1024, 1024}), Code::kBadInput, "exactly 8589934592"},
        {read(folder.put("n", float_bytes({0, nan}, false)), f32, {1, 2, 1}), Code::kBadInput,
         "density: voxel 0 1 0 (index 1), nan, allowed: a finite number >= 0"},
        {read(folder.put("i", float_bytes({inf, 0}, false)), f32, {2, 1, 1}), Code::kBadInput,
         "voxel 0 0 0 (index 0), inf"},
        {read(folder.put("m", float_bytes({0, -1}, false)), f32, {2, 1, 1}), Code::kBadInput,
         "voxel 1 0 0 (index 1), -1, allowed"},
    };
    for (const Row& row : rows) {
        INFO(row.status.message);
        CHECK(row.status.code == row.code);
        CHECK(holds(row.status.message, row.line));
    }
}

TEST_CASE("volume: y up becomes z up by a right-handed turn") {
    // Cell (x, y, z) of 2 x 3 x 4 holds the number xyz; it must land at (x, 4-1-z, y).
    Volume v;
    v.size = {2, 3, 4};
    REQUIRE(v.density.resize(24, "test"));
    for (int z = 0; z < 4; ++z)
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 2; ++x)
                v.density[std::size_t((z * 3 + y) * 2 + x)] = float(100 * x + 10 * y + z);
    v.knows_bounds = true;
    v.bounds_m = {{{1, 2, 3}, {4, 6, 8}}};
    REQUIRE(permute_y_up(v));
    CHECK(v.size == std::array<int, 3>{2, 4, 3});
    CHECK(v.density[0] == 3.0f);                      // (0,0,0) was x 0, y 0, z 3
    CHECK(v.density[1] == 103.0f);                    // (1,0,0) was x 1, y 0, z 3
    CHECK(v.density[2] == 2.0f);                      // (0,1,0) was x 0, y 0, z 2
    CHECK(v.density[8] == 13.0f);                     // (0,0,1) was x 0, y 1, z 3
    CHECK(v.density[(2 * 4 + 3) * 2 + 1] == 120.0f);  // (1,3,2) was x 1, y 2, z 0
    CHECK(v.bounds_m[0] == Double3{1, -8, 2});
    CHECK(v.bounds_m[1] == Double3{4, -3, 6});
}

TEST_CASE("volume: format by key or extension, axes in file order") {
    const test::TempFolder folder;
    const std::string path = folder.put("v.raw", "\x33\x66\x99");
    MediumSettings medium;
    medium.source.raw_type = RawType::kUint8;
    medium.source.raw_size = {1, 3, 1};
    Volume v;
    REQUIRE(read_volume(medium, path, v));
    CHECK(v.size == std::array<int, 3>{1, 3, 1});
    CHECK_FALSE(v.knows_bounds);

    medium.source.y_up = true;  // the turn is the caller's step
    REQUIRE(read_volume(medium, path, v));
    CHECK(v.size == std::array<int, 3>{1, 3, 1});
    CHECK(v.density[2] == 153.0f / 255.0f);

    const std::string other = folder.put("v.dat", "\x33\x66\x99");
    const Status unknown = read_volume(medium, other, v);
    CHECK(unknown.code == Code::kBadInput);
    CHECK(holds(unknown.message,
                "format: unknown, \".dat\", allowed: \"pbrt\", \"raw\", \"vol\", "
                "\"les\", \"openvdb\", \"nanovdb\""));
    medium.source.format = "raw";
    CHECK(read_volume(medium, other, v));
    medium.source.format = "pbrt";
    CHECK(read_volume(medium, path, v).code == Code::kBadInput);
}
