// SPDX-License-Identifier: Apache-2.0
// Places on the maps of weather data: degrees, rotated poles, projections.
// in: files made in memory -> out: pass or fail, against Snyder's examples and against the columns'
// own places. docs/weather.md, "Places"; docs/testing.md, label weather
#include <cmath>
#include <glm/geometric.hpp>

#include "src/io/volumes/weather_file.h"
#include "tests/weather/weather_case.h"

using namespace pileus;

namespace {

constexpr double kMetres = 40030173.0 / 360;

Status map_of(const test::WeatherCase& c, WeatherMap& map) {
    const std::string bytes = c.maker.bytes();
    NcFile file;
    PILEUS_TRY(file.open_bytes("m.nc", {bytes.data(), bytes.size()}));
    return find_map(file, c.medium.weather, map);
}

Double3 place(const WeatherMap& map, double lon, double lat, double height = 0) {
    Double3 metres{};
    const Status status = map.place("place", {lon, lat, height}, metres);
    REQUIRE_MESSAGE(status, status.message);
    return metres;
}

/// 3 x 2 columns of content on two heights; the caller says where.
test::WeatherCase bare_case(const std::string& y, const std::string& x) {
    test::WeatherCase c;
    c.maker.dimension("z", 2);
    c.maker.dimension(y, 2);
    c.maker.dimension(x, 3);
    c.maker.variable("z", {"z"}, {500, 600}, "m");
    c.maker.variable("lwc", {"z", y, x}, std::vector<double>(12, 0.1), "g m-3");
    return c;
}

test::WeatherCase mapped_case(const char* name, const test::NetcdfMaker::Numbers& numbers) {
    test::WeatherCase c = bare_case("y", "x");
    c.maker.variable("y", {"y"}, {0, 2000}, "m");
    c.maker.variable("x", {"x"}, {-2000, 0, 2000}, "m");
    c.maker.of("lwc").texts.emplace_back("grid_mapping", "crs");
    auto& crs = c.maker.variable("crs", {}, {0});
    crs.texts.emplace_back("grid_mapping_name", name);
    crs.doubles = numbers;
    return c;
}

test::WeatherCase wrf_case(double kind) {
    test::WeatherCase c = bare_case("south_north", "west_east");
    c.maker.globals = {{"MAP_PROJ", kind}, {"DX", 9000},      {"DY", 9000},    {"TRUELAT1", 30},
                       {"TRUELAT2", 60},   {"STAND_LON", 10}, {"CEN_LAT", 48}, {"CEN_LON", 10}};
    return c;
}

}  // namespace

TEST_CASE("map: degrees, with the cosine of the row and without") {
    test::WeatherCase c = bare_case("lat", "lon");
    c.maker.variable("lat", {"lat"}, {50, 52}, "degrees_north");
    c.maker.variable("lon", {"lon"}, {359, 1, 3}, "degrees_east");
    WeatherMap map;
    REQUIRE(map_of(c, map));
    // The middle: 1 degree east, 51 north.
    CHECK(glm::length(place(map, 1, 51)) < 1e-6);
    CHECK(glm::length(place(map, -359, 51)) < 1e-6);
    const double radian = std::acos(-1.0) / 180;
    const double south = (std::sin(51 * radian) - std::sin(49 * radian)) / (2 * radian);
    const Double3 corner = place(map, -2, 49.5, 1000);
    CHECK(corner[0] == doctest::Approx(-3 * kMetres * south).epsilon(1e-12));
    CHECK(corner[1] == doctest::Approx(-1.5 * kMetres).epsilon(1e-12));
    CHECK(corner[2] == 1000);
    // Beyond the rows the cosine goes on.
    CHECK(place(map, 2, 60)[0] == doctest::Approx(kMetres * 0.5).epsilon(1e-12));
    CHECK(map.projection().substr(0, 22) == "+proj=sinu +lon_0=1 +x");
    c.medium.weather.place.plain_degrees = true;
    c.medium.weather.place.origin_deg = {0, 50};
    c.medium.weather.place.vertical_scale = 3;
    REQUIRE(map_of(c, map));
    CHECK(place(map, 2, 52, 10)[0] == doctest::Approx(2 * kMetres).epsilon(1e-12));
    CHECK(place(map, 2, 52, 10)[1] == doctest::Approx(2 * kMetres).epsilon(1e-12));
    CHECK(place(map, 2, 52, 10)[2] == 30);
    Double3 metres{};
    CHECK(map.place("p", {0, 90.5, 0}, metres).message ==
          "p: out of range, 0, 90.5, allowed: longitude -360 to 360, latitude -90 to 90");
}

TEST_CASE("map: a rotated pole turns places as the sphere does") {
    test::WeatherCase c = bare_case("rlat", "rlon");
    auto& lat = c.maker.variable("rlat", {"rlat"}, {-1, 1}, "degrees");
    lat.texts.emplace_back("standard_name", "grid_latitude");
    auto& lon = c.maker.variable("rlon", {"rlon"}, {-2, 0, 2}, "degrees");
    lon.texts.emplace_back("standard_name", "grid_longitude");
    WeatherMap map;
    CHECK(map_of(c, map).message.find("map: a rotated pole that nothing tells") !=
          std::string::npos);
    c.maker.of("lwc").texts.emplace_back("grid_mapping", "rotated_pole");
    auto& pole = c.maker.variable("rotated_pole", {}, {0});
    pole.doubles = {{"grid_north_pole_latitude", 39.25}, {"grid_north_pole_longitude", -162}};
    const Status status = map_of(c, map);
    REQUIRE_MESSAGE(status, status.message);
    // The rotated equator's zero lies a quarter from the pole: 18 east, 50.75 north.
    CHECK(glm::length(place(map, 18, 50.75)) < 1e-6);
    // Distances from there by the haversine of the sphere, within a degree, where the map is true.
    const double radian = std::acos(-1.0) / 180, earth = kMetres / radian;
    for (const auto& p : {std::array<double, 2>{18.4, 50.9}, {17.5, 50.5}, {18, 51.2}}) {
        const double a = std::sin((p[1] - 50.75) * radian / 2),
                     b = std::sin((p[0] - 18) * radian / 2);
        const double h = a * a + std::cos(50.75 * radian) * std::cos(p[1] * radian) * b * b;
        const double far = 2 * earth * std::asin(std::sqrt(h));
        CHECK(glm::length(place(map, p[0], p[1])) == doctest::Approx(far).epsilon(2e-4));
    }
    CHECK(place(map, 18.5, 50.75)[0] > 0);
    CHECK(place(map, 18, 50.9)[1] == doctest::Approx(0.15 * kMetres).epsilon(1e-9));
    CHECK(map.projection().find("+o_lat_p=39.25 +o_lon_p=0 +lon_0=18 ") != std::string::npos);
}

TEST_CASE("map: Snyder's numerical examples on a sphere of radius 1, in metres of 2e6") {
    // Working Manual, pages 266 (Mercator), 295 (Lambert), 312 (polar: by its formula 21-33).
    constexpr double kR = 2e6;
    WeatherMap map;
    const Status mercator = map_of(
        mapped_case("mercator", {{"earth_radius", kR}, {"longitude_of_projection_origin", -180}}),
        map);
    REQUIRE_MESSAGE(mercator, mercator.message);
    const double middle_y = 1000;
    CHECK(place(map, -75, 35)[0] == doctest::Approx(1.8325957 * kR).epsilon(1e-7));
    CHECK(place(map, -75, 35)[1] + middle_y == doctest::Approx(0.6528366 * kR).epsilon(1e-7));
    // A cone of one true latitude: made so that both parallels are told.
    test::WeatherCase c =
        mapped_case("lambert_conformal_conic", {{"earth_radius", kR},
                                                {"standard_parallel", 33},
                                                {"longitude_of_central_meridian", -96},
                                                {"latitude_of_projection_origin", 23}});
    REQUIRE(map_of(c, map));
    map.parallel[1] = 45;
    map.shift[0] = map.shift[1] = 0;
    const Double3 tip = place(map, -75, 35), foot = place(map, -96, 23);
    CHECK(tip[0] == doctest::Approx(0.2966785 * kR).epsilon(5e-7));
    CHECK(tip[1] - foot[1] == doctest::Approx(0.2462112 * kR).epsilon(5e-7));
    REQUIRE(
        map_of(mapped_case("polar_stereographic", {{"earth_radius", kR},
                                                   {"latitude_of_projection_origin", 90},
                                                   {"straight_vertical_longitude_from_pole", 0}}),
               map));
    const double radian = std::acos(-1.0) / 180;
    CHECK(place(map, 90, 60)[0] == doctest::Approx(2 * kR * std::tan(15 * radian)).epsilon(1e-9));
    CHECK(place(map, 0, 60)[1] + middle_y ==
          doctest::Approx(-2 * kR * std::tan(15 * radian)).epsilon(1e-9));
    CHECK(place(map, 0, 90)[1] + middle_y == doctest::Approx(0));
}

TEST_CASE("map: WRF by its first column or its middle; steps on the map") {
    for (const double kind : {1.0, 2.0, 3.0}) {
        CAPTURE(kind);
        test::WeatherCase c = wrf_case(kind);
        WeatherMap map;
        Status status = map_of(c, map);
        REQUIRE_MESSAGE(status, status.message);
        CHECK(glm::length(place(map, 10, 48)) < 1e-6);
        // Along the middle meridian the scale is the map's: north is north.
        CHECK(place(map, 10, 49)[0] == doctest::Approx(0).epsilon(1e-9));
        CHECK(place(map, 10, 49)[1] > 9e4);
        CHECK(place(map, 11, 48)[0] > 6e4);
        // The first column at a place: it lies 9 km west and 4.5 km south of the middle.
        c.maker.variable("XLAT", {"south_north", "west_east"}, std::vector<double>(6, 47.9));
        c.maker.variable("XLONG", {"south_north", "west_east"}, std::vector<double>(6, 9.8));
        REQUIRE(map_of(c, map));
        CHECK(place(map, double(float(9.8)), double(float(47.9)))[0] == doctest::Approx(-9000));
        CHECK(place(map, double(float(9.8)), double(float(47.9)))[1] == doctest::Approx(-4500));
        CHECK(map.projection().find("+R=6370000") != std::string::npos);
    }
    test::WeatherCase c = wrf_case(1);
    WeatherMap map;
    c.maker.globals[3].second = 30;
    c.maker.globals[4].second = -30;
    CHECK(map_of(c, map).message.find("map: true latitudes of no cone") != std::string::npos);
}

TEST_CASE("map: files without one say so in a line") {
    WeatherMap map;
    test::WeatherCase c = mapped_case("orthographic", {});
    CHECK(map_of(c, map).message.find("m.nc: variable lwc: map: projection: unknown, "
                                      "\"orthographic\"") == 0);
    c = mapped_case("mercator", {{"semi_major_axis", 6378137}, {"inverse_flattening", 298.257}});
    CHECK(map_of(c, map).message.find("map: an ellipsoid, allowed: a sphere") != std::string::npos);
    c.maker.of("lwc").texts.pop_back();
    CHECK(map_of(c, map).message.find("map: none, allowed: longitudes and latitudes, WRF") !=
          std::string::npos);
}
