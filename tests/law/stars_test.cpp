// SPDX-License-Identifier: Apache-2.0
// Stars: where they stand, how many, how bright, and as pixels show them.
// in: dates, places, cameras -> out: directions, sums of light.
// Hoffleit 1991 (counts, places); Meeus 1998, chapter 21; docs/atmosphere.md, "Night"
#include "src/world/atmosphere/stars.h"

#include "src/picture/night/night_view.h"
#include "src/world/atmosphere/star_catalogue.h"
#include "src/world/camera/view.h"
#include "tests/support/air_scene.h"

using namespace render_test;

namespace {

AtmosphereSettings on(const char* date, const char* time, double latitude, double longitude) {
    AtmosphereSettings s;
    s.present = s.stars = true;
    s.refraction = false;
    s.date = date, s.time = time;
    s.latitude_deg = latitude, s.longitude_deg = longitude;
    return s;
}

struct Turned {
    Stars stars;
    explicit Turned(const AtmosphereSettings& s) {
        Night night;
        place_night(s, 0, night);
        REQUIRE(night.stars);
        REQUIRE(turn_stars(night, stars));
    }
    const Star& of(const std::string& name) const {
        const Span<const CatalogueStar> all = bright_stars();
        for (std::size_t i = 0; i < all.size; ++i)
            if (name == all.data[i].name) return stars.stars[i];
        FAIL("no such star");
        return stars.stars[0];
    }
};

double elevation_deg(const Star& star) { return std::asin(double(star.to[2])) * 57.29577951308232; }

double apart_deg(const float (&a)[3], const float (&b)[3]) {
    double square = 0;
    for (int i = 0; i < 3; ++i) square += std::pow(double(a[i]) - double(b[i]), 2);
    return 2 * std::asin(std::sqrt(square) / 2) * 57.29577951308232;
}

double luminance(const float (&light)[3]) {
    return 0.2126 * double(light[0]) + 0.7152 * double(light[1]) + 0.0722 * double(light[2]);
}

/// Light of the night's sky in a picture, over the solid angle of its pixels.
double seen(int height, double fov_deg, Double3 target, bool points) {
    AtmosphereSettings s = on("2026-01-15", "00:00", 28, -16);
    s.stars = points;
    s.airglow = !points;
    Sun sun;
    sun.elevation_deg = -60;
    Night night;
    place_night(s, 0, night);
    Atmosphere air;
    Image map;
    REQUIRE(light_atmosphere(s, sun, Ground{}, 0, 2, air, map, night));
    REQUIRE(look_from(0, 2, air));
    Camera c;
    c.position_m = {0, 0, 0}, c.target_m = target;
    c.fov_deg = fov_deg, c.resolution = {height, height};
    const CameraParams camera = make_camera(c, 0, {});
    std::vector<float> behind(3 * std::size_t(height * height), 0.0f);
    show_night(2, air, {camera, {}, {}, behind.data()});
    double sum = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < height; ++x) {
            const double px = (2 * (x + 0.5) / height - 1) * double(camera.half_width);
            const double py = (1 - 2 * (y + 0.5) / height) * double(camera.half_height);
            const double cosine = 1 / std::sqrt(1 + px * px + py * py);
            sum += double(behind[std::size_t(height * height + y * height + x)]) * cosine * cosine *
                   cosine;
        }
    return sum * std::pow(2 * double(camera.half_height) / height, 2);
}

}  // namespace

TEST_CASE("stars: Polaris goes around the pole, and comes nearer in two centuries") {
    // Half a turn apart its heights differ by twice its distance from the pole: 1 degree 13 in
    // 1900, 44 minutes in 2000, 27 in 2100 (Meeus 1998, of the apparent place: 0.01 degrees for
    // aberration and nutation, 0.02 for the table's place).
    struct Row {
        const char* date;
        double off_deg;
    };
    for (const Row& row :
         {Row{"1900-01-01", 1.23}, Row{"2000-01-01", 0.735}, Row{"2100-01-01", 0.46}}) {
        CAPTURE(row.date);
        double low = 90, high = -90;
        for (int hour = 0; hour < 24; ++hour) {
            const std::string time = (hour < 10 ? "0" : "") + std::to_string(hour) + ":00";
            const Turned t(on(row.date, time.c_str(), 40, 10));
            const double height = elevation_deg(t.of("Polaris"));
            low = std::fmin(low, height), high = std::fmax(high, height);
        }
        CHECK(std::abs((high + low) / 2 - 40) < 0.02);
        CHECK(std::abs((high - low) / 2 - row.off_deg) < 0.03);
        CAPTURE(high - low);
    }
}

TEST_CASE("stars: figures, distances, heights at their meridian") {
    const Turned t(on("2026-01-15", "00:00", 28, -16));
    // Orion's belt, the pointers: from catalogues' places, 0.02 degrees each.
    CHECK(std::abs(apart_deg(t.of("Alnitak").to, t.of("Mintaka").to) - 2.74) < 0.03);
    CHECK(std::abs(apart_deg(t.of("Dubhe").to, t.of("Merak").to) - 5.37) < 0.03);
    CHECK(std::abs(apart_deg(t.of("Polaris").to, t.of("Dubhe").to) - 28.7) < 0.1);
    CHECK(std::abs(apart_deg(t.of("Castor").to, t.of("Pollux").to) - 4.51) < 0.03);
    CHECK(std::abs(apart_deg(t.of("Betelgeuse").to, t.of("Rigel").to) - 18.6) < 0.1);
    // At a pole a star's height is its declination of the date: Sirius in 2026 at -16.75.
    CHECK(std::abs(elevation_deg(Turned(on("2026-01-15", "00:00", -90, 0)).of("Sirius")) - 16.75) <
          0.02);
    // Sirius culminates at midnight of January 1, a little after: 28 north, 16 west is 64 minutes
    // late.
    const Turned late(on("2026-01-01", "01:06", 28, -16));
    const Star& sirius = late.of("Sirius");
    CHECK(std::abs(double(sirius.to[0])) < 0.03);
    CHECK(sirius.to[1] < 0);
    CHECK(std::abs(elevation_deg(sirius) - (90 - 28 - 16.75)) < 0.05);
    // The galaxy's middle is where Sagittarius is: low over the spout, 4 degrees off Gamma, 11
    // off Kaus Australis.
    const Double3& middle = t.stars.galaxy[0];
    const float to[3] = {float(middle.x), float(middle.y), float(middle.z)};
    CHECK(std::abs(apart_deg(to, t.of("Kaus Australis").to) - 10.1) < 1);
}

TEST_CASE("stars: counts and light by magnitude, and the Milky Way's side has more") {
    const Turned t(on("2026-01-15", "00:00", 28, -16));
    REQUIRE(t.stars.stars.size() == std::size_t(kStars));
    const double limits[] = {1.5, 2.5, 3.5, 4.5, 5.5, 6.51};
    const double known[] = {22, 93, 288, 900, 2850, 8768};
    for (int i = 0; i < 6; ++i) {
        int count = 0;
        for (const Star& star : t.stars.stars.span())
            count += luminance(star.light) > std::pow(10, -0.4 * (limits[i] + 26.74)) ? 1 : 0;
        CAPTURE(limits[i]);
        // Colours have the luminance 1 to three digits, and steps of a hundredth in the table.
        CHECK(count == doctest::Approx(known[i]).epsilon(0.06));
    }
    int near = 0, far = 0;
    for (const Star& star : t.stars.stars.span()) {
        const Double3& pole = t.stars.galaxy[2];
        const double sine = std::abs(pole.x * double(star.to[0]) + pole.y * double(star.to[1]) +
                                     pole.z * double(star.to[2]));
        near += sine < 0.1 ? 1 : 0;
        far += sine > 0.9 ? 1 : 0;
    }
    // (x + 1.25)^-2 between both tenths: 2.7, with 2 % and 5 % of chance.
    CHECK(double(near) / far == doctest::Approx(2.7).epsilon(0.15));
    // What is between the stars on the whole, and what they sum up to: some 100 stars of magnitude
    // 10 per square degree (Leinert et al. 1998: 30 at the poles, 300 in the plane).
    CHECK(t.stars.even[1] / kStarOfTen == doctest::Approx(100).epsilon(0.2));
    double sum = 0;
    int count = 0;
    for (int i = 0; i < 40000; ++i) {
        const double z = 2 * (i + 0.5) / 40000 - 1, side = std::sqrt(1 - z * z);
        sum +=
            milky_way(t.stars, {side * std::cos(2.399963 * i), side * std::sin(2.399963 * i), z});
        ++count;
    }
    double points = 0;
    for (const Star& star : t.stars.stars.span()) points += double(star.light[1]);
    CHECK(sum / count + points / (4 * kPi64) == doctest::Approx(t.stars.even[1]).epsilon(2e-3));
    CHECK(star_colour(0.65)[0] == doctest::Approx(1).epsilon(0.01));
    CHECK(star_colour(-0.2)[2] > 1.5);
    CHECK(star_colour(1.8)[0] > 1.3);
}

TEST_CASE("stars: their light is that of their irradiance in pictures of any size") {
    // Towards Orion. One pixel of 20 degrees has the light of its middle's solid angle: 5 %.
    const double whole = seen(512, 20, {0.34, -0.75, 0.56}, true);
    CHECK(seen(64, 20, {0.34, -0.75, 0.56}, true) == doctest::Approx(whole).epsilon(0.03));
    CHECK(seen(1111, 20, {0.34, -0.75, 0.56}, true) == doctest::Approx(whole).epsilon(0.03));
    CHECK(whole > 0);
    // Airglow, which has no points.
    const double even = seen(64, 20, {0, -0.1, 1}, false);
    CHECK(even / (4 * std::pow(std::tan(10 * kPi64 / 180), 2)) ==
          doctest::Approx(0.88 * 205 * kStarOfTen).epsilon(0.08));
    CHECK(seen(1, 20, {0, -0.1, 1}, false) == doctest::Approx(even).epsilon(0.05));
}

TEST_CASE("stars: a part of a picture has the bits of the whole, and media hide them") {
    const std::string text = R"(
[camera]
position_m = [0, 0, 2]
target_m = [0, -100, 70]
fov_deg = 60
resolution = [64, 48]
[atmosphere]
date = 2026-01-15
time = 00:00:00
latitude_deg = 28
longitude_deg = -16
stars = true
airglow = true
moon = true
[ground]
[[medium]]
density = "uniform:box"
bounds_m = [[-50, -300, 10], [0, -200, 200]]
resolution = [4, 4, 4]
extinction_per_m = 1
[output]
layers = ["radiance", "alpha"]
[method]
name = "raymarch"
)";
    const Picture whole = render_one(scene_from(text));
    const Picture part = render_one(scene_from(text, {"camera.crop=[10, 3, 51, 22]"}));
    int lit = 0;
    for (int y = 3; y < 22; ++y)
        for (int x = 10; x < 51; ++x) {
            CHECK(part.at("G", x - 10, y - 3) == whole.at("G", x, y));
            lit += whole.at("G", x, y) > 1e-8f ? 1 : 0;
        }
    CHECK(lit > 3);
    const Picture none = render_one(scene_from(text, {"atmosphere.stars=false"}));
    int hidden = 0, brighter = 0;
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 64; ++x) {
            const bool thick = whole.at("A", x, y) > 0.999f;  // where rays end
            // Skylight on the medium has a little of the stars'.
            if (thick) CHECK(whole.at("G", x, y) < 2 * none.at("G", x, y) + 1e-9f);
            hidden += thick ? 1 : 0;
            brighter += !thick && whole.at("G", x, y) > 5 * none.at("G", x, y) ? 1 : 0;
        }
    CHECK(hidden > 20);
    CHECK(brighter > 5);
}
