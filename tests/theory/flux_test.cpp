// SPDX-License-Identifier: Apache-2.0
// Fluxes by paths against the photons' ledger, which is other code, and what must add up to one.
// in: a periodic slab and an open sphere -> out: shares within their standard errors.
// docs/flux.md
#include "src/session/flux/flux.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/render_harness.h"

namespace flux_test {

using namespace render_test;
using Keys = std::vector<std::string>;

/// A false alarm in 150 000 comparisons; seeds are fixed.
constexpr double kErrors = 4.5;

const char* const kScene = R"(
[camera]
position_m = [0, -1, 0]
target_m = [0, 0, 0]
resolution = [2, 2]
[sun]
azimuth_deg = 30
elevation_deg = 50
[[medium]]
density = "uniform:sphere"
bounds_m = [[0, 0, 100], [200, 100, 250]]
resolution = [16, 8, 12]
extinction_per_m = 0.04
albedo = 0.8
phase = { type = "henyey-greenstein", g = 0.6 }
[collectors]
photons = 300_000
)";
const Keys kSlab = {"medium.0.density=uniform:box", "medium.0.boundary=periodic",
                    "medium.0.extinction_per_m=0.02"};

FluxSettings in_columns(std::array<int, 2> columns) {
    FluxSettings settings;
    settings.columns = columns;
    return settings;
}

struct Measured {
    FluxResult flux;
    Image maps;
};
Measured measure(const Keys& keys, std::int64_t samples, std::array<int, 2> columns) {
    Measured m;
    RenderOptions options;
    options.budget.samples = samples;
    Report report;
    const Status status = measure_flux(scene_from(kScene, keys), options, in_columns(columns),
                                       m.flux, m.maps, report);
    REQUIRE_MESSAGE(bool(status), status.message);
    return m;
}

void check_agrees(const FluxShare& flux, double ledger, double ledger_error, double floor = 0) {
    const double error =
        std::sqrt(flux.standard_error[0] * flux.standard_error[0] + ledger_error * ledger_error);
    CHECK(error > 0);
    CHECK(std::fabs(flux.mean[0] - ledger) < kErrors * error + floor);
}

TEST_CASE("flux: a slab's and a sphere's shares are those of the photons' ledger") {
    for (const bool periodic : {true, false}) {
        CAPTURE(periodic);
        const Keys keys = periodic ? kSlab : Keys{};
        const Measured m = measure(keys, 2048, {16, 8});
        const EnergyRow row = render_one(scene_from(kScene, keys)).report.photons.energy[0];
        // The ledger's shares are of what arrives at the box, those of fluxes of a level plane.
        const double to_sun[3] = {0.3213938, 0.5566704, 0.7660444};
        double arrives = to_sun[2];
        if (!periodic) arrives += to_sun[0] * 100 * 150 / 2e4 + to_sun[1] * 200 * 150 / 2e4;
        const double level = arrives / to_sun[2];
        check_agrees(m.flux.reflectance, level * row.top, level * row.error.top);
        check_agrees(m.flux.transmittance, level * row.bottom, level * row.error.bottom,
                     2e-3 * m.flux.transmittance_direct.mean[0]);  // steps of the direct rays
        check_agrees(m.flux.absorptance, level * row.absorbed, level * row.error.absorbed,
                     2e-3 * m.flux.transmittance_direct.mean[0]);
    }
}

TEST_CASE("flux: direct light is the law of Beer, and what is kept and sent away adds up to one") {
    const Measured m = measure(kSlab, 512, {4, 4});
    const FluxResult& f = m.flux;
    CHECK(f.mu0 == doctest::Approx(0.76604444).epsilon(1e-7));
    // Midpoint steps are exact in a uniform medium, to float's rounding of 150 of them.
    CHECK(f.transmittance_direct.mean[0] ==
          doctest::Approx(std::exp(-3 / 0.76604444)).epsilon(1e-4));
    CHECK(f.reflectance.mean[0] + f.transmittance.mean[0] + f.absorptance.mean[0] ==
          doctest::Approx(1).epsilon(1e-9));
    Keys white = kSlab;
    white.push_back("medium.0.albedo=1");
    const Measured w = measure(white, 2048, {4, 4});
    CHECK(w.flux.absorptance.mean[0] == 0);
    check_agrees(w.flux.reflectance, 1 - w.flux.transmittance.mean[0],
                 w.flux.transmittance.standard_error[0]);
}

TEST_CASE("flux: maps have the means of the shares, north at the top, west at the left") {
    const Measured m = measure({"medium.0.bounds_m=[[0, 100, 0], [100, 200, 100]]",
                                "medium.0.resolution=[8, 8, 8]", "sun.elevation_deg=90"},
                               256, {6, 4});
    CHECK(m.maps.width == 6);
    CHECK(m.maps.height == 4);
    for (const char* name : {"R", "transmittance.G", "direct.B"}) {
        CAPTURE(name);
        double sum = 0;
        for (float v : m.maps.find(name)->pixels.span()) sum += double(v) / 24;
        const FluxShare& share = name[0] == 'R'   ? m.flux.reflectance
                                 : name[0] == 't' ? m.flux.transmittance
                                                  : m.flux.transmittance_direct;
        CHECK(sum == doctest::Approx(share.mean[1]).epsilon(1e-5));
    }
    // A pillar in the north-west corner of a thin sphere's box.
    const Keys two = {"medium.0.bounds_m=[[0, 0, 0], [100, 100, 100]]",
                      "medium.0.resolution=[16, 16, 16]", "sun.elevation_deg=90"};
    std::string text = kScene;
    text +=
        "[[medium]]\ndensity = \"uniform:box\"\nbounds_m = [[0, 75, 0], [25, 100, 100]]\n"
        "resolution = [4, 4, 16]\nextinction_per_m = 0.2\nalbedo = 0.8\n"
        "phase = { type = \"isotropic\" }\n";
    FluxResult flux;
    Image maps;
    Report report;
    RenderOptions options;
    options.budget.samples = 256;
    REQUIRE(measure_flux(scene_from(text, two), options, in_columns({4, 4}), flux, maps, report));
    const auto at = [&](const char* name, std::size_t x, std::size_t y) {
        return double(maps.find(name)->pixels[y * 4 + x]);
    };
    // tau = 20 in the corner: nothing passes straight on, nor much otherwise.
    CHECK(at("direct.R", 0, 0) < 1e-3);
    CHECK(at("transmittance.R", 0, 0) < 0.5 * at("transmittance.R", 3, 0));
    CHECK(at("transmittance.R", 0, 0) < 0.5 * at("transmittance.R", 0, 3));
    CHECK(at("R", 0, 0) > 2 * at("R", 3, 0));
    CHECK(at("R", 0, 0) > 2 * at("R", 0, 3));
}

TEST_CASE("flux: what cannot be measured is one line") {
    const auto fault = [](const Keys& keys, const RenderOptions& options = {}) {
        FluxResult flux;
        Image maps;
        Report report;
        const Status status =
            measure_flux(scene_from(kScene, keys), options, in_columns({2, 2}), flux, maps, report);
        CHECK(status.code == Code::kBadInput);
        return status.message;
    };
    CHECK(fault({"sun.elevation_deg=-5"}).find("test.toml: sun: not above the horizon") == 0);
    CHECK(fault({"sun.elevation_deg=0"}).find("test.toml: sun: not above the horizon") == 0);
    CHECK(fault({"sun.irradiance=0"}).find("test.toml: sun: not above the horizon") == 0);
    RenderOptions seconds;
    seconds.budget.seconds = 1;
    CHECK(fault({}, seconds) == "--budget seconds: not for method flux, allowed: samples=N");
    // Corners: the sun in the zenith, on the horizon's edge, one column of one cell.
    for (const char* elevation : {"90", "0.001"}) {
        const Measured m = measure(
            {std::string("sun.elevation_deg=") + elevation, "medium.0.resolution=[1, 1, 1]"}, 64,
            {1, 1});
        for (const FluxShare* share : {&m.flux.reflectance, &m.flux.transmittance})
            CHECK(std::isfinite(share->mean[0]));
    }
}

}  // namespace flux_test
