// SPDX-License-Identifier: Apache-2.0
// Packed, unsigned and missing numbers; attributes that say nothing.
// in: small files made in memory -> out: pass or fail.
// docs/weather.md, "Variables"; docs/testing.md, label weather
#include <limits>

#include "src/io/netcdf/netcdf_packing.h"
#include "tests/weather/weather_case.h"

using namespace pileus;
using test::WeatherCase;

namespace {

/// The numbers of a variable as they are meant; NaN: missing. Of a fault its line in `line`.
std::vector<double> meant(test::NetcdfMaker& maker, std::string& line) {
    const std::string bytes = maker.bytes(5);
    NcFile file;
    REQUIRE(file.open_bytes("p.nc", {bytes.data(), bytes.size()}));
    const NcVariable& v = *file.head().find("v");
    std::vector<double> values(std::size_t(whole_block(file.head(), v).values()), 0.0);
    const Status status =
        read_unpacked(file, v, whole_block(file.head(), v), {values.data(), values.size()});
    line = status.message;
    return values;
}

test::NetcdfMaker numbers(NcType type, const std::vector<double>& values) {
    test::NetcdfMaker maker;
    maker.dimension("n", values.size());
    maker.variable("v", {"n"}, values).type = type;
    return maker;
}

bool is_missing(double value) { return value != value; }

}  // namespace

TEST_CASE("packing: _Unsigned makes bytes, shorts and ints unsigned, their marks and limits too") {
    const struct {
        NcType type;
        double span;
    } kinds[] = {{NcType::kByte, 256}, {NcType::kShort, 65536}, {NcType::kInt, 4294967296.0}};
    for (const auto& kind : kinds) {
        CAPTURE(kind.span);
        // -1 is the largest, marked missing; -56 is span - 56; 3 lies below the least.
        test::NetcdfMaker maker = numbers(kind.type, {0, 100, -56, -1, 3, -2});
        auto& v = maker.of("v");
        v.texts = {{"_Unsigned", "true"}};
        v.numbers = {{"_FillValue", -1}, {"missing_value", 0}, {"valid_min", 5}, {"valid_max", -3}};
        v.doubles = {{"scale_factor", 0.5}, {"add_offset", 10}};
        std::string line;
        const std::vector<double> values = meant(maker, line);
        REQUIRE_MESSAGE(line.empty(), line);
        CHECK(is_missing(values[0]));
        CHECK(values[1] == 60);
        CHECK(values[2] == 10 + 0.5 * (kind.span - 56));
        CHECK(is_missing(values[3]));
        CHECK(is_missing(values[4]));
        CHECK(is_missing(values[5]));
    }
}

TEST_CASE("packing: _Unsigned = false gives unsigned numbers a sign") {
    test::NetcdfMaker maker = numbers(NcType::kUByte, {1, 127, 128, 255});
    maker.of("v").texts = {{"_Unsigned", "False"}};
    std::string line;
    CHECK(meant(maker, line) == std::vector<double>{1, 127, -128, -1});
}

TEST_CASE("packing: limits of packed whole numbers, and of values where they are floats") {
    test::NetcdfMaker maker = numbers(NcType::kShort, {0, 1, 100, 101});
    auto& v = maker.of("v");
    v.doubles = {{"scale_factor", 0.01}, {"valid_min", 0.01}, {"valid_max", 1}};
    std::string line;
    std::vector<double> values = meant(maker, line);
    CHECK(is_missing(values[0]));
    CHECK(values[1] == 0.01);
    CHECK(values[2] == 1);
    CHECK(is_missing(values[3]));
    // A scale below 0 turns the limits round.
    v.doubles = {{"scale_factor", -0.01}, {"valid_min", -1}};
    values = meant(maker, line);
    CHECK(values[2] == -1);
    CHECK(is_missing(values[3]));
    v.numbers = {{"valid_min", 100}};
    v.doubles = {{"scale_factor", 0.01}};
    values = meant(maker, line);
    CHECK(is_missing(values[1]));
    CHECK(values[3] == 1.01);
}

TEST_CASE("packing: an attribute that says nothing is a line with its name") {
    const struct {
        const char* what;
        void (*spoil)(test::NetcdfMaker::Variable&);
        const char* line;
    } rows[] = {
        {"a scale as a text",
         [](auto& v) {
             v.texts = {{"scale_factor", "0.001"}};
         },
         "scale_factor: a text, \"0.001\", allowed: one number"},
        {"an offset as a text",
         [](auto& v) {
             v.texts = {{"add_offset", "0.0"}};
         },
         "add_offset: a text, \"0.0\", allowed: one number"},
        {"a scale of 0",
         [](auto& v) {
             v.doubles = {{"scale_factor", 0}};
         },
         "scale_factor: 0, allowed: any other number"},
        {"an endless offset",
         [](auto& v) {
             v.doubles = {{"add_offset", std::numeric_limits<double>::infinity()}};
         },
         "add_offset: inf, allowed: a finite number"},
        {"a mark as a text",
         [](auto& v) {
             v.texts = {{"missing_value", "-999"}};
         },
         "missing_value: a text, \"-999\", allowed: numbers"},
        {"a mark that a short cannot hold",
         [](auto& v) {
             v.doubles = {{"missing_value", 1e20}};
         },
         "missing_value: 1e+20, allowed: a number of the variable's type, short"},
        {"a mark in another unit",
         [](auto& v) {
             v.doubles = {{"_FillValue", -9.99}};
         },
         "_FillValue: -9.99, allowed: a number of the variable's type, short"},
        {"a range of one number",
         [](auto& v) {
             v.numbers = {{"valid_range", 1}};
         },
         "valid_range: 1, allowed: two numbers"},
        {"a range that runs backwards",
         [](auto& v) {
             v.numbers = {{"valid_min", 5}, {"valid_max", 4}};
         },
         "valid_max: 5 to 4 as packed, allowed: a range that holds a number"},
        {"a sign of another word",
         [](auto& v) {
             v.texts = {{"_Unsigned", "yes"}};
         },
         "_Unsigned: a text, \"yes\", allowed: \"true\" or \"false\""},
        {"an axis as a number",
         [](auto& v) {
             v.numbers = {{"axis", 1}};
         },
         "axis: 1, allowed: a text"},
        {"a sign as a number",
         [](auto& v) {
             v.numbers = {{"_Unsigned", 1}};
         },
         "_Unsigned: 1, allowed: \"true\" or \"false\""},
    };
    for (const auto& row : rows) {
        CAPTURE(std::string(row.what));
        test::NetcdfMaker maker = numbers(NcType::kShort, {1, 2});
        row.spoil(maker.of("v"));
        std::string line;
        (void)meant(maker, line);
        CHECK_MESSAGE(line.find(std::string("p.nc: variable v: ") + row.line) == 0, line);
    }
    test::NetcdfMaker floats = numbers(NcType::kFloat, {1, 2});
    floats.of("v").texts = {{"_Unsigned", "true"}};
    std::string line;
    (void)meant(floats, line);
    CHECK(line.find("p.nc: variable v: _Unsigned: \"true\" of type float") == 0);
}

TEST_CASE(
    "packing: water in unsigned bytes, coordinates in packed shorts, units that are a number") {
    WeatherCase c = test::content_case();
    auto& water = c.maker.of("lwc");
    water.type = NcType::kByte;
    water.values = {-56, 0, 0, 0, 0, 0};  // 200
    water.doubles = {{"scale_factor", 0.0025}};
    water.texts.emplace_back("_Unsigned", "true");
    auto& x = c.maker.of("x");
    x.type = NcType::kShort;
    x.values = {-100, 100};
    x.doubles = {{"scale_factor", 10}, {"add_offset", 5}};
    const Status status = c.load();
    REQUIRE_MESSAGE(status, status.message);
    // 0.5 g/m3 of 10 um over 100 m; places -995 and 1005.
    CHECK(c.depth(0, 0) == doctest::Approx(7.5).epsilon(1e-6));
    CHECK(c.cell_m(0) == doctest::Approx(2000).epsilon(1e-12));
    c.maker.of("lwc").texts = {{"_Unsigned", "true"}};
    c.maker.of("lwc").doubles.emplace_back("units", 1);
    CHECK(c.fault().find("w.nc: variable lwc: units: 1, allowed: a text") == 0);
}
