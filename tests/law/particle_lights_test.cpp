// SPDX-License-Identifier: Apache-2.0
// Lights and solids of method particles; the layer of shadows.
// in: one thin ball, lights, plates -> out: radiance and shadows against closed forms.
// docs/particles.md, "Lights"; docs/testing.md, label law
#include <cmath>

#include "tests/io/temp_folder.h"
#include "tests/support/particle_harness.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using namespace render_test;
using namespace particle_test;

namespace {

constexpr double kIsotropic = 0.07957747154594767;

/// A plate of 60 m by 60 m about a place, level or facing east.
std::string plate(double x, double y, double z, bool level) {
    std::string text;
    for (int i = 0; i < 4; ++i) {
        const double u = i % 2 == 0 ? -30 : 30, v = i / 2 == 0 ? -30 : 30;
        char row[96];
        (void)std::snprintf(row, sizeof row, "v %.9g %.9g %.9g\n", level ? x + u : x,
                            level ? y + v : y + u, level ? z : z + v);
        text += row;
    }
    return text + "f 1 2 4\nf 1 4 3\n";
}

/// One thin ball of 2 m at (0, 0, 50), isotropic, without sun; `tables` follow.
Picture show(const std::string& tables, const std::vector<std::string>& overrides,
             const std::string& rows = "0 0 50 2 0.001\n", const RenderOptions& options = {},
             const std::string& mesh = plate(0, 0, 0, true)) {
    const test::TempFolder folder;
    folder.put("p.csv", "x y z radius density\n" + rows);
    folder.put("plate.obj", mesh);
    std::string text = kText;
    const std::size_t sun = text.find("[sun]"), medium = text.find("[[medium]]");
    text.replace(sun, medium - sun, tables);
    const std::string phase = "{ type = \"henyey-greenstein\", g = 0.5 }";
    text.replace(text.find(phase), phase.size(), "{ type = \"isotropic\" }");
    text.replace(text.find("albedo = 0.9"), 12, "albedo = 1");
    text.replace(text.find("fov_deg = 30"), 12, "fov_deg = 0.1");
    text.replace(text.find("resolution = [24, 24]"), 21, "resolution = [3, 3]");
    Scene scene = scene_from(text, overrides);
    scene.directory = folder.path("");
    return render_one(scene, options);
}

/// Radiance of the ball's middle over what it scatters of a unit of irradiance.
double irradiance_of(const Picture& p) {
    return double(p.at("G", 1, 1)) / (kIsotropic * (1 - std::exp(-double(p.at("tau", 1, 1)))));
}

const char* const kPoint =
    "[[light]]\ntype = \"point\"\nposition_m = [60, 0, 50]\nintensity = 3600\n";
const char* const kSpot =
    "[[light]]\ntype = \"spot\"\nposition_m = [0, 0, 110]\ntarget_m = [0, 0, 50]\n"
    "cone_deg = 20\npenumbra_deg = 2\nintensity = 7200\n";
const char* const kMoon =
    "[[light]]\ntype = \"directional\"\nazimuth_deg = 90\nelevation_deg = 0\nirradiance = 0.25\n";
const char* const kSun = "[sun]\nazimuth_deg = 90\nelevation_deg = 0\n";
const char* const kPlate = "[[solid]]\nfile = \"plate.obj\"\n";

const std::vector<std::vector<std::string>> kDisplays = {
    {"particles.display = \"march\""},
    {"particles.display = \"billboards\""},
    {"particles.display = \"march\"", "particles.light = \"centre\""},
    {"particles.display = \"march\"", "particles.light = \"linear\""},
};

}  // namespace

TEST_CASE("particles: a thin ball has a light's irradiance, wherever it comes from") {
    for (const auto& display : kDisplays) {
        // A ball's own shade is below 1e-3, its size against the way 1e-3.
        CHECK(std::fabs(irradiance_of(show(kPoint, display)) - 1) < 0.005);
        CHECK(std::fabs(irradiance_of(show(kSpot, display)) - 2) < 0.01);
        CHECK(std::fabs(irradiance_of(show(kMoon, display)) - 0.25) < 0.002);
        const std::string all = std::string(kPoint) + kSpot + kMoon;
        CHECK(std::fabs(irradiance_of(show(all, display)) - 3.25) < 0.02);
        // Out of the cone: nothing.
        std::string beside = kSpot;
        beside.replace(beside.find("target_m = [0, 0, 50]"), 21, "target_m = [60, 0, 50]");
        CHECK(irradiance_of(show(beside, display)) == 0);
    }
}

TEST_CASE("particles: a light in a ball's centre is the mean over the ball") {
    std::string inside = kPoint;
    inside.replace(inside.find("[60, 0, 50]"), 11, "[0, 0, 50]");
    for (const auto& display : kDisplays)
        // 7 / radius^2 of its intensity.
        CHECK(std::fabs(irradiance_of(show(inside, display)) / (3600 * 7.0 / 4) - 1) < 0.005);
}

TEST_CASE("particles: extinction on the way to a light dims it, shadow_density more so") {
    // A second ball half way, of depth 1 on the line through it.
    const std::string rows = "0 0 50 2 0.001\n30 0 50 5 0.1875\n";
    const double kept = std::exp(-1.0);
    for (const auto& display : kDisplays)
        for (const char* light : {kPoint, kMoon}) {
            const double lit = irradiance_of(show(light, display));
            // Places 0.94 m beside the line: (1 - 0.0356)^(5/2) of that depth, 0.0333 more light.
            CHECK(std::fabs(irradiance_of(show(light, display, rows)) / lit - kept) < 0.035);
            auto darker = display;
            darker.push_back("particles.shadow_density = 2");
            CHECK(std::fabs(irradiance_of(show(light, darker, rows)) / lit - kept * kept) < 0.03);
            darker.back() = "particles.shadow_density = 0";
            CHECK(std::fabs(irradiance_of(show(light, darker, rows)) / lit - 1) < 0.002);
        }
}

TEST_CASE("particles: solids shadow them, but for the share that is kept") {
    const std::string between = plate(30, 0, 50, false), behind = plate(-30, 0, 50, false);
    for (const auto& display : kDisplays)
        for (const char* light : {kPoint, kMoon, kSun}) {
            CAPTURE(light);
            const std::string tables = std::string(light) + kPlate;
            const double lit = irradiance_of(show(light, display));
            auto kept = display;
            kept.push_back("particles.solid_shadow = 0.25");
            CHECK(irradiance_of(show(tables, display, "0 0 50 2 0.001\n", {}, between)) == 0);
            const double half = irradiance_of(show(tables, kept, "0 0 50 2 0.001\n", {}, between));
            CHECK(std::fabs(half / lit - 0.25) < 1e-4);
            const double beyond =
                irradiance_of(show(tables, display, "0 0 50 2 0.001\n", {}, behind));
            CHECK(std::fabs(beyond / lit - 1) < 1e-4);
        }
}

TEST_CASE("particles: lights reach solids past other solids, as by paths") {
    // A wall that faces the camera, beside the ball; in its middle a unit of irradiance.
    const std::string rows = "0 0 90 2 0.001\n";
    const std::string wall = "v -30 20 20\nv 30 20 20\nv -30 20 80\nv 30 20 80\nf 1 2 4\nf 1 4 3\n";
    const std::string grey = "[[solid]]\nfile = \"plate.obj\"\nalbedo = [0.2, 0.5, 0.8]\n";
    const std::string lights[] = {
        "[[light]]\ntype = \"point\"\nposition_m = [0, -40, 50]\nintensity = 3600\n",
        "[[light]]\ntype = \"spot\"\nposition_m = [0, -40, 50]\ntarget_m = [0, 20, 50]\n"
        "cone_deg = 20\npenumbra_deg = 2\nintensity = 3600\n",
        "[[light]]\ntype = \"directional\"\nazimuth_deg = 180\nelevation_deg = 60\nirradiance = "
        "2\n"};
    // Between the wall and the lights, out of the camera's sight.
    const std::string level = "v -30 0 60\nv 30 0 60\nv -30 19 60\nv 30 19 60\nf 5 6 8\nf 5 8 7\n";
    for (const auto& display : kDisplays) {
        for (const std::string& light : lights) {
            CAPTURE(light);
            const Picture lit = show(light + grey, display, rows, {}, wall);
            CHECK(std::fabs(double(lit.at("G", 1, 1)) / (0.5 / 3.141592653589793) - 1) < 0.001);
            CHECK(std::fabs(double(lit.at("B", 1, 1)) / double(lit.at("R", 1, 1)) - 4) < 1e-5);
        }
        const Picture dark = show(lights[2] + grey, display, rows, {}, wall + level);
        CHECK(dark.at("G", 1, 1) == 0);
    }
}

TEST_CASE("particles: lights and solids give the same picture in every width and thread") {
    std::string rows;
    for (std::uint32_t i = 0; i < 200; ++i)
        rows += std::to_string(60 * draw(i, 0) - 30) + " " + std::to_string(60 * draw(i, 1) - 30) +
                " " + std::to_string(20 + 60 * draw(i, 2)) + " " +
                std::to_string(2 + 8 * draw(i, 3)) + " " + std::to_string(0.1 * draw(i, 4)) + "\n";
    const std::string tables =
        std::string(kPoint) + kSpot + kMoon + kSun + "[sky]\nradiance = 0.1\n" + kPlate;
    for (const auto& display : kDisplays) {
        auto own = display;
        own.push_back("camera.fov_deg = 20");
        own.push_back("camera.resolution = [24, 24]");
        own.push_back("particles.scattering = \"octaves\"");
        std::string hash;
        for (int t = 0; const KernelTable* table = kernel_table_at(t); ++t) {
            RenderOptions options;
            options.isa = table->name;
            options.threads = 1 + t;
            const std::string found =
                show(tables, own, rows, options, plate(30, 0, 40, false)).report.hash;
            if (t == 0) hash = found;
            CHECK(found == hash);
        }
    }
}

TEST_CASE("particles: without a sun, every light and display is finite") {
    for (const char* light : {"centre", "linear", "exact"})
        for (const char* tables : {"[sky]\nradiance = 0.1\n", kPoint}) {
            const Picture p = show(tables, {"particles.light = \"" + std::string(light) + "\""});
            CHECK(p.at("G", 1, 1) > 0);
            CHECK(p.at("G", 1, 1) < 1);
        }
}

TEST_CASE("shadow layer: what media and solids keep from the ground, in every method") {
    const std::string scene_text = R"(
[camera]
position_m = [0, -300, 200]
target_m = [0, 0, 0]
fov_deg = 60
resolution = [61, 61]
[sun]
elevation_deg = 90
[ground]
altitude_m = 0
albedo = 0
[[medium]]
density = "uniform:box"
bounds_m = [[-20, -20, 50], [20, 20, 90]]
resolution = [8, 8, 8]
extinction_per_m = 0.02
phase = { type = "isotropic" }
[collectors]
photons = 1000
[photon_grid]
photons = 1000
[path]
samples_per_pixel = 1
[output]
layers = ["radiance", "alpha", "shadow"]
)";
    const test::TempFolder folder;
    folder.put("plate.obj", plate(60, 0, 20, true));
    for (const char* method : {"raymarch", "collectors", "photon-grid", "optical-depth", "path"})
        for (const bool solid : {false, true}) {
            CAPTURE(method);
            Scene scene = scene_from(scene_text + (solid ? kPlate : ""),
                                     {"method.name = \"" + std::string(method) + "\""});
            scene.directory = folder.path("");
            const Picture p = render_one(scene);
            // The middle pixel sees the origin, below the box.
            CHECK(std::fabs(double(p.at("shadow", 30, 30)) - (1 - std::exp(-0.8))) < 1e-4);
            // The sky, and the ground far to the left.
            CHECK(p.at("shadow", 30, 0) == 0);
            CHECK(p.at("shadow", 2, 40) == 0);
            std::size_t dark = 0;
            for (const float v : p.image.find("shadow")->pixels.span()) {
                CHECK(v >= 0);
                CHECK(v <= 1);
                dark += v == 1 ? 1 : 0;
            }
            // Ground below the plate that is seen.
            CHECK((dark > 9) == solid);
        }
}
