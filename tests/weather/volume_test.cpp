// SPDX-License-Identifier: Apache-2.0
// From small files to extinction on a grid: exact values, what is conserved, keys.
// in: files made in memory -> out: pass or fail.
// docs/weather.md; docs/testing.md, label weather
#include <cmath>

#include "tests/weather/weather_case.h"

using namespace pileus;
using test::WeatherCase;

namespace {

/// What floats keep of a sum: half a unit in the last place of each value.
constexpr double kFloat = 1e-7;

double kappa(double grams, double um) { return 1.5 * grams * 1e-3 / (1000 * um * 1e-6); }

}  // namespace

TEST_CASE("weather: content on heights, cell by cell") {
    WeatherCase c = test::content_case();
    c.medium.box.resolution = {2, 1, 3};
    const Status status = c.load();
    REQUIRE_MESSAGE(status, status.message);
    CHECK(c.volume.in_extinction);
    CHECK(c.volume.bounds_m[0][2] == doctest::Approx(500));
    CHECK(c.volume.bounds_m[1][2] == doctest::Approx(800));
    CHECK(c.volume.bounds_m[0][0] == doctest::Approx(-1000));
    CHECK(c.volume.bounds_m[1][0] == doctest::Approx(1000));
    CHECK(c.cell_m(1) == doctest::Approx(1000));  // a slice is as wide as its columns are apart
    const double grams[6] = {0.1, 0, 0.2, 0.4, 0, 0.3};
    for (std::size_t i = 0; i < 6; ++i)
        CHECK(c.volume.density[i] == doctest::Approx(kappa(grams[i], 10)).epsilon(kFloat));
}

TEST_CASE("weather: layers of the file are cut into cells of two optical depths") {
    WeatherCase c = test::content_case();
    REQUIRE(c.load());
    // 0.4 g/m3 in drops of 10 um: 0.06 per m, 18 optical depths in 300 m.
    CHECK(c.volume.size == std::array<int, 3>{2, 1, 9});
    for (std::size_t z = 0; z < 9; ++z) {
        const double grams[3][2] = {{0.1, 0}, {0.2, 0.4}, {0, 0.3}};
        for (std::size_t x = 0; x < 2; ++x)
            CHECK(c.volume.density[2 * z + x] ==
                  doctest::Approx(kappa(grams[z / 3][x], 10)).epsilon(kFloat));
    }
    // Thin layers stay as they are, and no layer has more than sixteen cells.
    c.medium.weather.sizes.liquid_radius_um = 200;
    REQUIRE(c.load());
    CHECK(c.volume.size == std::array<int, 3>{2, 1, 3});
    c.medium.weather.sizes.liquid_radius_um = 0.01;
    REQUIRE(c.load());
    CHECK(c.volume.size == std::array<int, 3>{2, 1, 48});
}

TEST_CASE("weather: radii of the scene, width, exaggerated heights keep the optical depth") {
    WeatherCase c = test::content_case();
    c.medium.weather.sizes.liquid_radius_um = 5;
    c.medium.weather.place.width_m = 250;
    c.medium.weather.place.vertical_scale = 4;
    c.medium.box.resolution = {2, 1, 3};
    REQUIRE(c.load());
    CHECK(c.cell_m(1) == doctest::Approx(250));
    CHECK(c.volume.bounds_m[0][2] == doctest::Approx(2000));
    CHECK(c.cell_m(2) == doctest::Approx(400));
    CHECK(c.volume.density[0] == doctest::Approx(kappa(0.1, 5) / 4).epsilon(kFloat));
    CHECK(c.depth(0, 0) == doctest::Approx(100 * kappa(0.3, 5)).epsilon(kFloat));
}

TEST_CASE("weather: pressures of faces from above: water path is q dp/g, depth its extinction") {
    WeatherCase c = test::pressure_case();
    c.medium.box.resolution = {1, 1, 40};
    const Status status = c.load();
    REQUIRE_MESSAGE(status, status.message);
    const double g = 9.80665, liquid = (3e-4 + 1e-4) * 1e4 / g, ice = 1e-5 * 1e4 / g;
    CHECK(c.survey.liquid_kg / c.survey.area_m2 == doctest::Approx(liquid).epsilon(1e-7));
    CHECK(c.survey.ice_kg / c.survey.area_m2 == doctest::Approx(ice).epsilon(1e-7));
    const double depth = 1.5 * liquid / (1000 * 10e-6) + 1.5 * ice / (917 * 30e-6);
    CHECK(c.survey.most_depth == doctest::Approx(depth).epsilon(1e-7));
    CHECK(c.depth(0, 0) == doctest::Approx(depth).epsilon(1e-6));
    // Heights: the lowest face is the ground; the highest after three layers of virtual air.
    double z = 0;
    const double p[4] = {1e5, 9e4, 8e4, 7e4}, t[3] = {285, 279, 273}, q[3] = {8e-3, 4e-3, 2e-3};
    for (int k = 0; k < 3; ++k)
        z += 287.05 * t[k] * (1 + 0.608 * q[k]) / g * std::log(p[k] / p[k + 1]);
    CHECK(c.volume.bounds_m[0][2] == doctest::Approx(0));
    CHECK(c.volume.bounds_m[1][2] == doctest::Approx(z).epsilon(1e-7));
}

TEST_CASE("weather: levels from above and from below are the same cloud") {
    WeatherCase down = test::pressure_case(), up = test::pressure_case();
    for (const char* name : {"pressure_hl", "temperature_hl", "q", "q_liquid", "q_ice"}) {
        std::vector<double>& values = up.maker.of(name).values;
        std::vector<double> turned(values.rbegin(), values.rend());
        values = turned;
    }
    REQUIRE(down.load());
    REQUIRE(up.load());
    REQUIRE(up.volume.size == down.volume.size);
    for (std::size_t i = 0; i < up.volume.density.size(); ++i)
        CHECK(up.volume.density[i] == down.volume.density[i]);
}

TEST_CASE("weather: ice by Fu's size, cloud fraction, radii of the file") {
    WeatherCase c = test::pressure_case();
    c.maker.variable("cloud_fraction", {"column", "level"}, {0.5, 0.25, 1}, "1");
    c.maker.variable("re_liquid", {"column", "level"}, {5e-6, 8e-6, 12e-6}, "m");
    REQUIRE(c.load());
    const double g = 9.80665;
    const double l1 = 3e-4 * 1e4 / g, l0 = 1e-4 * 1e4 / g, i2 = 1e-5 * 1e4 / g;
    const double mean =
        1.5 * l1 / (1000 * 8e-6) + 1.5 * l0 / (1000 * 12e-6) + 1.5 * i2 / (917 * 30e-6);
    CHECK(c.survey.most_depth == doctest::Approx(mean).epsilon(1e-6));
    c.medium.weather.in_cloud = true;
    REQUIRE(c.load());
    const double inside =
        4 * 1.5 * l1 / (1000 * 8e-6) + 1.5 * l0 / (1000 * 12e-6) + 2 * 1.5 * i2 / (917 * 30e-6);
    CHECK(c.survey.most_depth == doctest::Approx(inside).epsilon(1e-6));
    c.medium.weather.in_cloud = false;
    c.medium.weather.names.liquid = "none";
    c.medium.weather.sizes.ice_dge_um = 40;
    REQUIRE(c.load());
    CHECK(c.survey.most_depth ==
          doctest::Approx(4 * std::sqrt(3.0) / 3 * i2 / (917 * 40e-6)).epsilon(1e-6));
}

TEST_CASE("weather: depth is conserved under any grid") {
    // Rows of unequal width by the cosine, layers of unequal thickness, a grid that fits none.
    WeatherCase c;
    c.maker.dimension("lev", 5);
    c.maker.dimension("lat", 4);
    c.maker.dimension("lon", 6);
    c.maker.variable("lev", {"lev"}, {1000, 1200, 1500, 2100, 3300}, "m");
    c.maker.variable("lat", {"lat"}, {60, 58, 57, 55}, "degrees_north");
    c.maker.variable("lon", {"lon"}, {358, 359, 0, 1, 2, 3.5}, "degrees_east");
    std::vector<double> water;
    for (int i = 0; i < 120; ++i) water.push_back((i * 37 % 11) * (i % 3 == 0 ? 0.0 : 0.02));
    c.maker.variable("lwc", {"lev", "lat", "lon"}, water, "g m-3");
    for (const std::array<int, 3> size : {std::array<int, 3>{0, 0, 0}, {7, 5, 3}, {64, 3, 50}}) {
        CAPTURE(size[0]);
        c.medium.box.resolution = size;
        const Status status = c.load();
        REQUIRE_MESSAGE(status, status.message);
        CHECK(c.total() == doctest::Approx(c.survey.depth_m2).epsilon(1e-6));
    }
    // The footprints have the area of the Earth's surface between their edges.
    const double pi = 3.14159265358979323846, radius = 40030173 / (2 * pi);
    const double south = 54 * pi / 180, north = 61 * pi / 180;
    const double width = (4.25 + 2.5) * pi / 180;
    CHECK(c.survey.area_m2 ==
          doctest::Approx(radius * radius * width * (std::sin(north) - std::sin(south)))
              .epsilon(1e-9));
}

TEST_CASE("weather: columns keep their depth where cells are footprints") {
    WeatherCase c = test::content_case();
    c.medium.box.resolution = {2, 1, 7};  // layers that no level fits
    REQUIRE(c.load());
    CHECK(c.depth(0, 0) == doctest::Approx(100 * kappa(0.3, 10)).epsilon(1e-6));
    CHECK(c.depth(1, 0) == doctest::Approx(100 * kappa(0.7, 10)).epsilon(1e-6));
}

TEST_CASE("weather: packed numbers, missing values, undershoots") {
    WeatherCase c = test::content_case();
    test::NetcdfMaker::Variable& lwc = c.maker.of("lwc");
    lwc.type = NcType::kShort;
    lwc.values = {50, -999, 150, 350, -50, 250};
    lwc.numbers = {{"_FillValue", -999}};
    lwc.doubles = {{"scale_factor", 0.001}, {"add_offset", 0.05}};
    c.medium.box.resolution = {2, 1, 3};
    const Status status = c.load();
    REQUIRE_MESSAGE(status, status.message);
    CHECK(c.volume.missing == 1);
    CHECK(c.volume.density[0] == doctest::Approx(kappa(0.1, 10)).epsilon(1e-6));
    CHECK(c.volume.density[1] == 0);
    CHECK(c.volume.density[3] == doctest::Approx(kappa(0.4, 10)).epsilon(1e-6));
    c.medium.weather.missing_is_fault = true;
    CHECK(c.fault().find("missing value, allowed: none") != std::string::npos);

    WeatherCase air = test::pressure_case();
    air.maker.of("q_ice").values = {1e-5, -9e-7, 0};
    REQUIRE(air.load());
    CHECK(air.volume.clamped == 1);
}

TEST_CASE("weather: a clear sky is a clear volume") {
    WeatherCase c = test::content_case();
    c.maker.of("lwc").values.assign(6, 0.0);
    REQUIRE(c.load());
    CHECK(c.volume.size[2] == 1);
    for (const float v : c.volume.density.span()) CHECK(v == 0);
}
