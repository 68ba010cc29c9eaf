// SPDX-License-Identifier: Apache-2.0
// Two media with one lobe each are one medium with two lobes: photons and pictures.
// in: slabs and small scenes, written both ways -> out: differences of means, two-stage.
// docs/methods.md 2, "Several media": phases mix by their share of the extinction.
#include "tests/support/media_harness.h"
#include "tests/support/render_harness.h"

using namespace trace_test;

namespace {

constexpr float kG1 = 0.85f, kG2 = -0.4f;

Rig make_two(double tau, double share, float albedo) {
    Rig rig = make_slab(tau, albedo, kG1);
    split(rig, optics_of({albedo, albedo, albedo}, {kPhaseHg, kG2, 0, 1}),
          [&](std::size_t) { return share; });
    add_light(rig, beam_light(rig.medium, {0.6, 0, -0.8}));
    return rig;
}

Rig make_one(double tau, double share, float albedo) {
    Rig rig = make_slab(tau, albedo, 0);
    rig.medium.optics[0].phase = {kPhaseTwoLobe, kG1, kG2, float(1 - share)};
    add_light(rig, beam_light(rig.medium, {0.6, 0, -0.8}));
    return rig;
}

Mean difference(const Mean& a, const Mean& b) {
    return {a.value - b.value, std::sqrt(a.error * a.error + b.error * b.error)};
}

double scatterings(const TraceTally& t) { return double(t.scatterings) / double(t.photons); }

const char* const kText = R"(
seed = 5
camera = { position_m = [0, -300, 40], target_m = [0, 0, 0], fov_deg = 32, resolution = [24, 24] }
sun = { azimuth_deg = 60, elevation_deg = 40, irradiance = [1, 1, 1] }
sky = { radiance = [0.1, 0.1, 0.1] }
collectors = { generations = 1, samples = 500 }
[[medium]]
density = "uniform:sphere"
resolution = [16, 16, 16]
bounds_m = [[-50, -50, -50], [50, 50, 50]]
albedo = 0.95
)";

std::string text_of(bool two) {
    const std::string text = kText;
    if (!two)
        return text +
               "extinction_per_m = 0.04\n"
               "phase = { type = \"two-lobe\", g1 = 0.8, g2 = -0.3, weight = 0.75 }\n";
    const std::string again = text.substr(text.find("[[medium]]"));
    return text + "extinction_per_m = 0.03\nphase = { type = \"henyey-greenstein\", g = 0.8 }\n" +
           again + "extinction_per_m = 0.01\nphase = { type = \"henyey-greenstein\", g = -0.3 }\n";
}

/// Mean of a quarter of the picture over eight seeds.
Mean quarter_mean(bool two, const std::vector<std::string>& keys, int quarter, int multiple,
                  std::uint64_t seed) {
    constexpr int kSeeds = 8;
    std::vector<double> values;
    for (int s = 0; s < kSeeds; ++s) {
        std::vector<std::string> all = keys;
        const std::uint64_t own = seed % 1'000'000 * 64 + std::uint64_t(s) + (two ? 32u : 0u);
        all.push_back("seed=" + std::to_string(own));
        all.push_back("collectors.photons=" + std::to_string(20'000 * multiple));
        const render_test::Picture p =
            render_test::render_one(render_test::scene_from(text_of(two), all));
        double sum = 0;
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 12; ++x)
                sum += double(p.at("G", x + quarter % 2 * 12, y + quarter / 2 * 12));
        values.push_back(sum / 144);
    }
    Mean m;
    for (double v : values) m.value += v / kSeeds;
    for (double v : values) m.error += (v - m.value) * (v - m.value);
    m.error = std::sqrt(m.error / (kSeeds * (kSeeds - 1.0)));
    return m;
}

}  // namespace

TEST_CASE("media: slabs of two lobes, as one medium and as two") {
    for (double tau : {0.5, 4.0})
        for (double share : {0.2, 0.7})
            for (float albedo : {1.0f, 0.9f}) {
                Rig two = make_two(tau, share, albedo), one = make_one(tau, share, albedo);
                char name[80];
                std::snprintf(name, sizeof name, "tau %g share %g albedo %g", tau, share,
                              double(albedo));
                const auto row = [&](const char* end, auto fate) {
                    check_mean(name + std::string(end), 0, [&](int n, std::uint64_t seed) {
                        const std::uint64_t photons = 400'000 * std::uint64_t(n);
                        const TraceTally a = shoot(two, photons, seed);
                        const TraceTally b = shoot(one, photons, seed + 77);
                        return difference(share_mean(fate(a), a), share_mean(fate(b), b));
                    });
                };
                row(": top", [](const TraceTally& t) { return t.light.top[0]; });
                row(": bottom", [](const TraceTally& t) { return t.light.bottom[0]; });
                check_mean(name + std::string(": scatterings"), 0, [&](int n, std::uint64_t seed) {
                    const std::uint64_t photons = 400'000 * std::uint64_t(n);
                    return difference(batch_mean(two, photons, seed, scatterings),
                                      batch_mean(one, photons, seed + 77, scatterings));
                });
            }
}

TEST_CASE("media: pictures of two lobes, as one medium and as two") {
    const std::vector<std::string> ways[] = {
        {"collectors.display=march"},
        {"collectors.display=billboards"},
        {"collectors.display=billboards", "collectors.closure=lobe"},
        {"collectors.variant=paper", "collectors.display=billboards"},
        {"collectors.closure=camera"},
        {"collectors.first_order_split=false", "collectors.window=true"},
    };
    for (const auto& keys : ways)
        for (int quarter : {0, 3}) {
            const std::string name = keys[0] + (keys.size() > 1 ? " " + keys[1] : "") +
                                     " quarter " + std::to_string(quarter);
            const Mean m = check_mean(name, 0, [&](int n, std::uint64_t seed) {
                return difference(quarter_mean(true, keys, quarter, n, seed),
                                  quarter_mean(false, keys, quarter, n, seed));
            });
            CHECK(m.error < 0.004);  // the quarters show about 0.1
        }
}

TEST_CASE("media: thin ones beside and in one another scatter once, each by its own law") {
    // Radiance = irradiance x sum of albedo p(theta) tau, but for the optical depth itself.
    const char* const text = R"(
seed = 5
camera = { position_m = [0, -300, 0], target_m = [0, 0, 0], projection = "orthographic", height_m = 100, resolution = [20, 20] }
sun = { azimuth_deg = 0, elevation_deg = 0, irradiance = [1, 1, 1] }
collectors = { photons = 20_000, generations = 1, samples = 500 }
[[medium]]
density = "uniform:box"
bounds_m = [[-50, -20, -50], [0, 30, 50]]
resolution = [10, 10, 20]
extinction_per_m = 2e-5
albedo = [1, 0.5, 0.25]
phase = { type = "henyey-greenstein", g = 0.3 }
[[medium]]
density = "uniform:box"
bounds_m = [[-30, -20, -50], [50, 30, 50]]
extinction_per_m = 1e-5
albedo = 0.8
phase = { type = "rayleigh" }
)";
    // The sun stands behind the medium: what the camera sees was not turned.
    const double hg = (1 + 0.3) / (4 * 3.14159265358979 * 0.7 * 0.7);
    const double rayleigh = 6.0 / (16 * 3.14159265358979);
    for (const char* display : {"display=march", "closure=camera"}) {
        const render_test::Picture p = render_test::render_one(
            render_test::scene_from(text, {std::string("collectors.") + display}));
        const double first[3] = {1e-3 * hg, 0.5e-3 * hg, 0.25e-3 * hg};
        const double second = 0.8 * 0.5e-3 * rayleigh;
        const char* const names[3] = {"R", "G", "B"};
        for (int c = 0; c < 3; ++c)
            for (int y : {3, 10, 16}) {
                CAPTURE(c);
                // The second scattering adds, and the depth takes, about a thousandth; the photons
                // that bring it are few.
                const auto near = [](double v) { return doctest::Approx(v).epsilon(5e-3); };
                CHECK(double(p.at(names[c], 1, y)) == near(first[c]));
                CHECK(double(p.at(names[c], 7, y)) == near(first[c] + second));
                CHECK(double(p.at(names[c], 15, y)) == near(second));
            }
    }
}
