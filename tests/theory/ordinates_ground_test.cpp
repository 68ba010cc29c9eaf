// SPDX-License-Identifier: Apache-2.0
// Light of media on the ground, and of the ground in media, by discrete ordinates.
// in: clouds over a ground, cameras below them -> out: radiance of the ground against closed forms
// and paths. docs/ordinates.md, "Ground"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

/// A cloud 400 m over the ground, which a camera below it looks at straight down.
constexpr const char* kBelow = R"(
seed = 3
[camera]
position_m = [0, 0, 300]
target_m = [0, 0, 0]
up = [0, 1, 0]
fov_deg = 60
resolution = [8, 8]
[sun]
azimuth_deg = 65
elevation_deg = 60
[sky]
radiance = [0.1, 0.1, 0.1]
[ground]
altitude_m = 0
albedo = 0.3
[[medium]]
density = "uniform:ellipsoid"
bounds_m = [[-500, -500, 400], [500, 500, 900]]
resolution = [20, 20, 10]
extinction_per_m = 0.02
phase = { type = "henyey-greenstein", g = 0.7 }
[method]
name = "raymarch"
[path]
target_error = 0
samples_per_pixel = 2048
pixel = "centre"
)";

double mean_of(const Scene& scene, const char* channel = "R") {
    const Picture p = render_one(scene);
    return sum_of(p, channel).value / (p.image.width * p.image.height);
}

double over_path(std::vector<std::string> set, const char* channel = "R") {
    const double ours = mean_of(scene_from(kBelow, set), channel);
    set.push_back("method.name=path");
    return ours / mean_of(scene_from(kBelow, set), channel);
}

}  // namespace

TEST_CASE("a white ground under a white sky stays white below and among white clouds") {
    for (const char* density : {"uniform:ellipsoid", "uniform:box"})
        for (const char* boundary : {"open", "periodic"})
            for (const char* extinction : {"0.0005", "0.01", "0.2"})
                // Below the box, and at its lower face.
                for (const char* altitude : {"0", "400"}) {
                    const std::string high = std::string(altitude) == "0" ? "300" : "2000";
                    const Scene scene = scene_from(
                        kBelow, {std::string("medium.0.density=") + density,
                                 std::string("medium.0.boundary=") + boundary,
                                 std::string("medium.0.extinction_per_m=") + extinction,
                                 std::string("ground.altitude_m=") + altitude,
                                 "camera.position_m=[0,0," + high + "]", "ground.albedo=1",
                                 "sky.radiance=[1,1,1]", "sun.irradiance=[0,0,0]"});
                    CAPTURE(std::string(density));
                    CAPTURE(std::string(boundary));
                    CAPTURE(std::string(extinction));
                    CAPTURE(std::string(altitude));
                    // Where little comes through, white ground and cloud multiply what iterations
                    // leave by as much.
                    const double allowed = std::string(extinction) == "0.2" ? 0.03 : 0.005;
                    const Picture p = render_one(scene);
                    for (int y = 0; y < p.image.height; ++y)
                        for (int x = 0; x < p.image.width; ++x)
                            CHECK(p.at("R", x, y) == doctest::Approx(1).epsilon(allowed));
                }
}

// Paths' noise is up to 2 %; the rest are nodes, and looks of 64 directions.
TEST_CASE("the ground below a cloud is as bright as paths find it") {
    const std::vector<std::string> kinds[] = {
        {},
        {"sun.elevation_deg=90"},
        {"sun.elevation_deg=15"},
        {"ground.albedo=1"},
        {"medium.0.extinction_per_m=0.002"},
        {"medium.0.extinction_per_m=0.2"},
        {"medium.0.density=uniform:box"},
        {"medium.0.density=uniform:box", "medium.0.boundary=periodic"},
        {"medium.0.density=uniform:box", "medium.0.boundary=periodic", "ground.albedo=0.9"},
        {"medium.0.density=uniform:box", "medium.0.boundary=periodic", "sun.elevation_deg=20"},
        {"medium.0.phase={type=\"henyey-greenstein\",g=0.95}"},
        {"medium.0.phase={type=\"cloud\",effective_radius_um=10}"},
        {"ground.altitude_m=250"},
    };
    for (const std::vector<std::string>& kind : kinds) {
        std::string named;
        for (const std::string& key : kind) named += key + " ";
        CAPTURE(named);
        CHECK(over_path(kind) == doctest::Approx(1).epsilon(0.06));
    }
}

TEST_CASE("coloured clouds colour the ground below them") {
    const std::vector<std::string> kind = {"medium.0.albedo=[1,0.9,0.7]",
                                           "medium.0.extinction_per_m=0.01"};
    for (const char* channel : {"R", "G", "B"})
        CHECK(over_path(kind, channel) == doctest::Approx(1).epsilon(0.06));
}

TEST_CASE("a lamp's light on the ground lights the cloud above it") {
    const auto lit = [](std::vector<std::string> set) {
        for (const char* line :
             {"camera.position_m=[420,-60,40]", "camera.target_m=[0,0,650]", "sun.irradiance=0",
              "sky.radiance=0", "ground.albedo=0.8", "path.samples_per_pixel=8192"})
            set.push_back(line);
        return over_path(set, "cloud.R");
    };
    const std::string layers = "output.layers=[\"cloud\"]";
    // A street lamp, one as high as a hill, a spot that shines down and one aslant.
    for (const char* lamp :
         {"light=[{type=\"point\",position_m=[50,20,30],intensity=1e5}]",
          "light=[{type=\"point\",position_m=[-100,60,150],intensity=1e5}]",
          "light=[{type=\"spot\",position_m=[0,100,200],direction=[0,0,-1],cone_deg=60,"
          "penumbra_deg=10,intensity=1e5}]",
          "light=[{type=\"spot\",position_m=[-200,0,100],direction=[2,0,-1],cone_deg=20,"
          "penumbra_deg=10,intensity=1e5}]"}) {
        CAPTURE(std::string(lamp));
        const double ratio = lit({lamp, layers});
        CHECK(ratio > 0.9);
        CHECK(ratio < 1.1);
    }
    // Where fog takes its light on the way nothing comes back in one piece.
    const double fog =
        lit({"light=[{type=\"point\",position_m=[50,20,650],intensity=1e5}]", layers});
    CHECK(fog > 0.85);
    CHECK(fog < 1.15);
}
