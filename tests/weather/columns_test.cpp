// SPDX-License-Identifier: Apache-2.0
// Columns without values, heights above the ground, levels that are numbers, cloud fractions of 0,
// files of WRF without a map.
// in: small files made in memory -> out: pass or fail.
// docs/weather.md, "Heights", "Place", "Missing and bad values"; docs/testing.md, label weather
#include <cmath>

#include "tests/weather/weather_case.h"

using namespace pileus;
using test::WeatherCase;

namespace {

constexpr double kFill = 1e20;

/// 2 x 2 columns on heights of their own, water as a ratio in the lower of two layers.
WeatherCase holed_case() {
    WeatherCase c;
    c.maker.dimension("z", 3);
    c.maker.dimension("y", 2);
    c.maker.dimension("x", 2);
    c.maker.variable("y", {"y"}, {0, 1000}, "m");
    c.maker.variable("x", {"x"}, {0, 1000}, "m");
    const std::vector<std::string> at{"z", "y", "x"};
    const auto field = [&](const char* name, std::vector<double> values, const char* unit) {
        c.maker.variable(name, at, values, unit).doubles = {{"_FillValue", kFill}};
    };
    field("height", {3000, 3000, 3000, 3000, 2000, 2000, 2000, 2000, 1000, 1000, 1000, 1000}, "m");
    field("qc", {0, 0, 0, 0, 5e-4, 5e-4, 5e-4, 5e-4, 0, 0, 0, 0}, "kg kg-1");
    field("ta", std::vector<double>(12, 280.0), "K");
    field("p", std::vector<double>(12, 80000.0), "Pa");
    return c;
}

void empty_column(WeatherCase& c, const char* name, std::size_t column, double value = kFill) {
    for (std::size_t k = 0; k < 3; ++k) c.maker.of(name).values[4 * k + column] = value;
}

/// Layers of 100 m on a coordinate of heights, over ground at 0 and at 1500 m.
WeatherCase hill_case(const char* standard_name) {
    WeatherCase c = test::content_case();
    c.maker.of("z").texts.emplace_back("standard_name", standard_name);
    c.maker.variable("orog", {"y", "x"}, {0, 1500}, "m")
        .texts.emplace_back("standard_name", "surface_altitude");
    return c;
}

WeatherCase wrf_case(double map) {
    WeatherCase c;
    c.maker.records = 1;
    c.maker.dimension("Time", 0);
    c.maker.dimension("bottom_top", 2);
    c.maker.dimension("bottom_top_stag", 3);
    c.maker.dimension("south_north", 2);
    c.maker.dimension("west_east", 2);
    const std::vector<std::string> at{"Time", "bottom_top", "south_north", "west_east"};
    c.maker.variable("PB", at, std::vector<double>(8, 90000.0), "Pa");
    c.maker.variable("P", at, std::vector<double>(8, 0.0), "Pa");
    c.maker.variable("T", at, std::vector<double>(8, 0.0), "K");
    const std::vector<std::string> faces{"Time", "bottom_top_stag", "south_north", "west_east"};
    c.maker.variable("PH", faces, std::vector<double>(12, 0.0), "m2 s-2");
    c.maker.variable("PHB", faces, {0, 0, 0, 0, 9810, 9810, 9810, 9810, 19620, 19620, 19620, 19620},
                     "m2 s-2");
    c.maker.variable("QCLOUD", at, {0, 0, 0, 0, 1e-3, 1e-3, 1e-3, 1e-3}, "kg kg-1");
    c.maker.globals = {{"DX", 500}, {"DY", 250}, {"MAP_PROJ", map}};
    return c;
}

// Dry air of 300 K potential temperature at 900 hPa: 1000 m of 1 g/kg in drops of 10 um.
double wrf_depth() {
    return 1.5 * 1e-3 * 90000 / (287.05 * 300 * std::pow(0.9, 2.0 / 7)) / 0.01 * 1000;
}

}  // namespace

TEST_CASE("columns: those without a value are clear and counted, the first one too") {
    WeatherCase c = holed_case();
    const double depth = 1.5 * 5e-4 * 80000 / (287.05 * 280) / 0.01 * 1000;
    REQUIRE(c.load());
    CHECK(c.volume.blank == 0);
    for (const char* name : {"height", "qc", "ta", "p"}) empty_column(c, name, 0);
    // No water and no air: a regridding that fills water with 0.
    empty_column(c, "qc", 3, 0);
    empty_column(c, "ta", 3);
    const Status status = c.load();
    REQUIRE_MESSAGE(status, status.message);
    CHECK(c.volume.blank == 2);
    CHECK(c.volume.missing == 3);
    CHECK(c.depth(0, 0) == 0);
    CHECK(c.depth(1, 0) == doctest::Approx(depth).epsilon(1e-6));
    CHECK(c.depth(0, 1) == doctest::Approx(depth).epsilon(1e-6));
    CHECK(c.depth(1, 1) == 0);
    CHECK(c.head.detail.find("2 columns without a value are clear") != std::string::npos);
    c.medium.weather.missing_is_fault = true;
    CHECK(c.fault().find("w.nc: variable qc: row 0, column 0: level 2: missing value") == 0);
}

TEST_CASE("columns: water without air is a fault, and a file without any value") {
    WeatherCase c = holed_case();
    empty_column(c, "ta", 1);
    CHECK(c.fault().find("w.nc: variable ta: row 0, column 1: all values missing") == 0);
    WeatherCase none = holed_case();
    none.maker.of("qc").values.assign(12, 0);
    none.maker.of("ta").values.assign(12, kFill);
    CHECK(none.fault().find("w.nc: variable qc: no column has values of it and of its air") == 0);
}

TEST_CASE("columns: a field of any kind with a hole is empty there") {
    WeatherCase c = holed_case();
    c.maker.variable("cc", {"z", "y", "x"}, std::vector<double>(12, 0.5)).doubles = {
        {"_FillValue", kFill}};
    empty_column(c, "cc", 2);
    empty_column(c, "height", 2);
    c.medium.weather.names.variable = "cc";
    c.medium.optics.transfer = {{0, 0, {1, 1, 1}}, {1, 0.01, {1, 1, 1}}};
    const Status status = c.load();
    REQUIRE_MESSAGE(status, status.message);
    CHECK(c.volume.blank == 1);
    const std::size_t hole = 2;
    CHECK(c.volume.density[hole] != c.volume.density[hole]);
    CHECK(c.volume.density[0] == 0.5f);
}

TEST_CASE("columns: height counts from the ground, altitude from the datum") {
    WeatherCase above = hill_case("height"), datum = hill_case("altitude");
    REQUIRE(above.load());
    REQUIRE(datum.load());
    CHECK(datum.volume.bounds_m[1][2] == doctest::Approx(800));
    CHECK(above.volume.bounds_m[1][2] == doctest::Approx(2300));
    CHECK(above.volume.bounds_m[0][2] == doctest::Approx(500));
    CHECK(above.head.detail.find("above the ground") != std::string::npos);
    above.maker.remove("orog");
    REQUIRE(above.load());
    CHECK(above.volume.bounds_m[1][2] == doctest::Approx(800));
    CHECK(above.head.detail.find("which is not known: at 0 m") != std::string::npos);
    // Words say the same where no standard name does.
    WeatherCase words = hill_case("height");
    words.maker.of("z").texts = {{"units", "m"}, {"long_name", "Height above ground level"}};
    REQUIRE(words.load());
    CHECK(words.volume.bounds_m[1][2] == doctest::Approx(2300));
}

TEST_CASE("columns: hybrid heights and sigma by their formulas") {
    WeatherCase c = test::content_case();
    c.maker.set_units("z", "m");
    c.maker.of("z").texts.emplace_back("standard_name", "atmosphere_hybrid_height_coordinate");
    c.maker.of("z").texts.emplace_back("formula_terms", "a: z b: share orog: orog");
    c.maker.variable("share", {"z"}, {0.9, 0.8, 0.7}, "1");
    c.maker.variable("orog", {"y", "x"}, {0, 400}, "m")
        .texts.emplace_back("standard_name", "surface_altitude");
    const Status status = c.load();
    REQUIRE_MESSAGE(status, status.message);
    // Levels of the second column: 910, 970, 1030; the layers of 0.4 and 0.3 g/m3 end at 1060.
    CHECK(c.volume.bounds_m[1][2] == doctest::Approx(1060));
    CHECK(c.volume.bounds_m[0][2] == doctest::Approx(500));
    WeatherCase ratio;
    ratio.maker = c.maker;
    ratio.maker.set_units("lwc", "g kg-1");
    ratio.maker.variable("t", {"z", "y", "x"}, std::vector<double>(6, 280.0), "K");
    CHECK(ratio.fault().find("w.nc: pressure: no such variable") == 0);
    c.maker.remove("share");
    CHECK(c.fault().find("w.nc: variable z: formula_terms: not enough to place the levels") == 0);

    WeatherCase s = test::pressure_case();
    s.maker.remove("pressure_hl");
    s.maker.remove("temperature_hl");
    s.maker.variable("t", {"column", "level"}, {280, 280, 280}, "K");
    s.maker.variable("level", {"level"}, {0.7, 0.8, 0.9}, "1").texts = {
        {"standard_name", "atmosphere_sigma_coordinate"},
        {"formula_terms", "sigma: level ps: ps ptop: top"}};
    s.maker.variable("ps", {"column"}, {1e5}, "Pa");
    s.maker.variable("top", {}, {100}, "hPa");
    const Status sigma = s.load();
    REQUIRE_MESSAGE(sigma, sigma.message);
    // Pressures 730, 820, 910 hPa: the middle layer has its faces at the geometric means.
    const double path = 3e-4 * 100 * (std::sqrt(820.0 * 910) - std::sqrt(820.0 * 730)) / 9.80665;
    const double low = 1e-4 * (1e5 - 100 * std::sqrt(820.0 * 910)) / 9.80665;
    CHECK(s.survey.liquid_kg / s.survey.area_m2 == doctest::Approx(path + low).epsilon(1e-6));
}

TEST_CASE("columns: levels that are numbered are no heights") {
    WeatherCase c = holed_case();
    c.maker.variable("z", {"z"}, {1, 2, 3}).texts = {{"standard_name", "height"},
                                                     {"long_name", "generalized_height"}};
    REQUIRE(c.load());
    CHECK(c.volume.bounds_m[1][2] == doctest::Approx(2500));
    c.maker.remove("height");
    c.maker.of("z").texts.emplace_back("units", "m");
    REQUIRE_FALSE(c.fault().empty());
    CHECK(c.fault().find("w.nc: variable p: row 0, column 0: levels not monotonic") == 0);
    // Metres without such words are metres.
    WeatherCase metres = test::content_case();
    metres.maker.of("z").values = {1, 2, 3};
    REQUIRE(metres.load());
    CHECK(metres.volume.bounds_m[1][2] == doctest::Approx(3.5));
}

TEST_CASE("columns: a cloud fraction of 0 with water makes it no denser, a small one ten times") {
    WeatherCase c = test::content_case();
    c.maker.of("lwc").values = {0.1, 0.1, 0.1, 0.1, 0, 0};
    c.maker.variable("cc", {"z", "y", "x"}, {0, 0.05, 0.005, 0.5, 0, 0}, "1");
    c.medium.weather.in_cloud = true;
    const Status status = c.load();
    REQUIRE_MESSAGE(status, status.message);
    // 0.1 g/m3 over 100 m is 1.5: as it is twice, ten times as dense and twice.
    CHECK(c.depth(0, 0) == doctest::Approx(1.5 + 1.5).epsilon(1e-6));
    CHECK(c.depth(1, 0) == doctest::Approx(15 + 3).epsilon(1e-6));
    CHECK(c.volume.capped == 3);
    CHECK(c.head.detail.find("3 cells have more water than their cloud fraction tells") !=
          std::string::npos);
}

TEST_CASE("columns: WRF without a map, of longitudes and latitudes, without its base pressure") {
    WeatherCase ideal = wrf_case(0);
    Status status = ideal.load();
    REQUIRE_MESSAGE(status, status.message);
    CHECK(ideal.depth(1, 1) == doctest::Approx(wrf_depth()).epsilon(1e-6));
    CHECK(ideal.cell_m(0) == 500);
    CHECK(ideal.cell_m(1) == 250);
    WeatherCase global = wrf_case(6);
    REQUIRE(global.load());
    CHECK(global.cell_m(0) == 500);
    const std::vector<std::string> at{"Time", "south_north", "west_east"};
    global.maker.variable("XLAT", at, {-0.5, -0.5, 0.5, 0.5}, "degree_north");
    global.maker.variable("XLONG", at, {179.5, -179.5, 179.5, -179.5}, "degree_east");
    REQUIRE(global.load());
    // Rows that reach from the equator to 1 degree: their mean cosine is sin(1 degree) / 1 degree.
    const double degree = 3.14159265358979323846 / 180;
    CHECK(global.cell_m(0) ==
          doctest::Approx(40030173.0 / 360 * std::sin(degree) / degree).epsilon(1e-9));
    CHECK(global.survey.most_depth == doctest::Approx(wrf_depth()).epsilon(1e-6));
    WeatherCase bare = wrf_case(0);
    bare.maker.remove("PB");
    CHECK(bare.fault().find("w.nc: pressure: no such variable") == 0);
    const std::vector<std::string> levels{"Time", "bottom_top", "south_north", "west_east"};
    bare.maker.variable("P_HYD", levels, std::vector<double>(8, 90000.0), "Pa");
    REQUIRE(bare.load());
    CHECK(bare.survey.most_depth == doctest::Approx(wrf_depth()).epsilon(1e-6));
    CHECK(wrf_case(7).fault().find("MAP_PROJ: unknown, 7, allowed: 0 (idealized)") !=
          std::string::npos);
}

TEST_CASE("columns: units with a factor, and those of DALES, which are none") {
    const struct {
        const char* unit;
        double factor;
    } rows[] = {{"kg kg-1", 1}, {"(kg/kg)", 1},   {"1e-3 kg kg-1", 1e-3}, {"10^-3 kg kg-1", 1e-3},
                {"g/g", 1},     {"1e-5kg/kg", 1}, {"1e-5 kg/kg", 1e-5}};
    WeatherCase c = test::pressure_case();
    REQUIRE(c.load());
    c.maker.remove("q_ice");
    c.maker.set_units("q_liquid", "kg kg-1");
    REQUIRE(c.load());
    const double whole = c.survey.most_depth;
    for (const auto& row : rows) {
        CAPTURE(std::string(row.unit));
        c.maker.set_units("q_liquid", row.unit);
        const Status status = c.load();
        REQUIRE_MESSAGE(status, status.message);
        CHECK(c.survey.most_depth == doctest::Approx(row.factor * whole).epsilon(1e-12));
    }
    c.maker.set_units("q_liquid", "1e-5kg/kg");
    REQUIRE(c.load());
    CHECK(c.head.detail.find("1e-5kg/kg of DALES is in kg/kg") != std::string::npos);
}
