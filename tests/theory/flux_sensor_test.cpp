// SPDX-License-Identifier: Apache-2.0
// Sensors of pileus flux: radiance at places, fluxes through levels, light from below.
// in: clear air, slabs, sky maps -> out: laws, and agreement with the faces and with photons.
// docs/flux.md, "Sensors", "Light from below"
#include <doctest/doctest.h>

#include <cmath>

#include "src/io/images/image_file.h"
#include "src/session/flux/flux.h"
#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"
#include "tests/support/sky_images.h"

namespace flux_sensor_test {

using namespace render_test;
using Keys = std::vector<std::string>;

constexpr double kErrors = 4.5;  // once in 150 000 by the normal law; seeds are fixed
constexpr double kPiD = 3.14159265358979323846;

const char* const kScene = R"(
seed = 5
[camera]
position_m = [0, -1, 0]
target_m = [0, 0, 0]
[sun]
azimuth_deg = 30
elevation_deg = 50
irradiance = [100, 200, 50]
[[medium]]
density = "uniform:box"
bounds_m = [[0, 0, 100], [200, 100, 250]]
resolution = [16, 8, 12]
boundary = "periodic"
extinction_per_m = 0.02
albedo = 0.8
phase = { type = "henyey-greenstein", g = 0.6 }
)";
const double kMu = 0.766044443;

Sensor level(double height, std::uint64_t samples = 100'000) {
    Sensor s;
    s.kind = SensorKind::kLevel;
    s.name = "level";
    s.height_m = height;
    s.samples = samples;
    return s;
}
Sensor look(const Double3& place, const Double3& direction, std::uint64_t samples = 20'000) {
    Sensor s;
    s.name = "look";
    s.position_m = place;
    s.direction = direction;
    s.samples = samples;
    return s;
}

Sensor plane(const Double3& place, const Double3& normal, std::uint64_t samples = 100'000) {
    Sensor s = look(place, normal, samples);
    s.kind = SensorKind::kPlane;
    return s;
}

Status try_measure(const Keys& keys, const std::vector<Sensor>& sensors, FluxResult& flux) {
    FluxSettings settings;
    settings.columns = {4, 4};
    settings.sensors = sensors;
    settings.sensor_file = "sensors.toml";
    RenderOptions options;
    options.budget.samples = 4096;
    Image maps;
    Report report;
    return measure_flux(scene_from(kScene, keys), options, settings, flux, maps, report);
}
FluxResult measure(const Keys& keys, const std::vector<Sensor>& sensors) {
    FluxResult flux;
    const Status status = try_measure(keys, sensors, flux);
    REQUIRE_MESSAGE(bool(status), status.message);
    REQUIRE(flux.sensors.size() == sensors.size());
    return flux;
}

TEST_CASE("sensors: in clear air they see sky and ground, and levels hold what falls on them") {
    const FluxResult f =
        measure({"medium.0.extinction_per_m=0", "sky.radiance=[1,2,3]", "ground.altitude_m=0",
                 "ground.albedo=0.5"},
                {look({-500, 30, 120}, {0, 0, 1}), look({50, 1000, 180}, {0.6, 0, -0.8}),
                 level(100), level(175), level(250)});
    const double sun[3] = {100, 200, 50}, sky[3] = {1, 2, 3};
    for (std::size_t c = 0; c < 3; ++c) {
        CAPTURE(c);
        const double falls = kMu * sun[c] + kPiD * sky[c];
        CHECK(f.sensors[0].radiance.mean[c] == doctest::Approx(sky[c]).epsilon(1e-6));
        const FluxShare& ground = f.sensors[1].radiance;
        CHECK(std::fabs(ground.mean[c] - 0.5 * falls / kPiD) <=
              kErrors * ground.standard_error[c] + 1e-5 * falls);
        for (std::size_t i = 2; i < 5; ++i) {
            const SensorReading& r = f.sensors[i];
            CHECK(r.direct[c] == doctest::Approx(kMu * sun[c]).epsilon(1e-6));
            CHECK(std::fabs(r.down.mean[c] - falls) <=
                  kErrors * r.down.standard_error[c] + 1e-5 * falls);
            CHECK(std::fabs(r.up.mean[c] - 0.5 * falls) <=
                  kErrors * r.up.standard_error[c] + 1e-5 * falls);
        }
    }
}

TEST_CASE("sensors: levels at the faces are the faces, and between two lies what is absorbed") {
    const FluxResult f = measure({}, {level(250), level(100), level(150), level(200)});
    const auto near = [](double a, double ea, double b, double eb) {
        CHECK(std::fabs(a - b) <= kErrors * std::sqrt(ea * ea + eb * eb) + 1e-9);
    };
    for (std::size_t c = 0; c < 3; ++c) {
        const double all = kMu * double(f.irradiance[c]);
        const SensorReading &top = f.sensors[0], &bottom = f.sensors[1];
        near(top.up.mean[c] / all, top.up.standard_error[c] / all, f.reflectance.mean[c],
             f.reflectance.standard_error[c]);
        near(bottom.down.mean[c] / all, bottom.down.standard_error[c] / all,
             f.transmittance.mean[c], f.transmittance.standard_error[c]);
        CHECK(top.down.mean[c] == doctest::Approx(all).epsilon(1e-6));
        CHECK(bottom.up.mean[c] == 0);
        CHECK(bottom.direct[c] / all ==
              doctest::Approx(f.transmittance_direct.mean[c]).epsilon(1e-3));
    }
    // Photons tell how much the four layers between 150 and 200 m absorb.
    FluxSettings settings;
    settings.method = FluxMethod::kPhotons;
    settings.absorbed = true;
    settings.columns = {1, 1};
    FluxResult shot;
    Image maps;
    Report report;
    RenderOptions options;
    options.budget.photons = 300'000;
    REQUIRE(measure_flux(scene_from(kScene), options, settings, shot, maps, report));
    const SensorReading &low = f.sensors[2], &high = f.sensors[3];
    for (std::size_t c = 0; c < 3; ++c) {
        CAPTURE(c);
        double kept = 0, error = 0;
        for (std::size_t z = 4; z < 8; ++z) {
            kept += shot.absorbed.layers[z].mean[c] * 12.5;
            error += shot.absorbed.layers[z].standard_error[c] * 12.5;
        }
        const double net = high.down.mean[c] - high.up.mean[c] - low.down.mean[c] + low.up.mean[c];
        for (const FluxShare* s : {&high.down, &high.up, &low.down, &low.up})
            error = std::sqrt(error * error + s->standard_error[c] * s->standard_error[c]);
        CHECK(error < 0.1 * kept);
        // Direct rays are marched in steps of a cell: 2e-3 of the light.
        CHECK(std::fabs(net - kept) <= kErrors * error + 2e-3 * kMu * double(shot.irradiance[c]));
    }
}

TEST_CASE("sensors: a small plane anywhere in or about a slab has what its level has") {
    // The sun's direction, a tilted plane, places beside, below and above the slab and on its
    // faces.
    const Double3 to_sun{0.321393805, 0.556670399, 0.766044443};
    const FluxResult f =
        measure({}, {level(175), plane({33, 44, 175}, {0, 0, 1}),
                     plane({-730, 910, 175}, {0, 0, 1}), plane({5, 5, 175}, {0, 0, -1}),
                     plane({5, 5, -1000}, {0, 0, 1}), plane({0, 0, 100}, {0, 0, 1}),
                     plane({50, 50, 900}, to_sun), plane({50, 50, 900}, {0, 0, -1})});
    const auto near = [](double a, double ea, double b, double eb) {
        CHECK(std::fabs(a - b) <= kErrors * std::sqrt(ea * ea + eb * eb) + 1e-4 * b);
    };
    for (std::size_t c = 0; c < 3; ++c) {
        CAPTURE(c);
        const SensorReading& mid = f.sensors[0];
        const double all = kMu * double(f.irradiance[c]), e = double(f.irradiance[c]);
        for (std::size_t i : {1u, 2u}) {
            const SensorReading& r = f.sensors[i];
            near(r.down.mean[c], r.down.standard_error[c], mid.down.mean[c],
                 mid.down.standard_error[c]);
            CHECK(r.direct[c] == doctest::Approx(all * std::exp(-1.5 / kMu)).epsilon(1e-4));
        }
        const SensorReading& under = f.sensors[3];
        near(under.down.mean[c], under.down.standard_error[c], mid.up.mean[c],
             mid.up.standard_error[c]);
        CHECK(under.direct[c] == 0);
        for (std::size_t i : {4u, 5u}) {
            const SensorReading& r = f.sensors[i];
            near(r.down.mean[c] / all, r.down.standard_error[c] / all, f.transmittance.mean[c],
                 f.transmittance.standard_error[c]);
            CHECK(r.direct[c] == doctest::Approx(all * std::exp(-3 / kMu)).epsilon(1e-4));
        }
        CHECK(f.sensors[6].direct[c] == doctest::Approx(e).epsilon(1e-6));
        near(f.sensors[7].down.mean[c] / all, f.sensors[7].down.standard_error[c] / all,
             f.reflectance.mean[c], f.reflectance.standard_error[c]);
    }
    // An open box shades the place that the sun sees through it, and no other.
    const Keys open = {"medium.0.boundary=open", "medium.0.albedo=0"};
    const FluxResult shade = measure(
        open, {plane({100 - 0.41955 * 175, 50 - 0.72668 * 175, 0}, {0, 0, 1}, 64),
               plane({100, -5000, 0}, {0, 0, 1}, 64), plane({100, 50, 175}, {1, 0, 0}, 64)});
    const double all = kMu * double(shade.irradiance[0]);
    // Through the middle of the box, which it crosses between the faces across y.
    const double path = 100 / 0.556670399;
    CHECK(shade.sensors[0].direct[0] ==
          doctest::Approx(all * std::exp(-0.02 * path)).epsilon(2e-3));
    CHECK(shade.sensors[1].direct[0] == doctest::Approx(all).epsilon(1e-6));
    CHECK(shade.sensors[2].direct[0] ==
          doctest::Approx(100 * 0.321393805 * std::exp(-0.01 * path)).epsilon(2e-3));
}

TEST_CASE("light from below: a sky map whose lower half shines adds what --from-below measures") {
    const test::TempFolder folder;
    // Rows from the zenith to the nadir; the horizon is blurred over one of 720.
    REQUIRE(write_image(
        sky_test::sky_image(1, 720, [](int row, int, int c) { return row < 360 ? 0.0 : 10.0 * c; }),
        folder.path("below.pfm"), {}));
    const FluxResult dark = measure({}, {});
    const FluxResult lit = measure({"sky.map=" + folder.path("below.pfm")}, {});
    FluxSettings settings;
    settings.columns = {4, 4};
    settings.from_below = true;
    settings.below_radiance = {0, 10, 20};
    RenderOptions options;
    options.budget.samples = 4096;
    FluxResult below;
    Image maps;
    Report report;
    REQUIRE(measure_flux(scene_from(kScene), options, settings, below, maps, report));
    CHECK(below.reflectance.mean[0] == 0);
    for (std::size_t c = 1; c < 3; ++c) {
        CAPTURE(c);
        const double ratio = kPiD * 10.0 * double(c) / (kMu * double(dark.irradiance[c]));
        const auto adds = [&](const FluxShare& with, const FluxShare& without,
                              const FluxShare& share) {
            const double ea = with.standard_error[c], eb = without.standard_error[c],
                         es = ratio * share.standard_error[c];
            CHECK(std::fabs(with.mean[c] - without.mean[c] - ratio * share.mean[c]) <=
                  kErrors * std::sqrt(ea * ea + eb * eb + es * es) + 1e-4 * ratio);
            CHECK(share.mean[c] > 0.05);
        };
        // What goes through from below leaves where the sun's reflectance does.
        adds(lit.reflectance, dark.reflectance, below.transmittance);
        adds(lit.transmittance, dark.transmittance, below.reflectance);
        adds(lit.absorptance, dark.absorptance, below.absorptance);
    }
}

TEST_CASE("sensors: one that cannot be is one line") {
    FluxResult flux;
    const auto fault = [&](const Sensor& sensor, const Keys& keys = {}) {
        const Status status = try_measure(keys, {sensor}, flux);
        CHECK(status.code == Code::kBadInput);
        return status.message;
    };
    CHECK(fault(level(99)) ==
          "sensors.toml: \"level\": height_m: outside of the media's box, 99, allowed: 100 to 250");
    CHECK(fault(look({0, 0, -1}, {0, 0, 1}), {"ground.altitude_m=0"}) ==
          "sensors.toml: \"look\": position_m: below the ground, -1 m, allowed: 0 and above");
}

}  // namespace flux_sensor_test
