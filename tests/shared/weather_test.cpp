// SPDX-License-Identifier: Apache-2.0
// Weather data as published: water paths and optical depths against an independent sum.
// in: PILEUS_DATA_DIR/data/weather -> out: pass or fail, or one line why it was skipped.
// docs/weather.md; docs/testing.md, label shared
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "src/io/volumes/volume.h"
#include "src/io/volumes/volume_file.h"
#include "src/io/volumes/weather/weather_grid.h"
#include "src/io/volumes/weather_file.h"

using namespace pileus;

namespace {

std::string weather_file(const char* name) {
    const char* root = std::getenv("PILEUS_DATA_DIR");
    if (root == nullptr || root[0] == '\0') {
        MESSAGE("skipped: PILEUS_DATA_DIR is not set");
        return "";
    }
    return std::string(root) + "/data/weather/" + name;
}

/// Sums over columns of kg/m2 and of optical depth.
struct Paths {
    double liquid = 0, most_liquid = 0, ice = 0, most_ice = 0, depth = 0, most_depth = 0;
    std::size_t columns = 0;
};

Paths paths_of(const WeatherSource& s) {
    Paths p;
    CloudLayers layers;
    WeatherCounts counts;
    const std::uint64_t step = block_rows(s);
    const std::size_t n = s.levels();
    for (std::uint64_t row = 0; row < s.axes.ny; row += step) {
        const std::uint64_t rows = s.axes.ny - row < step ? s.axes.ny - row : step;
        const Status status = read_layers(s, row, rows, layers, counts);
        REQUIRE_MESSAGE(status, status.message);
        for (std::size_t c = 0; c < std::size_t(rows) * s.row_columns(); ++c, ++p.columns) {
            double liquid = 0, ice = 0, depth = 0;
            for (std::size_t k = 0; k < n; ++k) {
                const double dz =
                    layers.faces_m[c * (n + 1) + k + 1] - layers.faces_m[c * (n + 1) + k];
                liquid += layers.liquid[c * n + k] * dz;
                ice += layers.ice[c * n + k] * dz;
                depth += layers.extinction[c * n + k] * dz;
            }
            p.liquid += liquid;
            p.ice += ice;
            p.depth += depth;
            p.most_liquid = liquid > p.most_liquid ? liquid : p.most_liquid;
            p.most_ice = ice > p.most_ice ? ice : p.most_ice;
            p.most_depth = depth > p.most_depth ? depth : p.most_depth;
        }
    }
    return p;
}

double depth_of(const Volume& v) {
    double sum = 0;
    for (const float value : v.density.span()) sum += double(value);
    double cell = 1;
    for (std::size_t a = 0; a < 3; ++a) cell *= (v.bounds_m[1][a] - v.bounds_m[0][a]) / v.size[a];
    return sum * cell;
}

void check_conserved(const NcFile& file, const MediumSettings& medium, const WeatherSource& s) {
    WeatherSurvey survey;
    Volume volume;
    REQUIRE(survey_weather(s, survey));
    const Status status = weather_volume(medium, file, volume);
    REQUIRE_MESSAGE(status, status.message);
    CHECK(depth_of(volume) == doctest::Approx(survey.depth_m2).epsilon(1e-6));
}

}  // namespace

// Of the pressures of faces: sum of q (p_low - p_high) / g over layers and columns, g = 9.80665;
// depth 1.5 path / (density radius), 1000 and 917 kg/m3, radii of the file. In Python, in doubles.
TEST_CASE("weather: ecRad's meridian has its water paths and depths") {
    const std::string path = weather_file("ecrad_meridian.nc");
    if (path.empty()) return;
    NcFile file;
    REQUIRE(file.open(path));
    MediumSettings medium;
    WeatherSource s;
    const Status status = open_weather(file, medium.weather, s);
    REQUIRE_MESSAGE(status, status.message);
    const Paths p = paths_of(s);
    CHECK(p.columns == 32);
    // The masses of layers differ by rounding alone: 1e-9.
    CHECK(p.liquid == doctest::Approx(0.9790796869).epsilon(1e-8));
    CHECK(p.most_liquid == doctest::Approx(0.3666619488).epsilon(1e-8));
    CHECK(p.ice == doctest::Approx(1.013802771).epsilon(1e-8));
    CHECK(p.most_ice == doctest::Approx(0.5550073277).epsilon(1e-8));
    CHECK(p.depth == doctest::Approx(178.1427815).epsilon(1e-8));
    CHECK(p.most_depth == doctest::Approx(56.24536106).epsilon(1e-8));
    check_conserved(file, medium, s);
}

// Air of the pressures' arithmetic means of faces, heights of the file: sum of q rho dz.
TEST_CASE("weather: the I3RC cumulus profile is a single column") {
    const std::string path = weather_file("i3rc_mls_cumulus.nc");
    if (path.empty()) return;
    NcFile file;
    REQUIRE(file.open(path));
    MediumSettings medium;
    WeatherSource s;
    const Status status = open_weather(file, medium.weather, s);
    REQUIRE_MESSAGE(status, status.message);
    const Paths p = paths_of(s);
    CHECK(p.columns == 1);
    CHECK(p.liquid == doctest::Approx(0.03848534321).epsilon(1e-9));
    CHECK(p.depth == doctest::Approx(5.591003928).epsilon(1e-9));
    check_conserved(file, medium, s);
}

// T = (T' + 300) (p/1e5)^(2/7), rho = p / (287.05 T (1 + 0.608 r/(1 + r))), path = sum of
// qc rho / (1 + r) (PH + PHB)/9.81 between faces; depth 1.5 path / (1000 x 10 um). In Python.
TEST_CASE("weather: WRF on Mercator has the water of each of its times") {
    const std::string path = weather_file("wrf_mercator.nc");
    if (path.empty() || netcdf_library_text() == "NetCDF-4 no") return;
    const double mean[4] = {0.0574303199493, 0.0515788695579, 0.0629920823099, 0.0470615074904};
    const double most[4] = {3.6659012034, 3.05861635452, 3.10682482683, 1.77374190331};
    const char* const dates[4] = {"2005-08-28T12", "2005-08-28_15:00:00", "2005-08-28 18", "3"};
    for (int i = 0; i < 4; ++i) {
        CAPTURE(i);
        NcFile file;
        REQUIRE(file.open(path));
        MediumSettings medium;
        medium.weather.time = {true, dates[i], 0};
        WeatherSource s;
        const Status status = open_weather(file, medium.weather, s);
        REQUIRE_MESSAGE(status, status.message);
        const Paths p = paths_of(s);
        CHECK(p.columns == 48 * 48);
        CHECK(p.liquid / 2304 == doctest::Approx(mean[i]).epsilon(1e-9));
        CHECK(p.most_liquid == doctest::Approx(most[i]).epsilon(1e-9));
        CHECK(p.most_depth == doctest::Approx(most[i] * 150).epsilon(1e-9));
        check_conserved(file, medium, s);
    }
}

TEST_CASE("weather: WRF's own longitudes and latitudes are found where their columns lie") {
    const std::string path = weather_file("wrf_mercator.nc");
    if (path.empty() || netcdf_library_text() == "NetCDF-4 no") return;
    WeatherMap map;
    MediumSettings medium;
    const Status status = read_weather_map(medium, path, map);
    REQUIRE_MESSAGE(status, status.message);
    NcFile file;
    REQUIRE(file.open(path));
    std::vector<double> places[2];
    for (int i = 0; i < 2; ++i) {
        const NcVariable* v = file.head().find(i == 0 ? "XLONG" : "XLAT");
        REQUIRE((v != nullptr));
        NcBlock block = whole_block(file.head(), *v);
        block.count[0] = 1;
        places[i].resize(std::size_t(block.values()));
        REQUIRE(file.read(*v, block, {places[i].data(), places[i].size()}));
    }
    REQUIRE(places[0].size() == 48 * 48);
    // Floats of degrees are good to 4e-6 degrees, 0.4 m, of 10 km columns; single precision in
    // WRF's own projection makes some metres of it.
    double worst = 0;
    for (std::size_t at = 0; at < places[0].size(); ++at) {
        Double3 metres{};
        REQUIRE(map.place("place", {places[0][at], places[1][at], 0}, metres));
        const double x = (double(at % 48) - 23.5) * 10000, y = (double(at / 48) - 23.5) * 10000;
        const double off = std::hypot(metres[0] - x, metres[1] - y);
        if (off > worst) worst = off;
    }
    MESSAGE("farthest off: ", worst, " m");
    CHECK(worst < 10);
}
