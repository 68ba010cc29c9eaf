// SPDX-License-Identifier: Apache-2.0
// The last pass over a picture writes the bytes that all stages one after the other write.
// in: small scenes by both ways -> out: equal bytes, also around them.
// docs/realtime.md, "One pass after the march"
#include "tests/embed/host_harness.h"

using namespace host_test;
using render_test::kSmallCumulus;

namespace {

/// 8-bit pixels, with some bytes after each row; asking for the hash has all planes made.
std::vector<unsigned char> pixels(Hosted& host, int width, int height, bool stepwise,
                                  bool bottom_up) {
    const std::size_t stride = 4 * std::size_t(width) + 12;
    std::vector<unsigned char> colour(stride * std::size_t(height), 7);
    auto frame = cleared<pileus_frame>();
    std::uint64_t hash = 0;
    frame.colour = colour.data();
    frame.colour_stride = std::int64_t(stride);
    frame.bottom_up = bottom_up ? 1 : 0;
    frame.exposure_stops = 0.5f;
    if (stepwise) frame.hash = &hash;
    host.check(pileus_session_render(host.session.get(), &frame, &host.out.error));
    return colour;
}

Overrides with(const Overrides& more) {
    Overrides all{"method.name=\"collectors\"", "collectors.generations=3",
                  "collectors.photons=3000"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

}  // namespace

TEST_CASE("late rows: the bytes of all stages one after the other") {
    const Overrides ways[] = {
        {},
        {"collectors.display=\"billboards\""},
        {"collectors.scale=2"},
        {"collectors.scale=4"},
        {"collectors.scale=4", "collectors.upsample=\"linear\""},
        {"collectors.scale=4", "collectors.upsample=\"nearest\""},
        {},
        {"method.name=\"photon-grid\"", "photon_grid.photons=3000"},
        {"method.name=\"photon-grid\"", "photon_grid.photons=3000", "photon_grid.scale=2"},
        {"method.name=\"raymarch\"", "raymarch.steps=24"},
        {"method.name=\"raymarch\"", "raymarch.steps=24", "raymarch.scale=4"},
        {"method.name=\"optical-depth\""},
    };
    // Within lanes and beyond, pictures smaller than a cell among them.
    const int sizes[][2] = {{1, 1}, {3, 2}, {17, 9}, {45, 27}, {96, 54}};
    for (std::size_t way = 0; way < sizeof ways / sizeof ways[0]; ++way) {
        CAPTURE(way);
        Hosted host(kSmallCumulus, with(ways[way]));
        REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
        if (way == 6) {
            const auto none = cleared<pileus_ground>();
            host.check(pileus_session_set_ground(host.session.get(), &none, &host.out.error));
        }
        host.step(host.whole());
        for (const auto& size : sizes) {
            CAPTURE(size[0]);
            // The horizon, ground and cloud are in view.
            const double from[3] = {16.0 + 40 * size[0], -4000, 256}, to[3] = {0, 0, 700};
            host.aim(from, to, 40, std::uint32_t(size[0]), std::uint32_t(size[1]));
            host.sun(120, 30 + size[1]);
            for (const bool bottom_up : {false, true}) {
                const auto late = pixels(host, size[0], size[1], false, bottom_up);
                CHECK(late == pixels(host, size[0], size[1], true, bottom_up));
                CHECK(late == pixels(host, size[0], size[1], false, bottom_up));
            }
        }
    }
}

TEST_CASE("late rows: what has more between the light and the pixels goes the other way") {
    // Lamps, an image of solids, and frames that the next one reads.
    const Overrides ways[] = {
        {"collectors.temporal=2"},
        {"collectors.scale=2"},
        {"collectors.scale=2"},
    };
    for (std::size_t way = 0; way < 3; ++way) {
        CAPTURE(way);
        const char* lamp = "[[light]]\ntype = \"point\"\nposition_m = [0, 0, 1500]\n";
        Hosted host(std::string(kSmallCumulus) + (way == 1 ? lamp : ""), with(ways[way]));
        REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
        host.step(host.whole());
        constexpr int kWidth = 45, kHeight = 27;
        std::vector<float> metres(std::size_t(kWidth) * kHeight, 4000.0f);
        for (std::size_t i = 0; i < metres.size() / 2; ++i) metres[i] = 1e6f;
        if (way == 2) {
            auto depth = cleared<pileus_depth_image>();
            depth.values = metres.data();
            const double from[3] = {16, -4000, 256}, to[3] = {0, 0, 700};
            host.aim(from, to, 40, kWidth, kHeight);
            host.check(pileus_session_set_depth(host.session.get(), &depth, &host.out.error));
        }
        for (int frame = 0; frame < 3; ++frame) {
            const double from[3] = {16.0 + 40 * frame, -4000, 256}, to[3] = {0, 0, 700};
            host.aim(from, to, 40, kWidth, kHeight);
            const auto late = pixels(host, kWidth, kHeight, false, false);
            if (way > 0) CHECK(late == pixels(host, kWidth, kHeight, true, false));
        }
        // A still camera and sun: frames of reprojection no longer change.
        for (int frame = 0; way == 0 && frame < 4; ++frame)
            (void)pixels(host, kWidth, kHeight, false, false);
        CHECK(pixels(host, kWidth, kHeight, false, false) ==
              pixels(host, kWidth, kHeight, true, false));
    }
}

TEST_CASE("late rows: a flight by reprojection, its background before or after") {
    const Overrides ways[] = {
        {"collectors.temporal=4"},
        {"method.name=\"raymarch\"", "raymarch.steps=24", "raymarch.temporal=4"},
        {"method.name=\"raymarch\"", "raymarch.steps=24", "raymarch.temporal=2",
         "raymarch.upsample=\"linear\""},
        {"method.name=\"photon-grid\"", "photon_grid.photons=3000", "photon_grid.temporal=2"},
    };
    for (const Overrides& way : ways) {
        CAPTURE(way.front());
        Hosted late(kSmallCumulus, with(way)), whole(kSmallCumulus, with(way));
        REQUIRE_MESSAGE(late.code == PILEUS_OK, late.out.line());
        constexpr int kWidth = 45, kHeight = 27;
        for (int frame = 0; frame < 7; ++frame) {
            CAPTURE(frame);
            const double from[3] = {16.0 + 60 * frame, -4000, 256}, to[3] = {0, 0, 700};
            for (Hosted* host : {&late, &whole}) {
                host->aim(from, to, 40, kWidth, kHeight);
                host->sun(120, 30 + frame / 2);
                host->step(host->whole());
            }
            CHECK(pixels(late, kWidth, kHeight, false, false) ==
                  pixels(whole, kWidth, kHeight, true, false));
        }
    }
}

TEST_CASE("late rows: the same bytes from every instruction set and number of threads") {
    std::vector<unsigned char> first;
    int sets = 0;
    for (const char* isa : {"scalar", "vec4", "sse2", "avx2", "avx512"})
        for (const std::uint32_t threads : {1u, 3u}) {
            CAPTURE(isa);
            CAPTURE(threads);
            auto lent = cleared<pileus_host>();
            lent.isa = isa;
            lent.threads = threads;
            Hosted host(kSmallCumulus, with({"collectors.scale=2"}), &lent);
            // This machine may not have it.
            if (host.code != PILEUS_OK) continue;
            ++sets;
            host.step(host.whole());
            const double from[3] = {16, -4000, 256}, to[3] = {0, 0, 700};
            host.aim(from, to, 40, 77, 41);
            const auto bytes = pixels(host, 77, 41, false, false);
            if (first.empty()) first = bytes;
            CHECK(bytes == first);
        }
    CHECK(sets >= 2);
}
