// SPDX-License-Identifier: Apache-2.0
// Scenes, files and places that no user means: what the program says about each.
// in: generated files and command lines -> out: exit status, one line a fault, nothing written.
// docs/program.md; docs/scene.md, section Messages
#include <doctest/doctest.h>

#include "tests/cli/run_program.h"

using namespace pileus;
using namespace pileus::test;

namespace {

struct Case {
    const char* what;
    std::string scene;  ///< text of bad.toml; empty: the sound s.toml
    const char* arguments;
    int exit_status;
    std::vector<const char*> lines;  ///< what each line of the standard error holds, in order
};

const std::string kCamera = "[camera]\nposition_m = [0, -300, 50]\ntarget_m = [0, 0, 50]\n";
const std::string kBox =
    "[[medium]]\ndensity = \"uniform:box\"\nextinction_per_m = 1\n"
    "bounds_m = [[0, 0, 0], [9, 9, 9]]\n";

std::string file_medium(const std::string& density) {
    return kCamera + "[[medium]]\nextinction_per_m = 1\nbounds_m = [[0, 0, 0], [9, 9, 9]]\n" +
           "density = " + density + "\n";
}

/// Nothing is left but what stood there before.
void check_case(const Case& row, void (*prepare)(const TempFolder&) = nullptr) {
    const ProgramFolder folder;
    if (!row.scene.empty()) folder.files().put("bad.toml", row.scene);
    if (prepare != nullptr) prepare(folder.files());
    const std::vector<std::string> before = folder.left();
    const std::string scene = row.scene.empty() ? "s.toml " : "bad.toml ";
    const Outcome outcome = folder.run("render " + scene + row.arguments);
    CAPTURE(row.what);
    CAPTURE(outcome.errors);
    CHECK(outcome.exit_status == row.exit_status);
    CHECK(outcome.output == "");
    CHECK(folder.left() == before);
    REQUIRE(line_count(outcome.errors) == long(row.lines.size()));
    std::size_t at = 0;
    for (const char* line : row.lines) {
        const std::size_t end = outcome.errors.find('\n', at);
        CHECK_MESSAGE(holds(outcome.errors.substr(at, end - at), line), line);
        at = end + 1;
    }
    for (const char c : outcome.errors) CHECK((c == '\n' || (c >= ' ' && c != 0x7F) || c < 0));
}

}  // namespace

TEST_CASE("bad inputs: texts that are no scene") {
    const std::string camera = "camera.position_m: missing";
    const Case rows[] = {
        {"text cut in a number",
         kCamera + "fov_deg = 4.",
         "-o a.pfm",
         2,
         {"bad.toml:4:13: not TOML"}},
        {"a picture",
         std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16),
         "-o a.pfm",
         2,
         {"bad.toml:1:1: not TOML, character outside ASCII"}},
        {"zero bytes", kCamera + std::string(9, '\0'), "-o a.pfm", 2, {"bad.toml:4:1: not TOML"}},
        {"UTF-16",
         std::string("\xff\xfe[\0c\0a\0", 8),
         "-o a.pfm",
         2,
         {"bad.toml:1:1: not TOML, character outside ASCII"}},
        {"invalid UTF-8 in a comment",
         "# \xff\n" + kCamera,
         "-o a.pfm",
         2,
         {"bad.toml:1:2: not TOML, Encountered invalid utf-8 sequence"}},
        {"a bare carriage return",
         "seed = 1\rseed = 2\n" + kCamera,
         "-o a.pfm",
         2,
         {"bad.toml:1:"}},
        {"one line of half a megabyte",
         "seed = [" + std::string(500'000, '1') + "]\n",
         "-o a.pfm",
         2,
         {"bad.toml:1:"}},
        {"more than a megabyte",
         std::string((1 << 20) + 1, '#'),
         "-o a.pfm",
         3,
         {"bad.toml: scene text too long, allowed: at most 1048576 bytes"}},
        {"JSON", "{ \"camera\": { \"fov_deg\": 40 } }", "-o a.pfm", 2, {"bad.toml:1:1: not TOML"}},
        {"an unclosed text",
         kCamera + "[output]\nreport = \"r.json\n",
         "-o a.pfm",
         2,
         {"bad.toml:5:1"}},
        {"a table given twice",
         kCamera + "[sun]\nelevation_deg = 1\n[sun]\nazimuth_deg = 1\n",
         "-o a.pfm",
         2,
         {"bad.toml:6:1: not TOML, "}},
        {"comments only",
         "# nothing here\n",
         "-o a.pfm",
         2,
         {"bad.toml:1:1: camera.position_m: missing", "bad.toml:1:1: camera.target_m: missing"}},
    };
    for (const Case& row : rows) check_case(row);
}

TEST_CASE("bad inputs: values at and beyond their ends") {
    const Case rows[] = {
        {"10^12 voxels",
         kCamera + kBox + "resolution = [10000, 10000, 10000]\n",
         "-o a.pfm",
         2,
         {"8:15: medium.0.resolution: out of range, 10000, allowed: 3 whole numbers in [1, 4096]",
          "8:22: medium.0.resolution", "8:29: medium.0.resolution"}},
        {"sides allowed, their product not",
         kCamera + kBox + "resolution = [4096, 4096, 4096]\n",
         "-o a.pfm",
         3,
         {"limits.voxels: needs 68719476736 cells, allowed: at most 2147483648 cells"}},
        {"NaN, infinity, -infinity",
         kCamera + "up = [nan, inf, -inf]\n",
         "-o a.pfm",
         2,
         {"4:7: camera.up: not finite, nan", "4:12: camera.up: not finite, inf",
          "4:17: camera.up: not finite, -inf"}},
        {"negative seed",
         "seed = -9223372036854775808\n" + kCamera,
         "-o a.pfm",
         2,
         {"1:8: seed: out of range, -9223372036854775808, allowed: whole number in [0, 92"}},
        {"seed beyond 64 bits",
         "seed = 9223372036854775808\n" + kCamera,
         "-o a.pfm",
         2,
         {"bad.toml:1:"}},
        {"a field of view of a line",
         kCamera + "fov_deg = -0.0\n",
         "-o a.pfm",
         2,
         {"4:11: camera.fov_deg: out of range"}},
        {"no generations",
         kCamera + kBox + "[collectors]\ngenerations = 0\n",
         "-o a.pfm",
         2,
         {"9:15: collectors.generations: out of range, 0, allowed: whole number in [1, 1000]"}},
        {"photons as a fraction",
         kCamera + kBox + "[collectors]\nphotons = 0.5\n",
         "-o a.pfm",
         2,
         {"9:11: collectors.photons: not a whole number, 0.5"}},
        {"half a pixel",
         kCamera + "resolution = [0.5, 1e3]\n",
         "-o a.pfm",
         2,
         {"4:15: camera.resolution: out of range, 0.5"}},
        {"a flat box",
         kCamera + "[[medium]]\ndensity = \"uniform:box\"\nextinction_per_m = 1\n"
                   "bounds_m = [[0, 0, 5], [9, 9, 5]]\n",
         "-o a.pfm",
         2,
         {"7:12: medium.0.bounds_m: inverted or empty"}},
        {"a box in a box's brackets",
         kCamera + kBox + "albedo = [[1, 1, 1]]\n",
         "-o a.pfm",
         2,
         {"8:10: medium.0.albedo: wrong"}},
    };
    for (const Case& row : rows) check_case(row);
}

TEST_CASE("bad inputs: volumes that are not what they say") {
    const auto prepare = [](const TempFolder& files) {
        const std::string head = "Volume \"volumegrid\" \"integer nx\" 2 \"integer ny\" 1 ";
        files.put("short.pbrt", head + "\"integer nz\" 1 \"float density\" [0.5");
        files.put("negative.pbrt", head + "\"integer nz\" 1\n\"float density\" [0.5 -1]\n");
        files.put("huge.pbrt", head + "\"integer nz\" 4096000000000 \"float density\" [1]\n");
        files.put("few.pbrt", head + "\"integer nz\" 2 \"float density\" [1 2 3]\n");
        files.put("control.pbrt", head + "\"integer\x1b[31m nz\" 1 \"float density\" [1 2]\n");
        files.put("empty.pbrt", "");
        files.put("nan.raw", std::string("\0\0\xc0\x7f", 4));
        files.put("short.raw", "1234567");
        std::filesystem::create_directory(files.path("folder.pbrt"));
    };
    const Case rows[] = {
        {"cut",
         file_medium("\"short.pbrt\""),
         "-o a.pfm",
         2,
         {"short.pbrt:1:82: float density: list not closed before the end of the text"}},
        {"negative",
         file_medium("\"negative.pbrt\""),
         "-o a.pfm",
         2,
         {"negative.pbrt:2:22: float density: voxel 1 0 0 (index 1), -1, allowed: a finite"}},
        {"4 * 10^12 cells",
         file_medium("\"huge.pbrt\""),
         "-o a.pfm",
         2,
         {"huge.pbrt:1:64: integer nz: out of range, 4096000000000, allowed: 1 to 4096"}},
        {"three of four",
         file_medium("\"few.pbrt\""),
         "-o a.pfm",
         2,
         {"float density: wrong number of values, 3, allowed: exactly 4 = 2 x 1 x 2"}},
        {"control characters",
         file_medium("\"control.pbrt\""),
         "-o a.pfm",
         2,
         {"integer\\x1b[31m nz: wrong type"}},
        {"empty file", file_medium("\"empty.pbrt\""), "-o a.pfm", 2, {"empty.pbrt:1:1: directive"}},
        {"a folder",
         file_medium("\"folder.pbrt\""),
         "-o a.pfm",
         2,
         {"folder.pbrt: cannot read: is a folder, allowed: a file"}},
        {"missing",
         file_medium("\"none.pbrt\""),
         "-o a.pfm",
         2,
         {"none.pbrt: cannot read: no such file"}},
        {"a name with a line feed",
         file_medium("\"a\\nb.pbrt\""),
         "-o a.pfm",
         2,
         {"file name: holds a control character (code 10), \"a\\x0ab.pbrt\""}},
        {"not a number",
         file_medium("{ file = \"nan.raw\", type = \"float32\", size = [1, 1, 1] }"),
         "-o a.pfm",
         2,
         {"nan.raw: density: voxel 0 0 0 (index 0), nan, allowed: a finite number >= 0"}},
        {"a byte short",
         file_medium("{ file = \"short.raw\", type = \"uint8\", size = [2, 2, 2] }"),
         "-o a.pfm",
         2,
         {"short.raw: file length: does not fit the size, 7 bytes, allowed: exactly 8"}},
    };
    for (const Case& row : rows) check_case(row, prepare);
}

TEST_CASE("bad inputs: a file that is not there is told at the key that names it") {
    const struct {
        std::string lines;
        const char* arguments;
        const char* fault;
    } rows[] = {
        {"[[medium]]\nextinction_per_m = 1\ndensity = \"no.vdb\"\n", "",
         "a.toml:6:11: medium.0.density: no.vdb: cannot read: no such file\n"},
        {kBox + "[[medium]]\nbounds_m = [[0, 0, 0], [9, 9, 9]]\nextinction_per_m = 1\n"
                "density = { type = \"uint8\", size = [1, 1, 1], file = \"no.raw\" }\n",
         "", "a.toml:11:54: medium.1.density.file: no.raw: cannot read: no such file\n"},
        {kBox + "phase = { type = \"table\", file = \"no.txt\" }\n", "",
         "a.toml:8:34: medium.0.phase.file: no.txt: cannot read: no such file\n"},
        {"[sky]\nmap = \"no.exr\"\n", "",
         "a.toml:5:7: sky.map: no.exr: cannot read: no such file\n"},
        {"[[solid]]\nfile = \"no.ply\"\n", "",
         "a.toml:5:8: solid.0.file: no.ply: cannot read: no such file\n"},
        {"depth = \"no.pfm\"\n" + kBox, "",
         "a.toml:4:9: camera.depth: no.pfm: cannot read: no such file\n"},
        {kBox, "--set medium.0.density=no.vol",
         "--set medium.0.density=no.vol: medium.0.density: no.vol: cannot read: no such file\n"},
    };
    for (const auto& row : rows) {
        const ProgramFolder folder;
        folder.files().put("a.toml", kCamera + row.lines);
        const Outcome outcome =
            folder.run("render a.toml -o a.pfm --quiet " + std::string(row.arguments));
        CHECK(outcome.exit_status == 2);
        CHECK(outcome.errors == row.fault);
    }
}

TEST_CASE("bad inputs: places that cannot be written or read") {
    const auto prepare = [](const TempFolder& files) {
        files.put("file", "");
        std::filesystem::create_directory(files.path("a.pfm"));
    };
    const std::string deep = "-o " + std::string(5000, 'd') + ".pfm";
    const std::string folders = "-o a/" + std::string(300, 'd') + "/b.pfm";
    const Case rows[] = {
        {"a folder in the picture's place",
         "",
         "-o a.pfm",
         4,
         {"a.pfm: cannot write: is a folder"}},
        {"a file in a folder's place",
         "",
         "-o file/b.pfm",
         4,
         {"file/b.pfm: cannot write: Not a dir"}},
        {"a name of 5000 characters", "", deep.c_str(), 4, {"cannot write: File name too long"}},
        {"a folder of 300 characters",
         "",
         folders.c_str(),
         4,
         {"cannot write: File name too long"}},
        {"a line feed in the name",
         "",
         "-o \"$(printf 'b\\nc.pfm')\"",
         4,
         {"file name: holds a control character (code 10), \"b\\x0ac.pfm\", allowed: printable"}},
        {"an escape in an unknown extension",
         "",
         "-o \"$(printf 'b.\\033c')\"",
         4,
         {"file name: holds a control character (code 27)"}},
        {"a full device",
         "",
         "-o /dev/full --report file/r.json",
         2,
         {"/dev/full: extension", "file/r.json"}},
        {"a full device for the report",
         "",
         "-o b.pfm --report /dev/full",
         4,
         {"/dev/full: cannot write: No space left on device"}},
        {"no name", "", "-o ''", 2, {"extension: unknown"}},
    };
    for (const Case& row : rows) check_case(row, prepare);
}

TEST_CASE("bad inputs: the output is the scene, a pipe that closed, no output at all") {
    const ProgramFolder folder;
    const Outcome same = folder.run("render s.toml -o s.toml");
    CHECK(same.exit_status == 2);
    CHECK(folder.files().get("s.toml") == small_scene());
    const Outcome report = folder.run("render s.toml -o a.pfm --report s.toml");
    CHECK(report.exit_status == 2);
    CHECK_MESSAGE(holds(report.errors, "s.toml: output: is the scene itself"), report.errors);
    CHECK(folder.files().get("s.toml") == small_scene());

    const Outcome closed = folder.run("plan s.toml >&- 2>.err; exit $? #");
    CHECK(closed.exit_status == 4);
    CHECK(line_count(folder.files().get(".err")) == 1);
    // Whoever reads only the first line has what it wanted: no crash, at most one line.
    const Outcome head = folder.run("plan s.toml 2>.err | head -1 >.out; exit 0 #");
    CHECK(head.exit_status == 0);
    CHECK(line_count(folder.files().get(".err")) <= 1);
    CHECK(folder.left().empty());
}
