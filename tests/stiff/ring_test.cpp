// SPDX-License-Identifier: Apache-2.0
// The ring of an animation: nothing of the past stays, whatever the sun did.
// in: animations with jumps, pauses and rings of one -> out: frames equal to fresh ones, by bits.
// docs/testing.md S62, S63; sums are integers, so that what is taken out is what was put in.
#include <cfenv>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "tests/stiff/stiff_scene.h"

using namespace stiff_test;

namespace {

Keys animated(const char* display, const Keys& more) {
    Keys all{display_key(display), "collectors.photons=1000", "collectors.samples=100",
             "camera.resolution=[12,8]", "medium.0.resolution=[10,10,8]"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

std::vector<std::string> hashes(const Scene& scene, int first, int last) {
    std::vector<std::string> out;
    RenderOptions options = one_thread();
    options.first_frame = first;
    options.last_frame = last;
    const Status status = render(scene, options, [&](int, Image& image, Report& report) {
        for (const Channel& c : image.channels)
            for (float v : c.pixels.span())
                if (!(v >= 0.0f && std::isfinite(v))) FAIL("not a radiance");
        out.push_back(report.hash);
        return Status::ok();
    });
    REQUIRE_MESSAGE(status, status.message);
    return out;
}

/// Mean green of one frame, cloud and ground together.
double light_of(const Scene& scene, int frame) {
    RenderOptions options = one_thread();
    options.first_frame = options.last_frame = frame;
    return mean_of(render_one(scene, options), "G");
}

}  // namespace

TEST_CASE("S62, S63: every frame is the one that starts afresh, after a jump of 180 degrees, too") {
    for (const char* display : kDisplays)
        for (const char* suns : {"[-90,90]", "[35,35]", "[0.0000001,-0.0000001]"})
            for (const char* generations : {"1", "3"}) {
                const Scene scene = bent_scene(
                    animated(display, {"animation.frames=6", "ground.altitude_m=0",
                                       std::string("animation.sun_elevation_deg=") + suns,
                                       std::string("collectors.generations=") + generations}));
                const std::vector<std::string> whole = hashes(scene, 0, 5);
                REQUIRE(whole.size() == 6);
                const std::string name = std::string(display) + " " + suns + " " + generations;
                for (int f = 0; f < 6; ++f) {
                    CAPTURE(name);
                    CAPTURE(f);
                    CHECK(hashes(scene, f, f)[0] == whole[std::size_t(f)]);
                }
            }
}

TEST_CASE("S63: a sun that rises during an animation lights it, one that sets leaves it dark") {
    for (const char* display : kDisplays) {
        const Keys move = animated(display, {"animation.frames=9", "ground.altitude_m=0",
                                             "collectors.generations=2", "sky.radiance=0"});
        Scene rising = bent_scene(move), setting = bent_scene(move), still = bent_scene(move);
        for (Scene* s : {&rising, &setting, &still}) s->animation.moves_sun = true;
        rising.sun.elevation_deg = -40;
        rising.animation.sun_elevation_deg = {-40, 40};
        setting.animation.sun_elevation_deg = {40, -40};
        still.animation.sun_elevation_deg = {40, 40};
        const double full = light_of(still, 8);
        CHECK(full > 0);
        // Before sunrise and a full ring after sunset nothing is lit; at noon all is.
        CHECK(light_of(rising, 0) == 0);
        CHECK(light_of(rising, 3) == 0);
        CHECK(light_of(setting, 8) == 0);
        std::printf("%s: rising %.4g %.4g %.4g, setting %.4g %.4g, still %.4g\n", display,
                    light_of(rising, 4), light_of(rising, 6), light_of(rising, 8),
                    light_of(setting, 0), light_of(setting, 4), full);
        CHECK(light_of(rising, 8) == doctest::Approx(full).epsilon(0.2));
        CHECK(light_of(setting, 0) == doctest::Approx(full).epsilon(0.2));
    }
}

TEST_CASE("S63: a ring of one generation and a still sun gives frames that differ by noise alone") {
    // Nothing moves: each frame has photons of its own, and their means agree.
    const Scene scene =
        bent_scene(animated("march", {"animation.frames=3", "collectors.generations=1"}));
    const std::vector<std::string> frames = hashes(scene, 0, 2);
    CHECK(frames[0] != frames[1]);
    CHECK(frames[1] != frames[2]);
    // One frame alone is the still picture.
    const Scene lone =
        bent_scene(animated("march", {"animation.frames=1", "collectors.generations=1"}));
    const Scene still = bent_scene(animated("march", {"collectors.generations=1"}));
    CHECK(hashes(lone, 0, 0)[0] == hashes(still, 0, 0)[0]);
}

TEST_CASE("S65: the caller's rounding, flushing and traps change no bit, and come back") {
    for (const char* display : kDisplays) {
        const Scene scene = bent_scene(animated(display, {"medium.0.extinction_per_m=1e-5"}));
        const std::string plain = hashes(scene, 0, 0)[0];
        for (int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
            std::fesetround(mode);
            const std::string other = hashes(scene, 0, 0)[0];
            const int after = std::fegetround();
            std::fesetround(FE_TONEAREST);
            CHECK(other == plain);
            CHECK(after == mode);
        }
#if defined(__SSE2__)
        const unsigned before = _mm_getcsr();
        _mm_setcsr(before | 0x8040u);  // flush to zero, denormals are zero
        const std::string flushed = hashes(scene, 0, 0)[0];
        const unsigned after = _mm_getcsr();
        _mm_setcsr(before);
        CHECK(flushed == plain);
        CHECK((after & 0x8040u) == 0x8040u);
        _mm_setcsr(before & ~0x1fbfu);  // every trap unmasked, no flag raised
        const std::string trapped = hashes(scene, 0, 0)[0];
        const unsigned armed = _mm_getcsr();
        _mm_setcsr(before);
        CHECK(trapped == plain);
        CHECK((armed & 0x1f80u) == 0u);
#endif
    }
}
