// SPDX-License-Identifier: Apache-2.0
// The forecast that tools/make_weather makes up, and the scenes that show it.
// in: the tool, run by Python -> out: pass or fail; left out, with a line, where there is no
// Python. docs/weather.md, "A made-up forecast"; docs/testing.md, label weather
#include <glm/geometric.hpp>

#include "src/io/volumes/weather_file.h"
#include "src/scene/read_scene.h"
#include "src/session/render.h"
#include "tests/io/temp_folder.h"
#include "tests/weather/weather_case.h"

using namespace pileus;

namespace {

bool has_python() {
    if (std::system("python3 -c '' >/dev/null 2>&1") == 0) return true;
    MESSAGE("left out: no python3 here");
    return false;
}

/// Tests run in the root of the sources.
bool make(const std::string& path, const std::string& options) {
    const std::string line =
        "python3 tools/make_weather '" + path + "' " + options + " >/dev/null 2>&1";
    return std::system(line.c_str()) == 0;
}

}  // namespace

TEST_CASE("made forecast: clouds of stated heights on a standard atmosphere") {
    if (!has_python()) return;
    const pileus::test::TempFolder folder;
    const std::string path = folder.path("w.nc");
    REQUIRE(make(path, "--size 14 12 60 --step 2.5 --members 2"));
    NcFile file;
    REQUIRE(file.open(path));
    CHECK(file.head().attribute("source")->text.find("made up") == 0);
    MediumSettings medium;
    medium.weather.time = {true, "2026-06-21T12", 0};
    medium.weather.member = {false, "", 1};
    WeatherSource source;
    const Status status = open_weather(file, medium.weather, source);
    REQUIRE_MESSAGE(status, status.message);
    CHECK(source.hybrid_b.size() == 61);
    WeatherSurvey survey;
    REQUIRE(survey_weather(source, survey));
    CHECK(survey.counts.missing == 0);
    CHECK(survey.counts.clamped == 0);
    // Decks from 600 m to 11.5 km, by pressure: a low of 35 hPa moves them by 300 m, the air's
    // warmth by 5 %.
    CHECK(survey.low_m > 200);
    CHECK(survey.low_m < 1600);
    CHECK(survey.high_m > 7000);
    CHECK(survey.high_m < 12500);
    CHECK(survey.most_depth > 5);
    CHECK(survey.most_depth < 500);
    // The standard atmosphere: 288.15 K at the ground, 11 K between south and north; 216.65 K
    // above.
    Buffer<double> kelvin;
    REQUIRE(read_field(source, Role::kTemperature, 0, 1, kelvin));
    CHECK(kelvin[0] == doctest::Approx(288.15 + 5.04).epsilon(1e-3));
    CHECK(kelvin[46] == doctest::Approx(216.65).epsilon(1e-3));
    // Another member is another cloud.
    WeatherSurvey other;
    medium.weather.member = {false, "", 0};
    REQUIRE(open_weather(file, medium.weather, source));
    REQUIRE(survey_weather(source, other));
    CHECK(other.depth_m2 != survey.depth_m2);
}

TEST_CASE("made forecast: about a rotated pole, whose map is known") {
    if (!has_python()) return;
    const pileus::test::TempFolder folder;
    const std::string path = folder.path("w.nc");
    REQUIRE(make(path, "--size 7 5 12 --step 1 --times 1 --rotated"));
    WeatherMap map;
    const Status status = read_weather_map({}, path, map);
    REQUIRE_MESSAGE(status, status.message);
    Double3 metres{};
    REQUIRE(map.place("place", {18, 50.75, 0}, metres));
    CHECK(glm::length(metres) < 1e-3);
}

TEST_CASE("made forecast: its scenes render") {
    if (!has_python()) return;
    const pileus::test::TempFolder folder;
    const std::string path = folder.path("w.nc");
    REQUIRE(make(path, "--size 40 40 60 --step 0.75"));
    for (const char* name : {"optical_depth", "photon_grid", "ground"}) {
        CAPTURE(name);
        Scene scene;
        const Status read =
            read_scene_file(std::string("assets/scenes/weather_made_") + name + ".toml",
                            {"camera.resolution=[32, 18]", "photon_grid.photons=20000",
                             "photon_grid.cells=[8, 8, 4]",
                             "medium=[{ density = { file = \"" + path + "\", time = 1 } }]"},
                            scene);
        REQUIRE_MESSAGE(read, read.message);
        bool clouds = false, map = false;
        const Status status = render(scene, {}, [&](int, Image& image, Report&) {
            for (const float alpha : image.find("A")->pixels.span()) clouds |= alpha > 0.5f;
            for (const auto& told : image.origin) map |= told.first == "projection";
            return Status::ok();
        });
        REQUIRE_MESSAGE(status, status.message);
        CHECK(clouds);
        CHECK(map == (std::string(name) != "ground"));
    }
}

TEST_CASE("made forecast: what it cannot make it refuses, and leaves no file") {
    if (!has_python()) return;
    const pileus::test::TempFolder folder;
    for (const char* options : {"--size 3 3 1", "--size 0 3 9", "--times 0", "--corner 0 89"}) {
        CAPTURE(options);
        CHECK_FALSE(make(folder.path("w.nc"), options));
    }
    CHECK_FALSE(make("/dev/null/w.nc", "--size 2 2 2 --times 1"));
    CHECK(folder.entries() == 0);
    CHECK(make(folder.path("made/w.nc"), "--size 2 2 2 --times 1"));  // folders are made
}
