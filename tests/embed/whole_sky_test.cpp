// SPDX-License-Identifier: Apache-2.0
// The whole sky of a host: layers and clouds by depth, motion, the clock, reports of the weather.
// in: small skies -> out: checks.
// docs/whole-sky.md
#include "tests/embed/whole_sky_harness.h"

using namespace whole_sky_test;

TEST_CASE("sky: without clouds and layers it has the bits of its session's own picture") {
    for (const bool air : {false, true}) {
        Whole none(sky_text(air));
        Hosted session(sky_text(air), {"method.name=raymarch"});
        char text[17];
        std::snprintf(text, sizeof text, "%016llx",
                      static_cast<unsigned long long>(none.draw().hash));
        CHECK(session.hash() == text);
    }
}

TEST_CASE("sky: of two layers and a cloud each pixel shows the nearest first") {
    Whole two(sky_text(), kMarch);
    two.add_layer(deck(3000, 3400, kRed), kMarch);
    two.add_layer(deck(2000, 2400, kGreen), kMarch);
    const double middle = 4.0 * (7 * 24 + 12);
    const auto colour = [&](double z, double to_z) {
        const double from[3] = {0, 0, z}, to[3] = {0, 100, to_z};
        two.aim(from, to);
        const Picture p = two.draw();
        return std::array<float, 2>{p.rgba[std::size_t(middle)], p.rgba[std::size_t(middle) + 1]};
    };
    const auto from_below = colour(500, 900), from_above = colour(5000, 4000),
               between = colour(2700, 3000), between_down = colour(2700, 2500);
    CHECK(from_below[1] > 3 * from_below[0]);
    CHECK(from_above[0] > 3 * from_above[1]);
    CHECK(between[0] > 3 * between[1]);
    CHECK(between_down[1] > 3 * between_down[0]);
    // A cloud between the eye and the deck is seen, one behind it is not.
    Whole mixed(sky_text(), kMarch);
    mixed.add_layer(deck(3000, 3400, kRed), kMarch);
    const double from[3] = {0, 0, 500}, up[3] = {0, 10, 2000};
    mixed.aim(from, up, 30);
    // Its shadow falls beside what is seen of the deck.
    mixed.sun(120, 12);
    const Picture alone = mixed.draw();
    mixed.add_cumulus({at(0, 0, 3000)});
    const Picture behind = mixed.draw();
    double off = 0;
    for (std::size_t i = 0; i < alone.rgba.size(); ++i)
        off = std::max(off, std::fabs(double(alone.rgba[i]) - double(behind.rgba[i])));
    // Through 40 optical depths nothing comes; the deck's light does not know the cloud.
    CHECK(off < 0.02 * alone.sum(0) / double(alone.width * alone.height));
    mixed.place({at(0, 0, 600)});
    CHECK(relative_error(mixed.draw(), alone) > 0.01);
}

TEST_CASE("sky: a layer shades what is below it, clouds, ground and layers, and nothing above") {
    Whole sky(sky_text(), kMarch);
    sky.sun(120, 60);
    CHECK(sky.light_at(0, 0, 100).sun_share == 1);
    sky.add_layer(deck(3000, 3400, kRed), kMarch);
    const double from[3] = {0, 0, 500}, to[3] = {0, 100, 500};
    sky.aim(from, to);
    (void)sky.draw();
    // 46 optical depths of isotropic scattering, of which shadows know 23 at the most.
    const double deep = 1 / (1 + 0.75 * 23.0);
    CHECK(double(sky.light_at(0, 0, 100).sun_share) == doctest::Approx(deep).epsilon(0.02));
    CHECK(sky.light_at(0, 0, 5000).sun_share == 1);
    // Half-way clear: optical depth 0.4 / sin 60 along the sun's way, 64 steps of it.
    Whole thin(sky_text(), kMarch);
    thin.sun(120, 60);
    thin.add_layer(deck(3000, 3400, kRed),
                   add(kMarch, {"medium.0.extinction_per_m=0.001", "medium.0.boundary=periodic"}));
    thin.aim(from, to);
    (void)thin.draw();
    const double expected = 1 / (1 + 0.75 * 0.4 / std::sin(60 * 3.14159265358979 / 180));
    const pileus_sky_light below = thin.light_at(0, 0, 100), above = thin.light_at(0, 0, 5000);
    CHECK(std::fabs(double(below.sun_share) - expected) < 0.02);
    // The sky's light comes through as well, as from straight above.
    const double sky_left = 1 / (1 + 0.75 * 0.4);
    CHECK(double(below.level[2] / above.level[2]) == doctest::Approx(sky_left).epsilon(0.02));
    CHECK(thin.light_at(0, 0, 3200).extinction_per_m == doctest::Approx(0.001).epsilon(0.01));
    CHECK(thin.light_at(0, 0, 3500).extinction_per_m == 0);
}

TEST_CASE("sky: wind and a new origin move all of it, and nothing is drawn or lit anew") {
    Whole still(sky_text(), kMarch), moved(sky_text(), kMarch);
    auto detail = cleared<pileus_cloud_detail>();
    detail.near_px = 64;
    for (Whole* sky : {&still, &moved}) {
        sky->check(pileus_clouds_set_detail(sky->clouds(), &detail, &sky->out.error));
        // Cells that a shift of the origin does not cut otherwise.
        sky->add_cumulus({at(0, 3000, 512), at(-2000, 6000, 512, 90)});
        const double from[3] = {0, -9000, 512}, to[3] = {0, 0, 1024};
        sky->aim(from, to, 20);
        (void)sky->draw();
    }
    CHECK(moved.stats().captured == 2);
    const Picture before = still.draw();
    const double shift[3] = {8192, -4096, 0};
    moved.check(pileus_sky_move(moved.sky.get(), shift, &moved.out.error));
    const double from[3] = {8192, -13096, 512}, to[3] = {8192, -4096, 1024};
    moved.aim(from, to, 20);
    const Picture after = moved.draw();
    CHECK(moved.stats().captured == 0);
    CHECK(moved.stats().lit == 0);
    // Floats of rays around another origin.
    CHECK(relative_error(after, before) < 1e-5);
    // A little wind alone: within what an impostor may be off.
    const double wind[3] = {8192 + 2, -4096, 0};
    moved.check(pileus_sky_move(moved.sky.get(), wind, &moved.out.error));
    (void)moved.draw();
    CHECK(moved.stats().captured == 0);
    // By places it is the same.
    still.place({at(2, 3000, 512), at(-1998, 6000, 512, 90)});
    (void)still.draw();
    CHECK(still.stats().captured == 0);
    CHECK(still.stats().lit == 0);
}

TEST_CASE("sky: at any speed of the clock all kinds follow the sun, and none stays at noon") {
    Whole sky(sky_text(), kMarch);
    sky.add_cumulus({at(-1500, 4000, 512), at(1500, 4000, 512, 90), at(0, 7000, 512, 180)});
    const double from[3] = {0, -4000, 512}, to[3] = {0, 4000, 1024};
    sky.aim(from, to, 50);
    sky.sun(180, 60);
    const Picture noon = sky.draw();
    // A new sun in every frame: one of three is lit in each.
    for (int frame = 1; frame <= 6; ++frame) {
        sky.sun(180, 60 - 9 * frame);
        (void)sky.draw();
        CHECK(sky.stats().lit == 1);
    }
    // Night at once, with a sky that is as dark.
    auto dark = cleared<pileus_environment>();
    dark.present = 1;
    for (float& c : dark.radiance) c = 1e-4f;
    sky.check(pileus_session_set_environment(sky.session(), &dark, &sky.out.error));
    sky.sun(180, -30);
    const Picture night = sky.draw(PILEUS_BLEND_REPLACE);
    float brightest = 0;
    for (std::size_t i = 0; i < night.rgba.size(); ++i)
        if (i % 4 != 3) brightest = std::max(brightest, night.rgba[i]);
    CHECK(noon.sum(0) > 1);
    CHECK(brightest < 2e-3f);
    // Within as many frames as there are kinds and turns, and impostors' own.
    for (int frame = 0; frame < 3 + 3; ++frame) (void)sky.draw();
    CHECK(sky.stats().lit == 0);
}

TEST_CASE("sky: a cloud that is half there hides half") {
    Whole sky(sky_text(), kMarch);
    sky.add_cumulus({at(0, 0, 0)});
    const double from[3] = {16, -4000, 256}, to[3] = {0, 0, 1024};
    sky.aim(from, to);
    const Picture full = sky.draw();
    pileus_cloud half = at(0, 0, 0);
    half.presence = 0.5;
    sky.place({half});
    const Picture faded = sky.draw();
    CHECK(sky.stats().lit == 0);
    for (std::size_t i = 3; i < full.rgba.size(); i += 4)
        CHECK(faded.rgba[i] == doctest::Approx(0.5 * double(full.rgba[i])).epsilon(1e-5));
}

TEST_CASE("sky: a report of the weather takes the place of all clouds, or nothing changes") {
    Whole sky(sky_text(true), kMarch);
    sky.width = 32, sky.height = 18;
    const double from[3] = {0, 0, 300}, to[3] = {0, 1000, 700};
    sky.aim(from, to, 60);
    const Picture clear = sky.draw();
    sky.check(pileus_sky_set_weather(sky.sky.get(), "EGLL 271020Z 24015KT 9999 OVC030 12/08 Q1012",
                                     1, 0, &sky.out.error));
    const Picture overcast = sky.draw();
    // Half of the sun is gone: 14 optical depths of droplets let 0.4 of it through.
    CHECK(sky.light_at(0, 0, 10).sun_share < 0.6f);
    double covered = 0;
    for (std::size_t i = 3; i < overcast.rgba.size(); i += 4) covered += double(overcast.rgba[i]);
    CHECK(covered > 0.4 * 32 * 18);
    for (const char* wrong : {"", "nothing of the kind", "EGLL 271020Z 99915KT 9999 OVC030"}) {
        CHECK(pileus_sky_set_weather(sky.sky.get(), wrong, 1, 0, &sky.out.error) ==
              PILEUS_ERROR_INPUT);
        CHECK(sky.out.line().find("metar") != std::string::npos);
    }
    CHECK(relative_error(sky.draw(), overcast) < 0.05);
    sky.check(pileus_sky_set_weather(sky.sky.get(), "EGLL 271020Z 24005KT CAVOK 12/08 Q1012", 1, 0,
                                     &sky.out.error));
    const Picture again = sky.draw();
    double alpha = 0;
    for (std::size_t i = 3; i < again.rgba.size(); i += 4) alpha += double(again.rgba[i]);
    CHECK(alpha == 0);
    CHECK(again.rgba.size() == clear.rgba.size());
}
