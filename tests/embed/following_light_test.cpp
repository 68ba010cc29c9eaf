// SPDX-License-Identifier: Apache-2.0
// Light of discrete ordinates that follows a moving sun in a host's pictures.
// in: a small cloud, suns -> out: pictures against those of a session that begins there.
// docs/ordinates.md, "Time"
#include <cmath>

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

/// Radiance of a picture, and the largest difference to another over the mean.
std::vector<float> picture(Hosted& host, double azimuth, double elevation) {
    const double from[3] = {16, -4000, 256}, to[3] = {0, 0, 1024};
    host.aim(from, to, 30, kWidth, kHeight);
    host.sun(azimuth, elevation);
    std::vector<float> pixels(std::size_t(4) * kWidth * kHeight);
    auto frame = cleared<pileus_frame>();
    frame.colour = pixels.data();
    frame.format = PILEUS_RGBA32F;
    host.check(pileus_session_render(host.session.get(), &frame, &host.out.error));
    return pixels;
}

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
