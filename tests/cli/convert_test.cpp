// SPDX-License-Identifier: Apache-2.0
// pileus convert: round trips through the program, its lines, its faults.
// in: a small grid -> out: pass or fail.
// docs/program.md
#include "tests/cli/run_program.h"

using pileus::test::holds;
using pileus::test::Outcome;
using pileus::test::ProgramFolder;

namespace {

// 4 x 2 x 2 voxels, the first and the last not 0.
const char* const kGrid =
    "Volume \"volumegrid\" \"integer nx\" 4 \"integer ny\" 2 \"integer nz\" 2 "
    "\"point p0\" [0 0 10] \"point p1\" [4 2 14] "
    "\"float density\" [ 0.5 0 0 0  0 0 0 0  0 0 0 0  0 0 0 2 ]\n";

}  // namespace

TEST_CASE("convert: from one format to the next and back") {
    const ProgramFolder folder;
    folder.files().put("a.pbrt", kGrid);
    const Outcome vdb = folder.run("convert a.pbrt a.vdb");
    CHECK(vdb.errors == "");
    CHECK(vdb.exit_status == 0);
    CHECK(vdb.output ==
          "grid           a.vdb\n"
          "size           4 x 2 x 2\n"
          "cell           1 x 1 x 2 m\n"
          "box            0 0 10 to 4 2 14 m\n"
          "density = \"a.vdb\"\n");
    const Outcome info = folder.run("info a.vdb --grid density");
    CHECK(info.exit_status == 0);
    CHECK(holds(info.output, "kind           OpenVDB fog volume; grid \"density\" of"));
    CHECK(holds(info.output, "; 2 active voxels\n"));

    // Whole numbers say what they were divided by.
    const Outcome raw = folder.run("convert a.vdb a.raw --type uint8");
    CHECK(raw.exit_status == 0);
    CHECK(holds(raw.output,
                "density = { file = \"a.raw\", type = \"uint8\", size = [4, 2, 2] }\n"
                "# densities were divided by 2: multiply extinction_per_m by it\n"
                "bounds_m = [[0, 0, 10], [4, 2, 14]]\n"));
    CHECK(folder.files().get("a.raw") == std::string("\x40\0\0\0\0\0\0\0\0\0\0\0\0\0\0\xff", 16));
    const Outcome back = folder.run("convert a.raw b.vdb --size 4 2 2 --type uint8 --y-up");
    CHECK(back.exit_status == 0);
    CHECK(holds(back.output, "size           4 x 2 x 2\n"));

    // Extinctions in 1/m stay numbers, and the scene is told to take them as they are.
    folder.files().put("c.les", "1 1 2\n0.02 0.02 0.1 0.2\n0 0 0 0.5 10\n0 0 1 0 10\n");
    CHECK(holds(folder.run("convert c.les c.vdb").output, "\nextinction_per_m = 1\n"));
    CHECK(
        holds(folder.run("convert c.les c.raw --type uint16").output, "\nextinction_per_m = 0.07"));

    // A scene takes the converted file as it takes the first.
    const std::string keys = " --set 'medium.0.bounds_m=[[-50,-50,0],[50,50,100]]'";
    const Outcome first =
        folder.run("render s.toml -q -o a.pfm --set medium.0.density=a.pbrt" + keys);
    const Outcome second =
        folder.run("render s.toml -q -o b.pfm --set medium.0.density=a.vdb" + keys);
    CHECK(first.exit_status == 0);
    CHECK(first.output.substr(0, 16) == second.output.substr(0, 16));
}

TEST_CASE("convert: particles to a grid and back, and what a scene makes of them") {
    const ProgramFolder folder;
    folder.files().put("p.csv", "x,y,z,radius,density\n0,0,50,20,0.1\n10,0,60,10,0.2\n");
    const Outcome grid = folder.run("convert p.csv p.vdb --resolution 8 8 8");
    CHECK(grid.errors == "");
    CHECK(holds(grid.output, "size           8 x 8 x 8\n"));
    CHECK(holds(grid.output, "box            -20 -20 30 to 20 20 70 m\n"));
    CHECK(holds(folder.run("convert p.vdb back.ply").output, "density = \"back.ply\"\n"));
    CHECK(holds(folder.run("info back.ply").output, "particles, radius 7.5 to 7.5 m\n"));
    CHECK(holds(folder.run("info p.csv").output, "particles; 2 particles, radius 10 to 20 m\n"));
    const Outcome faulty = folder.run("convert p.csv p.ply --time 3");
    CHECK(holds(faulty.errors, "p.csv: --time, --member: for NetCDF files, allowed: left out"));
    CHECK(faulty.exit_status == 2);
}

TEST_CASE("convert: to NetCDF and back, the same bytes") {
    const ProgramFolder folder;
    folder.files().put("a.pbrt", kGrid);
    const Outcome nc = folder.run("convert a.pbrt a.nc");
    CHECK(nc.errors == "");
    CHECK(nc.output ==
          "grid           a.nc\n"
          "size           4 x 2 x 2\n"
          "cell           1 x 1 x 2 m\n"
          "box            0 0 10 to 4 2 14 m\n"
          "density = \"a.nc\"\n"
          "# relative densities: extinction_scale is the extinction at density 1, per m\n");
    CHECK(folder.run("convert a.nc a.raw").exit_status == 0);
    CHECK(folder.run("convert a.pbrt b.raw").exit_status == 0);
    CHECK(folder.files().get("a.raw") == folder.files().get("b.raw"));
    CHECK(folder.run("convert a.nc b.nc").output.find("#") == std::string::npos);
    const std::string whole = folder.files().get("a.nc");
    folder.files().put("c.nc", whole.substr(0, whole.size() - 1));
    CHECK(holds(folder.run("convert c.nc d.vdb").errors,
                "c.nc: variable density: the file ends before its values do"));
    const Outcome over = folder.run("convert a.nc a.nc");
    CHECK(over.exit_status == 2);
    CHECK(holds(over.errors, "a.nc: output: is the grid that is read"));
    CHECK(folder.files().get("a.nc") == whole);
    CHECK(holds(folder.run("convert a.pbrt d.nc --time 0").errors,
                "a.pbrt: --time, --member: for NetCDF files, allowed: left out"));
    CHECK(holds(folder.run("convert a.pbrt d.nc --resolution 2 2 2").errors,
                "a.pbrt: --resolution: for NetCDF files and particles, allowed: left out"));
    CHECK(holds(folder.run("convert a.nc d.vdb --resolution 2 2 2").errors,
                "a.nc: resolution: not for a grid of density, allowed: left out"));
    CHECK(holds(folder.run("convert a.nc d.vdb --resolution 2 0 2").errors,
                "--resolution: out of range, 0, allowed: 1 to 4096"));
}

TEST_CASE("convert: the scene's line holds the whole path, however long") {
    const ProgramFolder folder;
    folder.files().put("a.pbrt", kGrid);
    const std::string name = std::string(90, 'n') + ".vdb";
    const Outcome outcome = folder.run("convert a.pbrt " + name);
    CHECK(outcome.exit_status == 0);
    CHECK(holds(outcome.output, "\ndensity = \"" + name + "\"\n"));
}

TEST_CASE("convert: each fault is one line, and no file is left") {
    const ProgramFolder folder;
    folder.files().put("a.pbrt", kGrid);
    folder.files().put("n.vdb", "not a volume");
    const std::vector<std::string> before = folder.left();
    struct Row {
        const char *arguments, *line;
        int exit_status;
    };
    const Row rows[] = {
        {"a.pbrt b.pbrt", "b.pbrt: extension: unknown, \".pbrt\", allowed: .raw .vdb .nc .nc4 .cdf",
         2},
        {"a.raw b.raw", "b.raw: both files are raw, allowed: one of them", 2},
        {"a.raw b.vdb", "a.raw: --size: missing", 2},
        {"a.pbrt b.raw --size 1 1 1", "--size: for a .raw file that is read", 2},
        {"a.pbrt b.raw --type int", "--type: unknown, \"int\"", 2},
        {"none.pbrt b.vdb", "none.pbrt: cannot read: no such file", 2},
        {"n.vdb b.raw", "n.vdb: byte 8: mark of an OpenVDB file: not there", 2},
        {"a.pbrt /dev/null/b.vdb", "/dev/null/b.vdb: cannot write", 4},
        {"a.pbrt", "see pileus convert --help", 2},
    };
    for (const Row& row : rows) {
        CAPTURE(row.arguments);
        const Outcome outcome = folder.run(std::string("convert ") + row.arguments);
        CHECK(outcome.exit_status == row.exit_status);
        CHECK_MESSAGE(holds(outcome.errors, row.line), outcome.errors);
        CHECK(std::count(outcome.errors.begin(), outcome.errors.end(), '\n') == 1);
        CHECK(outcome.output == "");
        CHECK(folder.left() == before);
    }
}
