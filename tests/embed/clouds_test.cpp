// SPDX-License-Identifier: Apache-2.0
// Skies of many clouds: what they share with sessions, shadows, level of detail.
// in: small skies -> out: checks.
// docs/clouds.md
#include <algorithm>
#include <cmath>

#include "tests/embed/clouds_harness.h"

using namespace clouds_test;

TEST_CASE("clouds: a sky without any has the bits of its session's own picture") {
    for (const bool air : {false, true}) {
        CloudySky none({}, {}, air);
        const Picture p = none.draw();
        char text[17];
        std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(p.hash));
        CHECK(none.sky.hash() == text);
        CHECK(none.stats().clouds == 0);
    }
}

TEST_CASE("clouds: one that stands where its kind was made is the session's cloud") {
    // Light rounds differently on a part of the picture, no more.
    for (const char* method : {"raymarch", "optical-depth"}) {
        const Overrides name{std::string("method.name=") + method};
        CloudySky one({at(0, 0, 0)}, name);
        Hosted whole(kSmallCumulus, add(kMarch, name));
        CHECK(relative_error(one.draw(PILEUS_BLEND_MEDIA), session_picture(whole)) < 1e-6);
        CHECK(one.stats().marched == 1);
    }
}

TEST_CASE("clouds: methods with photons and paths show the session's cloud within their noise") {
    // The same photons fall, from a ground at another depth; paths are others.
    const struct {
        const char* method;
        double most;
    } rows[] = {{"collectors", 0.02}, {"photon-grid", 0.02}, {"path", 0.2}};
    for (const auto& row : rows) {
        CAPTURE(row.method);
        const Overrides name{std::string("method.name=") + row.method, "path.samples_per_pixel=32"};
        CloudySky one({at(0, 0, 0)}, name);
        Hosted whole(kSmallCumulus, add(kMarch, name));
        whole.step(whole.whole());
        CHECK(relative_error(one.draw(PILEUS_BLEND_MEDIA), session_picture(whole)) < row.most);
    }
}

TEST_CASE(
    "clouds: turned with the sun and the camera, or made larger with the way to it, they look the "
    "same") {
    CloudySky plain({at(0, 0, 0)});
    plain.sky.sun(120, 35);
    const Picture first = plain.draw(PILEUS_BLEND_MEDIA);
    // Counter-clockwise by 90: x to y, an azimuth 90 less.
    CloudySky turned({at(0, 0, 0, 90)});
    turned.sky.sun(30, 35);
    const double position[3] = {4000, 16, 256}, target[3] = {0, 0, 1024};
    turned.sky.aim(position, target, 40, 24, 14);
    CHECK(relative_error(turned.draw(PILEUS_BLEND_MEDIA), first) < 1e-4);
    CloudySky large({at(0, 0, -1024, 0, 2)});
    const double far[3] = {32, -8000, -512}, to[3] = {0, 0, 1024};
    auto ground = cleared<pileus_ground>();
    ground.present = 1;
    ground.altitude_m = -4000;
    ground.albedo = 0.25;
    large.sky.check(pileus_session_set_ground(large.sky.session.get(), &ground, &large.out.error));
    large.sky.aim(far, to, 40, 24, 14);
    CHECK(relative_error(large.draw(PILEUS_BLEND_MEDIA), first) < 1e-6);
}

TEST_CASE("clouds: depths are where half of the light is gone, in metres of the world") {
    CloudySky one({at(0, 0, 0)});
    Hosted whole(kSmallCumulus, kMarch);
    const Picture mine = one.draw(), its = session_picture(whole);
    std::size_t found = 0;
    for (std::size_t i = 0; i < mine.depth.size(); ++i) {
        // Pixels that are half hidden in both.
        if (!(its.rgba[4 * i + 3] > 0.6f)) continue;
        ++found;
        CHECK(std::fabs(double(mine.depth[i]) / double(its.depth[i]) - 1) < 1e-3);
    }
    CHECK(found > 8);
}

TEST_CASE("clouds: a cloud before the sun darkens another, and the ground below it") {
    // The sun in the south-east at 45 degrees: the second stands towards it.
    const Overrides by_paths{"method.name=path", "path.samples_per_pixel=64",
                             "medium.0.extinction_per_m=0.0625"};
    CloudySky alone({at(0, 0, 0)}, by_paths), shaded({at(0, 0, 0), at(3000, 0, 3000)}, by_paths);
    for (CloudySky* s : {&alone, &shaded}) s->sky.sun(90, 45);
    const Picture lit = alone.draw(PILEUS_BLEND_MEDIA), dark = shaded.draw(PILEUS_BLEND_MEDIA);
    // Two media in one scene by paths, 256 a pixel: what is left of R, G and B of the cloud's
    // middle.
    const double paths[3] = {0.626, 0.681, 0.799};
    for (std::size_t c = 0; c < 3; ++c) {
        double before = 0, after = 0;
        for (std::size_t y = 5; y < 9; ++y)
            for (std::size_t x = 9; x < 15; ++x) {
                const std::size_t i = 4 * (y * 24 + x) + c;
                before += double(lit.rgba[i]);
                after += double(dark.rgba[i]);
                CHECK(dark.rgba[i] <= lit.rgba[i]);
            }
        // Each pixel's share of the sun is told from the cloud's mean, and the other cloud sends
        // light, too.
        CHECK(std::fabs(after / before - paths[c]) < 0.1);
    }
    // The ground straight below a sun at the zenith, seen from above.
    CloudySky high({at(0, 0, 0)});
    high.sky.sun(0, 90);
    const double from[3] = {0, 0, 9000}, to[3] = {0, 100, 0};
    high.sky.aim(from, to, 60, 33, 33);
    const Picture seen = high.draw();
    CloudySky none({});
    none.sky.sun(0, 90);
    none.sky.aim(from, to, 60, 33, 33);
    const Picture empty = none.draw();
    // Far beside the cloud the ground has all of its light; hidden by the cloud is its shadow.
    CHECK(seen.rgba[0] == empty.rgba[0]);
    CHECK(seen.rgba[4 * (16 * 33 + 16) + 3] > 0.9f);
}

TEST_CASE("clouds: threads and instruction sets do not matter, nor does a frame drawn twice") {
    const std::vector<pileus_cloud> places{at(0, 0, 0), at(2500, 3000, 200, 90, 1.5),
                                           at(-6000, 9000, 0, 90), at(0, 30000, 0, 180)};
    std::uint64_t first = 0;
    for (const int threads : {1, 3}) {
        for (const char* isa : {"scalar", static_cast<const char*>(nullptr)}) {
            auto host = cleared<pileus_host>();
            host.threads = std::uint32_t(threads);
            host.isa = isa;
            CloudySky sky(places, {}, true, &host);
            sky.detail(false, 8);
            Picture last;
            for (int frame = 0; frame < 3; ++frame) {
                const double from[3] = {16, -4000.0 + 300 * frame, 256}, to[3] = {0, 0, 1024};
                sky.sky.aim(from, to, 40, 48, 28);
                last = sky.draw();
            }
            if (first == 0) first = last.hash;
            CHECK(last.hash == first);
            CHECK(sky.stats().marched < sky.stats().visible);
        }
    }
}

TEST_CASE("clouds: far ones stay as they are while the eye moves little, and near the truth") {
    std::vector<pileus_cloud> places;
    for (int i = 0; i < 12; ++i)
        places.push_back(
            at(1500.0 * (i % 4 - 2), 5000.0 + 4000 * i, 100.0 * (i % 3), 90.0 * (i % 4)));
    CloudySky quick(places), whole(places);
    quick.detail(false, 64);
    std::uint32_t captured = 0;
    double worst = 0;
    for (int frame = 0; frame < 20; ++frame) {
        const double from[3] = {16, -4000.0 + 4 * frame, 256}, to[3] = {0, 20000, 1024};
        for (CloudySky* s : {&quick, &whole}) s->sky.aim(from, to, 40, 96, 54);
        const Picture mine = quick.draw();
        worst = std::max(worst, relative_error(mine, whole.draw()));
        if (frame > 0) captured += quick.stats().captured;
        CHECK(quick.stats().worst_px < 2);
    }
    // At this size a picture is one of a few pixels, with edges between them.
    CHECK(worst < 0.01);
    CHECK(captured < 12);
    CHECK(quick.stats().marched == 0);
    CHECK(whole.stats().marched == whole.stats().visible);
}

TEST_CASE("clouds: a picture gives way to the next without a jump") {
    CloudySky quick({at(0, 0, 0)}), whole({at(0, 0, 0)});
    quick.detail(false, 1000);
    // From a picture to marched and back, by the distance at which balls are near.
    double before = 1;
    std::uint32_t marched = 0;
    for (int frame = 0; frame < 40; ++frame) {
        const double away = 1870 - 6.0 * (frame < 20 ? frame : 39 - frame);
        const double from[3] = {0, -away, 1024}, to[3] = {0, 0, 1024};
        for (CloudySky* s : {&quick, &whole}) s->sky.aim(from, to, 60, 48, 28);
        const double share =
            quick.draw(PILEUS_BLEND_MEDIA).sum(1) / whole.draw(PILEUS_BLEND_MEDIA).sum(1);
        marched += quick.stats().marched;
        // A picture of 48 by 28 pixels, read between its texels.
        CHECK(std::fabs(share - 1) < 0.03);
        if (frame > 0) CHECK(std::fabs(share - before) < 0.01);
        before = share;
    }
    CHECK(marched > 5);
    CHECK(marched < 35);
}

TEST_CASE("clouds: marched pixels stay where they are in the picture while a cloud moves in it") {
    for (int step = 0; step < 6; ++step) {
        CAPTURE(step);
        // A pixel or so from one to the next.
        const double x = 97.0 * step, z = 61.0 * step;
        CloudySky thinned({at(x, 0, z)}), whole({at(x, 0, z)});
        thinned.detail(false, 2, 4);
        for (CloudySky* s : {&thinned, &whole}) {
            const double from[3] = {16, -4000, 256}, to[3] = {0, 0, 1024};
            s->sky.aim(from, to, 60, 48, 40);
        }
        const Picture a = thinned.draw(PILEUS_BLEND_MEDIA), b = whole.draw(PILEUS_BLEND_MEDIA);
        CHECK(thinned.stats().marched == 1);
        // Alpha where pixels are marched, the third of each four, and between them.
        double marched = 0, between = 0;
        for (std::size_t y = 0; y < 40; ++y)
            for (std::size_t c = 0; c < 48; ++c) {
                const std::size_t i = 4 * (y * 48 + c) + 3;
                const double off = std::fabs(double(a.rgba[i]) - double(b.rgba[i]));
                double& most = c % 4 == 2 && y % 4 == 2 ? marched : between;
                most = std::max(most, off);
            }
        // Rays of a part of the picture round otherwise.
        CHECK(marched < 1e-3);
        CHECK(between > 0.05);
    }
}

TEST_CASE("clouds: a sun that moves lights kinds again, one in a picture") {
    CloudySky sky({at(0, 0, 0), at(4000, 4000, 0, 90)});
    sky.detail(false, 10);
    (void)sky.draw();
    CHECK(sky.stats().lit == 2);
    sky.sky.sun(120, 35.2);
    (void)sky.draw();
    CHECK(sky.stats().lit == 0);
    sky.sky.sun(120, 37);
    (void)sky.draw();
    CHECK(sky.stats().lit == 1);
    (void)sky.draw();
    CHECK(sky.stats().lit == 1);
    (void)sky.draw();
    CHECK(sky.stats().lit == 0);
}
