// SPDX-License-Identifier: Apache-2.0
// Light from sky maps: against a constant sky, against a sun, and in furnaces.
// in: constant maps, maps of one bright texel -> out: fates, mean paths, pictures.
// docs/methods.md 3 "Sky map". tests/support/trace_harness.h (two-stage rule).
#include "src/io/images/image_file.h"
#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"
#include "tests/support/sky_images.h"
#include "tests/support/trace_harness.h"

using namespace trace_test;
using namespace sky_test;

namespace {

const auto kEven = [](int, int, int) { return 1.0; };

/// A box of three unequal sides, optically thick a few times, absorbing a little.
Rig make_box() {
    Rig rig = make_rig({4, 3, 2}, {40, 30, 20}, 0.1);
    rig.medium.optics[0].phase.g1 = 0.6f;
    set_albedo(rig, {0.95f, 0.95f, 0.95f});
    return rig;
}

void light_by_map(Rig& rig, const SkyMap& map) {
    rig.lighting.map = map.view;
    add_light(rig, map_light(map));
}

struct Fate {
    const char* name;
    std::int64_t (Fates::*bins)[3];
};
const Fate kFates[] = {{"top", &Fates::top},
                       {"bottom", &Fates::bottom},
                       {"sides", &Fates::sides},
                       {"absorbed", &Fates::absorbed},
                       {"direct bottom", &Fates::direct_bottom}};

/// Shares of the same fate under two rigs agree: the difference has both their errors.
void check_equal_fates(const std::string& name, Rig& a, Rig& b, double model) {
    for (const Fate& fate : kFates)
        check_mean(
            name + ": " + fate.name, 0,
            [&](int multiple, std::uint64_t seed) {
                const std::uint64_t n = std::uint64_t(400'000 * multiple);
                const TraceTally ta = shoot(a, n, seed), tb = shoot(b, n, seed + 1);
                const Mean ma = share_mean((ta.light.*fate.bins)[0], ta);
                const Mean mb = share_mean((tb.light.*fate.bins)[0], tb);
                return Mean{ma.value - mb.value,
                            std::sqrt(ma.error * ma.error + mb.error * mb.error)};
            },
            model);
}

/// Saves a map of constant colour beside nothing else and renders a white cumulus under it.
double mean_of_picture(const std::vector<std::string>& overrides, const char* channel,
                       std::int64_t seed, const std::string& map) {
    const char* const text = R"(
[camera]
position_m = [0, -3000, 1400]
target_m = [0, 0, 1150]
fov_deg = 20
resolution = [32, 18]
[[medium]]
density = "procedural:cumulus"
bounds_m = [[-800, -800, 600], [800, 800, 1700]]
resolution = [32, 32, 22]
extinction_per_m = 0.02
phase = { type = "henyey-greenstein", g = 0.5 }
[collectors]
photons = 100_000
generations = 1
bands = 2
samples = 300
)";
    Scene scene = render_test::scene_from(text, overrides);
    scene.seed = seed;
    scene.sky.present = true;
    scene.view_files.sky_map = map;
    const render_test::Picture p = render_test::render_one(scene);
    double sum = 0;
    for (int y = 0; y < p.image.height; ++y)
        for (int x = 0; x < p.image.width; ++x) sum += double(p.at(channel, x, y));
    return sum / (p.image.width * p.image.height);
}

}  // namespace

TEST_CASE("sky map: a constant map is a constant sky") {
    for (int hemisphere : {0, -1}) {
        Rig a = make_box(), b = make_box();
        const SkyMap map =
            sky_map_of(sky_image(16, 8, kEven), hemisphere != 0, a.medium.extent_m, 20);
        light_by_map(a, map);
        add_light(b, diffuse_light(b.medium, hemisphere));
        check_equal_fates(hemisphere == 0 ? "even map" : "even map, upper half", a, b, 0);
    }
}

TEST_CASE("sky map: light from all sides has the mean path 4V/S and 2 tau scatterings") {
    Rig rig = make_box();
    set_albedo(rig, {1, 1, 1});
    const SkyMap map = sky_map_of(sky_image(6, 3, kEven), false, rig.medium.extent_m);
    light_by_map(rig, map);
    check_mean("even map: mean path", mean_chord(rig), [&](int multiple, std::uint64_t seed) {
        return batch_mean(rig, std::uint64_t(200'000 * multiple), seed,
                          [&](const TraceTally& t) { return mean_path(rig, t); });
    });
    Rig slab = make_slab(5, 1, 0.85f);
    const SkyMap above = sky_map_of(sky_image(6, 3, kEven), false, slab.medium.extent_m);
    light_by_map(slab, above);
    check_mean("slab tau 5 under an even map: scatterings", 5 * mean_chord(slab),
               [&](int multiple, std::uint64_t seed) {
                   return batch_mean(slab, std::uint64_t(100'000 * multiple), seed,
                                     [&](const TraceTally& t) {
                                         return double(t.scatterings) / double(t.photons);
                                     });
               });
}

TEST_CASE("sky map: one bright texel is a sun of the same direction and irradiance") {
    constexpr int kColumns = 720, kRows = 360, kRow = 90, kColumn = 450;
    const auto spot = [](int row, int column, int) {
        return row == kRow && column == kColumn ? 1000.0 : 0.0;
    };
    Rig a = make_box(), b = make_box();
    const SkyMap map = sky_map_of(sky_image(kColumns, kRows, spot), true, a.medium.extent_m);
    light_by_map(a, map);
    const double theta = (kRow + 0.5) * kPi64 / kRows;
    const double phi = (kColumn + 0.5) * 2 * kPi64 / kColumns - kPi64;
    const Double3 travel{-std::sin(theta) * std::sin(phi), -std::sin(theta) * std::cos(phi),
                         -std::cos(theta)};
    const Light sun = beam_light(b.medium, travel);
    add_light(b, sun);
    const double texel = kPi64 / kRows;
    const double irradiance = 1000 * texel * texel * std::sin(theta);
    // A texel's tents reach 0.0087 rad to each side: second order in that, below 1e-4 of anything.
    constexpr double kModel = 1e-4;
    CHECK(map.power_m2 == doctest::Approx(irradiance * sun.power_m2).epsilon(kModel));
    CHECK(map.ground_irradiance[0] ==
          doctest::Approx(irradiance * std::cos(theta)).epsilon(kModel));
    check_equal_fates("one texel", a, b, kModel);
}

TEST_CASE("sky map: the ledger of coloured light balances in every channel, shadows included") {
    Rig rig = make_box();
    set_albedo(rig, {0.9f, 0.95f, 1.0f});
    rig.medium.channels = 3;
    rig.lighting.ground.present = true;
    rig.lighting.ground.z = -5;
    rig.lighting.ground.albedo = 0.5;
    const SkyMap map = sky_map_of(rough_sky(12, 7, true), true, rig.medium.extent_m);
    light_by_map(rig, map);
    const TraceTally t = shoot(rig, 200'000, 3);
    for (std::size_t c = 0; c < 3; ++c) {
        CHECK(t.light.emitted[c] > 0);
        CHECK(t.light.emitted[c] < t.photons * kPhotonQuanta);
        CHECK(t.shadow.emitted[c] > 0);
        CHECK(balance(t.light, c) == 0);
        CHECK(balance(t.shadow, c) == 0);
    }
    CHECK(t.light.emitted[0] != t.light.emitted[2]);
}

TEST_CASE("sky map: in a coloured furnace a white cloud shows the sky, with and without a ground") {
    const test::TempFolder folder;
    const double colour[3] = {0.25, 1, 0.5};
    const std::string file = folder.path("even.pfm");
    REQUIRE(write_image(sky_image(8, 4, [&](int, int, int c) { return colour[c]; }), file, {}));
    const char* const names[3] = {"R", "G", "B"};
    for (bool ground : {false, true})
        for (int c = 0; c < 3; ++c) {
            const std::vector<std::string> overrides =
                ground ? std::vector<std::string>{"ground.albedo=1", "ground.altitude_m=300"}
                       : std::vector<std::string>{};
            // Marching and two bands of harmonics are exact here but for a clamp at zero and the
            // furnace's own 1e-3.
            check_mean(
                std::string("furnace under a map") + (ground ? " and over snow, " : ", ") +
                    names[c],
                colour[c],
                [&](int multiple, std::uint64_t seed) {
                    const int pictures = 12 * multiple;
                    Mean m;
                    std::vector<double> values;
                    for (int i = 0; i < pictures; ++i)
                        values.push_back(mean_of_picture(overrides, names[c],
                                                         std::int64_t(seed % 1000000) + i, file));
                    for (double v : values) m.value += v / pictures;
                    for (double v : values) m.error += (v - m.value) * (v - m.value);
                    m.error = std::sqrt(m.error / (double(pictures) * (pictures - 1)));
                    return m;
                },
                1e-3 * colour[c]);
        }
}
