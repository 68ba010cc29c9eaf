// SPDX-License-Identifier: Apache-2.0
// Memory that ends within a frame of a flight: told, and the next frame is drawn.
// in: flights of every method, an array refused at each place in turn; blocks of every size -> out:
// a code, nothing kept. docs/flight.md, "Memory"
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "include/pileus/pileus.h"
#include "src/flight/block.h"
#include "tests/flight/flight_scene.h"
#include "tests/support/long_tests.h"

namespace pileus {
namespace {

/// A block that refuses one array, so many from now.
struct Refusing {
    Block* block = nullptr;
    long left = -1;  ///< below 0: refuses none

    Allocator allocator() {
        return {[](void* user, std::size_t bytes, std::size_t) {
                    auto& own = *static_cast<Refusing*>(user);
                    if (own.left >= 0 && own.left-- == 0) return static_cast<void*>(nullptr);
                    return own.block->take(bytes);
                },
                [](void* user, void* memory) { static_cast<Refusing*>(user)->block->give(memory); },
                this, true};
    }
};

const std::vector<std::string> kShortRows[] = {
    {"method.name=collectors"},
    {"method.name=collectors", "collectors.display=billboards"},
    {"method.name=collectors", "camera.position_m=[0,-100,1000]", "collectors.scale=2"},
    {"method.name=raymarch", "raymarch.temporal=4"},
    {"method.name=optical-depth"},
    {"method.name=photon-grid", "photon_grid.ring=true"},
    {"method.name=path"},
    {"method.name=path", "filter.kind=regression"},
    {"method.name=particles", "medium.0.density=procedural:particle-cumulus",
     "medium.0.particle_cumulus.particles=400", "medium.0.extinction_per_m=0.02"},
    {"method.name=particles", "medium.0.density=procedural:particle-cumulus",
     "medium.0.particle_cumulus.particles=400", "particles.display=billboards"},
};

/// A step and a picture with depths from another place than before.
Status draw_short(Session& session, int number, std::vector<unsigned char>& pixels) {
    Camera camera = session.camera();
    camera.position_m.x += 10;
    PILEUS_TRY(session.set_camera(camera));
    PILEUS_TRY(session.set_frame(number));
    std::uint64_t done = 0, hash = 0;
    PILEUS_TRY(session.step(1, done));
    FrameTarget target;
    target.has_colour = true;
    target.colour.format = number % 2 == 0 ? PixelFormat::kRgba8Srgb : PixelFormat::kRgba32F;
    target.colour.rows.first = pixels.data();
    target.colour.rows.stride = 24 * std::int64_t(pixel_bytes(target.colour.format));
    if (number % 4 >= 2) target.hash = &hash;
    return session.render(target);
}

}  // namespace

TEST_CASE("an array that is refused anywhere in a frame is told, and the flight goes on") {
    for (const std::vector<std::string>& row : kShortRows) {
        CAPTURE(row.front() + " " + row.back());
        FlightNeed need;
        const std::string bytes = packed_small(row, need);
        std::vector<unsigned char> memory(std::size_t(need.block) + (4 << 20)),
            pixels(24 * 16 * 16);
        Refusing refusing;
        refusing.block = Block::make(memory.data(), memory.size());
        const Allocator allocator = refusing.allocator();
        Packed packed;
        Session session;
        {
            const HostGuard lent({&allocator, nullptr, nullptr});
            RenderOptions options;
            options.threads = 1;
            REQUIRE(begin_flight(bytes.data(), bytes.size(), memory.size(), options, false, false,
                                 packed, session));
            for (int i = 0; i < 2; ++i) REQUIRE(draw_short(session, i, pixels));
            session.seal();
            REQUIRE(refusing.block->seal());
            int number = 2;
            bool refused = true;
            for (long place = 0; refused && place < 400; ++place) {
                CAPTURE(place);
                refusing.left = place;
                const Status status = draw_short(session, ++number, pixels);
                refused = refusing.left < 0;
                refusing.left = -1;
                CHECK((status || status.code == Code::kLimit));
                REQUIRE(refusing.block->is_clear());
                REQUIRE(refusing.block->use().lost_pieces == 0);
                if (place % 8 != 0) continue;
                const Status next = draw_short(session, ++number, pixels);
                REQUIRE_MESSAGE(bool(next), next.message);
            }
            CHECK_FALSE(refused);
            CHECK(draw_short(session, ++number, pixels));
        }
    }
}

TEST_CASE("a block of any size is refused, or its flight goes on whatever its frames ask for") {
    for (const std::vector<std::string>& row : kShortRows) {
        if (!long_tests() && (&row - kShortRows) % 2 != 0) continue;
        CAPTURE(row.front() + " " + row.back());
        FlightNeed need;
        std::string bytes = packed_small(row, need);
        // As if it had not told how much it needs.
        tell_block(0, 0, bytes);
        int opened = 0;
        for (int part = 0; part <= 3; ++part) {
            CAPTURE(part);
            const std::uint64_t size =
                need.kept + (need.block - need.kept) * std::uint64_t(part) / 3;
            std::vector<unsigned char> block(std::size_t(size) + 64), pixels(24 * 16 * 16);
            pileus_error error;
            pileus_frame frame;
            pileus_flight_use use;
            pileus_camera camera;
            PILEUS_INIT(error);
            PILEUS_INIT(frame);
            PILEUS_INIT(use);
            PILEUS_INIT(camera);
            frame.format = PILEUS_FORMAT_RGBA32F;
            frame.colour = pixels.data();
            const pileus_flight flight = flight_in(bytes, block, frame);
            pileus_session* session = nullptr;
            const pileus_code code = pileus_flight_open(&flight, &session, &error);
            REQUIRE((code == PILEUS_OK || code == PILEUS_ERROR_LIMIT));
            CHECK((code == PILEUS_OK) == (session != nullptr));
            if (code != PILEUS_OK) continue;
            ++opened;
            camera.target_m[2] = 1024;
            camera.fov_deg = 60;
            for (int number = 0; number < 6; ++number) {
                camera.position_m[1] = number % 2 == 0 ? -4000 : -600;
                camera.position_m[2] = 1000;
                REQUIRE(pileus_session_set_camera(session, &camera, &error) == PILEUS_OK);
                pileus_code drawn = pileus_session_step(session, 1, nullptr, &error);
                if (drawn == PILEUS_OK) drawn = pileus_session_render(session, &frame, &error);
                CHECK_MESSAGE((drawn == PILEUS_OK || drawn == PILEUS_ERROR_LIMIT), error.message);
            }
            REQUIRE(pileus_flight_usage(session, &use, &error) == PILEUS_OK);
            CHECK(use.kept + use.lost == 0);
            pileus_flight_close(session);
        }
        CHECK(opened > 0);
    }
}

TEST_CASE("a flight is closed before its block is freed, or after, by either function") {
    FlightNeed need;
    const std::string bytes = packed_small({"method.name=raymarch"}, need);
    for (int order = 0; order < 4; ++order) {
        auto block = std::make_unique<std::vector<unsigned char>>(std::size_t(need.block));
        std::vector<unsigned char> pixels(24 * 16 * 4);
        pileus_frame frame;
        PILEUS_INIT(frame);
        frame.colour = pixels.data();
        const pileus_flight flight = flight_in(bytes, *block, frame);
        pileus_session* session = nullptr;
        REQUIRE(pileus_flight_open(&flight, &session, nullptr) == PILEUS_OK);
        const std::vector<unsigned char> before = *block;
        if (order % 2 == 0) {
            block.reset();
            order == 0 ? pileus_flight_close(session) : pileus_session_free(session);
        } else {
            order == 1 ? pileus_flight_close(session) : pileus_session_free(session);
            // Nothing is written to memory that its owner may have given to somebody else.
            CHECK(*block == before);
        }
    }
}

}  // namespace pileus
