// SPDX-License-Identifier: Apache-2.0
// Pictures on the map of weather data: places of the camera, extents, world files, pictures as
// NetCDF. in: a small file of weather data, made in memory -> out: pass or fail. docs/weather.md,
// "Places", "Pictures on the map"
#include "src/io/netcdf/netcdf_file.h"
#include "tests/cli/run_program.h"
#include "tests/support/netcdf_maker.h"

using pileus::test::holds;
using pileus::test::Outcome;
using pileus::test::ProgramFolder;

namespace {

/// 4 x 3 columns of a degree about 10 E, 50 N, one layer of cloud.
std::string weather_bytes() {
    ::test::NetcdfMaker maker;
    maker.dimension("z", 2);
    maker.dimension("lat", 3);
    maker.dimension("lon", 4);
    maker.variable("z", {"z"}, {1000, 2000}, "m");
    maker.variable("lat", {"lat"}, {49, 50, 51}, "degrees_north");
    maker.variable("lon", {"lon"}, {8.5, 9.5, 10.5, 11.5}, "degrees_east");
    maker.variable("lwc", {"z", "lat", "lon"}, std::vector<double>(24, 0.1), "g m-3");
    return maker.bytes();
}

/// Straight down, by places; 40 x 20 pixels of 10 km.
const char* const kScene =
    "[camera]\nprojection = \"orthographic\"\nposition_deg = [10, 50, 9000]\n"
    "target_deg = [10, 50, 0]\nup = [0, 1, 0]\nheight_m = 200_000\nresolution = [40, 20]\n"
    "[sun]\nelevation_deg = 40\n[[medium]]\ndensity = \"w.nc\"\n[method]\nname = \"raymarch\"\n"
    "[raymarch]\nscattering = \"octaves\"\n";

}  // namespace

TEST_CASE("map pictures: a camera by places, its world file, and a picture as NetCDF") {
    const ProgramFolder folder;
    folder.files().put("w.nc", weather_bytes());
    folder.files().put("m.toml", kScene);
    const Outcome outcome = folder.run("render m.toml -q -o a.png a.pfm a.nc --world-file");
    CHECK(outcome.errors == "");
    REQUIRE(outcome.exit_status == 0);
    CHECK(holds(outcome.output, "world file       a.pgw\nworld file       a.wld\n"));
    CHECK(folder.files().get("a.pgw") == "10000\n0\n0\n-10000\n-195000\n95000\n");
    CHECK(folder.files().get("a.wld") == folder.files().get("a.pgw"));
    CHECK(holds(folder.files().get("a.png"), "pileus.extent_m"));

    // In metres it is the same picture.
    const Outcome metres = folder.run(
        "render m.toml -q -o b.pfm --set "
        "'camera={projection=\"orthographic\",position_m=[0,0,9000],"
        "target_m=[0,0,0],up=[0,1,0],height_m=200000,resolution=[40,20]}'");
    CHECK(metres.errors == "");
    CHECK(folder.files().get("b.pfm") == folder.files().get("a.pfm"));

    pileus::NcFile file;
    const std::string bytes = folder.files().get("a.nc");
    REQUIRE(file.open_bytes("a.nc", {bytes.data(), bytes.size()}));
    double first[2];
    const pileus::NcVariable *y = file.head().find("y"), *red = file.head().find("R");
    REQUIRE((y != nullptr && red != nullptr));
    REQUIRE(file.read(*y, {{0}, {2}}, {first, 2}));
    CHECK(first[0] == 95000);
    CHECK(first[1] == 85000);
    CHECK(red->text("grid_mapping") == "crs");
    CHECK(holds(file.head().find("crs")->text("proj4"), "+proj=sinu +lon_0=10 "));
    // Its first value is the picture's upper left corner: the PFM's last row begins with it.
    double value = 0;
    float corner = 0;
    REQUIRE(file.read(*red, {{0, 0}, {1, 1}}, {&value, 1}));
    const std::string pfm = folder.files().get("a.pfm");
    std::memcpy(&corner, pfm.data() + pfm.size() - 40 * 12, 4);
    CHECK(value == double(corner));
}

TEST_CASE("map pictures: faults are one line, and no file is left") {
    const ProgramFolder folder;
    folder.files().put("w.nc", weather_bytes());
    folder.files().put("m.toml", kScene);
    const std::vector<std::string> before = folder.left();
    struct Row {
        const char *arguments, *line;
    };
    const Row rows[] = {
        {"m.toml -o a.png --world-file --set camera.up=[1,0,0] --set "
         "'camera.position_deg=[11,50,9]'",
         "m.toml: --world-file: no map, allowed: an orthographic camera that looks straight down"},
        {"s.toml -o a.png --world-file", "s.toml: --world-file: no map"},
        {"m.toml -o a.png --set 'camera.target_deg=[10,50,9000]'", "same as the target"},
        {"m.toml -o a.png --set 'camera.up=[0,0,1]'", "the view is along camera.up"},
        {"m.toml -o a.png --set 'ground={}' --set 'camera.position_deg=[10,50,-1]'",
         "camera.position_deg: below the ground, z -1"},
        {"m.toml -o a.png --set camera.position_m=[0,0,1]",
         "conflicts with camera.position_deg, [0, 0, 1], allowed: left out"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.arguments);
        const Outcome outcome = folder.run(std::string("render -q ") + row.arguments);
        CHECK(outcome.exit_status == 2);
        CHECK_MESSAGE(holds(outcome.errors, row.line), outcome.errors);
        CHECK(std::count(outcome.errors.begin(), outcome.errors.end(), '\n') == 1);
        CHECK(folder.left() == before);
    }
    CHECK(holds(folder.run("info s.toml --place 1 2").errors, "--place: for weather data"));
    CHECK(holds(folder.run("info w.nc --place 1 95").errors, "--place: out of range, 1, 95"));
    CHECK(holds(folder.run("info w.nc --place 10 50").output, "place          10 50 at "));
}
