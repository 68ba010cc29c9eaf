// SPDX-License-Identifier: Apache-2.0
// What a host made is freed in any order: each object keeps what it needs.
// in: a sky of clouds and all that it was made of, freed in every order, and sessions that handed
// over -> out: pictures as before while there is something to draw, all memory given back.
// docs/embedding.md
#include <algorithm>
#include <cstdlib>
#include <map>

#include "include/pileus/pileus.h"
#include "tests/embed/clouds_harness.h"

using namespace clouds_test;

namespace {

/// Memory of a host, which knows what is out, and spoils what comes back.
struct Counting {
    std::map<void*, std::size_t> out;
    pileus_host host = cleared<pileus_host>();

    Counting() {
        host.threads = 1;
        host.user = this;
        host.allocate = [](void* user, std::size_t bytes, std::size_t alignment) {
            void* const memory =
                std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
            static_cast<Counting*>(user)->out[memory] = bytes;
            return memory;
        };
        host.release = [](void* user, void* memory) {
            auto& own = *static_cast<Counting*>(user);
            const auto at = own.out.find(memory);
            REQUIRE(at != own.out.end());
            std::memset(memory, 0xa5, at->second);
            own.out.erase(at);
            std::free(memory);
        };
    }
    Counting(const Counting&) = delete;
};

/// A sky of two clouds, its parts by number.
struct Parts {
    Hosted sky, kind;
    std::unique_ptr<pileus_clouds, FreeClouds> clouds;
    static constexpr int kCount = 7;

    explicit Parts(const pileus_host* host)
        : sky(sky_text(), {"method.name=raymarch", "camera.resolution=[16,9]"}, host),
          kind(kSmallCumulus,
               add(kMarch, {"camera.resolution=[16,9]", "medium.0.resolution=[6,6,6]"}), host) {
        Outcome out;
        pileus_clouds* made = nullptr;
        REQUIRE(pileus_clouds_create(sky.session.get(), &made, &out.error) == PILEUS_OK);
        clouds.reset(made);
        REQUIRE(pileus_clouds_add_kind(made, kind.world.get(), kind.scene.get(), nullptr,
                                       &out.error) == PILEUS_OK);
        const pileus_cloud places[2] = {at(0, 0, 0), at(300, 0, 0)};
        REQUIRE(pileus_clouds_place(made, places, 2, &out.error) == PILEUS_OK);
    }
    void free(int part) {
        if (part == 0) sky.scene.reset();
        if (part == 1) sky.world.reset();
        if (part == 2) sky.session.reset();
        if (part == 3) kind.scene.reset();
        if (part == 4) kind.world.reset();
        if (part == 5) kind.session.reset();
        if (part == 6) clouds.reset();
    }
    std::uint64_t draw() {
        auto frame = cleared<pileus_frame>();
        std::uint64_t hash = 0;
        frame.hash = &hash;
        Outcome out;
        const pileus_code code = pileus_clouds_render(clouds.get(), &frame, &out.error);
        REQUIRE_MESSAGE(code == PILEUS_OK, out.line());
        return hash;
    }
};

}  // namespace

TEST_CASE("a sky of clouds, its session, worlds and scenes are freed in every order") {
    Counting memory;
    int order[Parts::kCount] = {0, 1, 2, 3, 4, 5, 6};
    std::uint64_t expected = 0;
    {
        Parts parts(&memory.host);
        expected = parts.draw();
    }
    int turns = 0;
    do {
        // Of all orders of seven those that differ in what a sky reads, and some of the others.
        if (++turns % 211 != 0 && !(order[0] == 2 && order[1] == 1)) continue;
        Parts parts(&memory.host);
        for (const int part : order) {
            parts.free(part);
            if (parts.clouds != nullptr && part == 2) REQUIRE(parts.draw() == expected);
        }
        REQUIRE(memory.out.empty());
    } while (std::next_permutation(order, order + Parts::kCount));
    CHECK(turns == 5040);
}

TEST_CASE("several skies over one session outlive it, and one another") {
    Counting memory;
    for (int first = 0; first < 3; ++first) {
        Parts parts(&memory.host);
        Outcome out;
        pileus_clouds* second = nullptr;
        REQUIRE(pileus_clouds_create(parts.sky.session.get(), &second, &out.error) == PILEUS_OK);
        if (first == 0) parts.sky.session.reset();
        if (first == 1) parts.clouds.reset();
        if (first == 2) pileus_clouds_free(second), second = nullptr;
        parts.sky.session.reset();
        auto stats = cleared<pileus_cloud_stats>();
        if (second != nullptr) CHECK(pileus_clouds_stats(second, &stats, &out.error) == PILEUS_OK);
        if (parts.clouds != nullptr) CHECK(parts.draw() != 0);
        pileus_clouds_free(second);
        parts.clouds.reset();
        parts.kind.session.reset(), parts.kind.world.reset(), parts.sky.world.reset();
        CHECK(memory.out.empty());
    }
}

TEST_CASE("sessions that handed over are freed in any order, with their worlds and hosts' memory") {
    for (int order = 0; order < 6; ++order) {
        Counting memory, other;
        Hosted old(kSmallCumulus, add(kMarch, {"camera.resolution=[16,9]"}), &memory.host);
        Hosted next(kSmallCumulus, add(kMarch, {"camera.resolution=[16,9]", "seed=5"}),
                    &other.host);
        old.hash();
        old.check(
            pileus_session_hand_over(old.session.get(), next.session.get(), 4, &old.out.error));
        if (order % 3 == 1) old.world.reset(), old.scene.reset();
        if (order % 3 == 2) next.world.reset(), next.scene.reset();
        if (order < 3) {
            next.session.reset();
            CHECK(old.hash().size() == 16);
            old.session.reset();
        } else {
            old.session.reset();
            CHECK(next.hash().size() == 16);
            next.session.reset();
        }
        old.world.reset(), next.world.reset();
        CHECK(memory.out.empty());
        CHECK(other.out.empty());
    }
}
