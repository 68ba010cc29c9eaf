// SPDX-License-Identifier: Apache-2.0
// What a host has of a whole sky: its own picture through air and clouds, shadows and light in its
// world. in: small skies -> out: checks. docs/whole-sky.md
#include "tests/embed/whole_sky_harness.h"

using namespace whole_sky_test;

TEST_CASE("sky: over a host's picture things stay where they are, seen through air and clouds") {
    const std::size_t pixels = std::size_t{24} * 14;
    std::vector<float> depth(pixels, std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < pixels; i += 2) depth[i] = 1500;
    // Without air and clouds a host's pixels are left alone, the others are the sky's.
    Whole bare(sky_text());
    const double from[3] = {0, 0, 500}, to[3] = {0, 1000, 700};
    bare.aim(from, to, 20);
    const Picture whole = bare.draw();
    const Picture over = bare.draw(PILEUS_BLEND_OVER, depth.data(), 7);
    for (std::size_t i = 0; i < pixels; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const float expected = depth[i] < 2000 ? 7.0f : whole.rgba[4 * i + c];
            CHECK(over.rgba[4 * i + c] == expected);
        }
    // With air: host * left + light, whatever the host shows; far things have less left.
    Whole air(sky_text(true));
    air.aim(from, to, 20);
    const Picture black = air.draw(PILEUS_BLEND_OVER, depth.data(), 0);
    const Picture one = air.draw(PILEUS_BLEND_OVER, depth.data(), 1);
    const Picture media = air.draw(PILEUS_BLEND_MEDIA, depth.data());
    for (float& d : depth)
        if (d < 2000) d = 15000;
    const Picture far = air.draw(PILEUS_BLEND_OVER, depth.data(), 1);
    const Picture far_black = air.draw(PILEUS_BLEND_OVER, depth.data(), 0);
    for (std::size_t i = 0; i < pixels; ++i) {
        float sum = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t k = 4 * i + c;
            const float left = one.rgba[k] - black.rgba[k];
            const float far_left = far.rgba[k] - far_black.rgba[k];
            sum += left;
            if (i % 2 == 1) {
                CHECK(left == 0);
                continue;
            }
            CHECK(left < 1);
            CHECK(far_left < left);
            CHECK(black.rgba[k] > 0);
            // Laid over later it is the same, to the mean of what is left.
            CHECK(media.rgba[k] == black.rgba[k]);
        }
        CHECK(media.rgba[4 * i + 3] == doctest::Approx(1 - sum / 3).epsilon(1e-5));
    }
    // The way of one pixel by itself.
    float left[3], light[3];
    const double ahead[3] = {0, 1000, 200};
    air.check(pileus_sky_air(air.sky.get(), ahead, 15000, left, light, &air.out.error));
    const std::size_t middle = 4 * (std::size_t{7} * 24 + 12);
    for (std::size_t c = 0; c < 3; ++c) {
        // Half a pixel off the middle, on a gradient of the air.
        CHECK(light[c] == doctest::Approx(double(far_black.rgba[middle + c])).epsilon(0.03));
        CHECK(left[c] == doctest::Approx(double(far.rgba[middle + c] - far_black.rgba[middle + c]))
                             .epsilon(0.03));
    }
}

TEST_CASE("sky: a map of shadows is that of the places on it, in every format, by rows") {
    Whole sky(sky_text(), kMarch);
    sky.sun(90, 45);
    sky.add_cumulus({at(0, 0, 1000), at(2500, 600, 1500, 90)});
    constexpr std::uint32_t kSide = 48;
    auto map = pileus_shadow_map_default();
    map.width = map.height = kSide;
    map.low_m[0] = -6000, map.low_m[1] = -3000;
    map.size_m[0] = map.size_m[1] = 6000;
    map.format = PILEUS_SHADOW_R32F;
    std::vector<float> shares(std::size_t{kSide} * kSide, -1), rows = shares;
    map.texels = shares.data();
    sky.check(pileus_sky_shadow(sky.sky.get(), &map, &sky.out.error));
    float least = 1, most = 0;
    for (std::size_t v = 0; v < kSide; v += 5)
        for (std::size_t u = 0; u < kSide; u += 5) {
            const double x = -6000 + (double(u) + 0.5) * 125, y = 3000 - (double(v) + 0.5) * 125;
            const float at_place = sky.light_at(x, y, 0).sun_share;
            CHECK(shares[v * kSide + u] == at_place);
            least = std::min(least, at_place), most = std::max(most, at_place);
        }
    // Both are on it: the middle of a cloud's shadow, and what lies beside.
    CHECK(least < 0.3f);
    CHECK(most == 1);
    map.texels = rows.data();
    for (std::uint32_t row = 0; row < kSide; row += 7) {
        map.first_row = row;
        map.rows = std::min<std::uint32_t>(7, kSide - row);
        sky.check(pileus_sky_shadow(sky.sky.get(), &map, &sky.out.error));
    }
    CHECK(rows == shares);
    map.first_row = map.rows = 0;
    map.bottom_up = 1;
    sky.check(pileus_sky_shadow(sky.sky.get(), &map, &sky.out.error));
    for (std::size_t v = 0; v < kSide; ++v)
        for (std::size_t u = 0; u < kSide; ++u)
            CHECK(rows[(kSide - 1 - v) * kSide + u] == shares[v * kSide + u]);
    std::vector<unsigned char> codes(4 * shares.size());
    map.bottom_up = 0;
    map.format = PILEUS_SHADOW_RGBA8;
    map.texels = codes.data();
    sky.check(pileus_sky_shadow(sky.sky.get(), &map, &sky.out.error));
    for (std::size_t i = 0; i < shares.size(); ++i) {
        CHECK(codes[4 * i] == static_cast<unsigned char>(shares[i] * 255.0f + 0.5f));
        CHECK(codes[4 * i + 3] == 255);
    }
    // Terrain as high as the clouds has another shadow; a sun that has set gives none its light.
    std::vector<float> heights(shares.size(), 4000);
    map.format = PILEUS_SHADOW_R32F;
    map.heights = heights.data();
    map.texels = rows.data();
    sky.check(pileus_sky_shadow(sky.sky.get(), &map, &sky.out.error));
    for (const float share : rows) CHECK(share == 1);
    sky.sun(90, -1);
    (void)sky.draw();
    sky.check(pileus_sky_shadow(sky.sky.get(), &map, &sky.out.error));
    for (const float share : rows) CHECK(share == 0);
}

TEST_CASE("sky: light at places") {
    for (const bool air : {false, true}) {
        Whole sky(sky_text(air), kMarch);
        sky.sun(90, 45);
        sky.add_cumulus({at(0, 0, 1000)});
        const pileus_sky_light inside = sky.light_at(0, 0, 2000),
                               beside = sky.light_at(3000, 0, 100);
        CHECK(inside.extinction_per_m > 0.001);
        CHECK(beside.extinction_per_m == 0);
        CHECK(beside.sun_share == 1);
        for (int c = 0; c < 3; ++c) {
            CHECK(beside.sun[c] > 0);
            CHECK(beside.level[c] > 0);
            // A plane that looks up sees the sky alone, one that looks down the ground.
            const double up =
                double(beside.around[c][0] + beside.around[c][3]) + 2 * double(beside.around[c][8]);
            // A sky map's second degree is all that is lost of it.
            CHECK(3.14159265358979 * up ==
                  doctest::Approx(double(beside.level[c])).epsilon(air ? 0.1 : 0.03));
        }
    }
}

TEST_CASE("sky: a map far beside all clouds has all of the sun") {
    Whole sky(sky_text(), kMarch);
    sky.sun(90, 45);
    sky.add_cumulus({at(0, 0, 1000)});
    auto map = pileus_shadow_map_default();
    map.width = 16384;
    map.height = 1;
    map.low_m[0] = -200000;
    map.size_m[0] = map.size_m[1] = 1;
    std::vector<unsigned char> codes(map.width);
    map.texels = codes.data();
    for (const double west : {-200000.0, 200000.0}) {
        map.low_m[0] = west;
        sky.check(pileus_sky_shadow(sky.sky.get(), &map, &sky.out.error));
        for (const unsigned char code : codes) CHECK(code == 255);
    }
}

TEST_CASE("sky: without a sun a layer dims the light of the sky on what is below it") {
    Whole open(sky_text(), kMarch), covered(sky_text(), kMarch);
    auto none = pileus_sun_default();
    none.present = 0;
    const double from[3] = {16, -4000, 256}, to[3] = {0, 0, 1024};
    for (Whole* sky : {&open, &covered}) {
        sky->check(pileus_session_set_sun(sky->session(), &none, &sky->out.error));
        sky->add_cumulus({at(0, 0, 0)});
        sky->aim(from, to);
    }
    covered.add_layer(deck(6000, 6400, kRed), add(kMarch, {"medium.0.boundary=periodic",
                                                           "medium.0.extinction_per_m=0.005"}));
    const Picture bright = open.draw(PILEUS_BLEND_MEDIA), dim = covered.draw(PILEUS_BLEND_MEDIA);
    // Two optical depths of isotropic scattering.
    const double share = 1 / (1 + 0.75 * 2);
    const pileus_sky_light below = covered.light_at(0, 0, 100);
    CHECK(below.sun_share == 0);
    CHECK(double(below.level[1] / open.light_at(0, 0, 100).level[1]) ==
          doctest::Approx(share).epsilon(0.02));
    const std::size_t middle = 4 * (std::size_t{7} * 24 + 12) + 1;
    REQUIRE(bright.rgba[middle] > 0);
    // The layer itself stands behind the cloud.
    CHECK(double(dim.rgba[middle]) < 1.3 * share * double(bright.rgba[middle]));
}
