// SPDX-License-Identifier: Apache-2.0
// Bad data: one clear line each, with the variable, the place and what is allowed.
// in: small files made in memory, each with one thing wrong -> out: pass or fail.
// docs/weather.md, "Messages"; docs/testing.md, label weather
#include <functional>
#include <limits>

#include "tests/weather/weather_case.h"

using namespace pileus;
using test::WeatherCase;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct FaultRow {
    const char* what;
    WeatherCase (*from)();
    std::function<void(WeatherCase&)> spoil;
    const char* line;  ///< begins the message
};

const FaultRow kRows[] = {
    {"unit of another quantity", test::content_case,
     [](WeatherCase& c) { c.maker.set_units("lwc", "K"); },
     "w.nc: variable lwc: units: not of liquid, \"K\", allowed: kg m-3, "},
    {"unit of a column's content", test::pressure_case,
     [](WeatherCase& c) { c.maker.set_units("q_liquid", "kg m-2"); },
     "w.nc: variable q_liquid: units: not of liquid, \"kg m-2\", allowed: kg kg-1, "},
    {"no unit", test::pressure_case,
     [](WeatherCase& c) { c.maker.of("temperature_hl").texts.clear(); },
     "w.nc: variable temperature_hl: units: missing, nothing, allowed: K, "},
    {"temperature in a wrong unit", test::pressure_case,
     [](WeatherCase& c) {
         c.maker.of("temperature_hl").values = {-3, 3, 9, 15};
     },
     "w.nc: variable temperature_hl: column 0: out of range, 12 K, allowed: 100 to 400"},
    {"no coordinate", test::content_case, [](WeatherCase& c) { c.maker.remove("x"); },
     "w.nc: variable lwc: coordinates: none that are known"},
    {"no levels", test::content_case, [](WeatherCase& c) { c.maker.remove("z"); },
     "w.nc: variable lwc: levels: neither height nor pressure is known"},
    {"coordinate without a unit", test::content_case,
     [](WeatherCase& c) { c.maker.of("x").texts.clear(); },
     "w.nc: variable x: units: missing, nothing, allowed: degrees, m, km"},
    {"coordinate twice the same", test::content_case,
     [](WeatherCase& c) {
         c.maker.of("x").values = {5, 5};
     },
     "w.nc: variable lwc: coordinates: x not monotonic"},
    {"levels not monotonic", test::content_case,
     [](WeatherCase& c) {
         c.maker.of("z").values = {550, 450, 750};
     },
     "w.nc: variable z: row 0, column 0: levels not monotonic, 550 then 450 upwards, "
     "allowed: rising"},
    {"levels marked as a depth", test::content_case,
     [](WeatherCase& c) { c.maker.of("z").texts.emplace_back("positive", "down"); },
     "w.nc: variable z: positive: levels upside down, \"down\", allowed: up"},
    {"no number", test::content_case, [](WeatherCase& c) { c.maker.of("lwc").values[4] = kNan; },
     "w.nc: variable lwc: row 0, column 0, level 2: not a number, allowed: finite"},
    {"no number in a coordinate", test::content_case,
     [](WeatherCase& c) { c.maker.of("x").values[1] = kNan; },
     "w.nc: variable x: values: not finite or missing"},
    {"all missing", test::content_case,
     [](WeatherCase& c) { c.maker.of("lwc").values.assign(6, 9.9692099683868690e+36); },
     "w.nc: variable lwc: all values missing"},
    {"negative water", test::pressure_case,
     [](WeatherCase& c) {
         c.maker.of("q_liquid").values = {0, -2e-6, 0};
     },
     "w.nc: variable q_liquid: column 0: level 1: negative water, -1.99999"},
    {"grams as kilograms", test::pressure_case,
     [](WeatherCase& c) {
         c.maker.of("q_liquid").values = {0, 0.9, 0};
     },
     "w.nc: variable q_liquid: column 0: level 1: out of range, 0.89999"},
    {"no temperature", test::pressure_case,
     [](WeatherCase& c) { c.maker.remove("temperature_hl"); },
     "w.nc: temperature: no such variable, nothing, allowed: one with"},
    {"no water", test::content_case, [](WeatherCase& c) { c.maker.remove("lwc"); },
     "w.nc: liquid: no variable of cloud water"},
    {"a name that is none", test::content_case,
     [](WeatherCase& c) { c.medium.weather.names.liquid = "qqq"; },
     "w.nc: liquid: no such variable, \"qqq\", allowed: lwc"},
    {"a radius without a size", test::pressure_case,
     [](WeatherCase& c) {
         c.maker.variable("re_ice", {"column", "level"}, {0, 1e-5, 1e-5}, "m");
     },
     "w.nc: variable re_ice: column 0: level 0: no radius for its cloud, 0 m"},
    {"an origin of metres", test::content_case,
     [](WeatherCase& c) {
         c.medium.weather.place.origin_deg = {10, 50};
     },
     "w.nc: origin_deg: the file's coordinates are metres, allowed: left out"},
    {"no such time", test::content_case,
     [](WeatherCase& c) {
         c.maker.dimension("time", 1);
         c.maker.of("lwc").dimensions = {"time", "z", "y", "x"};
         c.medium.weather.time = {false, "", 3};
     },
     "w.nc: time: not in the file, 3, allowed: 0 to 0"},
    {"an unlimited dimension without records", test::content_case,
     [](WeatherCase& c) {
         c.maker.dimension("time", 0);
         c.maker.of("lwc").dimensions = {"time", "z", "y", "x"};
         c.maker.of("lwc").values.clear();
     },
     "w.nc: variable lwc: dimension time: no elements, allowed: at least 1"},
    {"a dimension that means nothing", test::content_case,
     [](WeatherCase& c) {
         c.maker.dimension("colour", 2);
         c.maker.of("lwc").dimensions = {"colour", "z", "x"};
         c.maker.of("lwc").values.assign(12, 0.1);
     },
     "w.nc: variable lwc: dimension colour: neither time"},
};

}  // namespace

TEST_CASE("weather faults: one line each") {
    for (const FaultRow& row : kRows) {
        CAPTURE(std::string(row.what));
        WeatherCase c = row.from();
        row.spoil(c);
        const std::string line = c.fault();
        CHECK_MESSAGE(line.compare(0, std::string(row.line).size(), row.line) == 0, line);
    }
}

TEST_CASE("weather faults: one column upside down among others") {
    WeatherCase c;
    c.maker.dimension("column", 2);
    c.maker.dimension("level", 2);
    c.maker.variable("lat", {"column"}, {10, 11}, "degrees_north");
    c.maker.variable("lon", {"column"}, {5, 5}, "degrees_east");
    c.maker.variable("pressure", {"column", "level"}, {5e4, 6e4, 6e4, 5e4}, "Pa");
    c.maker.variable("temperature", {"column", "level"}, {260, 270, 270, 260}, "K");
    c.maker.variable("q_liquid", {"column", "level"}, {1e-4, 0, 0, 1e-4}, "1");
    CHECK(c.fault().find("w.nc: variable pressure: column 1: levels upside down") == 0);
}

TEST_CASE("weather faults: a file that ends in its values") {
    WeatherCase c = test::content_case();
    const std::string whole = c.maker.bytes();
    const Status status = c.load_bytes(whole.substr(0, whole.size() - 5));
    CHECK(status.code == Code::kBadInput);
    CHECK(status.message.find("w.nc: variable lwc: the file ends before its values do, ") == 0);
}

TEST_CASE("weather faults: HDF5 that is damaged, with the library or without") {
    WeatherCase c;
    const std::string bytes = std::string("\x89HDF\r\n\x1a\n", 8) + std::string(100, '\0');
    const Status status = c.load_bytes(bytes);
    CHECK(status.code == Code::kBadInput);
    CHECK(status.message.find("w.nc: ") == 0);
    CHECK(status.message.find('\n') == std::string::npos);
}
