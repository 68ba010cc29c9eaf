// SPDX-License-Identifier: Apache-2.0
// Packed scenes: what comes out is what went in, and damaged ones are refused.
// in: scenes, their bytes cut, changed and told of another version -> out: the same values; one
// line. docs/flight.md, "Packed scenes"
#include "src/flight/pack.h"

#include <doctest/doctest.h>

#include "src/scene/keys/all_keys.h"
#include "src/scene/read_scene.h"
#include "src/session/session.h"
#include "tests/flight/flight_scene.h"

namespace pileus {
namespace {

Scene scene_of(const std::vector<std::string>& overrides = {}) {
    Scene scene;
    const Status status = read_scene_text(kFlightScene, "scene", "", overrides, scene);
    REQUIRE_MESSAGE(bool(status), status.message);
    return scene;
}

std::string packed(const Scene& scene) {
    std::shared_ptr<const World> world;
    std::string bytes;
    REQUIRE(make_world(scene, {}, world));
    REQUIRE(pack_scene(scene, *world, bytes));
    tell_block(12345, 12000, bytes);
    return bytes;
}

/// Of every key of a scene its value as a text.
std::map<std::string, std::string> values_of(Scene& scene) {
    std::map<std::string, std::string> out;
    for_each_key(scene, [&](const KeyRow& row, const std::string& path, const KeySource& source) {
        out[path] = toml_text(value_of(row, source));
    });
    return out;
}

}  // namespace

TEST_CASE("a packed scene is the scene, every key that sessions read") {
    Scene scene = scene_of({"seed=9", "method.name=raymarch", "raymarch.steps=77",
                            "camera.fov_deg=33", "raymarch.jitter=hash", "collectors.bands=3",
                            "optical_depth.steps=5", "particles.bins=9", "path.max_depth=3",
                            "photon_grid.ring=true", "medium.0.albedo=[0.9,0.8,0.7]"});
    const std::string bytes = packed(scene);
    Packed out;
    REQUIRE(unpack_scene(bytes.data(), bytes.size(), false, out));
    CHECK(out.head.width == 24);
    CHECK(out.head.height == 16);
    CHECK(out.head.block_bytes == 12345);
    CHECK(out.head.method == "raymarch");
    auto before = values_of(scene), after = values_of(out.scene);
    // Files, films and what is written say nothing to a session.
    for (auto* values : {&before, &after})
        for (auto it = values->begin(); it != values->end();)
            it = it->first.rfind("output.", 0) == 0 || it->first.rfind("animation", 0) == 0
                     ? values->erase(it)
                     : std::next(it);
    CHECK(before == after);
    CHECK(before.size() > 150);
}

TEST_CASE("sessions over a packed scene have the hashes of those over the scene") {
    for (const char* method : {"collectors", "raymarch", "photon-grid", "optical-depth", "path"}) {
        const Scene scene =
            scene_of({std::string("method.name=") + method, "path.samples_per_pixel=2",
                      "photon_grid.photons=2000", "photon_grid.generations=2"});
        const std::string bytes = packed(scene);
        Packed out;
        REQUIRE(unpack_scene(bytes.data(), bytes.size(), false, out));
        std::uint64_t hashes[2] = {};
        for (int from = 0; from < 2; ++from) {
            Session session;
            const Scene& own = from == 0 ? scene : out.scene;
            std::shared_ptr<const World> world;
            if (from == 1) world = out.world;
            REQUIRE(session.open(own, {}, true, world));
            std::uint64_t done = 0;
            REQUIRE(session.step(session.light().whole, done));
            FrameTarget target;
            target.hash = &hashes[from];
            REQUIRE(session.render(target));
        }
        CHECK(hashes[0] == hashes[1]);
    }
}

TEST_CASE("what a flight does not have is refused when it is packed") {
    const Scene plain = scene_of();
    std::shared_ptr<const World> world;
    REQUIRE(make_world(plain, {}, world));
    std::string bytes;
    Scene scene = plain;
    scene.solids.emplace_back();
    CHECK(pack_scene(scene, *world, bytes).message.find("scene: solid: not packed") == 0);
    scene = plain;
    scene.view_files.depth = "depth.exr";
    CHECK(pack_scene(scene, *world, bytes).message.find("scene: camera.depth: not") == 0);
    scene = plain;
    scene.animation.present = true;
    CHECK(pack_scene(scene, *world, bytes).message.find("scene: animation: not packed") == 0);
    scene = plain;
    scene.media[0].detail.tile_m = 200;
    CHECK(pack_scene(scene, *world, bytes).message ==
          "scene: medium.0.detail.refine: a packed scene knows detail on a grid alone, 0, allowed: "
          "1 to 16");
    // Foreign libraries; a method that has nothing of them may be told of them.
    scene = plain;
    scene.collectors.display.compositor = Compositor::kOsmesa;
    CHECK(pack_scene(scene, *world, bytes).message ==
          "scene: collectors.compositor: not packed, allowed: builtin");
    scene.method = "raymarch";
    scene.filter.kind = FilterKind::kOidn;
    CHECK(pack_scene(scene, *world, bytes));
    bytes.clear();
    scene.method = "path";
    CHECK(pack_scene(scene, *world, bytes).message ==
          "scene: filter.kind: not packed, allowed: none, regression");
    CHECK(bytes.empty());
}

TEST_CASE("a damaged packed scene is refused, wherever it is cut or changed") {
    const std::string whole = packed(scene_of());
    PackedHead head;
    REQUIRE(read_packed_head(whole.data(), whole.size(), head));
    const auto refused = [](const std::string& bytes) {
        Packed out;
        const Status status = unpack_scene(bytes.data(), bytes.size(), false, out);
        return status.code == Code::kBadInput && status.message.find("packed scene: ") == 0 &&
               status.message.find(", allowed: ") != std::string::npos;
    };
    for (std::size_t size = 0; size < whole.size(); size += 1 + size / 7)
        CHECK(refused(whole.substr(0, size)));
    CHECK(refused(whole + 'x'));
    for (std::size_t at = 0; at < whole.size(); at += 1 + at / 5) {
        std::string changed = whole;
        changed[at] = char(changed[at] ^ 1);
        CHECK(refused(changed));
    }
    CHECK_FALSE(read_packed_head(nullptr, 100, head));
}

TEST_CASE("one bit that is turned over anywhere, or a byte that is missing, is refused in a line") {
    std::string bytes = packed(scene_of(
        {"method.name=raymarch", "medium.0.density=uniform:box", "medium.0.resolution=[2,2,2]",
         "medium.0.extinction_per_m=0.001", "medium.0.phase={type=\"henyey-greenstein\",g=0.5}"}));
    // Small, so that all of it is looked through every time.
    REQUIRE(bytes.size() < 8192);
    std::vector<unsigned char> block(1 << 20), pixels(1 << 20, 0x5a);
    pileus_error error;
    pileus_packed head;
    pileus_frame frame;
    PILEUS_INIT(error);
    PILEUS_INIT(head);
    PILEUS_INIT(frame);
    frame.colour = pixels.data();
    pileus_flight flight = flight_in(bytes, block, frame);
    pileus_session* session = nullptr;
    const auto is_line = [&] {
        const std::string said = error.message;
        return said.find("packed scene: ") == 0 && said.find(", allowed: ") != std::string::npos &&
               said.find('\n') == std::string::npos;
    };
    std::uint64_t taken = 0, silent = 0;
    const auto read = [&](std::size_t size) {
        flight.scene_bytes = size;
        for (int way = 0; way < 2; ++way) {
            error.message[0] = 0;
            const pileus_code code = way == 0
                                         ? pileus_packed_read(bytes.data(), size, &head, &error)
                                         : pileus_flight_open(&flight, &session, &error);
            taken += code != PILEUS_ERROR_INPUT;
            silent += !is_line();
        }
    };
    for (std::size_t at = 0; at < bytes.size(); ++at)
        for (int bit = 0; bit < 8; ++bit) {
            bytes[at] = char(bytes[at] ^ (1 << bit));
            read(bytes.size());
            bytes[at] = char(bytes[at] ^ (1 << bit));
        }
    for (std::size_t size = 0; size < bytes.size(); ++size) read(size);
    CHECK(taken == 0);
    CHECK(silent == 0);
    CHECK(session == nullptr);
    for (const unsigned char v : pixels) REQUIRE(v == 0x5a);
    CHECK(pileus_packed_read(bytes.data(), bytes.size(), &head, &error) == PILEUS_OK);
}

TEST_CASE("a head that is of another scene is refused when a flight is opened") {
    const Scene scene = scene_of({"method.name=raymarch"});
    const std::string whole = packed(scene);
    PackedHead head;
    REQUIRE(read_packed_head(whole.data(), whole.size(), head));
    head.block_bytes = head.in_place_bytes = 0;
    const std::size_t begin = packed_bytes(head, "").size();
    const auto opened = [&] {
        const std::string bytes = packed_bytes(head, whole.substr(begin));
        std::vector<unsigned char> block(16 << 20), pixels(24 * 16 * 4);
        pileus_frame frame;
        PILEUS_INIT(frame);
        frame.colour = pixels.data();
        const pileus_flight flight = flight_in(bytes, block, frame);
        pileus_session* session = nullptr;
        const pileus_code code = pileus_flight_open(&flight, &session, nullptr);
        pileus_flight_close(session);
        return code;
    };
    CHECK(opened() == PILEUS_OK);
    head.width = 8;
    CHECK(opened() == PILEUS_ERROR_INPUT);
    head.width = 24, head.height = 1 << 20;
    CHECK(opened() == PILEUS_ERROR_INPUT);
    head.height = 16, head.method = "path";
    CHECK(opened() == PILEUS_ERROR_INPUT);
    // And a block that is smaller than it asks for.
    head.method = "raymarch", head.block_bytes = (16 << 20) + 1;
    CHECK(opened() == PILEUS_ERROR_LIMIT);
}

}  // namespace pileus
