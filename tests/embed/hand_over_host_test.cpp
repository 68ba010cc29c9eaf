// SPDX-License-Identifier: Apache-2.0
// Hand-overs as a host sees them: refusals, memory, threads, 8-bit pixels, particles.
// in: two sessions over two densities -> out: checks.
// docs/living.md
#include <thread>

#include "tests/embed/living_harness.h"

using namespace host_test;

TEST_CASE("hand-over: 8-bit pictures, whose rows are made late, fade as floats do") {
    for (const Overrides& way : {with("collectors"), with("collectors", {"collectors.scale=2"}),
                                 with("raymarch", {"raymarch.scale=2"}), with("photon-grid")}) {
        CAPTURE(way[0]);
        Living late(way), whole(way), next(later(way)), other(later(way));
        late.bytes();
        whole.pixels();
        late.hand_over(next, 3);
        whole.hand_over(other, 3);
        for (int i = 0; i < 4; ++i) CHECK(late.hash() == whole.hash());
    }
}

TEST_CASE("hand-over: what is refused leaves the session as it was") {
    const Overrides way = with("collectors");
    Living now(way), march(with("raymarch")),
        small(with("collectors", {"camera.resolution=[8,8]"}));
    auto one = cleared<pileus_host>();
    one.threads = 3;
    Living threaded(way, &one);
    Living next(later(way));
    const std::string hash = now.hash();
    CHECK(now.refused(nullptr) == "next: null, allowed: what a function of pileus made");
    CHECK(now.refused(now.session.get()) ==
          "hand_over: next is the session itself, allowed: another");
    CHECK(now.refused(march.session.get()) ==
          "hand_over: next has method \"raymarch\", allowed: \"collectors\", as the session");
    CHECK(now.refused(small.session.get()) ==
          "hand_over: next has pictures of 8 x 8, allowed: 24 x 14, as the session");
    Hosted sky(
        "[camera]\nposition_m = [0, -9, 9]\ntarget_m = [0, 0, 9]\n[sky]\nradiance = [0.1, 0.2, "
        "0.4]\n",
        {"method.name=\"collectors\"", "camera.resolution=[24,14]"});
    CHECK(now.refused(sky.session.get()) ==
          "hand_over: a world without media, allowed: one with a density that gives way to "
          "another");
    CHECK(now.refused(next.session.get(), 10001) ==
          "hand_over: frames: 10001, allowed: 0 to 10000");
    CHECK(now.refused(threaded.session.get()).find("next has 3 threads, allowed: ") !=
          std::string::npos);
    CHECK(pileus_session_hand_over(nullptr, next.session.get(), 2, nullptr) == PILEUS_ERROR_INPUT);
    CHECK(now.hash() == hash);
    CHECK(next.hash() == Living(later(way)).hash());
}

TEST_CASE("hand-over: memory goes back to whom it came from, whoever is freed first") {
    struct Ledger {
        std::int64_t held = 0;
    } first, second;
    const auto host_of = [](Ledger& ledger) {
        auto host = cleared<pileus_host>();
        host.threads = 1;
        host.user = &ledger;
        host.allocate = [](void* user, std::size_t bytes, std::size_t alignment) -> void* {
            ++static_cast<Ledger*>(user)->held;
            return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
        };
        host.release = [](void* user, void* memory) {
            --static_cast<Ledger*>(user)->held;
            std::free(memory);
        };
        return host;
    };
    const pileus_host a = host_of(first), b = host_of(second);
    const Overrides way = with("collectors");
    {
        Living now(way, &a);
        {
            Living next(later(way), &b);
            now.hash();
            now.hand_over(next, 4);
            now.hash();
        }
        // While it fades: the session that draws has memory of both.
        CHECK(first.held > 0);
        CHECK(second.held > 0);
        now.hash();
    }
    CHECK(first.held == 0);
    CHECK(second.held == 0);
}

TEST_CASE("hand-over: pictures do not depend on threads or on who made the next session") {
    const auto flight = [](std::uint32_t threads, bool beside) {
        auto host = cleared<pileus_host>();
        host.threads = threads;
        const Overrides way = with("collectors");
        Living now(way, &host);
        std::string hashes = now.hash();
        for (int k = 0; k < 2; ++k) {
            std::unique_ptr<Living> next;
            const auto make = [&] { next = std::make_unique<Living>(later(way), &host); };
            if (beside)
                std::thread(make).join();
            else
                make();
            now.hand_over(*next, 3);
            for (int i = 0; i < 4; ++i) {
                now.orbit(0.3 * (4 * k + i));
                now.step(1);
                hashes += " " + now.hash();
            }
        }
        return hashes;
    };
    const std::string alone = flight(1, false);
    CHECK(flight(3, false) == alone);
    CHECK(flight(2, true) == alone);
}

TEST_CASE("hand-over: particles that move, from a host's memory") {
    const char* const text =
        "[camera]\nposition_m = [0, -300, 50]\ntarget_m = [0, 0, 50]\nresolution = [16, 12]\n"
        "[sun]\nelevation_deg = 30\nazimuth_deg = 100\n"
        "[[medium]]\ndensity = \"none.ply\"\n[output]\nlayers = [\"radiance\", \"alpha\"]\n";
    const SceneHandle scene = scene_of(text, {"method.name=\"particles\""});
    Outcome out;
    const auto session_of = [&](float east) {
        const float places[2][3] = {{east, 0, 50}, {-20, 4, 60}}, radii[2] = {24, 16};
        auto particles = cleared<pileus_particles>();
        particles.count = 2;
        particles.position = places[0];
        particles.position_stride = sizeof places[0];
        particles.radius = radii;
        particles.radius_stride = sizeof radii[0];
        auto density = cleared<pileus_density>();
        density.particles = &particles;
        pileus_world* world = nullptr;
        pileus_session* session = nullptr;
        REQUIRE_MESSAGE(
            pileus_world_create(scene.get(), nullptr, &density, 1, &world, &out.error) == PILEUS_OK,
            out.line());
        const WorldHandle kept(world);
        REQUIRE_MESSAGE(
            pileus_session_create(world, scene.get(), nullptr, &session, &out.error) == PILEUS_OK,
            out.line());
        return SessionHandle(session);
    };
    const auto pixels_of = [&](const SessionHandle& session) {
        Pixels made(16 * 12 * 4);
        auto frame = cleared<pileus_frame>();
        frame.colour = made.data();
        frame.format = PILEUS_FORMAT_RGBA32F;
        REQUIRE(pileus_session_render(session.get(), &frame, &out.error) == PILEUS_OK);
        return made;
    };
    const SessionHandle now = session_of(0), next = session_of(12), alone = session_of(12);
    const Pixels old = pixels_of(now), fresh = pixels_of(alone);
    REQUIRE(largest(old, fresh) > 0.01);
    REQUIRE(pileus_session_hand_over(now.get(), next.get(), 2, &out.error) == PILEUS_OK);
    const Pixels half = pixels_of(now);
    for (std::size_t p = 3; p < half.size(); p += 4)
        CHECK(std::fabs(double(half[p]) - 0.5 * (double(old[p]) + double(fresh[p]))) <= kRounding);
    CHECK(largest(pixels_of(now), fresh) == 0);
}

TEST_CASE("hand-over: pixels that are written late fade with a camera that moves, too") {
    const Overrides way = with("collectors", {"collectors.scale=2"});
    Living late(way), whole(way), next(later(way)), other(later(way));
    late.bytes();
    whole.pixels();
    late.hand_over(next, 4);
    whole.hand_over(other, 4);
    for (int i = 1; i < 4; ++i) {
        late.shift(20 * i, kWidth, kHeight);
        whole.shift(20 * i, kWidth, kHeight);
        CHECK(late.hash() == whole.hash());
    }
}
