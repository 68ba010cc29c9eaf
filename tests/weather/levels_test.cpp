// SPDX-License-Identifier: Apache-2.0
// Layers of air against closed forms: faces, hydrostatic heights, density, extinction.
// in: numbers of one column -> out: pass or fail.
// docs/weather.md, "Heights"; docs/testing.md, label weather
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "src/io/volumes/weather/weather_levels.h"
#include "src/io/volumes/weather/weather_units.h"

using namespace pileus;

TEST_CASE("levels: faces midway and in the logarithm, the outer ones mirrored") {
    const std::vector<double> z{100, 200, 400};
    std::vector<double> faces(4);
    faces_midway({z.data(), 3}, {faces.data(), 4});
    CHECK(faces == std::vector<double>{50, 150, 300, 500});
    const std::vector<double> p{80000, 20000, 5000};
    faces_in_logarithm({p.data(), 3}, {faces.data(), 4});
    CHECK(faces[0] == doctest::Approx(160000).epsilon(1e-14));
    CHECK(faces[1] == doctest::Approx(40000).epsilon(1e-14));
    CHECK(faces[3] == doctest::Approx(2500).epsilon(1e-14));
}

TEST_CASE("levels: an isothermal atmosphere has its scale height") {
    // z = R T / g ln(p0 / p).
    std::vector<double> p, kelvin(20, 250.0), z(21);
    for (int k = 0; k <= 20; ++k) p.push_back(100000 * std::pow(0.9, k));
    const auto integrate = [&] {
        std::vector<double> logarithms;
        for (std::size_t k = 0; k < 20; ++k) logarithms.push_back(layer_logarithm(p[k], p[k + 1]));
        sum_heights({logarithms.data(), 20}, {kelvin.data(), 20}, 30, {z.data(), 21});
    };
    integrate();
    for (std::size_t k = 0; k <= 20; ++k)
        CHECK(z[k] ==
              doctest::Approx(30 + 287.05 * 250 / 9.80665 * std::log(1e5 / p[k])).epsilon(1e-12));
    // The uppermost layer may end in space: ln 2 then.
    p[20] = 0;
    integrate();
    CHECK(z[20] - z[19] == doctest::Approx(287.05 * 250 / 9.80665 * std::log(2.0)).epsilon(1e-12));
}

TEST_CASE("levels: the mass of a layer is its pressure difference over g, however thick") {
    for (const double high : {99999.9999, 99999.0, 90000.0, 20000.0, 1.0, 0.0}) {
        CAPTURE(high);
        const double low = 100000, kelvin = 280;
        const double thickness = kDryAir * kelvin / kGravity * layer_logarithm(low, high);
        const double density =
            layer_pressure(low, high, layer_logarithm(low, high)) / (kDryAir * kelvin);
        // Of the thinnest layers the middle stands for the mean: (dp/p)^2/12 < 1e-13.
        CHECK(density * thickness == doctest::Approx((low - high) / kGravity).epsilon(1e-9));
    }
}

TEST_CASE("levels: potential temperature, virtual temperature, standard height") {
    CHECK(temperature_of(300, 1e5) == doctest::Approx(300).epsilon(1e-14));
    CHECK(temperature_of(300, 5e4) == doctest::Approx(300 * std::pow(0.5, 2.0 / 7)).epsilon(1e-12));
    CHECK(virtual_temperature(300, 0.01) == doctest::Approx(301.824).epsilon(1e-12));
    CHECK(standard_height(101325) == doctest::Approx(0).epsilon(1e-9));
    CHECK(standard_height(50000) == doctest::Approx(5574).epsilon(1e-3));
}

TEST_CASE("levels: extinction by radius and by Fu's size, which differ by 1.54") {
    // 0.3 g/m3 of 10 um: 1.5 * 0.3e-3 / (1000 * 10e-6).
    CHECK(radius_extinction(0.3e-3, 1000, 10e-6) == doctest::Approx(0.045).epsilon(1e-14));
    const double dge = dge_extinction(1e-5, 30e-6), radius = radius_extinction(1e-5, 917, 30e-6);
    CHECK(dge == doctest::Approx(4 * std::sqrt(3.0) / 3 * 1e-5 / (917 * 30e-6)).epsilon(1e-14));
    CHECK(dge / radius == doctest::Approx(8 * std::sqrt(3.0) / 9).epsilon(1e-12));
}

TEST_CASE("units: spellings, factors, and none of another quantity") {
    UnitScale scale;
    CHECK(find_unit("kg kg**-1", Quantity::kRatio, scale));
    CHECK(find_unit("g kg-1", Quantity::kRatio, scale));
    CHECK(scale.factor == 1e-3);
    CHECK(find_unit("kg.m^-3", Quantity::kContent, scale));
    CHECK(find_unit("hPa", Quantity::kPressure, scale));
    CHECK(scale.factor == 100);
    CHECK(find_unit("degC", Quantity::kTemperature, scale));
    CHECK(scale.offset == 273.15);
    CHECK(find_unit("\xc2\xb5m", Quantity::kRadius, scale));
    CHECK(scale.factor == 1e-6);
    CHECK_FALSE(find_unit("kg m-2", Quantity::kContent, scale));
    CHECK_FALSE(find_unit("Pa", Quantity::kTemperature, scale));
    CHECK_FALSE(find_unit("", Quantity::kRatio, scale));
}
