// SPDX-License-Identifier: Apache-2.0
// Sessions by the C interface whose every setter is called, for tools/guard.
// in: PART SCENE [KEY=VALUE ...] -> out: a line for each call that fails and each picture; r.json
// docs/testing.md, "The guard"
#include <cmath>
#include <functional>

#include "tests/guard/guarded.h"

using namespace guard;

namespace {

const std::vector<float>& sky_map() {
    static const std::vector<float> map = [] {
        std::vector<float> made(16 * 8 * 3);
        for (std::size_t i = 0; i < made.size(); ++i) made[i] = float(i % 37) / 64;
        return made;
    }();
    return map;
}

/// Whatever may be set, changed and set back.
void set_all(Guarded& g) {
    using Step = std::pair<const char*, std::function<void()>>;
    const Step steps[] = {
        {"first", [] {}},
        {"again", [] {}},
        {"camera", [&] { g.camera(300, -3900, 300); }},
        {"nearer", [&] { g.camera(600, -3000, 500, 50); }},
        {"frame", [&] { g.frame(5); }},
        {"orthographic", [&] { g.camera(600, -3000, 500, 0, 1800); }},
        {"matrices", [&] { g.matrices(0, PILEUS_CLIP_MINUS_ONE); }},
        {"off centre", [&] { g.matrices(0.2, PILEUS_CLIP_ZERO); }},
        {"camera back", [&] { g.camera(16, -4000, 256); }},
        {"sun a little", [&] { g.sun(120, 34.9); }},
        {"sun a little more", [&] { g.sun(120, 34.8); }},
        {"sun", [&] { g.sun(150, 15, 0.5f); }},
        {"sun and camera", [&] { g.sun(150, 14.5, 0.5f), g.camera(40, -4000, 256); }},
        {"sun below", [&] { g.sun(150, -5); }},
        {"no sun", [&] { g.sun(0, 0, 0, 0); }},
        {"sun back", [&] { g.sun(120, 35); }},
        {"sky", [&] { g.sky(0.3f); }},
        {"map", [&] { g.sky(0, &sky_map()); }},
        {"map kept", [&] { g.sky(0, nullptr, true); }},
        {"yaw below a map", [&] { g.placement(0, 0, 5); }},
        {"ground below a map", [&] { g.ground(0, 0, 0); }},
        {"no sky", [&] { g.sky(-1); }},
        {"ground", [&] { g.ground(1, 0, 0.75); }},
        {"ground lower", [&] { g.ground(1, -100, 0.5); }},
        {"no ground", [&] { g.ground(0, 0, 0); }},
        {"ground back", [&] { g.ground(1, 0, 0.25), g.sky(0.1f); }},
        {"a light", [&] { g.lights(1); }},
        {"lights", [&] { g.lights(3); }},
        {"no lights", [&] { g.lights(0); }},
        {"distances", [&] { g.depth(PILEUS_DEPTH_DISTANCE, 3900); }},
        {"depths", [&] { g.depth(PILEUS_DEPTH_VIEW_Z, 3800); }},
        {"depths and a camera", [&] { g.camera(60, -4000, 256); }},
        {"buffer", [&] { g.matrices(0, PILEUS_CLIP_ZERO), g.depth(PILEUS_DEPTH_BUFFER, 0.9997); }},
        {"no depths", [&] { g.depth(PILEUS_DEPTH_DISTANCE, 0), g.camera(16, -4000, 256); }},
        {"placed", [&] { g.placement(200, 50, 0); }},
        {"turned", [&] { g.placement(200, 50, 40); }},
        {"turned, sun", [&] { g.sun(100, 30); }},
        {"turned, light", [&] { g.lights(1); }},
        {"below the ground", [&] { g.placement(0, -1000, 0); }},
        {"as the scene", [&] { g.placement(0, 0, 0), g.lights(0), g.sun(120, 35); }},
    };
    for (const Step& step : steps) {
        step.second();
        g.picture(step.first);
    }
}

void work_all(Guarded& g) {
    g.picture("first");
    const pileus_work full = g.work();
    Guarded::print(full, "work");
    const std::function<void(pileus_work&)> changes[] = {
        [](pileus_work& w) { w.scale = 2; },
        [](pileus_work& w) { w.scale = 4; },
        [](pileus_work& w) { w.scale = 3; },
        [](pileus_work& w) { w.temporal = 2; },
        [](pileus_work& w) { w.steps = 12; },
        [](pileus_work& w) { w.light_refresh = 3; },
        [](pileus_work& w) { w.photons = 400; },
        [](pileus_work& w) { w.photons = 1u << 30; },
        [](pileus_work& w) { w = cleared<pileus_work>(); },
    };
    for (const auto& change : changes) {
        pileus_work w = full;
        change(w);
        g.set_work(w);
        auto most = cleared<pileus_units>();
        g.said("most_units", pileus_session_most_units(g.session, nullptr, &most, &g.error));
        std::printf("most: %llu pixels %llu rays %llu samples %llu photons\n", wide(most.pixels),
                    wide(most.rays), wide(most.samples), wide(most.photons));
        for (int frame = 0; frame < 3; ++frame) {
            g.sun(120, 35 - 0.1 * frame);
            g.picture("worked");
        }
    }
    g.set_work(full);
    auto governor = cleared<pileus_governor>();
    governor.target_s = 0.01;
    for (const double frame_s : {0.01, 0.03, 0.05, 0.04, 0.02, 0.002, 0.002, 0.001, 0.001}) {
        auto w = cleared<pileus_work>();
        g.said("govern", pileus_session_govern(g.session, &governor, frame_s, &w, &g.error));
        Guarded::print(w, "governed");
    }
    auto costs = cleared<pileus_costs>();
    costs.pixel = 1, costs.ray = 10, costs.sample = 2, costs.photon = 20;
    for (const double most : {1e9, 1e5, 2e4, 10.0}) {
        auto w = cleared<pileus_work>();
        g.said("fit", pileus_session_fit(g.session, &costs, most, &w, &g.error));
        Guarded::print(w, "fits");
    }
}

/// Wrong values of each setter, one at a time.
void refuse_all(Guarded& g) {
    const double nan = std::nan("");
    g.camera(nan, 0, 0), g.camera(0, 0, 1024), g.camera(0, 0, -900), g.camera(2e9, 0, 0);
    g.camera(0, -900, 300, 180), g.camera(0, -900, 300, 0), g.camera(0, -900, 300, 40, -1);
    g.matrices(nan, PILEUS_CLIP_ZERO), g.matrices(1e9, pileus_clip(7));
    g.sun(400, 10), g.sun(0, 91), g.sun(nan, 0), g.sun(0, 10, -1), g.sun(0, 10, 1e13f);
    g.sky(1e13f), g.sky(std::numeric_limits<float>::quiet_NaN()), g.sky(0, nullptr, true);
    g.ground(1, 0, 1.5), g.ground(1, nan, 0.5), g.ground(1, 900, 0.5), g.ground(1, 2e9, 0);
    g.lights(65), g.depth(pileus_depth(9), 3), g.depth(PILEUS_DEPTH_DISTANCE, -kFar);
    g.placement(nan, 0, 0), g.placement(2e9, 0, 0), g.placement(0, 0, 400);
    g.frame(-1);
    g.draw("format", pileus_format(9), PILEUS_BLEND_REPLACE, true);
    g.draw("blend", PILEUS_FORMAT_RGBA32F, pileus_blend(9), true);
    auto lamp = cleared<pileus_lamp>();
    const std::function<void()> changes[] = {
        [&] { lamp.type = 9; },         [&] { lamp.type = PILEUS_LAMP_SPOT; },
        [&] { lamp.direction[0] = 1; }, [&] { lamp.cone_deg = 40, lamp.penumbra_deg = 30; },
        [&] { lamp.radius_m = -1; },    [&] { lamp.shadow_samples = 65; },
        [&] { lamp.light[1] = -1; },    [&] { lamp.position_m[2] = 3e9; },
    };
    for (const auto& change : changes) {
        lamp = cleared<pileus_lamp>();
        change();
        g.said("light", pileus_session_set_lamps(g.session, &lamp, 1, &g.error));
    }
    for (const std::uint32_t value : {5u, 100u, 70000u}) {
        auto w = cleared<pileus_work>();
        w.scale = w.temporal = w.steps = w.light_refresh = value;
        g.set_work(w);
        w = cleared<pileus_work>();
        w.steps = w.light_refresh = value;
        g.set_work(w);
    }
    g.picture("after all");
}

void late_all(Guarded& g) {
    for (int frame = 0; frame < 6; ++frame) {
        g.camera(16 + 40 * frame, -4000, 256);
        g.sun(120, 35 + frame / 3);
        g.draw("late", PILEUS_FORMAT_RGBA8_SRGB, PILEUS_BLEND_REPLACE, false);
        g.said("step", pileus_session_step(g.session, 1, nullptr, &g.error));
        g.draw("late", PILEUS_FORMAT_RGBA8_SRGB, PILEUS_BLEND_OVER, false);
        g.draw("late, hashed", PILEUS_FORMAT_RGBA8_SRGB, PILEUS_BLEND_REPLACE, true);
    }
}

void hand_over(Guarded& g, Guarded& next) {
    g.picture("before");
    g.said("hand_over", pileus_session_hand_over(g.session, next.session, 8, &g.error));
    next.picture("next");
    g.said("hand_over", pileus_session_hand_over(g.session, next.session, 8, &g.error));
    for (int frame = 0; frame < 10; ++frame) {
        g.frame(frame);
        if (frame > 4) g.camera(16 + 20 * frame, -4000, 256);
        if (frame == 7) g.sun(121, 35);
        g.picture("over");
        g.draw("late", PILEUS_FORMAT_RGBA8_SRGB, PILEUS_BLEND_OVER, false);
    }
    g.said("back", pileus_session_hand_over(g.session, next.session, 1, &g.error));
    g.picture("back");
    next.picture("next");
}

/// The scene is a kind; the sky has neither media nor clouds.
void cloud_sky(Guarded& sky, const Guarded& kind) {
    sky.said("clouds", pileus_clouds_create(sky.session, &sky.clouds, &sky.error));
    std::uint32_t number = 0;
    if (!sky.said("add_kind",
                  pileus_clouds_add_kind(sky.clouds, kind.world, kind.scene, &number, &sky.error)))
        return;
    std::vector<pileus_cloud> places(6, cleared<pileus_cloud>());
    for (std::size_t i = 0; i < places.size(); ++i) {
        places[i].offset_m[0] = 1800.0 * (double(i) - 2.5);
        places[i].offset_m[1] = 3000.0 * double(i * i);
        places[i].offset_m[2] = 100;
        places[i].yaw_deg = 90.0 * double(i % 2);
        places[i].scale = 1 + 0.1 * double(i);
    }
    const auto place = [&](std::size_t count) {
        sky.said("place",
                 pileus_clouds_place(sky.clouds, places.data(), std::uint32_t(count), &sky.error));
    };
    const auto detail = [&](std::int32_t off, double error_px) {
        auto d = cleared<pileus_cloud_detail>();
        d.off = off;
        d.error_px = error_px;
        d.near_px = 12, d.blend_frames = 3;
        sky.said("detail", pileus_clouds_set_detail(sky.clouds, &d, &sky.error));
    };
    auto w = cleared<pileus_work>();
    w.scale = 2;
    using Step = std::pair<const char*, std::function<void()>>;
    const Step steps[] = {
        {"none", [] {}},
        {"detail", [&] { detail(0, 0.5); }},
        {"placed", [&] { place(6); }},
        {"camera", [&] { sky.camera(30, -3980, 256); }},
        {"farther", [&] { sky.camera(60, -3900, 256); }},
        {"sun", [&] { sky.sun(121, 35); }},
        {"low sun", [&] { sky.sun(121, 10, 0.5f); }},
        {"no sun", [&] { sky.sun(0, 0, 0, 0); }},
        {"sun back", [&] { sky.sun(120, 35); }},
        {"sky", [&] { sky.sky(0.3f); }},
        {"ground", [&] { sky.ground(1, 0, 0.7); }},
        {"no ground", [&] { sky.ground(0, 0, 0); }},
        {"lights", [&] { sky.lights(3); }},
        {"no lights", [&] { sky.lights(0); }},
        {"depths", [&] { sky.depth(PILEUS_DEPTH_DISTANCE, 4000); }},
        {"no depths", [&] { sky.depth(PILEUS_DEPTH_DISTANCE, 0); }},
        {"work", [&] { sky.set_work(w); }},
        {"sky placed", [&] { sky.placement(10, 0, 20); }},
        {"fewer", [&] { place(3); }},
        {"all marched", [&] { detail(1, 0.5); }},
        {"wrong",
         [&] { detail(0, 90), places[1].scale = 900, place(3), places[1].kind = 3, place(3); }},
        {"map", [&] { sky.sky(0, &sky_map()); }},
    };
    for (const Step& step : steps) {
        step.second();
        sky.draw(step.first, PILEUS_FORMAT_RGBA32F, PILEUS_BLEND_REPLACE, true);
        sky.draw(step.first, PILEUS_FORMAT_RGBA8_SRGB, PILEUS_BLEND_REPLACE, false);
        auto s = cleared<pileus_cloud_stats>();
        sky.said("stats", pileus_clouds_stats(sky.clouds, &s, &sky.error));
        std::printf(
            "stats: %u visible, %u marched, %u captured, %u lit, %llu %llu pixels, %.9g px\n",
            s.visible, s.marched, s.captured, s.lit, wide(s.marched_pixels),
            wide(s.captured_pixels), s.worst_px);
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: %s PART SCENE [KEY=VALUE ...]\n", argv[0]);
        return 2;
    }
    const std::string part = argv[1];
    const std::vector<const char*> overrides(argv + 3, argv + argc);
    Guarded g(argv[2], overrides);
    if (part == "setters") set_all(g);
    if (part == "work") work_all(g);
    if (part == "refused") refuse_all(g);
    if (part == "late") late_all(g);
    if (part == "hand-over") {
        std::vector<const char*> later = overrides;
        later.insert(later.end(), {"seed=11", "medium.0.shape_seed=5"});
        Guarded next(argv[2], later);
        hand_over(g, next);
        next.end();
    }
    if (part == "clouds") {
        Guarded sky("bare.toml", {});
        cloud_sky(sky, g);
        sky.end();
    }
    g.end();
    return 0;
}
