// SPDX-License-Identifier: Apache-2.0
// Lamps that are spheres: penumbras in closed form, and all methods against paths.
// in: spheres behind edges, beside and in a box and a cloud -> out: pictures, their difference.
// docs/lights.md, "Spheres". Bounds: 4 standard errors of the paths, and what is said beside.
#include <cmath>

#include "tests/io/temp_folder.h"
#include "tests/support/particle_harness.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using namespace render_test;
using namespace particle_test;

namespace {

constexpr double kPiD = 3.14159265358979323846;

/// Share of a disc beyond a straight edge at `x` radii from its middle.
double beyond(double x) {
    if (x >= 1) return 0;
    if (x <= -1) return 1;
    return (std::acos(x) - x * std::sqrt(1 - x * x)) / kPiD;
}

std::string row(const char* format, double x, double y, double z) {
    char text[160];
    (void)std::snprintf(text, sizeof text, format, x, y, z);
    return text;
}

/// A plate of 60 m by 60 m about a place, level or facing east.
std::string plate(double x, double y, double z, bool level) {
    std::string text;
    for (int i = 0; i < 4; ++i) {
        const double u = i % 2 == 0 ? -30 : 30, v = i / 2 == 0 ? -30 : 30;
        text += level ? row("v %.9g %.9g %.9g\n", x + u, y + v, z)
                      : row("v %.9g %.9g %.9g\n", x, y + u, z + v);
    }
    return text + "f 1 2 4\nf 1 4 3\n";
}

Picture with_plate(Scene scene, const std::string& mesh) {
    const test::TempFolder folder;
    folder.put("p.csv", "x y z radius density\n0 0 50 0.5 0.001\n");
    folder.put("plate.obj", mesh);
    scene.directory = folder.path("");
    return render_one(scene);
}

TEST_CASE("a sphere's penumbra behind an edge, by paths on the ground") {
    // 100 m over the ground; the plate covers x < 0 at half the height.
    const std::string text = R"(
[ground]
altitude_m = 0
albedo = 0.5
[[medium]]
density = "uniform:box"
bounds_m = [[500, 500, 500], [510, 510, 510]]
resolution = [2, 2, 2]
extinction_per_m = 0.001
[[solid]]
file = "plate.obj"
[[light]]
type = "point"
position_m = [0, 0, 100]
intensity = 10000
radius_m = 8
[method]
name = "path"
[path]
samples_per_pixel = 4000
[output]
layers = ["radiance", "alpha", "error"]
)";
    for (const double x : {-10.0, -5.0, 0.0, 3.0, 10.0}) {
        const std::string camera =
            row("[camera]\nposition_m = [%.9g, -20, 20]\nfov_deg = 0.01\nresolution = [2, 2]\n", x,
                0, 0) +
            row("target_m = [%.9g, 0, 0]\n", x, 0, 0);
        const Picture p = with_plate(scene_from(camera + text), plate(-30, 0, 50, true));
        const double far = 100 * 100 + x * x;
        const double whole = 0.5 / kPiD * 10000 * 100 / (far * std::sqrt(far));
        double mean = 0;
        for (int i = 0; i < 4; ++i) mean += 0.25 * double(p.at("G", i % 2, i / 2)) / whole;
        CAPTURE(x);
        // Half a percent for noise, two for the cone's slant.
        CHECK(std::fabs(mean - beyond(-x / 8)) < 0.025);
    }
}

TEST_CASE("a sphere's penumbra behind an edge, on particles") {
    for (const char* display : {"march", "billboards"})
        for (const double edge : {-4.0, -1.5, 0.0, 1.0, 4.0}) {
            std::string text = kText;
            const std::size_t sun = text.find("[sun]"), medium = text.find("[[medium]]");
            text.replace(sun, medium - sun,
                         "[[light]]\ntype = \"point\"\nposition_m = [60, 0, 50]\nintensity = 3600\n"
                         "radius_m = 6\nshadow_samples = 64\n[[solid]]\nfile = \"plate.obj\"\n");
            text.replace(text.find("fov_deg = 30"), 12, "fov_deg = 0.01");
            text.replace(text.find("resolution = [24, 24]"), 21, "resolution = [3, 3]");
            const std::string show = std::string("particles.display = \"") + display + "\"";
            // The plate half way reaches up to `edge` above the line from ball to sphere.
            const auto light = [&](double z) {
                return double(
                    with_plate(scene_from(text, {show}), plate(30, 0, z, false)).at("G", 1, 1));
            };
            const double seen = light(50 + edge - 30) / light(-500);
            CAPTURE(edge);
            // Of 64 places, and a ball of half a metre.
            CHECK(std::fabs(seen - beyond(2 * edge / 6)) < 0.04);
        }
}

constexpr const char* kView = R"(
[camera]
position_m = [0, -300, 60]
target_m = [0, 0, 50]
fov_deg = 24
resolution = [10, 8]
[path]
samples_per_pixel = 4000
pixel = "centre"
[collectors]
photons = 400000
[photon_grid]
photons = 400000
[output]
layers = ["radiance", "alpha", "error"]
)";

constexpr const char* kCloud = R"(
[[medium]]
density = "procedural:cumulus"
bounds_m = [[-60, -60, 0], [60, 60, 100]]
resolution = [24, 24, 20]
extinction_per_m = 0.05
phase = { type = "henyey-greenstein", g = 0.6 }
)";

constexpr const char* kBox = R"(
[[medium]]
density = "uniform:box"
bounds_m = [[-50, -50, 0], [50, 50, 100]]
resolution = [20, 20, 20]
extinction_per_m = 0.02
albedo = [0.9, 0.8, 1.0]
phase = { type = "henyey-greenstein", g = 0.4 }
)";

struct Sphere {
    const char* name;
    const char* table;
};
const Sphere kSpheres[] = {
    {"inside",
     "[[light]]\ntype = \"point\"\nposition_m = [12, -8, 45]\nintensity = [900, 600, 300]\n"
     "radius_m = 12\n"},
    {"small inside",
     "[[light]]\ntype = \"point\"\nposition_m = [12, -8, 45]\nintensity = [900, 600, 300]\n"
     "radius_m = 2\n"},
    {"beside",
     "[[light]]\ntype = \"point\"\nposition_m = [-120, -60, 90]\nintensity = 40000\n"
     "radius_m = 40\n"},
    {"spot",
     "[[light]]\ntype = \"spot\"\nposition_m = [-140, -40, 30]\ntarget_m = [0, 0, 60]\n"
     "cone_deg = 30\npenumbra_deg = 8\nintensity = 40000\nradius_m = 20\n"},
};

Picture by(const std::string& method, const std::string& text) {
    Scene scene = scene_from("[method]\nname = \"" + method + "\"\n" + text);
    if (scene.method != "path") scene.output.layer_error = false;
    return render_one(scene);
}

TEST_CASE("marched spheres are paths of one scattering, photons bring the rest") {
    const std::string ground = "[ground]\naltitude_m = -20\nalbedo = 0.5\n";
    for (const char* medium : {kBox, kCloud})
        for (const Sphere& sphere : kSpheres) {
            const std::string text = std::string(kView) + "[raymarch]\nscattering = \"single\"\n" +
                                     medium + sphere.table;
            std::string once = text;
            once.replace(once.find("[path]\n"), 7, "[path]\nmax_depth = 1\n");
            const Picture single = by("path", once), all = by("path", text + ground);
            for (const char* method : {"raymarch", "collectors", "photon-grid"}) {
                const bool march = std::string(method) == "raymarch";
                const Picture own = march ? by(method, text) : by(method, text + ground);
                const Picture& path = march ? single : all;
                for (const char* channel : {"R", "B"}) {
                    const PixelSum a = sum_of(path, channel), b = sum_of(own, channel);
                    MESSAGE(std::string(sphere.name)
                            << " " << std::string(method) << " path " << a.value << " +- "
                            << a.error << " own " << b.value << " " << b.value / a.value - 1);
                    CHECK(std::fabs(a.value - b.value) < 4 * a.error + 0.02 * a.value);
                }
            }
        }
}

}  // namespace
