// SPDX-License-Identifier: Apache-2.0
// Under [atmosphere] each place has the sun through the air above itself, and what is seen loses
// the light of the air before it.
// in: media high above a ground, solids, things that glow far away -> out: radiances against closed
// forms, and of all methods against paths. docs/atmosphere.md, "The sun's colour", "Columns"
#include <cmath>

#include "src/base/angles.h"
#include "src/world/atmosphere/air_column.h"
#include "src/world/environment.h"
#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using namespace render_test;

namespace {

/// A thin veil from 9 to 11 km, a camera close above the ground.
const char* const kVeil = R"(
[camera]
position_m = [0, -30, 20]
target_m = [0, 0, 0]
fov_deg = 20
resolution = [8, 8]
[sun]
azimuth_deg = 90
elevation_deg = 12
[atmosphere]
turbidity = 4
sun_disc = false
[ground]
altitude_m = 0
albedo = 0.5
[[medium]]
density = "uniform:box"
bounds_m = [[-4000, -4000, 9000], [4000, 4000, 11000]]
resolution = [4, 4, 4]
extinction_per_m = 1e-9
[collectors]
photons = 2000
generations = 1
[photon_grid]
photons = 2000
generations = 1
[path]
samples_per_pixel = 1024
)";

/// What the air leaves of the sun at a height.
double share_at(const Air& air, double height_km, double elevation_deg, std::size_t c) {
    const AirColumn up =
        column_to_space(kEarthRadiusKm + height_km, std::sin(elevation_deg * kPi64 / 180));
    return std::exp(-(double(air.rayleigh[c]) * up.air + double(air.haze_all[c]) * up.haze +
                      double(air.ozone[c]) * up.ozone));
}

double mean_of(const Picture& p, const char* channel) {
    double sum = 0;
    for (int y = 0; y < p.image.height; ++y)
        for (int x = 0; x < p.image.width; ++x) sum += double(p.at(channel, x, y));
    return sum / (double(p.image.width) * double(p.image.height));
}

}  // namespace

TEST_CASE("sun in air: ground, media and any height have it through the air above them") {
    const Scene scene = scene_from(kVeil);
    World world;
    world.medium.low_m = {-4000, -4000, 9000};
    world.medium.extent_m[0] = world.medium.extent_m[1] = 8000;
    world.medium.extent_m[2] = 2000;
    Environment environment;
    REQUIRE(relight_air(scene.atmosphere, scene, 1, world, environment));
    const Lighting light =
        light_of(scene, {scene.sun.azimuth_deg, scene.sun.elevation_deg}, world, environment);
    const Air air = make_air(4, 0.5);
    const double sine = std::sin(12 * kPi64 / 180);
    for (std::size_t c = 0; c < 3; ++c) {
        const int i = int(c);
        // Floats, and depths that are linear from one row to the next: 2e-4 of them.
        CHECK(light.sun_irradiance[i] == doctest::Approx(share_at(air, 10, 12, c)).epsilon(1e-4));
        CHECK(light.ground.sun[i] ==
              doctest::Approx(0.5 / kPi64 * sine * share_at(air, 0, 12, c)).epsilon(1e-4));
        for (const double height_km : {0.0, 0.333, 1.02, 3.0, 7.77, 10.0, 20.01})
            CHECK(sun_at_height(light, 1000 * height_km - 9000)[i] ==
                  doctest::Approx(share_at(air, height_km, 12, c)).epsilon(1e-3));
    }
    // Under this veil one sun for all would light the ground twice as much in blue.
    CHECK(light.ground.beam[2] > 2 * light.ground.sun[2]);
}

TEST_CASE("sun in air: the ground under high media is that of paths in every method") {
    const Picture paths = render_one(scene_from(kVeil, {"method.name=path"}));
    for (const char* method : {"collectors", "photon-grid", "raymarch", "optical-depth"}) {
        CAPTURE(method);
        const Picture p = render_one(scene_from(kVeil, {std::string("method.name=") + method}));
        // 65 536 paths, of which a half meets the sky alone: 0.3 % of noise.
        for (const char* channel : {"R", "G", "B"})
            CHECK(mean_of(p, channel) / mean_of(paths, channel) ==
                  doctest::Approx(1).epsilon(0.01));
    }
}

TEST_CASE("sun in air: what the ground sends high media is that of paths by photons, too") {
    // Seen from below. A thin layer has the light of the whole ground, a thick one shadows it.
    for (const char* extinction : {"0.0002", "0.004"}) {
        const std::vector<std::string> keys = {
            "camera.position_m=[0,0,7000]",
            "camera.target_m=[0,1,9000]",
            "ground.albedo=0.8",
            "medium.0.bounds_m=[[-4000,-4000,9000],[4000,4000,9500]]",
            "sun.elevation_deg=30",
            "medium.0.boundary=periodic",
            "medium.0.phase={type=\"isotropic\"}",
            std::string("medium.0.extinction_per_m=") + extinction};
        const auto shown = [&](const char* method) {
            std::vector<std::string> all = keys;
            all.push_back(std::string("method.name=") + method);
            all.push_back("collectors.photons=400000");
            return render_one(scene_from(kVeil, all));
        };
        const Picture paths = shown("path"), photons = shown("collectors");
        CAPTURE(extinction);
        // Noise of both is 1 %; the ground of one sun for all is 12 % too bright in the thin one.
        for (const char* channel : {"R", "G", "B"})
            CHECK(mean_of(photons, channel) / mean_of(paths, channel) ==
                  doctest::Approx(1).epsilon(0.03));
    }
}

TEST_CASE("sun in air: a solid has the sun of its own height") {
    // A level plate at 3 km fills the picture. Its own sky is of the media's height in both.
    const test::TempFolder folder;
    folder.put("plate.obj",
               "v -500 -500 3000\nv 500 -500 3000\nv 500 500 3000\nv -500 500 3000\n"
               "f 1 2 3\nf 1 3 4\n");
    Picture pictures[2];
    for (const int i : {0, 1}) {
        Scene scene =
            scene_from(std::string(kVeil) + "[[solid]]\nfile = \"plate.obj\"\nalbedo = 0.5\n",
                       {i == 0 ? "method.name=path" : "method.name=raymarch",
                        "camera.position_m=[0,-10,3020]", "camera.target_m=[0,0,3000]"});
        scene.directory = folder.path("");
        pictures[i] = render_one(scene);
    }
    // The sky on solids is harmonics to the second degree: 2 % in blue. One sun for all would be
    // off by 30 % there.
    for (const char* channel : {"R", "G", "B"})
        CHECK(mean_of(pictures[1], channel) / mean_of(pictures[0], channel) ==
              doctest::Approx(1).epsilon(0.03));
}

TEST_CASE("air before things: light from afar is left by the level column, exactly") {
    // A black wall glows; what it adds to the picture, over what it adds without air, is the
    // transmittance to it.
    struct Row {
        double camera_m, wall_m, away_m;
        const char* turbidity;
    };
    for (const Row row : {Row{20, 20, 8000, "1"}, Row{20, 20, 8000, "10"}, Row{5, 1500, 20000, "4"},
                          Row{20000, 500, 60000, "10"}, Row{12000, 9000, 150000, "4"},
                          Row{2000, 1990, 30000, "7.5"}}) {
        const auto radiance = [&](bool air, bool glows, const char* channel) {
            const std::string y = std::to_string(row.away_m),
                              back = std::to_string(row.away_m + 50);
            std::string text = "[camera]\nposition_m = [0, 0, " + std::to_string(row.camera_m) +
                               "]\ntarget_m = [0, " + y + ", " + std::to_string(row.wall_m) +
                               "]\nfov_deg = 0.01\nresolution = [8, 1]\n"
                               "[[medium]]\ndensity = \"uniform:box\"\nresolution = [2, 2, 2]\n"
                               "extinction_per_m = 4\nalbedo = 0\nbounds_m = [[-5000, " +
                               y + ", " + std::to_string(row.wall_m - 400) + "], [5000, " + back +
                               ", " + std::to_string(row.wall_m + 400) +
                               "]]\n[method]\nname = \"raymarch\"\n";
            if (air)
                text += "[sun]\nelevation_deg = 30\n[atmosphere]\nsun_disc = false\nturbidity = " +
                        std::string(row.turbidity) + "\n";
            return mean_of(render_one(scene_from(
                               text, {glows ? "medium.0.emission=4" : "medium.0.emission=0"})),
                           channel);
        };
        const Air clear = make_air(std::atof(row.turbidity), 0.2);
        const double way = std::hypot(row.away_m, row.wall_m - row.camera_m) / 1000;
        const LevelAir<float> mean =
            level_air(float(row.camera_m / 1000), float(row.wall_m / 1000));
        const char* const names[3] = {"R", "G", "B"};
        for (std::size_t c = 0; c < 3; ++c) {
            const double depth = way * (double(clear.rayleigh[c]) * double(mean.air) +
                                        double(clear.haze_all[c]) * double(mean.haze) +
                                        double(clear.ozone[c]) * double(mean.ozone));
            if (depth > 6) continue;
            const double bare = radiance(false, true, names[c]);
            const double left =
                (radiance(true, true, names[c]) - radiance(true, false, names[c])) / bare;
            CAPTURE(row.camera_m);
            CAPTURE(row.turbidity);
            // Floats, and the wall's half depth of a metre.
            CHECK(left == doctest::Approx(std::exp(-depth)).epsilon(0.003));
        }
    }
}
