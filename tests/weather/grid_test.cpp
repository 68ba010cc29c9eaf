// SPDX-License-Identifier: Apache-2.0
// Grids to NetCDF and back: the same bits, the same box; what is refused.
// in: volumes, files made in memory -> out: pass or fail.
// docs/formats.md, "NetCDF"; docs/testing.md, label weather
#include <cstring>

#include "src/io/volumes/volume_file.h"
#include "tests/weather/weather_case.h"

using namespace pileus;

namespace {

/// Cells of every size of float, zero and denormal ones included, in a box of no round numbers.
void fill(const std::array<int, 3>& size, bool in_extinction, Volume& volume) {
    volume.size = size;
    volume.in_extinction = in_extinction;
    volume.knows_bounds = true;
    volume.bounds_m = {{{-1234.5678, 0.1, 361.3}, {1e6 / 3, 7.7, 1e4 / 7}}};
    const std::size_t cells = std::size_t(size[0]) * std::size_t(size[1]) * std::size_t(size[2]);
    REQUIRE(volume.density.resize(cells, "test"));
    for (std::size_t i = 0; i < cells; ++i)
        volume.density[i] = i % 5 == 0 ? 0.0f : float(i * 7919 % 101) * 1.0e-9f / 3.0f;
    volume.density[cells - 1] = 1.0e-42f;
}

Status read_back(const Buffer<char>& bytes, const MediumSettings& medium, Volume& volume) {
    NcFile file;
    PILEUS_TRY(file.open_bytes("g.nc", bytes.span()));
    VolumeHead head;
    PILEUS_TRY(weather_head(medium, file, head));
    PILEUS_TRY(weather_volume(medium, file, volume));
    CHECK(head.size == volume.size);
    CHECK(head.bounds_m == volume.bounds_m);
    return Status::ok();
}

test::WeatherCase grid_case() {
    test::WeatherCase c;
    c.maker.dimension("z", 2);
    c.maker.dimension("y", 1);
    c.maker.dimension("x", 3);
    c.maker.variable("z", {"z"}, {100, 200}, "m");
    c.maker.variable("y", {"y"}, {0.5}, "km").texts.emplace_back("bounds", "y_bnds");
    c.maker.variable("x", {"x"}, {-1000, 0, 1000}, "m");
    c.maker.dimension("bnds", 2);
    c.maker.variable("y_bnds", {"y", "bnds"}, {0, 1});
    c.maker.variable("extinction", {"z", "y", "x"}, {0, 0.1, 0.2, 0.3, 0.4, 0.5}, "m-1");
    return c;
}

}  // namespace

TEST_CASE("grid: written and read again is the same, bit for bit") {
    for (const std::array<int, 3> size : {std::array<int, 3>{5, 3, 4}, {1, 1, 1}, {1, 7, 1}})
        for (const bool extinction : {true, false}) {
            CAPTURE(size[1]);
            Volume volume, again;
            fill(size, extinction, volume);
            Buffer<char> bytes;
            REQUIRE(encode_netcdf_volume(volume, bytes));
            const Status status = read_back(bytes, {}, again);
            REQUIRE_MESSAGE(status, status.message);
            CHECK(again.size == volume.size);
            CHECK(again.knows_bounds);
            CHECK(again.bounds_m == volume.bounds_m);
            REQUIRE(again.density.size() == volume.density.size());
            CHECK(std::memcmp(again.density.data(), volume.density.data(),
                              volume.density.size() * sizeof(float)) == 0);
        }
}

TEST_CASE("grid: a volume without a box has none when it is read") {
    Volume volume, again;
    fill({2, 3, 4}, false, volume);
    volume.knows_bounds = false;
    Buffer<char> bytes;
    REQUIRE(encode_netcdf_volume(volume, bytes));
    REQUIRE(read_back(bytes, {}, again));
    CHECK_FALSE(again.knows_bounds);
    CHECK(again.size == volume.size);
}

TEST_CASE("grid: a file of others: places, bounds, km") {
    test::WeatherCase c = grid_case();
    const std::string bytes = c.maker.bytes();
    NcFile file;
    REQUIRE(file.open_bytes("g.nc", {bytes.data(), bytes.size()}));
    Volume volume;
    const Status status = weather_volume({}, file, volume);
    REQUIRE_MESSAGE(status, status.message);
    CHECK(volume.size == std::array<int, 3>{3, 1, 2});
    CHECK(volume.bounds_m[0] == Double3{-1500, 0, 50});
    CHECK(volume.bounds_m[1] == Double3{1500, 1000, 250});
    CHECK(volume.density[4] == 0.4f);
}

TEST_CASE("grid: each fault is one line that says where and what") {
    const auto fault = [](test::WeatherCase& c) {
        const std::string bytes = c.maker.bytes();
        NcFile file;
        REQUIRE(file.open_bytes("g.nc", {bytes.data(), bytes.size()}));
        Volume volume;
        VolumeHead head;
        const Status status = weather_volume(c.medium, file, volume);
        CHECK_FALSE(bool(status));
        CHECK(status.message.find('\n') == std::string::npos);
        return status.message;
    };
    const auto has = [&](test::WeatherCase& c, const char* line) {
        const std::string text = fault(c);
        CHECK_MESSAGE(text.find(line) != std::string::npos, text);
    };
    test::WeatherCase c = grid_case();
    c.maker.set_units("extinction", "km-1");
    has(c, "g.nc: variable extinction: units: \"km-1\", allowed: m-1, 1/m, m^-1");
    c = grid_case();
    c.maker.of("x").values = {-1000, 0, 1001};
    has(c, "variable x: values: not evenly spaced, allowed: equal cells");
    c = grid_case();
    c.maker.of("z").values = {200, 100};
    has(c, "variable z: values: no box, allowed: rising metres");
    c = grid_case();
    c.maker.set_units("x", "degrees_east");
    has(c, "variable x: units: \"degrees_east\", allowed: m, km along a grid");
    c = grid_case();
    c.maker.of("y").texts.assign(1, {"units", "m"});
    has(c, "variable y: values: no box");  // one cell without bounds
    c = grid_case();
    c.maker.of("extinction").dimensions = {"x", "y", "z"};
    has(c, "dimension x: out of order, allowed: z, y, x");
    c = grid_case();
    c.maker.of("extinction").values[3] = -0.1;
    has(c, "variable extinction: voxel 0 0 1 (index 3): negative, -0.1, allowed: a finite number");
    c = grid_case();
    c.maker.of("extinction").values[3] = 2e12;
    has(c, "variable extinction: voxel 0 0 1 (index 3): too large or not a number");
    c = grid_case();
    c.medium.box.resolution = {2, 2, 2};
    has(c, "g.nc: resolution: not for a grid of extinction, allowed: left out");
    c = grid_case();
    c.medium.weather.place.vertical_scale = 2;
    has(c, "g.nc: vertical_scale: not for a grid of extinction");
}
