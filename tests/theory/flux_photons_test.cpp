// SPDX-License-Identifier: Apache-2.0
// Fluxes by photons against those by paths, against laws, and against themselves cell by cell.
// in: slabs, spheres, skies, grounds, colours -> out: shares within their standard errors.
// docs/flux.md, "By photons", "Absorbed power"
#include <doctest/doctest.h>

#include <cmath>

#include "src/session/flux/flux.h"
#include "tests/support/render_harness.h"

namespace flux_photons_test {

using namespace render_test;
using Keys = std::vector<std::string>;

/// Errors of photons come from 32 batches: 4.5 of them are passed once in 10 000 comparisons by
/// Student's law; seeds are fixed.
constexpr double kErrors = 4.5;
/// Direct light by paths is marched: so much of it may be its steps'.
constexpr double kSteps = 2e-3;

const char* const kScene = R"(
seed = 3
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
)";
const Keys kCamera = {"camera.position_m=[0,-1,1000]", "camera.target_m=[0,0,1000]"};
const Keys kSlab = {"medium.0.density=uniform:box", "medium.0.boundary=periodic",
                    "medium.0.extinction_per_m=0.02"};

Keys with(const Keys& some, const Keys& more) {
    Keys all = some;
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

struct Measured {
    FluxResult flux;
    Image maps;
};
Status try_measure(const std::string& text, const Keys& keys, const FluxSettings& settings,
                   std::int64_t budget, Measured& m) {
    RenderOptions options;
    (settings.method == FluxMethod::kPhotons ? options.budget.photons : options.budget.samples) =
        budget;
    Report report;
    return measure_flux(scene_from(text, with(kCamera, keys)), options, settings, m.flux, m.maps,
                        report);
}
Measured measure(const Keys& keys, const FluxSettings& settings, std::int64_t budget,
                 const std::string& text = kScene) {
    Measured m;
    const Status status = try_measure(text, keys, settings, budget, m);
    REQUIRE_MESSAGE(bool(status), status.message);
    return m;
}
FluxSettings paths(std::array<int, 2> columns = {4, 4}) {
    FluxSettings s;
    s.columns = columns;
    return s;
}
FluxSettings photons(bool absorbed = false, std::array<int, 2> columns = {4, 4}) {
    FluxSettings s = paths(columns);
    s.method = FluxMethod::kPhotons;
    s.absorbed = absorbed;
    return s;
}

void check_agree(const FluxShare& a, const FluxShare& b, double floor = 0) {
    for (std::size_t c = 0; c < 3; ++c) {
        CAPTURE(c);
        const double error = std::sqrt(a.standard_error[c] * a.standard_error[c] +
                                       b.standard_error[c] * b.standard_error[c]);
        CHECK(std::fabs(a.mean[c] - b.mean[c]) <= kErrors * error + floor);
    }
}

void check_near(const FluxShare& a, double value, double floor = 1e-6) {
    for (std::size_t c = 0; c < 3; ++c)
        CHECK(std::fabs(a.mean[c] - value) <= kErrors * a.standard_error[c] + floor);
}

void check_all(const FluxResult& a, const FluxResult& b) {
    const double steps = kSteps * a.transmittance_direct.mean[0];
    check_agree(a.reflectance, b.reflectance);
    check_agree(a.transmittance, b.transmittance, steps);
    check_agree(a.transmittance_direct, b.transmittance_direct, steps);
    check_agree(a.absorptance, b.absorptance, steps);
    CHECK(a.reflectance.standard_error[0] > 0);
    CHECK(a.reflectance.standard_error[0] < 0.02);
}

TEST_CASE("flux by photons: the same as by paths, with sky, ground, colours and several media") {
    const std::string thin = R"(
[[medium]]
density = "uniform:box"
bounds_m = [[0, 0, 100], [200, 100, 150]]
resolution = [8, 4, 4]
extinction_per_m = 0.01
albedo = [1.0, 0.5, 0.2]
phase = { type = "isotropic" }
)";
    const Keys sky = {"sky.radiance=[0.1,0.2,0.3]"};
    const Keys ground = {"ground.altitude_m=50", "ground.albedo=0.5"};
    const Keys colours = {"medium.0.albedo=[1,0.8,0.5]", "sun.irradiance=[1,2,0.5]"};
    struct Case {
        const char* name;
        Keys keys;
        bool several;
    };
    const Case cases[] = {
        {"slab", kSlab, false},
        {"sphere", {}, false},
        {"slab, sky, ground", with(with(kSlab, sky), ground), false},
        {"sphere, sky", sky, false},
        {"sphere, ground", ground, false},
        {"white slab, sky, ground", with(with(with(kSlab, sky), ground), {"medium.0.albedo=1"}),
         false},
        {"coloured sphere", colours, false},
        {"two media, coloured, sky", with(colours, sky), true},
    };
    for (const Case& one : cases) {
        CAPTURE(one.name);
        const std::string text = std::string(kScene) + (one.several ? thin : "");
        const Measured a = measure(one.keys, photons(), 400'000, text);
        const Measured b = measure(one.keys, paths(), 4096, text);
        check_all(a.flux, b.flux);
        CHECK(a.flux.terminated == 0);
        CHECK(a.flux.photons > 390'000);
    }
}

TEST_CASE("flux by photons: over a periodic ground what goes in stays somewhere") {
    const Keys ground = {"ground.altitude_m=20", "ground.albedo=0.4"};
    const Measured m = measure(with(kSlab, ground), photons(), 300'000);
    const FluxResult& f = m.flux;
    for (std::size_t c = 0; c < 3; ++c) {
        const double all =
            f.reflectance.mean[c] + f.absorptance.mean[c] + 0.6 * f.transmittance.mean[c];
        const double error = f.reflectance.standard_error[c] + f.absorptance.standard_error[c] +
                             0.6 * f.transmittance.standard_error[c];
        CHECK(std::fabs(all - 1) < kErrors * error);
    }
}

TEST_CASE("flux by photons: maps are where those by paths are, and have the means of the shares") {
    // A pillar in the north-west corner, from above.
    const Keys corner = {
        "medium.0.density=uniform:box", "medium.0.bounds_m=[[0, 0, 0], [100, 100, 100]]",
        "medium.0.resolution=[8, 8, 8]", "medium.0.extinction_per_m=0.001", "sun.elevation_deg=90"};
    const std::string text = std::string(kScene) + R"(
[[medium]]
density = "uniform:box"
bounds_m = [[0, 75, 0], [25, 100, 100]]
resolution = [4, 4, 16]
extinction_per_m = 0.2
albedo = 0.8
phase = { type = "isotropic" }
)";
    const Measured a = measure(corner, photons(false, {4, 4}), 200'000, text);
    const Measured b = measure(corner, paths({4, 4}), 1024, text);
    for (const char* name : {"R", "transmittance.G", "direct.B"}) {
        CAPTURE(name);
        const Channel &x = *a.maps.find(name), &y = *b.maps.find(name);
        double sum = 0;
        // 200 000 photons on 16 columns: 1 % each; the limits are six times that.
        for (std::size_t p = 0; p < 16; ++p) {
            CHECK(double(x.pixels[p]) == doctest::Approx(double(y.pixels[p])).epsilon(0.06));
            sum += double(x.pixels[p]) / 16;
        }
        const FluxShare& share = name[0] == 'R'   ? a.flux.reflectance
                                 : name[0] == 't' ? a.flux.transmittance
                                                  : a.flux.transmittance_direct;
        CHECK(sum == doctest::Approx(share.mean[1]).epsilon(1e-5));
    }
    CHECK(double(a.maps.find("direct.R")->pixels[0]) < 1e-3);
    CHECK(double(a.maps.find("direct.R")->pixels[3]) > 0.8);
}

TEST_CASE("absorbed power: the law of Beer layer by layer where nothing scatters") {
    const Keys black = with(kSlab, {"medium.0.albedo=0", "sun.irradiance=[1000,500,250]"});
    const Measured m = measure(black, photons(true), 200'000);
    const AbsorbedPower& power = m.flux.absorbed;
    REQUIRE(power.layers.size() == 12);
    CHECK(power.cells == std::array<int, 3>{16, 8, 12});
    CHECK(power.bounds_m[0].z == 100);
    CHECK(power.bounds_m[1].z == 250);
    const double mu = m.flux.mu0, step = 0.02 * 12.5 / mu;
    double sum = 0;
    for (std::size_t z = 0; z < 12; ++z) {
        CAPTURE(z);
        const double above = std::exp(-step * (11 - double(z)));
        const double law = 1000 * mu * above * (1 - std::exp(-step)) / 12.5;
        const FluxShare& layer = power.layers[z];
        CHECK(layer.standard_error[0] > 0);
        CHECK(layer.standard_error[0] < 0.02 * law);
        CHECK(std::fabs(layer.mean[0] - law) < kErrors * layer.standard_error[0]);
        CHECK(layer.mean[1] == doctest::Approx(0.5 * layer.mean[0]).epsilon(1e-9));
        sum += layer.mean[0] * 12.5;
    }
    CHECK(sum == doctest::Approx(m.flux.absorptance.mean[0] * 1000 * mu).epsilon(1e-9));
    // Cells add up to their layers, to float's rounding.
    double cells = 0;
    for (std::size_t i = 0; i < 128; ++i) cells += double(power.mean[0][i]) / 128;
    CHECK(cells == doctest::Approx(power.layers[0].mean[0]).epsilon(1e-5));
    CHECK(power.largest[0] >= power.layers[11].mean[0]);
}

TEST_CASE("absorbed power: coarser cells hold what finer ones do, several media by their share") {
    const std::string dark = std::string(kScene) + R"(
[[medium]]
density = "uniform:box"
bounds_m = [[0, 0, 100], [100, 100, 250]]
resolution = [8, 8, 12]
extinction_per_m = 0.02
albedo = [0.999, 0.5, 1.0]
phase = { type = "isotropic" }
)";
    const Keys white = {"medium.0.albedo=1"};
    FluxSettings fine = photons(true, {1, 1}), coarse = fine;
    coarse.cells = {2, 1, 1};
    const Measured a = measure(white, fine, 200'000, dark),
                   b = measure(white, coarse, 200'000, dark);
    REQUIRE(b.flux.absorbed.mean[1].size() == 2);
    check_agree(a.flux.absorptance, b.flux.absorptance);
    // The absorber fills the western half alone.
    CHECK(double(b.flux.absorbed.mean[1][0]) > 1e-4);
    CHECK(double(b.flux.absorbed.mean[1][1]) < 0.05 * double(b.flux.absorbed.mean[1][0]));
    for (std::size_t i = 0; i < 2; ++i) CHECK(b.flux.absorbed.mean[2][i] == 0);
    // An albedo of 0.999 keeps its digits: as a share of what 0.5 absorbs, to first order.
    const double ratio =
        double(b.flux.absorbed.mean[0][0]) / double(b.flux.absorbed.mean[1][0]) * 500;
    CHECK(ratio > 1);
    CHECK(ratio < 2.5);
    check_agree(a.flux.absorptance, measure(white, paths(), 2048, dark).flux.absorptance, kSteps);
}

TEST_CASE("flux by photons: corners") {
    const Keys corners[] = {
        {"sun.elevation_deg=90"},
        {"sun.elevation_deg=0.001"},
        {"medium.0.resolution=[1,1,1]", "medium.0.density=uniform:box"},
        {"medium.0.extinction_per_m=0"},
        {"medium.0.extinction_per_m=1e9", "medium.0.density=uniform:box"},
    };
    for (const Keys& keys : corners) {
        CAPTURE(keys[0]);
        const Measured m = measure(keys, photons(true, {1, 1}), 20'000);
        for (const FluxShare* s : {&m.flux.reflectance, &m.flux.transmittance, &m.flux.absorptance})
            CHECK(std::isfinite(s->mean[0]));
    }
    const Measured clear = measure({"medium.0.extinction_per_m=0"}, photons(true, {1, 1}), 20'000);
    CHECK(clear.flux.transmittance_direct.mean[0] ==
          doctest::Approx(clear.flux.transmittance.mean[0]));
    check_near(clear.flux.transmittance, 1, 1e-3);
    CHECK(clear.flux.absorptance.mean[0] == 0);
    const Measured white = measure(with(kSlab, {"medium.0.albedo=1"}), photons(true), 100'000);
    CHECK(white.flux.absorptance.mean[0] == 0);
    CHECK(white.flux.absorbed.largest[0] == 0);
    const double both = white.flux.reflectance.mean[0] + white.flux.transmittance.mean[0];
    CHECK(both == doctest::Approx(1).epsilon(1e-9));
}

TEST_CASE("flux from below: twice E3 through what only absorbs, and the same both ways") {
    FluxSettings down = paths(), shoot = photons();
    for (FluxSettings* s : {&down, &shoot}) {
        s->from_below = true;
        s->below_radiance = {2, 1, 0.5};
    }
    // 2 E3(1), Abramowitz and Stegun, table 5.4.
    constexpr double kThrough = 2 * 0.1096919671;
    const Keys black = with(kSlab, {"medium.0.albedo=0", "medium.0.extinction_per_m=0.00666666666",
                                    "sun.elevation_deg=-10"});
    for (const bool by_photons : {false, true}) {
        CAPTURE(by_photons);
        const FluxResult f =
            measure(black, by_photons ? shoot : down, by_photons ? 200'000 : 4096).flux;
        CHECK(double(f.irradiance[0]) == doctest::Approx(2 * 3.14159265));
        check_near(f.transmittance, kThrough);
        check_near(f.transmittance_direct, kThrough);
        check_near(f.reflectance, 0);
        check_near(f.absorptance, 1 - kThrough);
        CHECK(f.transmittance.standard_error[0] > 0);
        CHECK(f.transmittance_direct.standard_error[0] > 0);
        CHECK(f.transmittance.standard_error[0] < 0.01);
    }
    for (const Keys& keys : {kSlab, Keys{}}) {
        const FluxResult a = measure(keys, down, 4096).flux, b = measure(keys, shoot, 400'000).flux;
        check_agree(a.reflectance, b.reflectance);
        check_agree(a.transmittance, b.transmittance);
        check_agree(a.transmittance_direct, b.transmittance_direct);
        check_agree(a.absorptance, b.absorptance);
    }
}

TEST_CASE("flux by photons: neither threads nor instruction sets change a bit") {
    const auto of = [](int threads, const char* isa) {
        RenderOptions options;
        options.budget.photons = 5000;
        options.threads = threads;
        options.isa = isa;
        Measured m;
        Report report;
        const Scene scene = scene_from(
            kScene, with(kCamera, {"sky.radiance=0.1", "ground.altitude_m=0",
                                   "medium.0.albedo=[0.9,0.8,1]", "medium.0.resolution=[4,4,4]"}));
        REQUIRE(measure_flux(scene, options, photons(true), m.flux, m.maps, report));
        return m;
    };
    const Measured one = of(1, "scalar");
    CHECK(one.flux.absorptance.mean[0] > 0);
    for (const Measured& other : {of(2, "scalar"), of(3, "")}) {
        CHECK(other.flux.reflectance.mean == one.flux.reflectance.mean);
        CHECK(other.flux.absorptance.standard_error == one.flux.absorptance.standard_error);
        for (std::size_t i = 0; i < 64; ++i)
            CHECK(other.flux.absorbed.mean[1][i] == one.flux.absorbed.mean[1][i]);
    }
}

TEST_CASE("flux by photons: what cannot be measured is one line") {
    const auto fault = [](const FluxSettings& settings, std::int64_t budget,
                          const Keys& keys = {}) {
        Measured m;
        const Status status = try_measure(kScene, keys, settings, budget, m);
        CHECK(status.code == Code::kBadInput);
        return status.message;
    };
    CHECK(fault(photons(), 10) == "--budget photons: 10, allowed: at least 1024");
    CHECK(fault(photons(false, {5, 4}), 20'000) ==
          "--columns: along x, 5, allowed: what divides the media's 16 cells (with photons)");
    FluxSettings cells = photons(true);
    cells.cells = {16, 8, 24};
    CHECK(fault(cells, 20'000).find("--cells: along z, 24, allowed: what divides") == 0);
    FluxSettings wrong = paths();
    wrong.absorbed = true;
    CHECK(fault(wrong, 16) == "--absorbed: by photons alone, allowed: --method photons");
    FluxSettings below = photons();
    below.from_below = true;
    below.below_radiance = {1, 1, 1};
    CHECK(fault(below, 20'000, {"ground.altitude_m=0"}).find("test.toml: ground: lies between") ==
          0);
    FluxSettings sensors = photons();
    sensors.sensors.emplace_back();
    CHECK(fault(sensors, 20'000) == "--sensors: by paths alone, allowed: --method path");
}

}  // namespace flux_photons_test
