// SPDX-License-Identifier: Apache-2.0
// What a host lends: memory, threads, callbacks; and memory that ends at every moment.
// in: small scenes, hosts that count -> out: checks.
// docs/embedding.md, "What the library asks of its host"
#include <atomic>
#include <cfenv>
#include <cstdlib>
#include <thread>

#include "tests/embed/host_harness.h"

using namespace host_test;
using render_test::kSmallCumulus;

namespace {

/// Memory that is counted, and that ends at allocation number `fails_at`.
struct CountedMemory {
    std::atomic<long> calls{0}, held{0};
    long fails_at = -1;

    static void* allocate(void* user, std::size_t bytes, std::size_t alignment) {
        CountedMemory& own = *static_cast<CountedMemory*>(user);
        if (own.calls.fetch_add(1) == own.fails_at) return nullptr;
        void* memory =
            std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
        if (memory != nullptr) ++own.held;
        return memory;
    }
    static void release(void* user, void* memory) {
        if (memory != nullptr) --static_cast<CountedMemory*>(user)->held;
        std::free(memory);
    }
    pileus_host host() {
        auto made = cleared<pileus_host>();
        made.user = this;
        made.allocate = allocate;
        made.release = release;
        made.threads = 2;
        return made;
    }
};

Overrides method(const char* name) {
    return {std::string("method.name=\"") + name + "\"", "path.samples_per_pixel=2",
            "collectors.generations=3", "collectors.photons=300"};
}

/// A picture from nothing; the first code that is not fine.
pileus_code draw(const char* name, const pileus_host* lent, std::string* hash = nullptr) {
    Hosted host(kSmallCumulus, method(name), lent);
    if (host.code != PILEUS_OK) return host.code;
    std::uint32_t done = 0;
    const pileus_code stepped = pileus_session_step(host.session.get(), 3, &done, &host.out.error);
    if (stepped != PILEUS_OK) return stepped;
    std::vector<float> pixels(4 * 24 * 14), depth(24 * 14);
    auto frame = cleared<pileus_frame>();
    std::uint64_t digest = 0;
    frame.colour = pixels.data();
    frame.format = PILEUS_FORMAT_RGBA32F;
    frame.depth = depth.data();
    frame.hash = &digest;
    const pileus_code drawn = pileus_session_render(host.session.get(), &frame, &host.out.error);
    if (drawn == PILEUS_OK && hash != nullptr) *hash = std::to_string(digest);
    return drawn;
}

}  // namespace

TEST_CASE("hosts: every array comes from the host's memory and goes back") {
    for (const char* name : {"collectors", "raymarch", "path"}) {
        CAPTURE(name);
        std::string own, lent;
        REQUIRE(draw(name, nullptr, &own) == PILEUS_OK);
        CountedMemory memory;
        const pileus_host host = memory.host();
        REQUIRE(draw(name, &host, &lent) == PILEUS_OK);
        CHECK(own == lent);
        CHECK(memory.calls > 10);
        CHECK(memory.held == 0);
    }
}

TEST_CASE("hosts: memory that ends at any moment is a code, and nothing is leaked") {
    for (const char* name : {"collectors", "raymarch", "path"}) {
        CAPTURE(name);
        CountedMemory all;
        const pileus_host counted = all.host();
        REQUIRE(draw(name, &counted) == PILEUS_OK);
        for (long at = 0; at < all.calls; ++at) {
            CountedMemory memory;
            memory.fails_at = at;
            const pileus_host host = memory.host();
            CHECK(draw(name, &host) == PILEUS_ERROR_LIMIT);
            CHECK(memory.held == 0);
        }
    }
}

TEST_CASE("hosts: threads of the host's own, one after the other or at once") {
    std::string expected;
    REQUIRE(draw("collectors", nullptr, &expected) == PILEUS_OK);
    auto host = cleared<pileus_host>();
    host.threads = 3;
    for (const bool at_once : {false, true}) {
        if (at_once)
            host.run = [](void*, std::uint32_t count, void (*body)(void*, std::uint32_t),
                          void* data) {
                std::vector<std::thread> threads;
                for (std::uint32_t i = 0; i < count; ++i) threads.emplace_back(body, data, i);
                for (std::thread& t : threads) t.join();
            };
        else
            host.run = [](void*, std::uint32_t count, void (*body)(void*, std::uint32_t),
                          void* data) {
                for (std::uint32_t i = count; i-- > 0;) body(data, i);
            };
        std::string hash;
        REQUIRE(draw("collectors", &host, &hash) == PILEUS_OK);
        CHECK(hash == expected);
    }
}

TEST_CASE("hosts: a stop ends a step, and what is there can be drawn") {
    auto host = cleared<pileus_host>();
    int asked = 0;
    host.user = &asked;
    host.threads = 1;
    host.stop = [](void* user) { return std::int32_t(++*static_cast<int*>(user) > 2); };
    double last = -1;
    Hosted hosted(kSmallCumulus, method("collectors"), &host);
    REQUIRE(hosted.code == PILEUS_OK);
    const std::uint32_t done = hosted.step(1000);
    CHECK(done < 1000);
    CHECK(hosted.hash().size() == 16);
    (void)last;
}

TEST_CASE("hosts: the floating-point mode of the caller stays, and changes nothing") {
    std::string expected, other;
    REQUIRE(draw("raymarch", nullptr, &expected) == PILEUS_OK);
    REQUIRE(std::fesetround(FE_UPWARD) == 0);
    const pileus_code code = draw("raymarch", nullptr, &other);
    const int mode = std::fegetround();
    std::fesetround(FE_TONEAREST);
    CHECK(code == PILEUS_OK);
    CHECK(mode == FE_UPWARD);
    CHECK(other == expected);
}
