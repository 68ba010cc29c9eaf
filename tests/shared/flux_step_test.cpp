// SPDX-License-Identifier: Apache-2.0
// pileus flux on the step cloud of I3RC phase I: domain means and columns against the consensus.
// in: PILEUS_DATA_DIR/reference, data/i3rc/step -> out: R, T, A by photons and by paths.
// Cahalan et al. 2005, BAMS 86, 1275; docs/flux.md, "Checks"; docs/validation.md.
#include <cmath>
#include <cstdio>

#include "src/session/flux/flux.h"
#include "tests/io/temp_folder.h"
#include "tests/shared/published.h"
#include "tests/support/long_tests.h"
#include "tests/support/render_harness.h"

namespace flux_step_test {

using namespace render_test;

constexpr std::size_t kColumns = 32;
constexpr double kErrors = 4.5;  // once in 10 000 comparisons by Student's law; seeds are fixed
// How exact the consensus is: docs/validation.md, "The step cloud of I3RC".
constexpr double kGate = 0.003, kColumnGate = 0.015;

/// Each column of one voxel in 64: the step is smeared over 0.24 m.
std::string step_file(const test::TempFolder& folder) {
    std::string bytes;
    for (std::size_t x = 0; x < kColumns * 64; ++x) {
        const float density = x < kColumns * 32 ? 1.0f / 9.0f : 1.0f;
        bytes.append(reinterpret_cast<const char*>(&density), 4);
    }
    return folder.put("step.raw", bytes);
}

Scene step_scene(const test::TempFolder& folder, double zenith_deg, double albedo) {
    char text[800];
    std::snprintf(text, sizeof text, R"(
[camera]
position_m = [0, -1, 0]
target_m = [0, 0, 0]
[sun]
azimuth_deg = 270
elevation_deg = %g
[[medium]]
density = { file = "%s", type = "float32", size = [2048, 1, 1] }
bounds_m = [[0, 0, 0], [500, 500, 250]]
boundary = "periodic"
extinction_per_m = 0.072
albedo = %g
phase = { type = "henyey-greenstein", g = 0.85 }
)",
                  90 - zenith_deg, step_file(folder).c_str(), albedo);
    return scene_from(text);
}

std::vector<double> consensus(const std::string& root, int experiment, const char* quantity) {
    const std::string name = root + "/data/i3rc/step/I3RC_cons_res_case1_exp" +
                             std::to_string(experiment) + '_' + quantity + ".txt";
    std::ifstream file(name);
    std::vector<double> values;
    for (double v; file >> v;) values.push_back(v);
    REQUIRE_MESSAGE(values.size() == kColumns, name);
    return values;
}

struct Seen {
    const char* quantity;
    const FluxShare* share;
    std::vector<double> columns;
};

void check_step(const std::string& root, int experiment, const char* how, const Seen& seen) {
    const std::vector<double> published = consensus(root, experiment, seen.quantity);
    double mean = 0, square = 0;
    for (std::size_t i = 0; i < kColumns; ++i) mean += published[i] / double(kColumns);
    const double value = seen.share->mean[0], error = seen.share->standard_error[0];
    std::printf("step cloud exp%d %s by %s: %.6f +- %.6f, consensus %.6f\n", experiment,
                seen.quantity, how, value, error, mean);
    CAPTURE(experiment);
    CAPTURE(seen.quantity);
    CHECK(std::fabs(value - mean) <= kErrors * error + kGate * mean);
    for (std::size_t i = 0; i < seen.columns.size(); ++i) {
        const double off = seen.columns[i] / published[i] - 1;
        square += off * off / double(kColumns);
    }
    if (!seen.columns.empty()) {
        std::printf("  columns: rms %.2g\n", std::sqrt(square));
        CHECK(std::sqrt(square) <= kColumnGate);
    }
}

std::vector<double> columns_of(const Image& maps, const char* name) {
    std::vector<double> values;
    for (float v : maps.find(name)->pixels.span()) values.push_back(double(v));
    return values;
}

TEST_CASE("flux: the step cloud of I3RC by photons and by paths") {
    const std::string root = published::data_folder();
    if (root.empty()) return;
    const test::TempFolder folder;
    const struct {
        int number;
        double zenith_deg, albedo;
        bool transmitted;
    } experiments[] = {{1, 0, 1, true}, {2, 60, 1, false}, {4, 60, 0.99, true}};
    for (const auto& e : experiments) {
        const Scene scene = step_scene(folder, e.zenith_deg, e.albedo);
        FluxSettings settings;
        settings.columns = {int(kColumns), 1};
        RenderOptions options;
        FluxResult shot, traced;
        Image maps;
        Report report;
        options.budget.samples = long_tests() ? 65'536 : 2048;
        REQUIRE(measure_flux(scene, options, settings, traced, maps, report));
        check_step(root, e.number, "paths", {"R", &traced.reflectance, {}});
        if (e.transmitted) check_step(root, e.number, "paths", {"T", &traced.transmittance, {}});
        settings.method = FluxMethod::kPhotons;
        settings.absorbed = true;
        settings.cells = {int(kColumns), 1, 1};
        options.budget.samples = -1;
        options.budget.photons = long_tests() ? 40'000'000 : 2'000'000;
        Report other;
        REQUIRE(measure_flux(scene, options, settings, shot, maps, other));
        check_step(root, e.number, "photons", {"R", &shot.reflectance, columns_of(maps, "R")});
        if (e.transmitted)
            check_step(root, e.number, "photons",
                       {"T", &shot.transmittance, columns_of(maps, "transmittance.R")});
        if (e.albedo == 1) continue;
        std::vector<double> kept;
        const double level = shot.mu0 * double(shot.irradiance[0]);
        for (float v : shot.absorbed.mean[0].span()) kept.push_back(double(v) * 250 / level);
        check_step(root, e.number, "paths", {"A", &traced.absorptance, {}});
        check_step(root, e.number, "photons", {"A", &shot.absorptance, kept});
    }
}

}  // namespace flux_step_test
