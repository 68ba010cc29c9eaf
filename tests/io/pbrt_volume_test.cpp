// SPDX-License-Identifier: Apache-2.0
// The text volume reader: known answers, each fault once, and hostile text.
// in: small texts -> out: pass or fail.
// docs/testing.md, label io
#include <doctest/doctest.h>

#include "src/io/volumes/volume_file.h"
#include "tests/io/temp_folder.h"

using namespace pileus;
using test::holds;

namespace {

const char* const kHead =
    "Volume \"volumegrid\" \"integer nx\" 2 \"integer ny\" 1 \"integer nz\" 2 ";

Status read_text(const std::string& text, Volume& volume) {
    const test::TempFolder folder;
    return read_pbrt_volume(folder.put("v.pbrt", text), volume);
}

}  // namespace

TEST_CASE("pbrt volume: any order, comments, brackets and signs") {
    Volume volume;
    REQUIRE(
        read_text("# head ] [\r\nVolume\t\"volumegrid\" \"float density\" [0 +.5 # one ]\n"
                  "1e-400 25e-2] \"point p1\" [1 2 3.5] \"rgb sigma_a\" [1 1 \"]\" 1]\n"
                  "\"integer nz\" [2]\"integer nx\" 2 \"string name\" \"a]b\" "
                  "\"point p0\" [-1 0 .25]\"integer ny\" [ 1 ] # end",
                  volume));
    CHECK(volume.size == std::array<int, 3>{2, 1, 2});
    REQUIRE(volume.density.size() == 4);
    CHECK(volume.density[0] == 0.0f);
    CHECK(volume.density[1] == 0.5f);
    CHECK(volume.density[2] == 0.0f);
    CHECK(volume.density[3] == 0.25f);
    CHECK(volume.knows_bounds);
    CHECK(volume.bounds_m[0] == Double3{-1, 0, 0.25});
    CHECK(volume.bounds_m[1] == Double3{1, 2, 3.5});
}

TEST_CASE("pbrt volume: without points the box is not known") {
    Volume volume;
    volume.knows_bounds = true;
    REQUIRE(read_text(std::string(kHead) + "\"float density\" [1 2 3 4]", volume));
    CHECK_FALSE(volume.knows_bounds);
    CHECK(volume.density[3] == 4.0f);
}

TEST_CASE("pbrt volume: each fault has its line") {
    struct Row {
        std::string text;
        Code code;
        const char* line;
    };
    const std::string head = kHead, sides = "Volume \"volumegrid\" \"float density\" [1] ";
    const std::string three = "\"integer nx\" 10000 \"integer ny\" 10000 \"integer nz\" 10000 ";
    const std::string vast = "\"integer nx\" 4096 \"integer ny\" 4096 \"integer nz\" 4096 ";
    const std::string wide = "\"integer nx\" 2048 \"integer ny\" 1024 \"integer nz\" 1024 ";
    const Row rows[] = {
        {"", Code::kBadInput, ":1:1: directive: unknown, the end of the text"},
        {"Shape \"x\"", Code::kBadInput, ":1:1: directive: unknown, Shape, allowed: Volume"},
        {"Volume grid", Code::kBadInput, ":1:8: kind of volume: not found, grid"},
        {"Volume \"homogeneous\"", Code::kBadInput, ":1:8: kind of volume: unknown"},
        {"Volume \"volumegrid\" 12", Code::kBadInput, ":1:21: parameter: not found, 12"},
        {"Volume \"volumegrid\" \"a", Code::kBadInput, "parameter: not found, \"a"},
        {"Volume \"volumegrid\" \"a\"", Code::kBadInput, ":1:24: a: value missing"},
        {head, Code::kBadInput, "float density: missing"},
        {sides, Code::kBadInput, "integer nx: missing"},
        {head + "\n\"integer nx\" 2", Code::kBadInput, ":2:1: integer nx: given twice"},
        {head + "\"point p0\" [1 2 3] \"point p0\" [1 2 3]", Code::kBadInput, "p0: given twice"},
        {head + "\"float density\" 1 \"float density\" 1", Code::kBadInput, "density: given twice"},
        {head + "\"float nx\" 2", Code::kBadInput, "float nx: wrong type"},
        {sides + "\"integer nx\" 0", Code::kBadInput, "integer nx: out of range, 0, allowed: 1 to"},
        {sides + "\"integer nx\" -3", Code::kBadInput, "out of range, -3"},
        {sides + three, Code::kBadInput, "integer nx: out of range, 10000, allowed: 1 to 4096"},
        {sides + vast, Code::kLimit, "too many voxels, 68719476736, allowed: at most 2147483648"},
        {sides + wide, Code::kBadInput, "number of values, 1, allowed: exactly 2147483648 = 2048"},
        {sides + "\"integer nx\" 2.5", Code::kBadInput, "integer nx: not a number, 2.5"},
        {sides + "\"integer nx\" 99999999999999999999", Code::kBadInput, "nx: too large, 9999999"},
        {sides + "\"integer nx\" [2 3]", Code::kBadInput, "integer nx: more than one value"},
        {sides + "\"integer nx\" []", Code::kBadInput, "integer nx: not a number, the end"},
        {head + "\"point p0\" [1 2]", Code::kBadInput, "point p0: not a number"},
        {head + "\"point p0\" [1 2 3 4]", Code::kBadInput, "point p0: more than three values"},
        {head + "\"point p0\" [1 2 inf]", Code::kBadInput, "point p0: out of range, inf"},
        {head + "\"point p0\" [1 2 3] \"float density\" 1", Code::kBadInput, "one is missing"},
        {head + "\"point p0\" [0 0 0] \"point p1\" [1 0 1] \"float density\" 1", Code::kBadInput,
         "point p1: not above p0 on axis 1"},
        {head + "\"float density\" [1 2 3", Code::kBadInput, "list not closed"},
        {head + "\"float density\" [1 2 3]", Code::kBadInput, "of values, 3, allowed: exactly 4 ="},
        {head + "\"float density\" [1 2 3 4 5]", Code::kBadInput, "of values, 5, allowed"},
        {head + "\n\"float density\" [1 2\n 3 nan]", Code::kBadInput,
         ":3:4: float density: voxel 1 0 1 (index 3), nan, allowed: a finite number >= 0"},
        {head + "\"float density\" [1 -2 3 4]", Code::kBadInput, "voxel 1 0 0 (index 1), -2"},
        {head + "\"float density\" [inf 2 3 4]", Code::kBadInput, "voxel 0 0 0 (index 0), inf"},
        {head + "\"float density\" [1e400 2 3 4]", Code::kBadInput, "too large, 1e400"},
        {head + "\"float density\" [1e39 2 3 4]", Code::kBadInput, "too large, 1e39"},
        {head + "\"float density\" [1 2 3x 4]", Code::kBadInput, "not a number, 3x"},
        {head + "\"float density\" [1 2 [3] 4]", Code::kBadInput, "parameter: not found, 4]"},
        {head + "\"float density\" [1 2 3 4] x", Code::kBadInput, "parameter: not found, x"},
    };
    for (const Row& row : rows) {
        Volume volume;
        const Status status = read_text(row.text, volume);
        INFO(row.text, " -> ", status.message);
        CHECK(status.code == row.code);
        CHECK(holds(status.message, row.line));
        CHECK_FALSE(holds(status.message, "\n"));
    }
}

TEST_CASE("pbrt volume: missing file and folder") {
    Volume volume;
    const test::TempFolder folder;
    CHECK(read_pbrt_volume(folder.path("none.pbrt"), volume).code == Code::kBadInput);
    CHECK(read_pbrt_volume(folder.path(""), volume).code == Code::kBadInput);
}

TEST_CASE("pbrt volume: every truncation and every changed byte ends in a Status") {
    const std::string good = std::string(kHead) + "\"point p0\" [0 0 0] \"point p1\" [1 1 1] " +
                             "\"float density\" [1 2 3 4]";
    Volume volume;
    REQUIRE(read_text(good, volume));
    const test::TempFolder folder;
    for (std::size_t n = 0; n < good.size(); ++n) {
        const Status status = read_pbrt_volume(folder.put("v.pbrt", good.substr(0, n)), volume);
        INFO(n);
        CHECK(status.code == Code::kBadInput);
    }
    int accepted = 0;
    for (std::size_t n = 0; n < good.size(); ++n)
        for (const char byte : {'\0', '"', '[', ']', '#', '9', '-', '\xff'}) {
            std::string bad = good;
            bad[n] = byte;
            const Status status = read_pbrt_volume(folder.put("v.pbrt", bad), volume);
            CHECK((status.code == Code::kOk || status.code == Code::kBadInput));
            accepted += status.code == Code::kOk ? 1 : 0;
        }
    // A nine may stand for a digit of a density or of p1, so some changes are no fault.
    CHECK(accepted > 0);
    CHECK(accepted < 100);
}
