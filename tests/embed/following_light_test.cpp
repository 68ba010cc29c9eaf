// SPDX-License-Identifier: Apache-2.0
// Light of discrete ordinates that follows a moving sun in a host's pictures.
// in: a small cloud, suns -> out: pictures against those of a session that begins there.
// docs/ordinates.md, "Time"
#include <cmath>
#include <cstdlib>

#include "tests/embed/host_harness.h"

using namespace host_test;
using render_test::kSmallCumulus;

namespace {

constexpr std::uint32_t kWidth = 64, kHeight = 36;

Overrides with(const char* refresh) {
    return {"method.name=\"raymarch\"", "raymarch.scattering=\"ordinates\"",
            "output.layers=[\"radiance\",\"alpha\"]",
            std::string("raymarch.light_refresh=") + refresh};
}

/// What a camera sees of a host's scene under a sun.
std::vector<float> picture(Hosted& host, const double (&from)[3], const double (&to)[3],
                           double fov_deg, double azimuth, double elevation, float irradiance = 1) {
    host.aim(from, to, fov_deg, kWidth, kHeight);
    host.sun(azimuth, elevation, irradiance);
    std::vector<float> pixels(std::size_t(4) * kWidth * kHeight);
    auto frame = cleared<pileus_frame>();
    frame.colour = pixels.data();
    frame.format = PILEUS_FORMAT_RGBA32F;
    host.check(pileus_session_render(host.session.get(), &frame, &host.out.error));
    return pixels;
}

std::vector<float> picture(Hosted& host, double azimuth, double elevation, float irradiance = 1) {
    return picture(host, {16, -4000, 256}, {0, 0, 1024}, 30, azimuth, elevation, irradiance);
}

/// The sum of differences to another over that of its own.
double difference(const std::vector<float>& a, const std::vector<float>& b) {
    double off = 0, all = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        off += std::fabs(double(a[i]) - double(b[i])), all += std::fabs(double(b[i]));
    return off / all;
}

std::vector<float> fresh(double azimuth, double elevation) {
    Hosted host(kSmallCumulus, with("1"));
    REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
    return picture(host, azimuth, elevation);
}

}  // namespace

TEST_CASE(
    "following light: without a refresh each picture is that of a session that begins there") {
    Hosted host(kSmallCumulus, with("1"));
    REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
    for (double elevation : {30.0, 30.5, 60.0, 0.5, 30.0}) {
        CAPTURE(elevation);
        CHECK(picture(host, 120, elevation) == fresh(120, elevation));
    }
}

TEST_CASE("following light: a few iterations a picture follow the sun") {
    // Light on nodes of the sun's depth is refreshed over as many pictures: most of what is seen.
    Hosted host(kSmallCumulus, with("2"));
    REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
    double elevation = 30;
    (void)picture(host, 120, elevation);
    for (int i = 0; i < 20; ++i) (void)picture(host, 120, elevation += 0.1);
    CHECK(difference(picture(host, 120, elevation), fresh(120, elevation)) < 0.01);
}

TEST_CASE("following light: parts of the light follow in turn, and stand where the sun stands") {
    Hosted host(kSmallCumulus, with("8"));
    REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
    double elevation = 30;
    (void)picture(host, 120, elevation);
    std::vector<float> last;
    for (int i = 0; i < 40; ++i) {
        last = picture(host, 120, elevation += 0.1);
        if (i % 13 == 12) CHECK(difference(last, fresh(120, elevation)) < 0.02);
    }
    // A brighter sun has all of its light at once.
    for (int i = 0; i < 3; ++i) last = picture(host, 120, elevation += 0.1, 2);
    for (int i = 0; i < 9; ++i) last = picture(host, 120, elevation);
    CHECK(last == fresh(120, elevation));
}

TEST_CASE("following light: a sun that moves in every second picture is followed") {
    for (const int first : {0, 1}) {
        CAPTURE(first);
        Hosted host(kSmallCumulus, with("8"));
        REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
        double elevation = 30;
        std::vector<float> last = picture(host, 120, elevation);
        for (int i = 0; i < 12 + first; ++i) last = picture(host, 120, elevation);
        for (int i = 0; i < 60; ++i) last = picture(host, 120, elevation += i % 2 == 0 ? 0.2 : 0);
        CHECK(difference(last, fresh(120, elevation)) < 0.02);
    }
}

TEST_CASE("following light: after a jump of the sun it is there within eight pictures") {
    Hosted host(kSmallCumulus, with("2"));
    REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
    (void)picture(host, 120, 30);
    const std::vector<float> there = fresh(250, 60);
    std::vector<float> last;
    for (int i = 0; i < 8; ++i) last = picture(host, 250, 60);
    CHECK(difference(last, there) < 0.005);
    // And then stays as it is.
    for (int i = 0; i < 16; ++i) last = picture(host, 250, 60);
    CHECK(picture(host, 250, 60) == last);
}

namespace {

constexpr const char* kSmallSky = R"(
[camera]
position_m = [0, 0, 200]
target_m = [300, 3000, 1400]
resolution = [64, 36]
[sun]
azimuth_deg = 60
elevation_deg = 30
[sky]
radiance = [0.1, 0.2, 0.4]
[method]
name = "raymarch"
[raymarch]
scattering = "ordinates"
steps = 128
light_steps = 4
light_first_step_m = 60
light_growth = 2
[[medium]]
density = "procedural:sky"
resolution = [16, 16, 4]
extinction_per_m = 0.02
phase = { type = "henyey-greenstein", g = 0.5 }
sky = { size = 32, perlin_m = 4096, worley_m = 1500, coverage = 0.5, base_m = 1000, top_m = 2000 }
)";

std::vector<float> sky_picture(Hosted& host, double x, double elevation) {
    return picture(host, {x, 0, 200}, {x + 300, 3000, 1400}, 50, 60, elevation);
}

}  // namespace

TEST_CASE("following light: levels of a sky follow sun and camera") {
    unsetenv("HOME"), unsetenv("PILEUS_CACHE_DIR"), unsetenv("XDG_CACHE_HOME");
    Hosted host(kSmallSky, {"raymarch.light_refresh=3"});
    REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
    double x = 0, elevation = 30;
    (void)sky_picture(host, x, elevation);
    for (int i = 0; i < 6; ++i) (void)sky_picture(host, x += 130, elevation += 0.1);
    Hosted there(kSmallSky, {"raymarch.light_refresh=3"});
    REQUIRE_MESSAGE(there.code == PILEUS_OK, there.out.line());
    const std::vector<float> fresh = sky_picture(there, x, elevation);
    // A picture makes one light of one level.
    CHECK(difference(sky_picture(host, x, elevation), fresh) < 0.02);
    // Six levels of two lights move, and then see the sun where it stands.
    for (int i = 0; i < 40; ++i) (void)sky_picture(host, x, elevation);
    CHECK(sky_picture(host, x, elevation) == fresh);
}
