// SPDX-License-Identifier: Apache-2.0
// Skies of many clouds: corners, and what is refused.
// in: small skies -> out: checks.
// docs/clouds.md
#include <atomic>
#include <cmath>
#include <cstdlib>

#include "tests/embed/clouds_harness.h"

using namespace clouds_test;

TEST_CASE("clouds: corners have pictures") {
    // The eye within a cloud, straight below it, looking away; one pixel; parallel rays; a low sun.
    CloudySky sky({at(0, 0, 0), at(0, 0, 0, 360), at(0, 0, 9000), at(0, -9000, 0)});
    const struct {
        double from[3], to[3];
        std::uint32_t width, height;
    } rows[] = {{{0, 0, 1000}, {0, 10, 1000}, 24, 14},
                {{0, 0, 10}, {0, 10, 1000}, 24, 14},
                {{0, 20000, 100}, {0, 30000, 100}, 24, 14},
                {{0, -3000, 800}, {0, 0, 800}, 1, 1},
                {{-768, -768, 512}, {768, 768, 1536}, 7, 3}};
    for (const bool off : {true, false}) {
        sky.detail(off, off ? 0 : 4);
        for (const auto& row : rows)
            for (const double sun : {90.0, 0.0, -5.0, 3.0}) {
                sky.sky.sun(180, sun);
                sky.sky.aim(row.from, row.to, 70, row.width, row.height);
                for (const float v : sky.draw().rgba) CHECK((v >= 0 && v < 100));
            }
    }
    auto camera = cleared<pileus_camera>();
    camera.position_m[1] = -5000;
    camera.position_m[2] = camera.target_m[2] = 1000;
    camera.height_m = 3000;
    CHECK(pileus_session_set_camera(sky.sky.session.get(), &camera, &sky.out.error) == PILEUS_OK);
    CHECK(sky.draw(PILEUS_BLEND_MEDIA).sum(3) > 0);
}

TEST_CASE("clouds: wrong use has a line and changes nothing") {
    CloudySky sky({at(0, 0, 0)});
    const Picture before = sky.draw();
    pileus_clouds* const clouds = sky.clouds.get();
    const auto refused = [&](pileus_code code, const char* word) {
        CHECK(code == PILEUS_ERROR_INPUT);
        CHECK_MESSAGE(sky.out.line().find(word) != std::string::npos, sky.out.line());
        CHECK(sky.out.line().find("allowed") != std::string::npos);
    };
    for (const auto& spoil :
         {+[](pileus_cloud& c) { c.kind = 1; }, +[](pileus_cloud& c) { c.scale = -1; },
          +[](pileus_cloud& c) { c.yaw_deg = std::nan(""); },
          +[](pileus_cloud& c) { c.offset_m[2] = -INFINITY; }}) {
        pileus_cloud place = at(0, 0, 0);
        spoil(place);
        refused(pileus_clouds_place(clouds, &place, 1, &sky.out.error), "places[0].");
    }
    refused(pileus_clouds_place(clouds, nullptr, 1, &sky.out.error), "places");
    const std::vector<pileus_cloud> many(1001, at(0, 0, 0));
    refused(pileus_clouds_place(clouds, many.data(), 1001, &sky.out.error), "count");
    auto detail = cleared<pileus_cloud_detail>();
    detail.near_scale = 3;
    refused(pileus_clouds_set_detail(clouds, &detail, &sky.out.error), "detail.near_scale: 3");
    pileus_clouds* made = nullptr;
    refused(pileus_clouds_create(sky.kind.session.get(), &made, &sky.out.error), "sky");
    CHECK(made == nullptr);
    CHECK(pileus_clouds_create(nullptr, &made, &sky.out.error) == PILEUS_ERROR_INPUT);
    refused(pileus_clouds_add_kind(clouds, sky.sky.world.get(), sky.sky.scene.get(), nullptr,
                                   &sky.out.error),
            "kind");
    refused(pileus_clouds_add_kind(clouds, nullptr, sky.kind.scene.get(), nullptr, &sky.out.error),
            "world");
    const Hosted billboards(kSmallCumulus, {"collectors.display=billboards"});
    refused(pileus_clouds_add_kind(clouds, billboards.world.get(), billboards.scene.get(), nullptr,
                                   &sky.out.error),
            "billboards");
    for (const auto& call :
         {+[](pileus_error* e) { return pileus_clouds_place(nullptr, nullptr, 0, e); },
          +[](pileus_error* e) { return pileus_clouds_set_detail(nullptr, nullptr, e); },
          +[](pileus_error* e) { return pileus_clouds_render(nullptr, nullptr, e); },
          +[](pileus_error* e) { return pileus_clouds_stats(nullptr, nullptr, e); }})
        refused(call(&sky.out.error), "clouds");
    refused(pileus_clouds_render(clouds, nullptr, &sky.out.error), "frame");
    pileus_clouds_free(nullptr);
    CHECK(sky.draw().hash == before.hash);
}

TEST_CASE("clouds: turns that take more memory than is allowed are refused before they are made") {
    auto host = cleared<pileus_host>();
    host.memory_limit = std::uint64_t{192} << 20;
    std::vector<pileus_cloud> places;
    for (int i = 0; i < 300; ++i) places.push_back(at(4000.0 * i, 0, 0, i));
    CloudySky sky({at(0, 0, 0)}, {}, false, &host);
    const Picture one = sky.draw();
    sky.place(places);
    auto frame = cleared<pileus_frame>();
    std::vector<float> pixels(4 * std::size_t(one.width) * one.height);
    frame.colour = pixels.data();
    frame.format = PILEUS_FORMAT_RGBA32F;
    CHECK(pileus_clouds_render(sky.clouds.get(), &frame, &sky.out.error) == PILEUS_ERROR_LIMIT);
    CHECK_MESSAGE(
        sky.out.line().find("clouds: light of 300 kinds and turns: limits.memory: needs ") == 0,
        sky.out.line());
    CHECK(sky.stats().lit == 0);
    // Of four turns there is enough; those of other places have gone.
    for (int i = 0; i < 300; ++i) places[std::size_t(i)].yaw_deg = 90 * (i % 4);
    sky.place(places);
    CHECK(sky.draw().sum(3) > 0);
    sky.place({at(0, 0, 0)});
    CHECK(sky.draw().hash == one.hash);
}

TEST_CASE("clouds: where memory ends within a picture, the next one is whole") {
    struct Memory {
        std::atomic<long> left{1L << 40};
    } memory;
    auto host = cleared<pileus_host>();
    host.threads = 1;
    host.user = &memory;
    host.allocate = [](void* user, size_t bytes, size_t alignment) -> void* {
        if (static_cast<Memory*>(user)->left.fetch_sub(1) <= 0) return nullptr;
        return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    };
    host.release = [](void*, void* given) { std::free(given); };
    const std::vector<pileus_cloud> places{at(0, 0, 0), at(9000, 20000, 0, 90)};
    std::uint64_t whole = 0;
    int refused = 0;
    for (long most = 1L << 30; most >= 0; most = most > 1000 ? 60 : most - 4) {
        CloudySky sky(places, {}, true, &host);
        sky.detail(false, 16);
        memory.left = most;
        auto frame = cleared<pileus_frame>();
        std::uint64_t hash = 0;
        frame.hash = &hash;
        const pileus_code code = pileus_clouds_render(sky.clouds.get(), &frame, &sky.out.error);
        memory.left = 1L << 40;
        REQUIRE((code == PILEUS_OK || code == PILEUS_ERROR_LIMIT));
        refused += code == PILEUS_ERROR_LIMIT;
        hash = sky.draw().hash;
        if (whole == 0) whole = hash;
        CAPTURE(most);
        CHECK(hash == whole);
    }
    CHECK(refused > 5);
}
