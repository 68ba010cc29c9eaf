// SPDX-License-Identifier: Apache-2.0
// What dimensions are: by units, by other coordinates, by the scene; times and members by name.
// in: small files made in memory -> out: pass or fail.
// docs/weather.md, "Dimensions"; docs/testing.md, label weather
#include "src/io/netcdf/grib_fields.h"
#include "src/io/volumes/weather/weather_axes.h"
#include "tests/weather/weather_case.h"

using namespace pileus;
using test::WeatherCase;

namespace {

/// Content 0.5 g/m3 in the middle one of three layers of 100 m: optical depth 7.5 of each column.
WeatherCase named_case(const std::string& z, const std::string& y, const std::string& x) {
    WeatherCase c;
    c.maker.dimension(z, 3);
    c.maker.dimension(y, 2);
    c.maker.dimension(x, 2);
    c.maker.variable(z, {z}, {50, 150, 250}, "m");
    c.maker.variable(y, {y}, {0, 1}, "m");
    c.maker.variable(x, {x}, {0, 1}, "m");
    c.maker.variable("lwc", {z, y, x}, {0, 0, 0, 0, 0.5, 0.5, 0.5, 0.5, 0, 0, 0, 0}, "g m-3");
    return c;
}

void check_depth(WeatherCase& c) {
    const Status status = c.load();
    REQUIRE_MESSAGE(status, status.message);
    CHECK(c.survey.most_depth == doctest::Approx(7.5).epsilon(1e-6));
}

}  // namespace

TEST_CASE("axes: units of latitude and longitude alone, and positive") {
    for (const char* north : {"degrees_north", "degree_N", "degreesN", "degreeN", "degrees_N"}) {
        CAPTURE(std::string(north));
        WeatherCase c = named_case("a", "b", "c");
        c.maker.of("a").texts.emplace_back("positive", "up");
        c.maker.set_units("b", north);
        std::string east = north;
        const std::size_t at = east.find("north");
        east = at == std::string::npos ? east.substr(0, east.size() - 1) + 'E'
                                       : east.substr(0, at) + "east";
        c.maker.set_units("c", east);
        check_depth(c);
    }
}

TEST_CASE("axes: a unit of pressure tells of levels") {
    for (const char* unit : {"hPa", "millibar", "mb"}) {
        WeatherCase c = test::pressure_case();
        c.maker = test::NetcdfMaker();
        c.maker.dimension("foo", 3);
        c.maker.dimension("lat", 1);
        c.maker.dimension("lon", 1);
        c.maker.variable("foo", {"foo"}, {900, 800, 700}, unit);
        c.maker.variable("lat", {"lat"}, {0}, "degrees_north");
        c.maker.variable("lon", {"lon"}, {0}, "degrees_east");
        c.maker.variable("t", {"foo", "lat", "lon"}, {280, 280, 280}, "K");
        c.maker.variable("clwc", {"foo", "lat", "lon"}, {0, 1e-4, 0}, "kg kg-1");
        const Status status = c.load();
        REQUIRE_MESSAGE(status, status.message);
        // Faces at geometric means: mass (sqrt(800 900) - sqrt(800 700)) hPa / g.
        const double path = 1e-4 * 100 * (848.528137423857 - 748.3314773547883) / 9.80665;
        CHECK(c.survey.most_depth == doctest::Approx(1.5 * path / 0.01).epsilon(1e-6));
    }
}

TEST_CASE("axes: names of NCL, THREDDS, UFS and of large-eddy models") {
    const char* const kNames[][3] = {{"lv_HTGL1", "lat_0", "lon_0"},
                                     {"height_above_ground2", "y1", "x1"},
                                     {"zt", "yt", "xt"},
                                     {"zu_3d", "y", "x"},
                                     {"nk", "nj", "ni"},
                                     {"zc", "grid_yt", "grid_xt"},
                                     {"zf", "yh", "xh"}};
    for (const auto& names : kNames) {
        CAPTURE(std::string(names[0]));
        WeatherCase c = named_case(names[0], names[1], names[2]);
        check_depth(c);
    }
}

TEST_CASE("axes: coordinates of other names than their dimensions, in km") {
    WeatherCase c = named_case("nk", "nj", "ni");
    for (const char* name : {"nk", "nj", "ni"}) c.maker.remove(name);
    c.maker.variable("z", {"nk"}, {0.05, 0.15, 0.25}, "km");
    c.maker.variable("yh", {"nj"}, {0, 0.1}, "km");
    c.maker.variable("xh", {"ni"}, {0, 0.3}, "km");
    check_depth(c);
    CHECK(c.cell_m(0) == doctest::Approx(300));
    CHECK(c.cell_m(1) == doctest::Approx(100));
}

TEST_CASE("axes: keys of the scene, and what they must name") {
    WeatherCase c = named_case("d1", "d2", "d3");
    for (const char* name : {"d1", "d2", "d3"}) c.maker.of(name).texts.clear();
    CHECK(c.fault().find("w.nc: variable lwc: dimension d1: neither time") == 0);
    c.medium.weather.names.axes = "level: d1, y: d2,x : d3";
    c.medium.weather.names.units = "d1: m, d2: km, d3: m";
    check_depth(c);
    CHECK(c.cell_m(1) == doctest::Approx(1000));
    // A unit of the scene comes before the file's.
    c.medium.weather.names.units += ", lwc: mg m-3";
    REQUIRE(c.load());
    CHECK(c.survey.most_depth == doctest::Approx(7.5e-3).epsilon(1e-6));
    c.medium.weather.names.axes = "level: d1, y: d2, east: d3";
    CHECK(c.fault().find("w.nc: axes: no such axis, \"east\", allowed: time, member") == 0);
    c.medium.weather.names.axes = "level: d1, y: d2, x: d4";
    CHECK(c.fault().find("w.nc: axes: no such dimension, \"d4\", allowed: d1, d2, d3") == 0);
    c.medium.weather.names.axes = "level d1";
    CHECK(c.fault().find("w.nc: axes: not understood, \"level d1\"") == 0);
    c.medium.weather.names.axes = "level: d1, y: d2, x: d3";
    c.medium.weather.names.units = "q: m";
    CHECK(c.fault().find("w.nc: units: no such variable, \"q\", allowed: d1, d2, d3, lwc") == 0);
}

TEST_CASE("axes: a member by its number, by its name, by its index") {
    WeatherCase c = test::content_case();
    c.maker.dimension("number", 3);
    auto& water = c.maker.of("lwc");
    water.dimensions = {"number", "z", "y", "x"};
    water.values.assign(18, 0);
    for (std::size_t m = 0; m < 3; ++m) water.values[6 * m + 2] = 0.1 * double(m + 1);
    const auto depth = [&](const WeatherChoice& member) {
        c.medium.weather.member = member;
        return c.load() ? c.survey.most_depth : -1;
    };
    // Without a coordinate a number is an index.
    CHECK(depth({true, "2", 0}) == doctest::Approx(4.5).epsilon(1e-6));
    c.maker.variable("number", {"number"}, {1, 2, 30}, "1");
    CHECK(depth({true, "2", 0}) == doctest::Approx(3).epsilon(1e-6));
    CHECK(depth({true, "30", 0}) == doctest::Approx(4.5).epsilon(1e-6));
    CHECK(depth({false, "", 1}) == doctest::Approx(3).epsilon(1e-6));
    CHECK(c.head.detail.find("; member 2") != std::string::npos);
    c.medium.weather.member = {true, "3", 0};
    CHECK(c.fault() ==
          "w.nc: member: not in the file, \"3\", allowed: 0 to 2, or as text 1, 2, 30");
    c.medium.weather.member = {false, "", 3};
    CHECK(c.fault().find("w.nc: member: not in the file, 3, allowed: 0 to 2") == 0);
    c.maker.remove("number");
    c.maker.dimension("letters", 2);
    auto& names = c.maker.variable("number", {"number", "letters"}, {'c', 'f', 'p', '1', 'p', '2'});
    names.type = NcType::kChar;
    CHECK(depth({true, "p2", 0}) == doctest::Approx(4.5).epsilon(1e-6));
    WeatherCase none = test::content_case();
    none.medium.weather.member = {true, "1", 0};
    CHECK(none.fault().find("w.nc: member: the variable has no dimension of members") == 0);
}

TEST_CASE(
    "axes: dates in a time zone, before the calendar changed, and of what is not understood") {
    const struct {
        const char *units, *calendar, *date;
    } rows[] = {
        {"hours since 2020-01-01 00:00:00", "", "2020-01-01T06:00:00"},
        {"hours since 2020-01-01 00:00:00 +02:00", "standard", "2020-01-01T04:00:00"},
        {"hours since 2020-01-01 00:00 -0330", "", "2020-01-01T09:30:00"},
        {"hours since 2020-01-01T00:00:00Z", "", "2020-01-01T06:00:00"},
        {"minutes since 2020-1-1 0:0:0.0 UTC", "", "2020-01-01T00:06:00"},
        {"days since 1582-10-10", "proleptic_gregorian", "1582-10-16T00:00:00"},
        // 4 October 1582 was followed by 15 October.
        {"days since 1582-10-4", "gregorian", "1582-10-20T00:00:00"},
        {"hours since 1900-01-01", "noleap", ""},
        {"fortnights since 1900-01-01", "", ""},
        {"hours since 2020-01-01 00:00:00 CET", "", ""},
        {"hours since 2020-13-01", "", ""},
    };
    for (const auto& row : rows) {
        CAPTURE(std::string(row.units));
        WeatherCase c = test::content_case();
        c.maker.dimension("time", 1);
        auto& time = c.maker.variable("time", {"time"}, {6}, row.units);
        if (row.calendar[0] != '\0') time.texts.emplace_back("calendar", row.calendar);
        c.maker.of("lwc").dimensions = {"time", "z", "y", "x"};
        const Status status = c.load();
        REQUIRE_MESSAGE(status, status.message);
        const std::string date = row.date;
        if (!date.empty()) {
            CHECK_MESSAGE(c.head.detail.find(date) != std::string::npos, c.head.detail);
            continue;
        }
        c.medium.weather.time = {true, "2020-01-01", 0};
        CHECK(c.fault().find("of its dates this is not understood: ") != std::string::npos);
    }
}

TEST_CASE("axes: members of a GRIB file have its numbers") {
    GribFields fields;
    fields.grid = {2, 1, 0, 1, 0, 0};
    fields.units = {{"clwc", "kg kg-1"}, {"t", "K"}};
    for (const char* variable : {"clwc", "t"})
        for (const long member : {3, 7})
            for (const long level : {800, 900}) {
                fields.list.push_back({variable, 0, member, level});
                Buffer<float> values;
                REQUIRE(values.resize(2, "field"));
                const float water = level == 900 ? 1e-4f * float(member) : 0.0f;
                values[0] = values[1] = variable[0] == 't' ? 280.0f : water;
                fields.values.push_back(std::move(values));
            }
    Buffer<char> bytes;
    REQUIRE(encode_grib_fields("g.grib", fields, bytes));
    WeatherCase c;
    const std::string text(bytes.data(), bytes.size());
    double depth[2] = {};
    for (int i = 0; i < 2; ++i) {
        c.medium.weather.member = {true, i == 0 ? "3" : "7", 0};
        const Status status = c.load_bytes(text);
        REQUIRE_MESSAGE(status, status.message);
        depth[i] = c.survey.most_depth;
    }
    CHECK(depth[1] == doctest::Approx(7.0 / 3 * depth[0]).epsilon(1e-6));
    c.medium.weather.member = {true, "1", 0};
    CHECK(c.load_bytes(text).message.find("member: not in the file, \"1\", allowed: 0 to 1, or") !=
          std::string::npos);
}
