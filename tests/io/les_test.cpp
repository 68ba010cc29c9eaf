// SPDX-License-Identifier: Apache-2.0
// The LES text reader: both forms, stretched levels, each fault once, and hostile text.
// in: small texts -> out: pass or fail.
// docs/testing.md, label io
#include <doctest/doctest.h>

#include "src/io/volumes/les_layers.h"
#include "src/io/volumes/volume_file.h"
#include "tests/io/temp_folder.h"

using namespace pileus;
using test::holds;

namespace {

const std::string kSparseHead =
    "# a cloud\n2,3,2  # nx,ny,nz\n0.02,0.03\n0.44,0.48 # km\ni,j,k,lwc,reff\n";
const std::string kSparse = kSparseHead + "1,0,1,0.5,10\n0,2,0,0.25,12.5 # a row\n";
const std::string kDense =
    "# a cloud\n1 2 2\n0.05 0.05 0.4 0.425\n0 0 0 0.0 0.000\n0 0 1 0.3 9\n0 1 0 0 4\n0 1 1 0.6 6\n";

/// Bytes of the head of it.
const std::size_t kDenseHead = kDense.find("0 0 0 ");

Status decode(const std::string& text, Volume& volume) {
    return decode_les_volume("c.txt", {text.data(), text.size()}, volume);
}

double column_depth(const Volume& v, std::size_t column) {
    const std::size_t plane = std::size_t(v.size[0]) * std::size_t(v.size[1]);
    const double step = (v.bounds_m[1][2] - v.bounds_m[0][2]) / v.size[2];
    double depth = 0;
    for (std::size_t i = column; i < v.density.size(); i += plane) depth += step * v.density[i];
    return depth;
}

}  // namespace

TEST_CASE("LES text: sparse rows, absent ones are empty") {
    Volume v;
    REQUIRE(decode(kSparse, v));
    CHECK(v.size == std::array<int, 3>{2, 3, 2});
    CHECK(v.in_extinction);
    CHECK(v.knows_bounds);
    // Cells reach half a step below the first level and above the last; rounding of 1000 km -> m.
    const double box[2][3] = {{0, 0, 420}, {40, 90, 500}};
    for (std::size_t i = 0; i < 6; ++i)
        CHECK(v.bounds_m[i / 3][i % 3] == doctest::Approx(box[i / 3][i % 3]).epsilon(1e-12));
    REQUIRE(v.density.size() == 12);
    for (std::size_t i = 0; i < 12; ++i) {
        const float wanted = i == 7 ? 0.075f : i == 4 ? 0.03f : 0.0f;  // 1.5 LWC / r_eff
        CHECK(v.density[i] == wanted);
    }
}

TEST_CASE("LES text: as pySHDOM, AT3D and SHDOM write it, with a mark of UTF-8 or without") {
    // Voxels 0 0 0 and 2 1 1 of 3 x 2 x 2, 0.5 g/m3 of 10 um: 0.075 per m.
    const std::string head = "# a part\n3 2 2\n0.02 0.02 0.61 0.63\n", mark = "\xef\xbb\xbf";
    const std::string at3d = "# a cloud\n3,2,2 # nx,ny,nz\n0.02,0.02\n0.61,0.63\n";
    const std::string texts[] = {
        head + "0 0 0 0.5 10.0\n2 1 1 0.5 10.0\n",
        head + "0 0 0 0.5 10.0 0.12685\n2 1 1 0.5 10.0 0.09221\n",
        at3d + "x,y,z,lwc,reff,veff\n0,0,0,0.5,10.0,0.1\n2,1,1,0.5,10.0,0.1\n",
        at3d + "veff,\"reff\",LWC,z,y,x,name\n,10,0.5,0,0,0,\n0.1,10,0.5,1,1,2,a cloud\n",
        "2 parameter LWC file\n3 2 2\n0.02 0.02\n0.61 0.63\n290 289\n1 1 1 0.5 10\n3 2 2 0.5 10\n",
    };
    for (const std::string& text : texts)
        for (const std::string& begin : {std::string(), mark}) {
            Volume v;
            const Status status = decode(begin + text, v);
            REQUIRE_MESSAGE(status, status.message);
            CHECK(v.size == std::array<int, 3>{3, 2, 2});
            for (std::size_t i = 0; i < 12; ++i)
                CHECK(v.density[i] == (i == 0 || i == 11 ? 0.075f : 0.0f));
            CHECK(v.bounds_m[0][2] == doctest::Approx(600).epsilon(1e-12));
        }
    const test::TempFolder folder;
    VolumeHead read;
    REQUIRE(read_les_head(folder.put("c.txt", mark + texts[3]), read));
    CHECK(read.detail == "columns not used: veff, name");
}

TEST_CASE("LES text: water a little below 0 counts as 0") {
    Volume v;
    REQUIRE(decode(kSparse + "0,0,0,-1e-9,10\n1,1,1,-1e-9,0\n", v));
    CHECK(v.clamped == 2);
    CHECK(v.density[0] == 0.0f);
    CHECK(v.density[7] == 0.075f);
}

TEST_CASE("LES text: dense rows, in any order") {
    Volume v;
    REQUIRE(decode(kDense, v));
    CHECK(v.size == std::array<int, 3>{1, 2, 2});
    CHECK(v.bounds_m[0][2] == doctest::Approx(387.5).epsilon(1e-12));
    CHECK(v.bounds_m[1][1] == doctest::Approx(100).epsilon(1e-12));
    const float wanted[4] = {0, 0, 0.05f, 0.15f};
    for (std::size_t i = 0; i < 4; ++i) CHECK(v.density[i] == wanted[i]);

    Volume turned;
    REQUIRE(
        decode("1 2 2\n.05 .05 .4 .425\n0 1 1 0.6 6\n0 1 0 0 4\n0 0 1 0.3 9\n0 0 0 0 0", turned));
    for (std::size_t i = 0; i < 4; ++i) CHECK(turned.density[i] == wanted[i]);
}

TEST_CASE("LES text: ends of lines, blanks and comments do not matter") {
    for (const std::string& text : {kSparse, kDense}) {
        Volume plain;
        REQUIRE(decode(text, plain));
        std::string other = "\r\n \t\n#\n";
        for (const char c : text)
            other += c == '\n' ? " \t\r\n" : c == ',' ? " , " : std::string(1, c);
        while (other.back() == '\n' || other.back() == '\r') other.pop_back();
        Volume changed;
        const Status status = decode(other, changed);
        REQUIRE_MESSAGE(status, status.message);
        REQUIRE(changed.density.size() == plain.density.size());
        for (std::size_t i = 0; i < plain.density.size(); ++i)
            CHECK(changed.density[i] == plain.density[i]);
    }
}

TEST_CASE("LES text: rounded heights are an even ladder, others are laid on equal layers") {
    // Heights of 25 m steps printed in whole metres, as published grids have them.
    const LayerStack rounded = stack_of_levels({438, 463, 488, 512, 538, 562});
    CHECK(rounded.even);
    CHECK(rounded.layers == 6);
    CHECK_FALSE(stack_of_levels({100, 120, 145}).even);

    // Layers of 20, 30 and 40 m fill 90 m.
    const LayerStack stack = stack_of_levels({100, 120, 160});
    CHECK_FALSE(stack.even);
    CHECK(stack.faces_m == std::vector<double>{90, 110, 140, 180});
    CHECK(stack.layers == 5);  // of 18 m: 90 m by the thinnest, rounded up

    Volume v;
    REQUIRE(
        decode("1,2,3\n.1,.1\n.1,.12,.16\ni,j,k,lwc,reff\n0,0,0,1,15\n0,0,1,2,15\n0,0,2,4,15\n"
               "0,1,1,1,15\n",
               v));
    CHECK(v.size == std::array<int, 3>{1, 2, 5});
    CHECK(v.density[0] == doctest::Approx(0.1));  // 18 m of the first layer
    CHECK(v.density[2] == doctest::Approx((2 * 0.1 + 16 * 0.2) / 18));
    CHECK(v.density[8] == doctest::Approx(0.4));
    // Every column keeps its optical depth but for the rounding of five floats.
    CHECK(column_depth(v, 0) == doctest::Approx(20 * 0.1 + 30 * 0.2 + 40 * 0.4).epsilon(1e-6));
    CHECK(column_depth(v, 1) == doctest::Approx(30 * 0.1).epsilon(1e-6));
}

TEST_CASE("LES text: one voxel, one level") {
    Volume v;
    for (const char* text :
         {"1,1,1\n.1,.1\n.5\nx,y,z,lwc,reff\n0,0,0,2,10\n", "1 1 1\n.1 .1 .5\n0 0 0 2 10\n"}) {
        REQUIRE(decode(text, v));
        CHECK(v.size == std::array<int, 3>{1, 1, 1});
        CHECK(v.density[0] == 0.3f);
        CHECK_FALSE(v.knows_bounds);  // one height says nothing of a thickness
    }
}

TEST_CASE("LES text: each fault has its line") {
    struct Row {
        std::string text;
        Code code;
        const char* line;
    };
    const std::string s = kSparseHead, d = "1 1 2\n.05 .05 .4 .425\n";
    const Row rows[] = {
        {"", Code::kBadInput, "c.txt:1:1: nx, ny, nz: missing, the text ends"},
        {"# only\n", Code::kBadInput, "c.txt:2:1: nx, ny, nz: missing"},
        {"cloud", Code::kBadInput, "c.txt:1:1: nx: not a number, cloud, allowed: LES text begins"},
        {"2,3\n", Code::kBadInput, "c.txt:1:4: nz: missing, the line ends"},
        {"2,3 2\n", Code::kBadInput, "c.txt:1:5: nz: not parted by a comma, 2"},
        {"2,3,2,\n", Code::kBadInput, "c.txt:1:6: nx, ny, nz: more values than expected, ,"},
        {"2 3 2 1\n", Code::kBadInput, "c.txt:1:7: nx, ny, nz: more values than expected, 1"},
        {"2,3,2.5\n", Code::kBadInput, "c.txt:1:5: nz: not a number, 2.5"},
        {"0,3,2\n", Code::kBadInput, "c.txt: nx: out of range, 0, allowed: 1 to 4096"},
        {"-2 3 2\n", Code::kBadInput, "c.txt: nx: out of range, -2"},
        {"10000 10000 10000\n", Code::kBadInput, "c.txt: nx: out of range, 10000, allowed: 1 to"},
        {"99999999999999999999 1 1\n", Code::kBadInput, "c.txt:1:1: nx: too large, 999999"},
        {"4096,4096,4096\n", Code::kLimit, "c.txt: size: too many voxels, 68719476736"},
        {"2,3,2\n", Code::kBadInput, "c.txt:2:1: dx, dy: missing, the text ends"},
        {"2,3,2\n1\n", Code::kBadInput, "c.txt:2:2: dy: missing, the line ends"},
        {"2,3,2\n1,0\n", Code::kBadInput,
         "c.txt:2:3: dy: out of range, 0, allowed: 1e-6 to 100 km"},
        {"2,3,2\nnan,1\n", Code::kBadInput, "c.txt:2:1: dx: out of range, nan"},
        {"2,3,2\n1,1,1\n", Code::kBadInput, "c.txt:2:4: dx, dy: more values than expected, ,"},
        {"2,3,2\n1,1\n.4,.5,.6\n", Code::kBadInput, "levels, 2 as nz says: more values"},
        {"2,3,2\n1,1\n.4\n", Code::kBadInput, "c.txt:3:3: level 1: missing, the line ends"},
        {"2,3,2\n1,1\n.4,.4\n", Code::kBadInput, "c.txt:3:4: level 1: not above the one before"},
        {"2,3,2\n1,1\n.4,inf\n", Code::kBadInput, "c.txt:3:4: level 1: out of range, inf"},
        {"1,1,3\n1,1\n0,.5,.5000001\ni,j,k,lwc,reff\n", Code::kBadInput,
         "c.txt: levels laid on equal layers of the thinnest: nz: out of range, "},
        {"2,3,2\n1,1\n.4,.5\n", Code::kBadInput, "c.txt:4:1: names of the columns: missing"},
        {"2,3,2\n1,1\n.4,.5\ni,j,l,reff,lwc\n", Code::kBadInput,
         "c.txt:4:1: names of the columns: no k among i,j,l,reff,lwc"},
        {"2,3,2\n1,1\n.4,.5\nx,y,z,lwc,reff,x\n", Code::kBadInput,
         "c.txt:4:16: names of the columns: x given twice, allowed: once"},
        {"4096,4096,100\n1,1\n" +
             [] {
                 std::string levels;
                 for (int i = 0; i < 100; ++i) levels += std::to_string(i) + (i < 99 ? "," : "\n");
                 return levels;
             }() +
             "i,j,k,lwc,reff\n",
         Code::kLimit,
         "c.txt: size: too many voxels for so short a text, 1677721600, allowed: at most 1048576"},
        {s + "2,0,0,1,9\n", Code::kBadInput, "c.txt:6:1: i: out of range, 2, allowed: 0 to 1"},
        {s + "0,3,0,1,9\n", Code::kBadInput, "c.txt:6:3: j: out of range, 3, allowed: 0 to 2"},
        {s + "0,0,-1,1,9\n", Code::kBadInput, "c.txt:6:5: k: out of range, -1, allowed: 0 to 1"},
        {s + "0,0,0,-1,9\n", Code::kBadInput,
         "c.txt:6:7: lwc: out of range, -1 g/m3, an extinction of -0.16"},
        {s + "0,0,0,nan,9\n", Code::kBadInput, "c.txt:6:7: lwc: out of range, nan"},
        {s + "0,0,0,1,0\n", Code::kBadInput, "c.txt:6:9: reff: must not be 0, 0, allowed: above"},
        {s + "0,0,0,1,-4\n", Code::kBadInput, "c.txt:6:9: reff: out of range, -4"},
        {s + "0,0,0,1,inf\n", Code::kBadInput, "c.txt:6:9: reff: out of range, inf"},
        {s + "0,0,0,1e12,1e-300\n", Code::kBadInput, "c.txt:6:12: reff: too small for this lwc"},
        {s + "0,0,0,1\n", Code::kBadInput, "c.txt:6:8: reff: missing, the line ends"},
        {s + "0,0,0,1,9,9\n", Code::kBadInput, "c.txt:6:10: row: more values than expected"},
        {s + "0,0,0,1,9\n1,1,1,1,9\n0,0,0,0,9\n", Code::kBadInput,
         "c.txt:8:1: row: given twice, voxel 0 0 0 (index 0), allowed: once"},
        {s + "0 0 0 1 9\n", Code::kBadInput, "c.txt:6:3: j: not parted by a comma, 0"},
        {d + "0 0 0 1 9\n0 0 0 1 9\n", Code::kBadInput, "c.txt:4:1: row: given twice, voxel 0 0 0"},
        {d + "0 0 0 0 9\n       \n", Code::kBadInput,
         "c.txt:5:1: rows: the text ends after 1 of 2 voxels, allowed: all of them in turn, or"},
        {d + "0 0 0 1 9 0.1 2\n", Code::kBadInput, "c.txt:3:15: row: more values than expected"},
        {d + "0 0 0 1 9 x\n", Code::kBadInput, "c.txt:3:11: veff: not a number, x"},
        {"2 parameter LWC file\n1 1 2\n.05 .05\n.4 .425\n280\n", Code::kBadInput,
         "c.txt:5:4: temperature 1: missing"},
        {"2 parameter LWC file\n1 1 2\n.05 .05\n.4 .425\n280 279\n0 1 1 1 9\n", Code::kBadInput,
         "c.txt:6:1: i: out of range, 0, allowed: 1 to 1"},
        {d + "0,0,0,1,9\n0,0,1,1,9\n", Code::kBadInput, "c.txt:3:1: i: not a number, 0,0,0,1,9"},
        {"4096 4096 100\n1 1\n", Code::kBadInput, "c.txt:2:4: level 0: missing, the line ends"},
    };
    for (const Row& row : rows) {
        Volume volume;
        const Status status = decode(row.text, volume);
        INFO(row.text, " -> ", status.message);
        CHECK(status.code == row.code);
        CHECK(holds(status.message, row.line));
        CHECK_FALSE(holds(status.message, "\n"));
    }
}

TEST_CASE("LES text: every truncation and every changed byte ends in a Status") {
    Volume volume;
    for (const std::string& good : {kSparse, kDense}) {
        const bool sparse = good == kSparse;
        for (std::size_t n = 0; n < good.size(); ++n) {
            const Status status = decode(good.substr(0, n), volume);
            INFO(n, " of ", good.size(), ": ", status.message);
            CHECK((status || status.code == Code::kBadInput));
            // Without a count of rows a text may end behind any whole row or the last level, but
            // where all voxels come in turn, dry ones too.
            const bool cut = sparse
                                 ? n <= kSparseHead.size() - 2
                                 : n < kDenseHead - 3 || (n > kDenseHead && n <= good.size() - 2);
            if (cut) CHECK_FALSE(status);
        }
        for (std::size_t n = 0; n < good.size(); ++n)
            for (const char byte : {'\0', ',', ' ', '\n', '#', '9', '-', 'e', '\xff'}) {
                std::string bad = good;
                bad[n] = byte;
                const Status status = decode(bad, volume);
                INFO(n, " ", int(byte), " ", status.message);
                CHECK((status || status.code == Code::kBadInput || status.code == Code::kLimit));
                CHECK_FALSE(holds(status.message, "\n"));
            }
    }
}

TEST_CASE("LES text: the head alone agrees with the whole, also behind a long comment") {
    const test::TempFolder folder;
    const std::string long_comment = "#" + std::string(70000, 'x') + '\n';
    const std::string stretched = "1,1,3\n.1,.1\n.1,.12,.16\ni,j,k,lwc,reff\n";
    for (const std::string& text : {kSparse, kDense, stretched, long_comment + kSparse}) {
        const std::string path = folder.put("c.txt", text);
        VolumeHead head;
        Volume volume;
        MediumSettings medium;
        REQUIRE(read_volume_head(medium, path, head));
        REQUIRE(read_volume(medium, path, volume));
        CHECK(head.size == volume.size);
        CHECK(head.knows_bounds == volume.knows_bounds);
        CHECK(head.bounds_m == volume.bounds_m);
        CHECK(head.in_extinction);
        CHECK(holds(head.kind, text == kDense ? "without names" : "with names"));
        CHECK(holds(head.detail, text == stretched ? "3 stretched levels" : ""));
    }
    // Rows at fault are no matter of the head.
    VolumeHead head;
    CHECK(read_les_head(folder.put("c.txt", kSparseHead + "9,9,9,9,9\n"), head));
    CHECK(read_les_head(folder.put("c.txt", "2,3\n"), head).code == Code::kBadInput);
    CHECK(read_les_head(folder.path("none.txt"), head).code == Code::kBadInput);
}
