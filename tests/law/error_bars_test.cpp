// SPDX-License-Identifier: Apache-2.0
// Standard errors are right: intervals of 95 % hold the long-run mean in 95 % of pixels.
// in: small clouds under many seeds -> out: shares of intervals that cover.
// docs/validation.md, "Error bars"
#include "tests/support/coverage.h"
#include "tests/support/path_harness.h"
#include "tests/support/render_harness.h"
#include "tests/support/validation_rows.h"

using namespace pileus;

namespace {

const char* const kScene = R"(
camera = { position_m = [0, -2500, 520], target_m = [0, 0, 1000], fov_deg = 36, resolution = [24, 18] }
sun = { azimuth_deg = 65, elevation_deg = 38 }
sky = { radiance = [0.03, 0.05, 0.09] }
ground = { altitude_m = 0, albedo = 0 }
animation = { frames = 100000 }
[[medium]]
density = "procedural:cumulus"
resolution = [32, 32, 22]
bounds_m = [[-800, -800, 600], [800, 800, 1700]]
extinction_per_m = 0.05
phase = { type = "henyey-greenstein", g = 0.85 }
[collectors]
photons = 96000
generations = 16
samples = 2000
[output]
layers = ["error"]
)";
constexpr int kBatches = 16;
/// Of the layer: pixels around add to the 15 differences of a pixel's own batches.
constexpr int kFreedom = 60;

/// Green of the cloud's pixels and its error; 0 where there is no cloud.
coverage::Sample sample_of(const render_test::Picture& p) {
    const Channel &g = *p.image.find("G"), &e = *p.image.find("error.G"), &a = *p.image.find("A");
    coverage::Sample s;
    for (std::size_t i = 0; i < g.pixels.size(); ++i) {
        s.mean.push_back(double(g.pixels[i]));
        s.error.push_back(a.pixels[i] > 0.02f ? double(e.pixels[i]) : 0.0);
    }
    return s;
}

/// Pictures of one seed's collectors under other photons (frames that share none), or of as many
/// seeds, whose collectors stand elsewhere, too.
coverage::Result of_collectors(const std::vector<std::string>& set, bool other_places, int count) {
    std::vector<coverage::Sample> samples;
    for (int k = 0; k < count; ++k) {
        RenderOptions options;
        options.first_frame = options.last_frame = other_places ? 0 : kBatches * k;
        std::vector<std::string> all = set;
        all.push_back("seed=" + std::to_string(other_places ? k + 1 : 1));
        samples.push_back(
            sample_of(render_test::render_one(render_test::scene_from(kScene, all), options)));
    }
    return coverage::judge(samples, kFreedom);
}

/// A lumpy cloud under sun and sky, over a ground.
trace_test::Rig make_cloud() {
    trace_test::Rig rig = trace_test::make_rig({9, 7, 8}, {2, 2, 2}, 5);
    std::uint32_t state = 12345;
    for (float& v : rig.medium.volume.density.span()) {
        state = state * 1664525u + 1013904223u;
        v = float(state >> 24) / 255;
        v = v * v;
    }
    trace_test::set_albedo(rig, {0.99f, 0.99f, 0.99f});
    rig.medium.optics[0].phase.g1 = 0.85f;
    trace_test::set_majorants(rig, 2);
    path_test::shine(rig, {0.6f, 0, 0.8f});
    path_test::set_sky(rig, 0.1);
    path_test::set_ground(rig, -1, 0.2);
    return rig;
}

/// Films of one view under many seeds; `sunlit`: by sun and sky, else by the sky alone.
coverage::Result of_path(bool sunlit, int edge, std::uint64_t per_pixel, int count) {
    trace_test::Rig rig = make_cloud();
    rig.lighting.sunlit = sunlit;
    const CameraParams view = path_test::make_flat_view({1, -5, 1}, {0, 1, 0}, 1.9f, edge, edge);
    std::vector<coverage::Sample> samples;
    for (int k = 0; k < count; ++k) {
        const Film film = path_test::trace_film(
            path_test::path_input(rig, view, std::uint64_t(k) + 1), per_pixel);
        coverage::Sample s;
        for (std::size_t p = 0; p < film.pixels(); ++p) {
            s.mean.push_back(film_mean(film, 0, 0, p));
            s.error.push_back(film_error(film, 0, p));
        }
        samples.push_back(s);
    }
    return coverage::judge(samples, int(per_pixel) - 1);
}

/// Independent pixels of the collectors' picture, which share photons: 44 or more were measured.
constexpr double kIndependent = 40;

/// A row; where `promised`, 95 % is right to 1 %; with few pictures, beside 4.5 standard errors of
/// the share itself, from no more than `independent` pixels.
void add_row(validation::Section& section, const std::string& what, int count, bool promised,
             double independent, const coverage::Result& r) {
    const double noise = std::sqrt(0.95 * 0.05 / (independent * count));
    std::printf(
        "%s: %d seeds, %zu pixels (%.0f independent), %.2f %% covered, +-%.2f; reported "
        "over true error %.4f\n",
        what.c_str(), count, r.pixels, r.effective, 100 * r.covered, 100 * noise, r.ratio);
    section.line(validation::text_of("| %s | %d | %zu | %.1f | %.1f | %.3f |", what.c_str(), count,
                                     r.pixels, 100 * r.covered, 100 * noise, r.ratio));
    if (promised)
        CHECK_MESSAGE(std::fabs(r.covered - 0.95) <= (long_tests() ? 0.01 : 0.01 + 4.5 * noise),
                      what);
}

const char* const kHead =
    "| error bars of | pictures | pixels | covered, % | standard error, % | said / true error |\n"
    "|---|---|---|---|---|---|";

}  // namespace

TEST_CASE("validation: error bars") {
    validation::Section section("error-bars", kHead);
    const int count = long_tests() ? 256 : 6;
    add_row(section, "`path`, sky alone, 256 samples", count, true, 144,
            of_path(false, 12, 256, count));
    if (long_tests()) {
        for (int n : {64, 1024, 16384})
            add_row(section, validation::text_of("`path`, sun and sky, %d samples", n), count,
                    false, 16, of_path(true, 4, std::uint64_t(n), count));
        add_row(section, "`path`, sun and sky, 65536 samples", count, true, 16,
                of_path(true, 4, 65536, count));
    }
    for (const char* display : {"march", "billboards"}) {
        const std::string key = std::string("collectors.display=") + display;
        const std::string what = std::string("`collectors`, ") + display;
        add_row(section, what, count, true, kIndependent, of_collectors({key}, false, count));
        if (!long_tests()) continue;
        add_row(section, what + ", other seeds", count, false, kIndependent,
                of_collectors({key}, true, count));
        add_row(section, what + ", ground of albedo 0.2", count, false, kIndependent,
                of_collectors({key, "ground.albedo=0.2"}, false, count));
    }
}
