// SPDX-License-Identifier: Apache-2.0
// Flights that read a packed scene's arrays where they lie.
// in: packed scenes in memory that cannot be written to -> out: hashes as of a flight that copies
// them; a smaller block. docs/flight.md, "Memory"
#include <doctest/doctest.h>
#include <sys/mman.h>

#include <cstring>

#include "src/flight/flight.h"
#include "tests/flight/flight_scene.h"

namespace {

/// Bytes at a page's start that nothing can change.
class ReadOnly {
public:
    explicit ReadOnly(const std::string& bytes) : size_(bytes.size()) {
        memory_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        REQUIRE(memory_ != MAP_FAILED);
        std::memcpy(memory_, bytes.data(), size_);
        REQUIRE(mprotect(memory_, size_, PROT_READ) == 0);
    }
    ~ReadOnly() { munmap(memory_, size_); }
    ReadOnly(const ReadOnly&) = delete;
    const void* data() const { return memory_; }

private:
    std::size_t size_;
    void* memory_;
};

/// Hashes of some frames; of a flight that is told to read in place, and of one that is not.
std::vector<std::uint64_t> flown(const std::string& bytes, const void* scene, std::uint64_t room) {
    std::vector<unsigned char> block(std::size_t(room), 0), pixels(24 * 16 * 4);
    std::uint64_t hash = 0;
    pileus_frame frame;
    PILEUS_INIT(frame);
    frame.colour = pixels.data();
    frame.hash = &hash;
    pileus_flight flight = flight_in(bytes, block, frame);
    flight.in_place = scene != nullptr;
    if (scene != nullptr) flight.scene = scene;
    pileus_session* session = nullptr;
    pileus_error error;
    PILEUS_INIT(error);
    const pileus_code opened = pileus_flight_open(&flight, &session, &error);
    REQUIRE_MESSAGE(opened == PILEUS_OK, error.message);
    std::vector<std::uint64_t> hashes{hash};
    for (int number = 1; number < 4; ++number) {
        pileus_sun sun;
        PILEUS_INIT(sun);
        sun.present = 1;
        sun.azimuth_deg = 120;
        sun.elevation_deg = 35 + number;
        for (float& c : sun.irradiance) c = 1;
        REQUIRE(pileus_session_set_frame(session, number, &error) == PILEUS_OK);
        REQUIRE(pileus_session_set_sun(session, &sun, &error) == PILEUS_OK);
        REQUIRE(pileus_session_step(session, 1, nullptr, &error) == PILEUS_OK);
        REQUIRE(pileus_session_render(session, &frame, &error) == PILEUS_OK);
        hashes.push_back(hash);
    }
    pileus_flight_use use;
    PILEUS_INIT(use);
    REQUIRE(pileus_flight_usage(session, &use, &error) == PILEUS_OK);
    CHECK(use.refused + use.kept + use.lost == 0);
    pileus_flight_close(session);
    return hashes;
}

}  // namespace

TEST_CASE(
    "a flight in place has the hashes of one that copies, in less memory, and writes nothing") {
    const std::vector<std::string> rows[] = {
        {},
        {"collectors.display=billboards"},
        {"method.name=raymarch"},
        {"method.name=raymarch", "raymarch.temporal=4"},
        {"method.name=optical-depth"},
        {"method.name=photon-grid", "photon_grid.ring=true"},
        {"method.name=path"},
        {"method.name=particles", "medium.0.density=procedural:particle-cumulus",
         "medium.0.particle_cumulus.particles=400", "medium.0.extinction_per_m=0.02"},
    };
    for (const std::vector<std::string>& row : rows) {
        CAPTURE(row.empty() ? std::string("collectors") : row.front());
        // As large as to be seen among what is rounded up.
        std::vector<std::string> keys = row;
        keys.push_back("medium.0.resolution=[48,48,48]");
        pileus::FlightNeed need;
        const std::string bytes = packed_small(keys, need);
        pileus_packed head;
        PILEUS_INIT(head);
        REQUIRE(pileus_packed_read(bytes.data(), bytes.size(), &head, nullptr) == PILEUS_OK);
        const ReadOnly scene(bytes);
        const auto copied = flown(bytes, nullptr, head.block_bytes);
        const auto in_place = flown(bytes, scene.data(), head.in_place_bytes);
        CHECK(copied == in_place);
        CHECK(copied[1] != copied[2]);
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
        // Its densities, but for what blocks are rounded up to.
        CHECK(head.in_place_bytes + 48 * 48 * 48 * 4 <= head.block_bytes + (64 << 10));
#else
        CHECK(head.in_place_bytes == head.block_bytes);
#endif
    }
}

TEST_CASE("a packed scene at another address is refused in place") {
    pileus::FlightNeed need;
    const std::string bytes = packed_small({"method.name=raymarch"}, need);
    alignas(64) static unsigned char memory[1 << 20];
    REQUIRE(bytes.size() + 64 < sizeof memory);
    for (const std::size_t past : {0, 8, 32, 63}) {
        std::memcpy(memory + past, bytes.data(), bytes.size());
        std::vector<unsigned char> block(std::size_t(need.block));
        pileus_frame frame;
        PILEUS_INIT(frame);
        std::vector<unsigned char> pixels(24 * 16 * 4);
        frame.colour = pixels.data();
        pileus_flight flight = flight_in(bytes, block, frame);
        flight.scene = memory + past;
        flight.in_place = 1;
        pileus_session* session = nullptr;
        pileus_error error;
        PILEUS_INIT(error);
        const pileus_code code = pileus_flight_open(&flight, &session, &error);
        CHECK(code == (past == 0 ? PILEUS_OK : PILEUS_ERROR_INPUT));
        if (past > 0)
            CHECK(std::string(error.message) ==
                  "packed scene: at no multiple of 64 bytes, allowed in place: one");
        pileus_flight_close(session);
    }
}
