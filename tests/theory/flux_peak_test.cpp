// SPDX-License-Identifier: Apache-2.0
// Fluxes by paths through narrow peaks, against photons: the printed error covers the difference.
// in: slabs of large droplets and sharp lobes -> out: shares, sensors, refusals.
// docs/flux.md, "By paths"; docs/path.md, "Flux camera".
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "src/session/flux/flux.h"
#include "tests/support/render_harness.h"

namespace flux_peak_test {

using namespace render_test;
using Keys = std::vector<std::string>;

const char* const kSlab = R"(
[camera]
position_m = [0, -1, 1000]
target_m = [0, 0, 1000]
[sun]
azimuth_deg = 40
elevation_deg = 60
[[medium]]
density = "uniform:box"
bounds_m = [[0, 0, 200], [800, 800, 600]]
resolution = [4, 4, 4]
extinction_per_m = 0.005
albedo = 0.99
boundary = "periodic"
phase = { type = "isotropic" }
)";

Status measured(const std::string& phase, bool photons, std::int64_t budget, int seed,
                const Keys& keys, FluxResult& out, const std::vector<Sensor>& sensors = {}) {
    std::string text = kSlab;
    const std::string plain = "{ type = \"isotropic\" }";
    text.replace(text.find(plain), plain.size(), phase);
    FluxSettings settings;
    settings.columns = {1, 1};
    settings.method = photons ? FluxMethod::kPhotons : FluxMethod::kPath;
    settings.sensors = sensors;
    RenderOptions options;
    (photons ? options.budget.photons : options.budget.samples) = budget;
    Keys all = {"seed=" + std::to_string(seed)};
    all.insert(all.end(), keys.begin(), keys.end());
    Image maps;
    Report report;
    return measure_flux(scene_from(text, all), options, settings, out, maps, report);
}

/// Of what not one of 32 768 photons did, a few may do.
constexpr double kFewPhotons = 1e-4;

/// In standard errors of both.
double off(const FluxShare& a, const FluxShare& b) {
    const double error = std::sqrt(a.standard_error[0] * a.standard_error[0] +
                                   b.standard_error[0] * b.standard_error[0]);
    const double apart = std::fabs(a.mean[0] - b.mean[0]) - kFewPhotons;
    return std::max(apart, 0.0) / std::max(error, 1e-9);
}

TEST_CASE("flux by paths: the error covers what narrow peaks send through") {
    const std::string phases[] = {
        "{ type = \"cloud\", effective_radius_um = 20 }",
        "{ type = \"hg-draine\", droplet_diameter_um = 50 }",
        "{ type = \"henyey-greenstein\", g = 0.97 }",
        "{ type = \"henyey-greenstein\", g = 0.999 }",
        "{ type = \"henyey-greenstein\", g = 0.99999 }",
        "{ type = \"two-lobe\", g1 = 0.9995, g2 = -0.3, weight = 0.7 }",
    };
    for (const std::string& phase : phases)
        for (const char* disc : {"0", "4"}) {
            CAPTURE(phase);
            CAPTURE(disc);
            const Keys keys = {std::string("sun.angular_radius_deg=") + disc};
            FluxResult truth;
            REQUIRE(measured(phase, true, 32'768, 1, {}, truth));
            double square = 0;
            for (int seed = 0; seed < 4; ++seed) {
                FluxResult flux;
                REQUIRE(measured(phase, false, 4000, seed, keys, flux));
                // One of 100 000 by Gauss's law; a few more as 4000 samples are.
                CHECK(off(flux.transmittance, truth.transmittance) < 4.5);
                CHECK(off(flux.reflectance, truth.reflectance) < 4.5);
                CHECK(off(flux.absorptance, truth.absorptance) < 4.5);
                // 5 a sample: rays that seek the sun make it so small.
                CHECK(flux.transmittance.standard_error[0] < 0.08);
                square += std::pow(off(flux.transmittance, truth.transmittance), 2) / 4;
            }
            // Four squares of unit normals have a mean above 4.6 in one case of 1000.
            CHECK(square < 4.6);
        }
}

TEST_CASE(
    "flux by paths: a plane below the slab that faces the sun has what its bottom lets through") {
    Sensor sensor;
    sensor.name = "below";
    sensor.kind = SensorKind::kPlane;
    sensor.position_m = {400, 400, 100};
    sensor.direction = {0, 0, 1};
    sensor.samples = 4000;
    const std::string phase = "{ type = \"cloud\", effective_radius_um = 20 }";
    FluxResult truth, flux;
    REQUIRE(measured(phase, true, 65'536, 1, {}, truth));
    REQUIRE(measured(phase, false, 500, 3, {}, flux, {sensor}));
    REQUIRE(flux.sensors.size() == 1);
    // Shares are of mu0 E: E is 1 here.
    FluxShare share = flux.sensors[0].down;
    share.mean[0] /= flux.mu0;
    share.standard_error[0] /= flux.mu0;
    CHECK(off(share, truth.transmittance) < 4.5);
    CHECK(share.standard_error[0] < 0.08);
}

TEST_CASE("flux by paths: lobes without width are refused, photons take them") {
    for (const char* phase :
         {"{ type = \"henyey-greenstein\", g = 1 }", "{ type = \"henyey-greenstein\", g = -1 }",
          "{ type = \"two-lobe\", g1 = 1, g2 = 0, weight = 0.5 }"}) {
        CAPTURE(phase);
        FluxResult flux;
        const Status status = measured(phase, false, 100, 1, {}, flux);
        CHECK(status.code == Code::kBadInput);
        CHECK(status.message.find("medium.0.phase: a lobe of g = 1 or -1") != std::string::npos);
        CHECK(measured(phase, true, 4096, 1, {}, flux));
    }
    // All light goes straight on, and 1 % of each meeting is absorbed: 2.31 of them.
    FluxResult flux;
    REQUIRE(measured("{ type = \"henyey-greenstein\", g = 1 }", true, 32'768, 1, {}, flux));
    CHECK(std::fabs(flux.transmittance.mean[0] - std::exp(-0.01 * 2 / std::sin(1.0471975512))) <
          4.5 * flux.transmittance.standard_error[0]);
}

}  // namespace flux_peak_test
