// SPDX-License-Identifier: Apache-2.0
// Hand-overs: the next density comes in by weights, to the bit what both pictures say.
// in: two sessions over two densities -> out: checks.
// docs/living.md
#include "tests/embed/living_harness.h"

using namespace host_test;

namespace {

const std::vector<Overrides>& all_methods() {
    static const std::vector<Overrides> methods{
        with("collectors"),
        with("collectors", {"collectors.display=\"billboards\""}),
        with("collectors", {"collectors.scale=2"}),
        with("raymarch"),
        with("raymarch", {"raymarch.temporal=2"}),
        with("optical-depth"),
        with("photon-grid", {"photon_grid.ring=true"}),
        with("photon-grid"),
        with("path")};
    return methods;
}

Pixels blend(const Pixels& a, const Pixels& b, double share) {
    Pixels made(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        made[i] = float((1 - share) * double(a[i]) + share * double(b[i]));
    return made;
}

}  // namespace

TEST_CASE("hand-over: picture i of n has i / n of the next density, in every method") {
    for (const Overrides& way : all_methods()) {
        CAPTURE(way[0]);
        Living now(way), next(later(way)), alone(later(way));
        const Pixels old = now.pixels(), fresh = alone.pixels();
        REQUIRE(largest(old, fresh) > 0.01);
        now.hand_over(next, 4);
        for (int i = 1; i <= 5; ++i) {
            CAPTURE(i);
            const double share = i < 4 ? i / 4.0 : 1;
            const Pixels shown = now.pixels(), last = i == 1 ? fresh : alone.pixels();
            // Colour and shadowed ground are mixed apart: their product is not that of the mixture.
            const double apart = share < 1 ? 0.25 * largest(old, last) : 0;
            CHECK(largest(shown, blend(old, last, share)) <= apart + kRounding);
            const Pixels alpha = blend(old, last, share);
            for (std::size_t p = 3; p < shown.size(); p += 4)
                CHECK(std::fabs(double(shown[p]) - double(alpha[p])) <= kRounding);
        }
        // The state that was given back draws on as before.
        CHECK(next.hash() == Living(way).hash());
    }
}

TEST_CASE("hand-over: the same density changes nothing, to the bit") {
    for (const Overrides& way : all_methods()) {
        // Their pictures differ from one to the next.
        if (way.back() == "raymarch.temporal=2") continue;
        CAPTURE(way[0]);
        Living now(way), next(way);
        const Pixels before = now.pixels();
        const std::string hash = now.hash();
        now.hand_over(next, 3);
        for (int i = 0; i < 4; ++i) CHECK(largest(now.pixels(), before) == 0);
        CHECK(now.hash() == hash);
    }
}

TEST_CASE("hand-over: lumps that grow older, over a density that stays") {
    for (const char* method : {"raymarch", "collectors"}) {
        CAPTURE(method);
        const auto aged = [&](double age) {
            return with(method, {"medium.0.detail.tile_m=900", "medium.0.detail.strength=1",
                                 "medium.0.detail.age=" + std::to_string(age)});
        };
        Living now(aged(0)), none(with(method));
        const Pixels young = now.pixels();
        CHECK(largest(young, none.pixels()) > 0.01);
        double before = 0;
        for (const double age : {0.25, 0.5, 1.0}) {
            CAPTURE(age);
            Living next(aged(age)), alone(aged(age));
            now.hand_over(next, 2);
            now.pixels();
            const Pixels shown = now.pixels();
            CHECK(largest(shown, alone.pixels()) == 0);
            CHECK(largest(shown, young) > before);
            before = 0.5 * largest(shown, young);
        }
    }
}

TEST_CASE("hand-over: over 0 and 1 pictures, and before the first one, it switches at once") {
    const Overrides way = with("collectors");
    const std::string fresh = Living(later(way)).hash();
    for (const std::uint32_t frames : {0u, 1u, 5u}) {
        Living now(way), next(later(way));
        if (frames < 2) now.hash();
        now.hand_over(next, frames);
        CHECK(now.hash() == fresh);
    }
}

TEST_CASE("hand-over: while an earlier one fades it goes on from the mixture") {
    const Overrides way = with("raymarch");
    Living now(way), second(later(way)), third(way), alone(later(way));
    const Pixels old = now.pixels(), fresh = alone.pixels();
    now.hand_over(second, 4);
    now.pixels();
    const Pixels half = now.pixels();
    now.hand_over(third, 2);
    // Half of the half that was mixed is still of the second density.
    const Pixels shown = now.pixels();
    CHECK(largest(shown, blend(half, old, 0.5)) <= 0.25 * largest(old, fresh));
    for (std::size_t p = 3; p < shown.size(); p += 4)
        CHECK(std::fabs(double(shown[p]) - (0.75 * double(old[p]) + 0.25 * double(fresh[p]))) <=
              kRounding);
    CHECK(largest(now.pixels(), old) == 0);
}

TEST_CASE("hand-over: a camera that moves sees the old picture where it was") {
    // Of the same density: what moves wrongly shows as a difference.
    const std::string size = "camera.resolution=[192,112]";
    for (const Overrides& way : {with("collectors", {size}), with("raymarch", {size}),
                                 with("photon-grid", {size, "photon_grid.ring=true"})}) {
        CAPTURE(way[0]);
        Living now(way), next(way), alone(way);
        const Pixels start = now.pixels();
        now.hand_over(next, 6);
        double carried = 0, left = 0;
        for (int i = 1; i < 6; ++i) {
            now.shift(30 * i, 192, 112);
            alone.shift(30 * i, 192, 112);
            const Pixels shown = now.pixels(), fresh = alone.pixels();
            for (std::size_t p = 0; p < shown.size(); ++p) {
                carried += std::pow(double(shown[p]) - double(fresh[p]), 2);
                left += std::pow((1 - i / 6.0) * (double(start[p]) - double(fresh[p])), 2);
            }
        }
        // What is left are sharp edges between pixels, about 0.005 of it.
        CHECK(carried < 0.02 * left);
    }
}

TEST_CASE("hand-over: a cut to another view, or to another size, shows that view alone") {
    const Overrides way = with("raymarch");
    Living now(way), next(later(way)), alone(later(way));
    now.pixels();
    now.hand_over(next, 6);
    now.pixels();
    now.orbit(90);
    alone.orbit(90);
    CHECK(now.hash() == alone.hash());
    now.orbit(0);
    alone.orbit(0);
    CHECK(now.hash() == alone.hash());
    Living wide(way), late(later(way));
    wide.pixels();
    wide.hand_over(late, 6);
    wide.aim(kPosition, kTarget, 40, 40, 20);
    CHECK(wide.pixels().size() == 40u * 20 * 4);
}

TEST_CASE("hand-over: camera, place, frame and work stay, light is the next one's") {
    const Overrides way = with("collectors", {"collectors.scale=2"});
    Living now(way), next(later(way)), alone(later(way));
    auto work = cleared<pileus_work>();
    work.scale = 4;
    auto place = cleared<pileus_placement>();
    place.offset_m[0] = 100;
    for (Living* session : {&now, &alone}) {
        session->orbit(20);
        session->check(pileus_session_set_work(session->session.get(), &work, &session->out.error));
        session->check(
            pileus_session_set_placement(session->session.get(), &place, &session->out.error));
        session->check(pileus_session_set_frame(session->session.get(), 7, &session->out.error));
    }
    next.sun(200, 50);
    alone.sun(200, 50);
    now.hash();
    now.hand_over(next, 1);
    CHECK(now.hash() == alone.hash());
    // A sun that moves while the old picture fades moves in the new one.
    Living again(way);
    now.hand_over(again, 3);
    Living lit(way);
    lit.orbit(20);
    lit.check(pileus_session_set_work(lit.session.get(), &work, &lit.out.error));
    lit.check(pileus_session_set_placement(lit.session.get(), &place, &lit.out.error));
    lit.check(pileus_session_set_frame(lit.session.get(), 7, &lit.out.error));
    for (Living* session : {&now, &lit}) {
        session->sun(140, 36);
        session->step(4);
    }
    lit.hash();
    for (int i = 0; i < 2; ++i) now.hash();
    lit.hash();
    CHECK(now.hash() == lit.hash());
}

TEST_CASE("hand-over: a solid thing that moves is not seen twice") {
    const Overrides way = with("raymarch");
    Living now(way), next(way);
    std::vector<float> depth(kWidth * kHeight, 1e30f);
    const auto wall = [&](std::size_t column) {
        for (std::size_t y = 0; y < kHeight; ++y)
            for (std::size_t x = 0; x < kWidth; ++x)
                depth[y * kWidth + x] = x == column ? 1000.0f : 1e30f;
        auto image = cleared<pileus_depth_image>();
        image.values = depth.data();
        now.check(pileus_session_set_depth(now.session.get(), &image, &now.out.error));
    };
    wall(4);
    now.pixels();
    now.hand_over(next, 4);
    wall(12);
    const Pixels shown = now.pixels();
    // Behind the wall is no cloud, and where it was is no hole.
    for (std::size_t y = 0; y < kHeight; ++y) CHECK(shown[4 * (y * kWidth + 12) + 3] == 0);
    Living alone(way);
    const Pixels open = alone.pixels();
    for (std::size_t y = 0; y < kHeight; ++y)
        CHECK(shown[4 * (y * kWidth + 4) + 3] == open[4 * (y * kWidth + 4) + 3]);
}
