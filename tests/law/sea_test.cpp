// SPDX-License-Identifier: Apache-2.0
// A rough sea: facets, what they reflect in all, and pictures of it by both methods.
// in: winds, angles, scenes over water -> out: integrals, radiances. docs/ground.md, "Sea"
#include <array>

#include "kernels_cpu/light/ground.h"
#include "src/base/angles.h"
#include "src/world/light/ground_look.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using namespace render_test;

namespace {

Vec<float> upwards(double cosine) {
    return {float(std::sqrt(1 - cosine * cosine)), 0, float(cosine)};
}

struct Sums {
    double turns = 0, light = 0;
};

/// Over all directions upwards, in even steps of height and azimuth.
Sums all_around(const SeaView& sea, double cosine) {
    constexpr int kHeights = 1500, kTurns = 1500;
    Sums out;
    const Vec<float> from = upwards(cosine);
    const SeaPlace<float> place{0, 0, sea.slope};
    const SeaSight<float> sight = sea_sight(sea, place, from);
    for (int i = 0; i < kHeights; ++i) {
        const double z = (i + 0.5) / kHeights, level = std::sqrt(1 - z * z);
        for (int j = 0; j < kTurns; ++j) {
            const double turn = 2 * 3.14159265358979 * (j + 0.5) / kTurns;
            const Vec<float> to{float(level * std::cos(turn)), float(level * std::sin(turn)),
                                float(z)};
            float density = 0;
            out.light += double(sea_glint(place, sight.seen, from, to, density));
            out.turns += double(density);
        }
    }
    const double step = 2 * 3.14159265358979 / (double(kHeights) * kTurns);
    return {out.turns * step, out.light * step};
}

constexpr const char* kWater = R"(
seed = 3
[camera]
position_m = [0, -100, 60]
target_m = [0, 0, 0]
fov_deg = 40
resolution = [12, 8]
[ground]
altitude_m = 0
surface = "sea"
[path]
samples_per_pixel = 2000
importance = false
[[medium]]
density = "uniform:box"
bounds_m = [[-10, -10, 900], [10, 10, 920]]
resolution = [2, 2, 2]
extinction_per_m = 1e-9
)";

/// Means of R, G and B of a whole picture.
std::array<double, 3> means(const char* method, const std::vector<std::string>& more,
                            const std::string& lamp = {}) {
    std::vector<std::string> set = more;
    set.push_back(std::string("method.name=") + method);
    const Picture p = render_one(scene_from(kWater + lamp, set));
    std::array<double, 3> out{};
    const double pixels = double(p.image.width) * double(p.image.height);
    for (int y = 0; y < p.image.height; ++y)
        for (int x = 0; x < p.image.width; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                out[c] += double(p.at(c == 0 ? "R" : c == 1 ? "G" : "B", x, y)) / pixels;
    return out;
}

/// By marching, whose pixels tell their middles, on 16 times as many of them.
void compare(const std::vector<std::string>& set, double tolerance, const std::string& lamp = {}) {
    const std::array<double, 3> truth = means("path", set, lamp);
    std::vector<std::string> finer = set;
    finer.push_back("camera.resolution=[48, 32]");
    const std::array<double, 3> found = means("raymarch", finer, lamp);
    for (std::size_t c = 0; c < 3; ++c) {
        CAPTURE(c);
        CHECK(found[c] == doctest::Approx(truth[c]).epsilon(tolerance));
    }
}

std::string first_fault(const std::vector<std::string>& set) {
    Scene scene;
    return read_scene_text(kWater, "test.toml", "", set, scene).message;
}

}  // namespace

TEST_CASE("water reflects by Fresnel's equations") {
    // ((n - 1)/(n + 1))^2 straight down, all of it along the surface; at 45 degrees by hand.
    CHECK(water_reflects(1.0f) == doctest::Approx(0.0211118).epsilon(1e-4));
    CHECK(water_reflects(0.0f) == doctest::Approx(1));
    CHECK(water_reflects(0.70710678f) == doctest::Approx(0.0286).epsilon(0.02));
}

TEST_CASE("facets of a sea send on all that they are seen with") {
    for (const double wind : {0.0, 6.0, 20.0}) {
        const SeaView sea = make_sea(wind);
        for (const double cosine : {1.0, 0.7, 0.3, 0.05}) {
            CAPTURE(wind);
            CAPTURE(cosine);
            const Sums sums = all_around(sea, cosine);
            // 1500 steps across lobes of at least 4 degrees; tables of 64 cosines.
            CHECK(sums.turns == doctest::Approx(1).epsilon(0.01));
            CHECK(sums.light ==
                  doctest::Approx(double(sea_reflects(sea, float(cosine)))).epsilon(0.01));
        }
    }
}

TEST_CASE("slopes of a sea are those that Cox and Munk measured") {
    CHECK(2 * std::pow(double(make_sea(0).slope), 2) == doctest::Approx(0.003).epsilon(1e-5));
    CHECK(2 * std::pow(double(make_sea(10).slope), 2) == doctest::Approx(0.0542).epsilon(1e-5));
    // Rough water reflects less along the surface.
    CHECK(make_sea(15).reflects[2] < make_sea(1).reflects[2]);
    CHECK(make_sea(6).reflects[kSeaCosines] == doctest::Approx(0.0213).epsilon(0.02));
}

TEST_CASE("waves that are shown and those that are not have the sea's slopes") {
    GroundSurface surface;
    surface.sea = true;
    GroundLook look;
    look.surface = surface;
    REQUIRE(look.facets.resize(1, "test"));
    look.facets[0] = make_sea(surface.wind_m_s);
    GroundStand stand;
    stand.low_m = {100, 50, 0};
    const GroundPaint paint =
        make_paint(look, 0.02, ground_albedo(look, 0.02, stand, 1), stand, 12);
    const double asked = std::pow(double(look.facets[0].slope), 2);
    // Of a pixel of 500 m none is shown; of a point all are, by 40000 places over some waves.
    for (const float metres : {500.0f, 0.0f, 3.0f}) {
        double sum = 0, fine = 0;
        constexpr int kSide = 200;
        for (int i = 0; i < kSide * kSide; ++i) {
            const Vec<float> at{float(i % kSide) * 7.3f, float(i / kSide) * 6.1f, 0};
            const SeaPlace<float> place = sea_place(look.facets[0], paint.waves, at, metres, 1.0f);
            sum += 0.5 * double(place.x * place.x + place.y * place.y) / (kSide * kSide);
            fine = double(place.slope) * double(place.slope);
        }
        CAPTURE(metres);
        CHECK(sum + fine == doctest::Approx(asked).epsilon(0.05));
        CHECK((metres < 500 || sum == 0));
    }
}

TEST_CASE("a sea that sends all light back is not seen under an even sky") {
    // Facets reflect, and white water sends back the rest.
    const std::vector<std::string> set = {"ground.albedo=1", "ground.colour=1", "sky.radiance=1"};
    CHECK(means("raymarch", set)[1] == doctest::Approx(1).epsilon(1e-5));
    // 2000 samples of 96 pixels, each of a weight between 0 and 1.
    CHECK(means("path", set)[1] == doctest::Approx(1).epsilon(0.003));
}

TEST_CASE("sun and sky on a sea are the same by paths and by marching") {
    struct Case {
        std::string name;
        std::vector<std::string> set;
        std::string lamp = {};
    };
    const Case cases[] = {
        {"sky", {"sky.radiance=[0.1, 0.2, 0.4]"}},
        {"sun before the camera", {"sun.elevation_deg=35", "sun.azimuth_deg=0"}},
        {"sun behind it", {"sun.elevation_deg=20", "sun.azimuth_deg=170"}},
        {"sun overhead, strong wind", {"sun.elevation_deg=90", "ground.sea_wind_m_s=20"}},
        {"sun at the horizon",
         {"sun.elevation_deg=1", "sun.azimuth_deg=0", "ground.sea_wind_m_s=3"}},
        {"seen from straight above",
         {"camera.target_m=[0, -100, 0]", "camera.up=[0, 1, 0]", "sun.elevation_deg=80",
          "sky.radiance=0.1"}},
        {"seen level",
         {"camera.position_m=[0, -100, 2]", "camera.target_m=[0, 0, 1]", "camera.fov_deg=3",
          "sun.elevation_deg=25", "sun.azimuth_deg=5"}},
        {"parallel rays",
         {"camera={position_m=[0,-100,60],target_m=[0,0,0],projection=\"orthographic\",height_m=50,"
          "resolution=[12,8]}",
          "sky.radiance=0.3", "sun.elevation_deg=50", "sun.azimuth_deg=20"}},
        {"a lamp", {}, "[[light]]\ntype = \"point\"\nposition_m = [10, 20, 40]\nintensity = 900\n"},
        {"parallel light", {}, "[[light]]\ntype = \"directional\"\nelevation_deg = 35\n"},
    };
    for (const Case& one : cases) {
        CAPTURE(one.name);
        // Of paths the error is 1 to 2 %; of marching the slopes at which the sky is looked at, and
        // places of waves.
        compare(one.set, 0.05, one.lamp);
    }
}

TEST_CASE("a sea under a cloud mirrors it") {
    // A thick white deck: what is mirrored below is no sky.
    const std::vector<std::string> deck = {"medium.0.bounds_m=[[-900, -900, 200], [900, 900, 400]]",
                                           "medium.0.resolution=[24, 24, 12]",
                                           "medium.0.extinction_per_m=0.04",
                                           "sky.radiance=[0.05, 0.1, 0.3]",
                                           "sun.elevation_deg=60",
                                           "camera.position_m=[0, -300, 40]",
                                           "path.samples_per_pixel=600",
                                           "medium.0.phase={type=\"henyey-greenstein\", g=0.8}"};
    compare(deck, 0.08);
}

TEST_CASE("a sea far below mirrors each cloud in its place") {
    // One cloud over part of what is seen from straight above: it is not mirrored everywhere.
    compare(
        {"camera.position_m=[0, 0, 3000]", "camera.target_m=[0, 0, 0]", "camera.up=[0, 1, 0]",
         "camera.fov_deg=50", "path.samples_per_pixel=600",
         "medium.0.bounds_m=[[-300, -300, 600], [300, 300, 900]]", "medium.0.resolution=[8, 8, 6]",
         "medium.0.extinction_per_m=0.01", "medium.0.phase={type=\"henyey-greenstein\", g=0.8}",
         "sky.radiance=[0.05, 0.1, 0.3]", "sun.elevation_deg=50", "sun.azimuth_deg=90"},
        0.08);
}

TEST_CASE("parts of the light over a sea mirror what these have of the clouds") {
    const auto parts = [](const char* method) {
        Scene scene =
            scene_from(kWater, {std::string("method.name=") + method, "output.layers=[\"light\"]",
                                "medium.0.bounds_m=[[-900, -900, 200], [900, 900, 400]]",
                                "medium.0.resolution=[16, 16, 8]", "medium.0.extinction_per_m=0.04",
                                "medium.0.phase={type=\"henyey-greenstein\", g=0.8}",
                                "sky.radiance=[0.05, 0.1, 0.3]", "sun.elevation_deg=60",
                                "camera.position_m=[0, -300, 40]", "path.samples_per_pixel=600"});
        const Picture p = render_one(scene);
        double sum = 0;
        for (int y = 0; y < p.image.height; ++y)
            for (int x = 0; x < p.image.width; ++x) sum += double(p.at("sun.G", x, y));
        return sum;
    };
    CHECK(parts("raymarch") == doctest::Approx(parts("path")).epsilon(0.12));
}

TEST_CASE("faults of a sea are told in one line") {
    CHECK(
        first_fault({"method.name=collectors"}).find("ground.surface: a sea is shown by methods") !=
        std::string::npos);
    CHECK(first_fault({"ground.sea_wind_m_s=-1"}).find("[0, 30]") != std::string::npos);
    CHECK(first_fault({"ground.surface=lava"}).find("land, sea") != std::string::npos);
    CHECK(
        first_fault({"ground.surface=land", "ground.sea_wind_m_s=3"}).find("ground.sea_wind_m_s") !=
        std::string::npos);
    CHECK(first_fault({"ground.albedo=1"}).find("ground.albedo: more than all light") !=
          std::string::npos);
    CHECK(first_fault({"ground.albedo=0.8", "ground.colour=[2, 1, 1]"}).find("ground.colour") !=
          std::string::npos);
}
