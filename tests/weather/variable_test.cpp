// SPDX-License-Identifier: Apache-2.0
// Any variable of a file, shown by a transfer function in place of water.
// in: files made in memory -> out: pass or fail.
// docs/weather.md, "Any variable"; docs/testing.md, label weather
#include <cmath>

#include "tests/weather/weather_case.h"

using namespace pileus;
using test::WeatherCase;

namespace {

/// Cloud fraction on the heights of content_case(), without units.
WeatherCase fraction_case() {
    WeatherCase c = test::content_case();
    c.maker.remove("lwc");
    c.maker.variable("cc", {"z", "y", "x"}, {0.5, 0, 1, 0.25, 0, 0.75});
    c.medium.weather.names.variable = "cc";
    c.medium.optics.transfer = {{0, 0, {1, 1, 1}}, {1, 0.01, {1, 1, 1}}};
    return c;
}

}  // namespace

TEST_CASE("variable: values as they stand in the file, units free, no water needed") {
    WeatherCase c = fraction_case();
    const Status status = c.load();
    REQUIRE_MESSAGE(status, status.message);
    CHECK(!c.volume.in_extinction);
    CHECK(!c.head.in_extinction);
    CHECK(c.volume.size == std::array<int, 3>{2, 1, 3});
    const float values[6] = {0.5f, 0, 1, 0.25f, 0, 0.75f};
    for (std::size_t i = 0; i < 6; ++i) CHECK(c.volume.density[i] == values[i]);
    CHECK(c.head.detail.find("variable cc") == 0);
}

TEST_CASE("variable: packed values count with their scale and offset, of any sign") {
    WeatherCase c = fraction_case();
    auto& v = c.maker.of("cc");
    v.type = NcType::kShort;
    v.values = {-50, 0, 100, 25, 1, 75};
    v.doubles = {{"scale_factor", 0.5}, {"add_offset", -10}};
    v.texts = {{"units", "furlong fortnight-1"}};
    c.medium.optics.transfer = {{-100, 0.01, {1, 1, 1}}, {100, 0.02, {1, 1, 1}}};
    REQUIRE(c.load());
    const float values[6] = {-35, -10, 40, 2.5f, -9.5f, 27.5f};
    for (std::size_t i = 0; i < 6; ++i) CHECK(c.volume.density[i] == values[i]);
}

TEST_CASE("variable: cells of other sizes hold the mean over their volume") {
    WeatherCase c = fraction_case();
    c.medium.box.resolution = {3, 2, 7};
    REQUIRE(c.load());
    double sum = 0, before = 0;
    for (const float value : c.volume.density.span()) sum += double(value);
    for (const double value : {0.5, 0.0, 1.0, 0.25, 0.0, 0.75}) before += value;
    // Floats of a double's sum.
    CHECK(sum / 42 == doctest::Approx(before / 6).epsilon(1e-6));
    // The middle third of the width is half in either column.
    CHECK(c.volume.density[1] == doctest::Approx(0.25).epsilon(1e-6));
}

TEST_CASE("variable: missing is nothing, counted, and no part of a mean") {
    WeatherCase c = fraction_case();
    c.maker.of("cc").values[0] = -99;
    c.maker.of("cc").numbers = {{"_FillValue", -99}};
    c.medium.optics.transfer = {{0, 0.01, {1, 1, 1}}, {1, 0.02, {1, 1, 1}}};
    REQUIRE(c.load());
    CHECK(c.volume.missing == 1);
    CHECK(std::isnan(c.volume.density[0]));
    CHECK(c.volume.density[2] == 1.0f);
    // A third of the width, and half of that known: the mean is that of the half that is.
    c.medium.box.resolution = {3, 1, 3};
    REQUIRE(c.load());
    CHECK(std::isnan(c.volume.density[0]));
    CHECK(c.volume.density[1] == 0.0f);
    c.medium.weather.missing_is_fault = true;
    CHECK(c.fault() ==
          "w.nc: variable cc: row 0, column 0: level 0: missing value, allowed: none (missing = "
          "\"fault\")");
}

TEST_CASE("variable: the heights that are seen make the box") {
    WeatherCase c = fraction_case();
    c.medium.optics.transfer = {{0.8, 0, {1, 1, 1}}, {1, 0.01, {1, 1, 1}}};
    REQUIRE(c.load());
    // 1 stands on the middle level alone.
    CHECK(c.volume.size[2] == 1);
    CHECK(c.volume.bounds_m[0][2] == doctest::Approx(600));
    CHECK(c.volume.bounds_m[1][2] == doctest::Approx(700));
    // Seen wherever there is a value: all levels. vertical_scale moves faces, not values.
    c.medium.optics.transfer = {{0, 0.1, {1, 1, 1}}, {1, 0.01, {1, 1, 1}}};
    c.medium.weather.place.vertical_scale = 3;
    REQUIRE(c.load());
    // Ten optical depths a layer, in cells of two.
    CHECK(c.volume.size[2] == 15);
    CHECK(c.volume.bounds_m[1][2] == doctest::Approx(2400));
    CHECK(c.volume.density[0] == 0.5f);
}

TEST_CASE("variable: on pressures, and on faces, as water is") {
    WeatherCase c = test::pressure_case();
    c.maker.remove("q_liquid");
    c.maker.remove("q_ice");
    c.medium.weather.names.variable = "temperature_hl";
    c.medium.optics.transfer = {{0, 0, {1, 1, 1}}, {300, 0.01, {1, 1, 1}}};
    c.medium.box.resolution = {1, 1, 4};
    const Status status = c.load();
    REQUIRE_MESSAGE(status, status.message);
    CHECK(c.volume.density[0] > 280);
    CHECK(c.volume.density[3] < 276);
    WeatherCase d = test::pressure_case();
    d.medium.weather.names.variable = "q";
    d.medium.optics.transfer = {{0, 0, {1, 1, 1}}, {1, 0.01, {1, 1, 1}}};
    d.medium.box.resolution = {1, 1, 60};
    REQUIRE(d.load());
    CHECK(d.volume.density[0] == doctest::Approx(0.008));
}

TEST_CASE("variable: faults") {
    WeatherCase c = fraction_case();
    c.medium.weather.names.variable = "none";
    CHECK(c.fault().find("w.nc: variable: no such variable, \"none\", allowed: cc") == 0);
    c = fraction_case();
    c.maker.of("cc").values[3] = std::nan("");
    CHECK(c.fault().find("not a number") != std::string::npos);
    c = fraction_case();
    c.maker.of("cc").values.assign(6, -99);
    c.maker.of("cc").numbers = {{"_FillValue", -99}};
    CHECK(c.fault() == "w.nc: variable cc: all values missing, allowed: some");
    c = fraction_case();
    c.maker.of("cc").type = NcType::kDouble;
    c.maker.of("cc").values[3] = 1e31;
    CHECK(c.fault() ==
          "w.nc: variable cc: row 0, column 1: level 1: out of range, 1e+31, allowed: -1e30 to "
          "1e30");
}
