// SPDX-License-Identifier: Apache-2.0
// `pileus pack`: the file that it writes flies in the block that it tells.
// in: scenes in clear air and others -> out: a packed scene, a table; one line where it is refused.
// docs/flight.md, "Start"
#include <sstream>

#include "include/pileus/pileus.h"
#include "tests/cli/run_program.h"

namespace pileus {
namespace {

std::string air_scene() {
    return std::string(test::small_scene()) + "[ground]\n[atmosphere]\nturbidity = 3\n";
}

/// The number of bytes in a row of the table.
std::uint64_t bytes_in(const std::string& table, const std::string& row) {
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t end = line.rfind(" bytes");
        if (line.find(row) != 0 || end == std::string::npos) continue;
        return std::stoull(line.substr(line.rfind(' ', end - 1) + 1));
    }
    FAIL("no row " << row);
    return 0;
}

}  // namespace

TEST_CASE("pack: a scene in clear air is packed and flies in the block that the table tells") {
    const test::ProgramFolder folder;
    folder.files().put("air.toml", air_scene());
    for (const char* method : {"raymarch", "collectors"}) {
        CAPTURE(method);
        const test::Outcome out =
            folder.run(std::string("pack air.toml -o air.packed --set method.name=") + method);
        REQUIRE_MESSAGE(out.exit_status == 0, out.errors);
        CHECK(out.errors.empty());
        CHECK(test::line_count(out.output) == 7);
        const std::string bytes = folder.files().get("air.packed");
        CHECK(bytes.size() == bytes_in(out.output, "packed scene"));
        pileus_error error;
        PILEUS_INIT(error);
        const auto ok = [&](pileus_code code) {
            REQUIRE_MESSAGE(code == PILEUS_OK, error.message);
        };
        pileus_packed head;
        PILEUS_INIT(head);
        ok(pileus_packed_read(bytes.data(), bytes.size(), &head, &error));
        CHECK(head.block_bytes == bytes_in(out.output, "block of a session"));
        CHECK(head.in_place_bytes == bytes_in(out.output, "  with arrays in place"));
        CHECK(std::string(head.method) == method);
        CHECK(head.width == 16);
        CHECK(head.height == 9);
        std::vector<unsigned char> block(std::size_t(head.block_bytes)), pixels(16 * 9 * 4);
        pileus_frame frame;
        PILEUS_INIT(frame);
        frame.colour = pixels.data();
        pileus_flight flight;
        PILEUS_INIT(flight);
        flight.scene = bytes.data(), flight.scene_bytes = bytes.size();
        flight.block = block.data(), flight.block_bytes = block.size();
        flight.frame = &frame;
        pileus_session* session = nullptr;
        ok(pileus_flight_open(&flight, &session, &error));
        ok(pileus_session_set_frame(session, 1, &error));
        ok(pileus_session_step(session, 1, nullptr, &error));
        ok(pileus_session_render(session, &frame, &error));
        // A blue sky is above, the ground below.
        CHECK(pixels[2] > pixels[0]);
        pileus_flight_use use;
        PILEUS_INIT(use);
        ok(pileus_flight_usage(session, &use, &error));
        CHECK(use.refused + use.kept + use.lost == 0);
        pileus_flight_close(session);
    }
}

TEST_CASE("pack: what no flight has ends in one line and leaves no file") {
    const test::ProgramFolder folder;
    for (const char* more : {"--set animation.frames=3", "--set camera.depth=depth.exr",
                             "--set method.name=none", "--set atmosphere.turbidity=-1"}) {
        CAPTURE(more);
        const test::Outcome out = folder.run(std::string("pack s.toml -o no.packed ") + more);
        CHECK(out.exit_status == 2);
        CHECK(test::line_count(out.errors) == 1);
        CHECK(out.errors.find("allowed: ") != std::string::npos);
        CHECK(folder.left().empty());
    }
}

}  // namespace pileus
