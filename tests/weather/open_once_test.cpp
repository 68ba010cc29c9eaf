// SPDX-License-Identifier: Apache-2.0
// A file of weather data is opened once by a session.
// in: a small file, taken away between the readings -> out: pass or fail.
// docs/weather.md; docs/testing.md, label weather
#include <filesystem>

#include "src/io/volumes/volume_file.h"
#include "src/io/volumes/weather_file.h"
#include "src/scene/read_scene.h"
#include "tests/io/temp_folder.h"
#include "tests/weather/weather_case.h"

using namespace pileus;

TEST_CASE("weather: a file that a session keeps is opened once, whatever is read of it") {
    const pileus::test::TempFolder folder;
    ::test::WeatherCase c;
    c.maker.dimension("z", 2);
    c.maker.dimension("south_north", 2);
    c.maker.dimension("west_east", 3);
    c.maker.variable("z", {"z"}, {500, 600}, "m");
    c.maker.variable("lwc", {"z", "south_north", "west_east"}, std::vector<double>(12, 0.1),
                     "g m-3");
    c.maker.globals = {{"MAP_PROJ", 1},  {"DX", 9000},      {"DY", 9000},    {"TRUELAT1", 30},
                       {"TRUELAT2", 60}, {"STAND_LON", 10}, {"CEN_LAT", 48}, {"CEN_LON", 10}};
    c.medium.density.clear();
    c.medium.source.format = "netcdf";
    c.medium.source.file = folder.put("w.nc", c.maker.bytes());
    const std::string path = c.medium.source.file;
    VolumeHead head;
    Volume volume;
    WeatherMap map;
    REQUIRE(read_volume_head(c.medium, path, head));
    Scene scene;
    scene.camera.orthographic = true;  // its picture tells its place
    scene.media = {c.medium, c.medium};
    WeatherFiles files;
    std::uint64_t bytes = 0;
    REQUIRE(density_file_bytes(scene.media[0], path, bytes, &files));
    CHECK(bytes == c.maker.bytes().size());
    std::filesystem::remove(path);
    CHECK(!read_volume_head(c.medium, path, head));
    for (const MediumSettings& medium : scene.media) {
        VolumeHead kept;
        REQUIRE(read_volume_head(medium, path, kept, &files));
        CHECK(kept.size == head.size);
        REQUIRE(read_volume(medium, path, volume, &files));
        CHECK(volume.size == head.size);
    }
    close_weather_files(scene, files);
    // The map stays known.
    REQUIRE(read_weather_map(scene.media[1], path, map, &files));
    CHECK(map.kind == MapKind::kConic);
    CHECK(!read_volume_head(scene.media[0], path, head, &files));
}

TEST_CASE("weather: a file whose name holds a # is that file, else a frame of a sequence") {
    const pileus::test::TempFolder folder;
    Scene scene;
    MediumSettings medium;
    medium.source.file = folder.path("cloud#1.nc");
    medium.source.first_frame = 7;
    CHECK(density_path(scene, medium) == folder.path("cloud71.nc"));
    folder.put("cloud#1.nc", "there");
    CHECK(density_path(scene, medium) == folder.path("cloud#1.nc"));
}
