// SPDX-License-Identifier: Apache-2.0
// Data of rays run to their ends: optical depth, transmittance, alpha and depth know nothing of
// where colours end.
// in: boxes and balls of known depth by every method -> out: closed forms, equal colours.
// docs/formats.md, "Pictures out"
#include <cmath>

#include "tests/io/temp_folder.h"
#include "tests/support/particle_harness.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using namespace render_test;

namespace {

using Texts = std::vector<std::string>;

const char* const kBox = R"(
[camera]
position_m = [0, -3000, 0]
target_m = [0, 0, 0]
fov_deg = 0.01
resolution = [3, 3]
[sun]
elevation_deg = 30
[sky]
radiance = 1
[[medium]]
density = "uniform:box"
bounds_m = [[-500, -500, -500], [500, 500, 500]]
extinction_per_m = 0.05
albedo = 0.5
phase = { type = "henyey-greenstein", g = 0.5 }
[collectors]
photons = 2000
generations = 1
samples = 100
[photon_grid]
photons = 2000
generations = 1
[path]
samples_per_pixel = 1
)";
constexpr double kDepth = 50, kFront = 2500;

const Texts kMethods[] = {
    {"method.name=raymarch", "raymarch.steps=300"},
    {"method.name=raymarch", "raymarch.steps=301", "raymarch.integrator=simpson"},
    {"method.name=raymarch", "raymarch.spacing=voxel", "raymarch.jitter=hash"},
    {"method.name=raymarch", "raymarch.steps=300", "raymarch.scale=2"},
    {"method.name=optical-depth"},
    {"method.name=optical-depth", "optical_depth.steps=200"},
    {"method.name=photon-grid"},
    {"method.name=collectors", "collectors.display=march"},
    {"method.name=path"},
};
const char* const kCells[] = {"medium.0.resolution=[1,1,1]", "medium.0.resolution=[40,40,40]"};

Picture box(Texts method, const std::string& cells, const Texts& more) {
    method.push_back(cells);
    method.insert(method.end(), more.begin(), more.end());
    return render_one(scene_from(kBox, method));
}

}  // namespace

TEST_CASE("whole rays: optical depth and transmittance run to the end in every method") {
    for (const Texts& method : kMethods)
        for (const char* cells : kCells) {
            CAPTURE(method[0]);
            CAPTURE(method.size() > 1 ? method[1] : "");
            const Picture p =
                box(method, cells, {"output.layers=[\"optical_depth\",\"transmittance\"]"});
            // Cells at the box's faces are half as dense where density is linear between cells.
            const double tau = double(p.at("tau", 1, 1));
            CHECK(tau == doctest::Approx(kDepth).epsilon(0.01));
            CHECK(double(p.at("T", 1, 1)) == doctest::Approx(std::exp(-tau)).epsilon(1e-3));
            CHECK(double(p.at("A", 1, 1)) == doctest::Approx(1).epsilon(1e-4));
            // Either alone tells the same.
            const Picture t = box(method, cells, {"output.layers=[\"transmittance\"]"});
            CHECK(t.at("T", 1, 1) == p.at("T", 1, 1));
            const Picture d = box(method, cells, {"output.layers=[\"optical_depth\"]"});
            CHECK(d.at("tau", 1, 1) == p.at("tau", 1, 1));
        }
}

TEST_CASE("whole rays: colours are the same with and without data") {
    for (const Texts& method : kMethods) {
        CAPTURE(method[0]);
        const Picture with = box(method, kCells[1],
                                 {"output.layers=[\"optical_depth\",\"transmittance\",\"depth\"]"}),
                      without = box(method, kCells[1], {});
        for (const char* c : {"R", "G", "B"})
            for (int i = 0; i < 9; ++i)
                CHECK(with.at(c, i % 3, i / 3) == without.at(c, i % 3, i / 3));
    }
}

TEST_CASE("whole rays: a march that ends early keeps alpha and depth right") {
    for (const char* name : {"raymarch", "optical_depth"}) {
        Texts method{std::string("method.name=") +
                         (std::string(name) == "raymarch" ? name : "optical-depth"),
                     std::string(name) + ".steps=2000"};
        const Picture whole = box(method, kCells[0], {"output.layers=[\"depth\"]"});
        const double half = kFront + std::log(2.0) / 0.05;
        CHECK(double(whole.at("Z", 1, 1)) == doctest::Approx(half).epsilon(1e-4));
        for (const char* stop : {"0.003", "0.6", "1"}) {
            CAPTURE(stop);
            method.resize(2);
            method.push_back(std::string(name) + ".stop_below=" + stop);
            const Picture p = box(method, kCells[0], {"output.layers=[\"depth\"]"});
            CHECK(p.at("Z", 1, 1) == whole.at("Z", 1, 1));
            CHECK(double(p.at("A", 1, 1)) == doctest::Approx(1).epsilon(1e-6));
            // Colours do end there.
            CHECK(p.at("R", 1, 1) != whole.at("R", 1, 1));
        }
    }
}

TEST_CASE("whole rays: balls of particles are seen through to the end") {
    const test::TempFolder folder;
    // 16/15 of density times radius along the ray through the middle.
    folder.put("p.csv", "x y z radius density\n0 0 50 60 0.5\n");
    const double tau = 16.0 / 15 * 0.5 * 60;
    for (const char* display : {"march", "billboards"}) {
        CAPTURE(display);
        const auto show = [&](const Texts& more) {
            Texts all{"camera.resolution=[3,3]", "camera.fov_deg=0.01",
                      std::string("particles.display=\"") + display + '"'};
            all.insert(all.end(), more.begin(), more.end());
            Scene scene = scene_from(particle_test::kText, all);
            scene.directory = folder.path("");
            return render_one(scene);
        };
        const Picture p = show({"output.layers=[\"optical_depth\",\"transmittance\",\"depth\"]"});
        CHECK(double(p.at("tau", 1, 1)) == doctest::Approx(tau).epsilon(1e-4));
        CHECK(double(p.at("T", 1, 1)) == doctest::Approx(std::exp(-tau)).epsilon(3e-3));
        const Picture early = show({"output.layers=[\"depth\"]", "particles.stop_below=0.7"});
        CHECK(early.at("Z", 1, 1) == p.at("Z", 1, 1));
        CHECK(double(early.at("A", 1, 1)) == doctest::Approx(1).epsilon(1e-6));
    }
}
