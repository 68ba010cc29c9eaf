// SPDX-License-Identifier: Apache-2.0
// What files of other models look like: CF names, hybrid and pressure levels, WRF, times, slices.
// in: files made in memory -> out: pass or fail.
// docs/weather.md, "Variables", "Dimensions"; docs/testing.md, label weather
#include <cmath>

#include "tests/weather/weather_case.h"

using namespace pileus;
using test::WeatherCase;

namespace {

constexpr double kG = 9.80665, kR = 287.05;

/// Four hybrid levels over a grid of 1 x 2, mass fractions by their standard names alone.
WeatherCase hybrid_case() {
    WeatherCase c;
    c.maker.dimension("lev", 2);
    c.maker.dimension("ilev", 3);
    c.maker.dimension("lat", 1);
    c.maker.dimension("lon", 2);
    c.maker.variable("lat", {"lat"}, {0}, "degrees_north");
    c.maker.variable("lon", {"lon"}, {10, 11}, "degrees_east");
    c.maker.variable("hyai", {"ilev"}, {50000, 20000, 0}, "Pa");
    c.maker.variable("hybi", {"ilev"}, {0, 0.6, 1}, "1");
    c.maker.variable("aps", {"lat", "lon"}, {100000, 90000}, "Pa")
        .texts.emplace_back("standard_name", "surface_air_pressure");
    c.maker.variable("tk", {"lev", "lat", "lon"}, {260, 260, 280, 280}, "K")
        .texts.emplace_back("standard_name", "air_temperature");
    c.maker.variable("foo", {"lev", "lat", "lon"}, {0, 0, 2e-4, 1e-4}, "kg kg-1")
        .texts.emplace_back("standard_name", "mass_fraction_of_cloud_liquid_water_in_air");
    c.maker.variable("phi", {"lat", "lon"}, {0, 9806.65}, "m2 s-2")
        .texts.emplace_back("standard_name", "surface_geopotential");
    return c;
}

}  // namespace

TEST_CASE("conventions: hybrid faces, standard names, the ground's geopotential") {
    WeatherCase c = hybrid_case();
    c.medium.box.resolution = {2, 1, 200};
    const Status status = c.load();
    REQUIRE_MESSAGE(status, status.message);
    // Faces at the ground 1e5 and 9e4, above 2e4 + 0.6 ps.
    const double path0 = 2e-4 * (1e5 - 8e4) / kG, path1 = 1e-4 * (9e4 - 7.4e4) / kG;
    CHECK(c.depth(0, 0) == doctest::Approx(1.5 * path0 / 0.01).epsilon(1e-6));
    CHECK(c.depth(1, 0) == doctest::Approx(1.5 * path1 / 0.01).epsilon(1e-6));
    CHECK(c.volume.bounds_m[0][2] == doctest::Approx(0));
    const double top0 = kR * 280 / kG * std::log(1 / 0.8);
    const double top1 = 1000 + kR * 280 / kG * std::log(9 / 7.4);
    CHECK(c.volume.bounds_m[1][2] == doctest::Approx(std::fmax(top0, top1)).epsilon(1e-6));
    CHECK(c.head.detail.find("hybrid faces from above") != std::string::npos);
}

TEST_CASE("conventions: hybrid levels by formula_terms, the ground's pressure as a logarithm") {
    WeatherCase c = hybrid_case();
    for (const char* name : {"hyai", "hybi", "aps", "phi"}) c.maker.remove(name);
    c.maker.variable("lev", {"lev"}, {1, 2}, "1").texts = {
        {"standard_name", "atmosphere_hybrid_sigma_pressure_coordinate"},
        {"formula_terms", "ap: am b: bm ps: lnsp"}};
    c.maker.variable("am", {"lev"}, {30000, 10000}, "Pa");
    c.maker.variable("bm", {"lev"}, {0.2, 0.8}, "1");
    auto& lnsp = c.maker.variable("lnsp", {"lat", "lon"}, {std::log(1e5), std::log(9e4)}, "1");
    lnsp.type = NcType::kDouble;
    c.medium.box.resolution = {2, 1, 64};
    const Status status = c.load();
    REQUIRE_MESSAGE(status, status.message);
    // Levels 5e4 and 9e4: the face between is their geometric mean, the lowest the ground.
    const double path0 = 2e-4 * (1e5 - std::sqrt(5e4 * 9e4)) / kG;
    CHECK(c.depth(0, 0) == doctest::Approx(1.5 * path0 / 0.01).epsilon(1e-6));
    CHECK(c.head.detail.find("hybrid levels") != std::string::npos);
}

TEST_CASE("conventions: pressure levels in hPa, one of several times by its date") {
    WeatherCase c;
    c.maker.records = 2;
    c.maker.dimension("time", 0);
    c.maker.dimension("plev", 3);
    c.maker.dimension("lat", 2);
    c.maker.dimension("lon", 2);
    c.maker.variable("time", {"time"}, {6, 18}, "hours since 2005-08-28 00:00:00");
    c.maker.variable("plev", {"plev"}, {900, 800, 600}, "hPa");
    c.maker.variable("lat", {"lat"}, {1, 0}, "degrees_north");
    c.maker.variable("lon", {"lon"}, {10, 11}, "degrees_east");
    std::vector<double> t(24, 280.0), w(24, 0.0);
    w[12 + 4 + 1] = 0.2;  // second time, 800 hPa, northern row, eastern column
    c.maker.variable("ta", {"time", "plev", "lat", "lon"}, t, "K");
    c.maker.variable("clw", {"time", "plev", "lat", "lon"}, w, "g kg-1");
    c.medium.weather.place.plain_degrees = true;  // so that cells are footprints
    c.medium.weather.time = {true, "2005-08-28 18", 0};
    const Status status = c.load();
    REQUIRE_MESSAGE(status, status.message);
    CHECK(c.head.detail.find("2005-08-28T18:00:00") != std::string::npos);
    const double path = 2e-4 * (std::sqrt(8e4 * 9e4) - std::sqrt(8e4 * 6e4)) / kG;
    CHECK(c.depth(1, 1) == doctest::Approx(1.5 * path / 0.01).epsilon(1e-6));
    CHECK(c.depth(1, 0) == 0);
    c.medium.weather.time = {false, "", 0};
    REQUIRE(c.load());
    CHECK(c.total() == 0);
    c.medium.weather.time = {true, "2005-08", 0};
    CHECK(c.fault().find("w.nc: time: several in the file, \"2005-08\"") == 0);
    c.medium.weather.time = {true, "2006-01", 0};
    CHECK(
        c.fault().find("w.nc: time: not in the file, \"2006-01\", allowed: 0 to 1 or the beginning "
                       "of one date from 2005-08-28T06:00:00") == 0);
}

TEST_CASE("conventions: WRF's names, staggered geopotential, water per kg of dry air") {
    WeatherCase c;
    c.maker.records = 1;
    c.maker.dimension("Time", 0);
    c.maker.dimension("bottom_top", 2);
    c.maker.dimension("bottom_top_stag", 3);
    c.maker.dimension("south_north", 1);
    c.maker.dimension("west_east", 2);
    const std::vector<std::string> at{"Time", "bottom_top", "south_north", "west_east"};
    const std::vector<std::string> faces{"Time", "bottom_top_stag", "south_north", "west_east"};
    c.maker.variable("P", at, {500, 500, -500, -500}, "Pa");
    c.maker.variable("PB", at, {89500, 89500, 80500, 80500}, "Pa");
    c.maker.variable("T", at, {-5, -5, 0, 0}, "K");
    c.maker.variable("PH", faces, {0, 0, 10, 10, 20, 20}, "m2 s-2");
    c.maker.variable("PHB", faces, {981, 981, 9800, 9800, 19600, 19600}, "m2 s-2");
    c.maker.variable("QVAPOR", at, {0.01, 0.01, 0.005, 0.005}, "kg kg-1");
    c.maker.variable("QCLOUD", at, {0, 5e-4, 0, 0}, "kg kg-1");
    c.maker.globals = {{"DX", 10000}, {"DY", 8000}, {"MAP_PROJ", 3}};
    c.medium.box.resolution = {2, 1, 1};
    const Status status = c.load();
    REQUIRE_MESSAGE(status, status.message);
    const double kelvin = 295 * std::pow(0.9, 2.0 / 7), humidity = 0.01 / 1.01;
    const double air = 90000 / (kR * kelvin * (1 + 0.608 * humidity));
    const double content = 5e-4 * air / 1.01, thickness = (9810 - 981) / 9.81;
    CHECK(c.depth(1, 0) == doctest::Approx(1.5 * content / 0.01 * thickness).epsilon(1e-6));
    CHECK(c.volume.bounds_m[0][2] == doctest::Approx(100));
    CHECK(c.volume.bounds_m[1][2] == doctest::Approx(1000));
    CHECK(c.cell_m(0) == 10000);
    CHECK(c.cell_m(1) == 8000);
    CHECK(c.head.detail.find("Mercator") != std::string::npos);
}

TEST_CASE("conventions: a slice along a meridian from north to south, an origin of one's own") {
    WeatherCase c;
    c.maker.dimension("column", 3);
    c.maker.dimension("level", 2);
    c.maker.variable("lat", {"column"}, {52, 51, 50}, "degrees_north");
    c.maker.variable("lon", {"column"}, {135, 135, 135}, "degrees_east");
    c.maker.variable("height", {"column", "level"}, {2000, 1000, 2000, 1000, 2000, 1000}, "m");
    c.maker.variable("lwc", {"column", "level"}, {0, 0, 0, 0, 0, 0.1}, "g m-3");
    c.medium.weather.place.origin_deg = {135, 50};
    const Status status = c.load();
    REQUIRE_MESSAGE(status, status.message);
    // 15 optical depths in cells of two.
    CHECK(c.volume.size == std::array<int, 3>{1, 3, 8});
    const double degree = 40030173.0 / 360;
    CHECK(c.volume.bounds_m[0][1] == doctest::Approx(-0.5 * degree).epsilon(1e-9));
    CHECK(c.volume.bounds_m[1][1] == doctest::Approx(2.5 * degree).epsilon(1e-9));
    CHECK(c.depth(0, 0) > 0);  // the last column is the southernmost
    CHECK(c.depth(0, 2) == 0);
    c.maker.of("lon").values = {135, 136, 137};
    CHECK(c.fault().find("neither on a meridian nor on a parallel") != std::string::npos);
}

TEST_CASE("conventions: degrees with the cosine of latitude and without") {
    WeatherCase c = test::content_case();
    c.maker.set_units("x", "degrees_east");
    c.maker.of("x").values = {0, 1};
    c.maker.set_units("y", "degrees_north");
    c.maker.of("y").values = {60};
    REQUIRE(c.load());
    const double degree = 40030173.0 / 360, pi = 3.14159265358979323846;
    // A single row is as high as its columns are apart, and has the mean cosine of its latitudes.
    const double half = c.cell_m(1) / degree / 2;
    const double mean = (std::sin((60 + half) * pi / 180) - std::sin((60 - half) * pi / 180)) /
                        (2 * half * pi / 180);
    CHECK(c.cell_m(0) == doctest::Approx(degree * mean).epsilon(1e-9));
    c.medium.weather.place.plain_degrees = true;
    REQUIRE(c.load());
    CHECK(c.cell_m(0) == doctest::Approx(degree).epsilon(1e-9));
}

TEST_CASE("conventions: a rotated pole counts its own degrees, a member is chosen") {
    WeatherCase c = test::content_case();
    for (const char* name : {"x", "y"}) c.maker.remove(name);
    c.maker.dimension("member", 2);
    c.maker.variable("x", {"x"}, {-1, 0}, "degrees")
        .texts.emplace_back("standard_name", "grid_longitude");
    c.maker.variable("y", {"y"}, {0}, "degrees")
        .texts.emplace_back("standard_name", "grid_latitude");
    c.maker.of("lwc").dimensions = {"member", "z", "y", "x"};
    c.maker.of("lwc").values = {0, 0, 0, 0, 0, 0, 0.1, 0, 0, 0, 0, 0};
    c.medium.weather.member = {false, "", 1};
    const Status status = c.load();
    REQUIRE_MESSAGE(status, status.message);
    CHECK(c.cell_m(0) == doctest::Approx(40030173.0 / 360).epsilon(1e-4));
    CHECK(c.depth(0, 0) > 0);
}
