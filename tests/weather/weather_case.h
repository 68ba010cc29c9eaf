// SPDX-License-Identifier: Apache-2.0
// Small files of weather data, and what they become.
// in: a maker of NetCDF files, settings -> out: a volume, or the line of a fault.
// docs/weather.md
#pragma once
#include <doctest/doctest.h>

#include <string>

#include "src/io/netcdf/netcdf_file.h"
#include "src/io/volumes/volume.h"
#include "src/io/volumes/volume_file.h"
#include "src/io/volumes/weather/weather_grid.h"
#include "tests/support/netcdf_maker.h"

namespace test {

struct WeatherCase {
    NetcdfMaker maker;
    pileus::MediumSettings medium;
    pileus::Volume volume;
    pileus::VolumeHead head;
    pileus::WeatherSurvey survey;

    pileus::Status load() {
        const std::string bytes = maker.bytes();
        return load_bytes(bytes);
    }
    pileus::Status load_bytes(const std::string& bytes) {
        pileus::NcFile file;
        PILEUS_TRY(file.open_bytes("w.nc", {bytes.data(), bytes.size()}));
        pileus::WeatherSource source;
        PILEUS_TRY(pileus::open_weather(file, medium.weather, source));
        PILEUS_TRY(pileus::survey_weather(source, survey));
        PILEUS_TRY(pileus::weather_head(medium, file, head));
        PILEUS_TRY(pileus::weather_volume(medium, file, volume));
        CHECK(head.size == volume.size);
        CHECK(head.bounds_m == volume.bounds_m);
        return pileus::Status::ok();
    }
    std::string fault() {
        const pileus::Status status = load();
        if (status) return "no fault";
        CHECK(status.message.find('\n') == std::string::npos);
        return status.message;
    }

    double cell_m(std::size_t a) const {
        return (volume.bounds_m[1][a] - volume.bounds_m[0][a]) / volume.size[a];
    }
    /// Optical depth along z of the column of cells (x, y).
    double depth(int x, int y) const {
        const std::size_t nx = std::size_t(volume.size[0]), ny = std::size_t(volume.size[1]);
        double sum = 0;
        for (std::size_t z = 0; z < std::size_t(volume.size[2]); ++z)
            sum += double(volume.density[(z * ny + std::size_t(y)) * nx + std::size_t(x)]);
        return sum * cell_m(2);
    }
    /// Extinction times volume of all cells.
    double total() const {
        double sum = 0;
        for (std::size_t i = 0; i < volume.density.size(); ++i) sum += double(volume.density[i]);
        return sum * cell_m(0) * cell_m(1) * cell_m(2);
    }
};

/// Two by one columns 1 km apart, three layers of 100 m from 500 m on, liquid in g/m3: no air is
/// needed.
inline WeatherCase content_case() {
    WeatherCase c;
    c.maker.dimension("z", 3);
    c.maker.dimension("y", 1);
    c.maker.dimension("x", 2);
    c.maker.variable("z", {"z"}, {550, 650, 750}, "m");
    c.maker.variable("y", {"y"}, {0}, "m");
    c.maker.variable("x", {"x"}, {0, 1000}, "m");
    c.maker.variable("lwc", {"z", "y", "x"}, {0.1, 0, 0.2, 0.4, 0, 0.3}, "g m-3");
    return c;
}

/// One column of `n` layers between faces of pressure, from above as ecRad has them.
inline WeatherCase pressure_case() {
    WeatherCase c;
    c.maker.dimension("column", 1);
    c.maker.dimension("level", 3);
    c.maker.dimension("half_level", 4);
    c.maker.variable("pressure_hl", {"column", "half_level"}, {70000, 80000, 90000, 100000}, "Pa");
    c.maker.variable("temperature_hl", {"column", "half_level"}, {270, 276, 282, 288}, "K");
    c.maker.variable("q", {"column", "level"}, {0.002, 0.004, 0.008}, "1");
    c.maker.variable("q_liquid", {"column", "level"}, {0, 3e-4, 1e-4}, "1");
    c.maker.variable("q_ice", {"column", "level"}, {1e-5, 0, 0}, "1");
    return c;
}

}  // namespace test
