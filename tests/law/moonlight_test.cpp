// SPDX-License-Identifier: Apache-2.0
// The moon as a light and in the picture: every method takes the same beams, skies add up, nothing
// jumps where the sun sets, and the disc has its phase.
// in: small scenes, suns and moons -> out: pictures, lights, sums.
// docs/atmosphere.md, "Night"
#include "src/picture/sun_disc.h"
#include "src/world/camera/view.h"
#include "src/world/environment.h"
#include "src/world/place_scene.h"
#include "tests/support/air_scene.h"

using namespace render_test;
using air_test::in_air;

namespace {

/// A cumulus 12 km off to the north, a moon behind the camera, the sun deep below.
std::string at_night() {
    std::string text = in_air();
    const auto put = [&](const std::string& from, const std::string& to) {
        text.replace(text.find(from), from.size(), to);
    };
    put("[sun]\nazimuth_deg = 120\nelevation_deg = 35\n", "");
    put("turbidity = 4",
        "turbidity = 4\ndate = 2026-09-23\ntime = 22:00:00\nlatitude_deg = 28\n"
        "longitude_deg = -16\nsun_disc = false\nmoon = true\n");
    return text;
}

std::string digits(double v) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", v);
    return text;
}

/// The same scene under a sun in the moon's place, as bright and of its colour.
std::string by_sun(const Scene& placed) {
    const Night& night = placed.night;
    std::string text = in_air(), irradiance;
    for (int c = 0; c < 3; ++c)
        irradiance += (c > 0 ? ", " : "") +
                      digits(double(float(double(placed.sun.irradiance[std::size_t(c)]) *
                                          night.moon_light[c])));
    const std::string from = "azimuth_deg = 120\nelevation_deg = 35";
    text.replace(text.find(from), from.size(),
                 "azimuth_deg = " + digits(night.moon_azimuth_deg) + "\nelevation_deg = " +
                     digits(night.moon_elevation_deg) + "\nirradiance = [" + irradiance + "]");
    const std::string air = "turbidity = 4";
    text.replace(text.find(air), air.size(), air + "\nsun_disc = false");
    return text;
}

/// Light of a sun at a height, with a full moon at another.
struct Lit {
    World world;
    Environment environment;
    Scene scene;
    Lighting light;

    Lit(double sun_deg, double moon_deg, bool ground, bool airglow = false) {
        scene = scene_from(in_air());
        scene.ground.present = ground;
        scene.atmosphere.airglow = airglow;
        scene.sun.azimuth_deg = 280;
        Night& night = scene.night;
        night.moon = true;
        night.moon_azimuth_deg = 100;
        night.moon_elevation_deg = moon_deg;
        night.moon_radius_deg = 0.26;
        night.moon_light = {2.7e-6, 2.5e-6, 2.1e-6};
        world.medium.low_m = {-4000, -4000, 500};
        world.medium.extent_m[0] = world.medium.extent_m[1] = 8000;
        world.medium.extent_m[2] = 1000;
        to(sun_deg);
    }
    void to(double sun_deg) {
        scene.sun.elevation_deg = sun_deg;
        REQUIRE(relight_air(scene.atmosphere, scene, 1, world, environment));
        light = light_of(scene, place_of(scene.sun), world, environment);
    }
    bool moonlit() const { return environment.air.moonlit; }
    double sky(std::size_t texel) const {
        return double(
            environment.sky_map.radiance[texel + environment.sky_map.radiance.size() / 3]);
    }
};

}  // namespace

TEST_CASE("moonlight: every method takes the moon for the sun") {
    Scene placed = scene_from(at_night());
    REQUIRE(place_scene(placed, nullptr));
    REQUIRE(placed.night.moon);
    // Below where anything of its sky is left.
    REQUIRE(placed.sun.elevation_deg < -35);
    const std::string sunny = by_sun(placed);
    for (const char* method : {"collectors", "raymarch", "optical-depth", "photon-grid", "path"}) {
        CAPTURE(method);
        const std::vector<std::string> keys = {std::string("method.name=") + method,
                                               "path.samples_per_pixel=16"};
        const Picture moon = render_one(scene_from(at_night(), keys));
        const Picture sun = render_one(scene_from(sunny, keys));
        const std::vector<float> a = pixels_of(moon), b = pixels_of(sun);
        // A digit of a float apart in a few pixels of a thousand.
        double most = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            most = std::max(most, std::abs(double(a[i]) - double(b[i])) / (double(b[i]) + 1e-30));
        CHECK(most < 1e-6);
        CHECK(sum_of(moon, "R").value > 0);
    }
}

TEST_CASE("moonlight: particles, too") {
    Scene placed = scene_from(at_night());
    REQUIRE(place_scene(placed, nullptr));
    const auto of_particles = [](std::string text) {
        const std::size_t begin = text.find("density ="), end = text.find("[photon_grid]");
        text.replace(begin, end - begin,
                     "density = \"assets/scenes/golden/data/puff.csv\"\nalbedo = 1.0\n");
        return text;
    };
    const std::vector<std::string> keys = {
        "method.name=particles", "output.layers=[\"radiance\", \"alpha\"]",
        "camera.position_m=[0, -1500, 700]", "camera.target_m=[0, 0, 800]"};
    const Picture moon = render_one(scene_from(of_particles(at_night()), keys)),
                  sun = render_one(scene_from(of_particles(by_sun(placed)), keys));
    CHECK(sum_of(moon, "A").value > 5);
    for (const char* channel : {"R", "G", "B"}) {
        CHECK(sum_of(moon, channel).value > 0);
        CHECK(sum_of(moon, channel).value ==
              doctest::Approx(sum_of(sun, channel).value).epsilon(1e-6));
    }
}

TEST_CASE("moonlight: pictures are as bright as the sun's irradiance, in every method") {
    // A power of two changes no digit: nothing dim is dropped on the way.
    for (const char* method : {"collectors", "raymarch", "optical-depth", "photon-grid", "path"}) {
        CAPTURE(method);
        std::vector<std::string> keys = {std::string("method.name=") + method,
                                         "path.samples_per_pixel=16", "atmosphere.airglow=true"};
        const Picture dim = render_one(scene_from(at_night(), keys));
        keys.push_back("sun.irradiance=1048576");
        const Picture bright = render_one(scene_from(at_night(), keys));
        for (const char* channel : {"R", "G", "B"})
            CHECK(sum_of(bright, channel).value ==
                  doctest::Approx(1048576 * sum_of(dim, channel).value).epsilon(1e-5));
    }
}

TEST_CASE("moonlight: the beams are those of which more reach the media") {
    CHECK_FALSE(Lit(10, 40, true).moonlit());
    CHECK_FALSE(Lit(0.01, 40, true).moonlit());
    // Over a level ground the sun has none at 0 and below.
    CHECK(Lit(0, 40, true).moonlit());
    CHECK(Lit(-0.5, 40, true).moonlit());
    // Without one a kilometre up still has some, until haze leaves less of them.
    CHECK_FALSE(Lit(0, 40, false).moonlit());
    CHECK(Lit(-1.4, 40, false).moonlit());
    CHECK(Lit(-90, 90, false).moonlit());
    // Neither is up.
    CHECK_FALSE(Lit(-30, -30, true).moonlit());
    const Lit lit(-18, 40, true);
    CHECK(lit.light.sunlit);
    CHECK(double(lit.light.to_sun[2]) == doctest::Approx(sincos_deg(40).sine).epsilon(1e-6));
    CHECK(lit.light.sun_irradiance[1] > 1e-6);
    CHECK(lit.light.sun_irradiance[1] < 2.5e-6);
    CHECK(lit.light.ground.sun[1] > 0);
    CHECK_FALSE(Lit(-18, -1, true).light.sunlit);
}

TEST_CASE("moonlight: the sky of both is the sum of both") {
    // Eight degrees below, where the sun's twilight is as bright as the moon's sky.
    const Lit both(-8, 40, true), moon(-60, 40, true), sun(-8, -60, true);
    CHECK(both.environment.air.two_skies);
    CHECK_FALSE(moon.environment.air.two_skies);
    CHECK_FALSE(sun.environment.air.two_skies);
    int compared = 0;
    for (std::size_t texel = 0; texel < 64 * 256; texel += 97) {
        CHECK(both.sky(texel) == doctest::Approx(moon.sky(texel) + sun.sky(texel)).epsilon(2e-3));
        ++compared;
    }
    CHECK(compared > 100);
}

TEST_CASE("moonlight: nothing jumps while the sun sets") {
    for (const bool ground : {false, true}) {
        double before[4] = {};
        bool was_moonlit = false;
        int switched = 0;
        Lit lit(1, 40, ground, true);
        for (int tenth = 10; tenth >= -150; --tenth) {
            lit.to(0.1 * tenth);
            const double shine =
                lit.light.ground.radiance()[1] + (ground ? 0 : lit.light.sun_irradiance[1]);
            // All light of a kilometre up without a ground, the ground's with one; straight up,
            // towards the sun, towards the moon.
            const double now[4] = {shine + lit.environment.sky_map.ground_irradiance[1],
                                   lit.sky(128), lit.sky(62 * 256 + 128 + 200 - 256),
                                   lit.sky(62 * 256 + 128 + 71)};
            CAPTURE(ground);
            CAPTURE(tenth);
            for (int i = 0; i < 4 && tenth < 10; ++i) {
                CAPTURE(i);
                // Twilight falls tenfold in 2 degrees where it falls quickest, 11 % in a tenth of
                // one, and by tables of which a line is 0.7 degrees wide; the last of the sun's
                // disc goes quicker, a tenth of a degree is a fifth of it.
                const bool disc = !ground && i == 0 && tenth > -15;
                CHECK(now[i] > (disc ? 0.5 : 0.8) * before[i]);
                CHECK(now[i] < 1.05 * before[i]);
            }
            if (tenth < 10 && lit.moonlit() != was_moonlit) ++switched;
            was_moonlit = lit.moonlit();
            for (int i = 0; i < 4; ++i) before[i] = now[i];
        }
        // It did change hands in between.
        CHECK(switched == 1);
        CHECK(was_moonlit);
    }
}

TEST_CASE("moonlight: suns and moons at the ends of their ranges") {
    for (const double moon_deg : {90.0, 0.0, -90.0}) {
        Lit lit(0, moon_deg, false);
        Lit without(0, moon_deg, false);
        without.scene.night = Night{};
        for (const double sun_deg : {0.0, -18.0, -90.0, 90.0}) {
            CAPTURE(moon_deg);
            CAPTURE(sun_deg);
            lit.scene.night.moon_light = {2.7e-6, 2.5e-6, 2.1e-6};
            lit.to(sun_deg);
            for (const float v : lit.environment.sky_map.radiance.span()) REQUIRE(v >= 0);
            CHECK(lit.moonlit() == (moon_deg >= 0 && sun_deg < 0));
            // A new moon is none, to the bit.
            lit.scene.night.moon_light = {};
            lit.to(sun_deg);
            without.to(sun_deg);
            CHECK_FALSE(lit.moonlit());
            CHECK_FALSE(lit.environment.air.two_skies);
            CHECK(lit.environment.sky_map.radiance.size() ==
                  without.environment.sky_map.radiance.size());
            bool same = true;
            for (std::size_t i = 0; i < lit.environment.sky_map.radiance.size(); ++i)
                same = same && lit.environment.sky_map.radiance[i] ==
                                   without.environment.sky_map.radiance[i];
            CHECK(same);
            CHECK(lit.light.sun_irradiance == without.light.sun_irradiance);
        }
    }
}

TEST_CASE("moonlight: the second sky is worked out at dusk alone") {
    Lit lit(0, 40, true);
    double first = 90, last = 90;
    for (int tenth = 100; tenth >= -400; tenth -= 2) {
        lit.to(0.1 * tenth);
        if (!lit.environment.air.two_skies) continue;
        if (first == 90) first = 0.1 * tenth;
        last = 0.1 * tenth;
    }
    // A full moon's sky is a millionth of a sun's by day; from where it has the beams on the sun's
    // is the other; twilight ends at 18 degrees.
    CHECK(std::abs(first) < 0.01);
    CHECK(last < -15);
    CHECK(last > -22);
}

TEST_CASE("moonlight: airglow is the sky of a moonless night, brighter towards the horizon") {
    const Lit dark(-90, -90, true, true), black(-90, -90, true, false);
    // 205 stars of magnitude 10 per square degree, of magnitudes below a sun of -26.74, less half
    // of what air of an optical depth of 0.4 takes.
    const double up = dark.sky(0), low = dark.sky(58 * 256);
    const double stars = 205 * std::pow(10, -0.4 * (10 + 26.74)) * 3282.8;
    CHECK(up > 0.7 * stars);
    CHECK(up < stars);
    CHECK(low > 1.2 * up);
    CHECK(low < 5 * up);
    // What the tables leave of a sun that deep is less than a twentieth.
    CHECK(black.sky(0) < 0.05 * up);
    CHECK(dark.environment.sky_map.ground_irradiance[1] > 3 * up);
}

TEST_CASE("moonlight: a date's moon in a picture adds up to its irradiance, whatever its phase") {
    for (const double phase : {0.0, 60.0, 90.0, 120.0, 170.0})
        for (const int height : {3, 90, 720}) {
            CAPTURE(phase);
            CAPTURE(height);
            Camera c;
            c.position_m = {0, 0, 0}, c.target_m = {0, 1000, 0};
            c.fov_deg = height < 10 ? 60 : 2, c.resolution = {height, height};
            const CameraParams camera = make_camera(c, 0, {});
            std::vector<float> behind(3 * std::size_t(height * height), 0.0f);
            SunDisc moon;
            moon.to_sun[0] = moon.to_sun[2] = 0, moon.to_sun[1] = 1;
            moon.radius_deg = 0.2591;
            moon.irradiance = {2, 2, 2};
            // Lit from the right: its west, seen to the north, is to the left.
            const SineCosine at = sincos_deg(phase);
            moon.lit_from = {at.sine, -at.cosine, 0};
            add_sun_disc(camera, moon, {}, {}, behind.data());
            double sum = 0, left = 0, right = 0;
            for (int i = 0; i < height * height; ++i) {
                sum += double(behind[std::size_t(i)]);
                (i % height < height / 2 ? left : right) += double(behind[std::size_t(i)]);
            }
            const double step = 2 * double(camera.half_width) / height;
            // Thin crescents have few parts of a pixel.
            CHECK(sum * step * step == doctest::Approx(2).epsilon(phase > 150 ? 0.1 : 0.03));
            if (height < 10) continue;
            // Of a phase the left half has what is left of the terminator: cos(phase) of a half.
            const double lit = 0.5 * (1 + at.cosine);
            const double share = std::max(at.cosine, 0.0) / 2 / lit;
            CHECK(left / sum == doctest::Approx(share).epsilon(0.03).scale(0.03));
        }
}
