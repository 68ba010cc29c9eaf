// SPDX-License-Identifier: Apache-2.0
// Packed scenes whose digest is right and whose arrays do not fit their numbers.
// in: worlds changed before they are packed, payloads cut and changed and signed anew -> out: one
// line. docs/flight.md, "Packed scenes"
#include <doctest/doctest.h>

#include <functional>

#include "src/flight/pack.h"
#include "src/scene/read_scene.h"
#include "src/session/session.h"
#include "tests/flight/flight_scene.h"

namespace pileus {
namespace {

constexpr const char* kLine =
    "packed scene: no scene, allowed: what `pileus pack` of this version wrote";

Scene scene_of(const std::vector<std::string>& overrides) {
    Scene scene;
    const Status status = read_scene_text(kFlightScene, "scene", "", overrides, scene);
    REQUIRE_MESSAGE(bool(status), status.message);
    return scene;
}

using Change = std::function<void(World&)>;

/// What is said of a scene whose world was changed before it was packed.
std::string said(const std::vector<std::string>& overrides, const Change& change) {
    const Scene scene = scene_of(overrides);
    std::shared_ptr<const World> world;
    std::string bytes;
    const Status made = make_world(scene, {}, world);
    REQUIRE_MESSAGE(bool(made), made.message);
    change(const_cast<World&>(*world));
    REQUIRE(pack_scene(scene, *world, bytes));
    Packed out;
    const Status status = unpack_scene(bytes.data(), bytes.size(), false, out);
    return status ? "taken" : status.message;
}

void check_all(const std::vector<std::string>& overrides, const std::vector<Change>& changes) {
    CHECK(said(overrides, [](World&) {}) == "taken");
    for (std::size_t i = 0; i < changes.size(); ++i) {
        CAPTURE(i);
        CHECK(said(overrides, changes[i]) == kLine);
    }
}

/// A packed scene, and its head.
std::string packed_march(PackedHead& head) {
    const Scene scene = scene_of({"method.name=raymarch"});
    std::shared_ptr<const World> world;
    std::string whole;
    REQUIRE(make_world(scene, {}, world));
    REQUIRE(pack_scene(scene, *world, whole));
    REQUIRE(read_packed_head(whole.data(), whole.size(), head));
    return whole;
}

}  // namespace

TEST_CASE("a packed grid that is not what its numbers say is refused") {
    std::vector<Change> changes = {
        [](World& w) { w.medium.count = 0; },
        [](World& w) { w.medium.count = kMaxMedia + 1; },
        [](World& w) { w.medium.count = 2; },
        [](World& w) { w.medium.channels = 2; },
        [](World& w) { w.medium.volume.density.truncate(7); },
        [](World& w) { w.medium.parts.truncate(0), w.medium.count = 3; },
        // Tables of phase functions.
        [](World& w) { w.medium.phases.clear(); },
        [](World& w) { w.medium.phases[0].table[0].cells = 0; },
        [](World& w) { w.medium.phases[0].table[0].cells = 1 << 30; },
        [](World& w) { w.medium.phases[0].table[0].slots = 0; },
        [](World& w) { w.medium.phases[0].table[0].slots = 1 << 30; },
        [](World& w) { w.medium.phases[0].numbers.truncate(5); },
        [](World& w) { w.medium.phases[0].guides.truncate(5); },
        [](World& w) { w.medium.optics[3].phase.type = kPhaseTable; },
    };
    for (std::size_t a = 0; a < 3; ++a) {
        changes.push_back([a](World& w) { w.medium.grid.size[a] = 0; });
        changes.push_back([a](World& w) { w.medium.grid.size[a] = 4097; });
        changes.push_back([a](World& w) { w.medium.volume.size[a] += 1; });
        changes.push_back([a](World& w) { w.medium.grid.cell_m[a] = 0; });
        changes.push_back([a](World& w) { w.medium.extent_m[a] = -1; });
    }
    check_all({}, changes);
}

TEST_CASE("packed particles that are fewer than they say are refused") {
    const auto none = [](auto& list) { list.truncate(1); };
    check_all({"method.name=particles", "medium.0.density=procedural:plume",
               "medium.0.plume.particles=40", "medium.0.extinction_per_m=1"},
              {
                  [](World& w) { w.particles.count += 1; },
                  [](World& w) { w.particles.count = std::size_t{1} << 33; },
                  [&](World& w) { none(w.particles.position); },
                  [&](World& w) { none(w.particles.radius); },
                  [&](World& w) { none(w.particles.density); },
                  [&](World& w) { none(w.particles.velocity); },
                  [](World& w) { REQUIRE(w.particles.colour.resize(2, "colour")); },
                  [](World& w) { REQUIRE(w.particles.emission.resize(2, "emission")); },
                  [](World& w) { REQUIRE(w.particles.id.resize(2, "id")); },
              });
}

TEST_CASE("packed noises of a sky that do not fit each other are refused") {
    const auto of_both = [](auto change) {
        return std::vector<Change>{
            [=](World& w) { change(w.layer.perlin, w.layer.params.perlin); },
            [=](World& w) { change(w.layer.worley, w.layer.params.worley); }};
    };
    std::vector<Change> changes;
    const auto add = [&](auto change) {
        for (const Change& one : of_both(change)) changes.push_back(one);
    };
    add([](NoiseTexture& noise, NoiseView&) { noise.size = 0; });
    add([](NoiseTexture& noise, NoiseView&) { noise.size = 513; });
    add([](NoiseTexture&, NoiseView& view) { view.size += 1; });
    add([](NoiseTexture&, NoiseView& view) { view.last = -1; });
    add([](NoiseTexture&, NoiseView& view) { view.last = kMaxNoiseLevels; });
    add([](NoiseTexture& noise, NoiseView&) { noise.words.truncate(9); });
    add([](NoiseTexture& noise, NoiseView&) { noise.largest.truncate(0); });
    // Without words there is no share of it.
    add([](NoiseTexture& noise, NoiseView&) { noise.words.truncate(0); });
    check_all({"method.name=raymarch", "medium.0.density=procedural:sky",
               "medium.0.sky={type=\"cumulus\",size=16,evaluate=\"direct\"}",
               "medium.0.resolution=[4,4,4]"},
              changes);
}

TEST_CASE("a payload that is cut and signed anew is refused, wherever it ends") {
    PackedHead head;
    const std::string whole = packed_march(head);
    const std::size_t begin = packed_bytes(head, "").size();
    const std::string payload = whole.substr(begin);
    const auto opened = [&](const std::string& bytes) {
        const std::string signed_anew = packed_bytes(head, bytes);
        Packed out;
        return unpack_scene(signed_anew.data(), signed_anew.size(), false, out);
    };
    REQUIRE(opened(payload));
    for (std::size_t size = 0; size < payload.size(); size += 1 + size / 40)
        CHECK(opened(payload.substr(0, size)).message == kLine);
    CHECK(opened(payload + 'x').message == kLine);
    // A byte at a time is another: some are other values, the rest is refused, too.
    int refused = 0;
    for (std::size_t at = 0; at < payload.size(); at += 1 + at / 60) {
        std::string changed = payload;
        changed[at] = char(changed[at] ^ 0x80);
        const Status status = opened(changed);
        refused += status ? 0 : 1;
        if (!status) CHECK(status.message == kLine);
    }
    CHECK(refused > 20);
    // A name that fills its place in the head, and one that does not fit.
    for (const std::size_t letters : {23, 24, 40}) {
        head.method = std::string(letters, 'm');
        const std::string bytes = packed_bytes(head, payload);
        PackedHead read;
        REQUIRE(read_packed_head(bytes.data(), bytes.size(), read));
        CHECK(read.method == std::string(23, 'm'));
    }
}

TEST_CASE("a packed sky map of more channels than there are colours is refused") {
    PackedHead head;
    const std::string whole = packed_march(head);
    // Without a map the payload ends with its width, height and number of channels, all 0.
    std::string payload = whole.substr(packed_bytes(head, "").size());
    REQUIRE(payload.substr(payload.size() - 24) == std::string(24, '\0'));
    for (const char channels : {1, 4, 5, 127}) {
        payload[payload.size() - 8] = channels;
        const std::string bytes = packed_bytes(head, payload);
        Packed out;
        CHECK(unpack_scene(bytes.data(), bytes.size(), false, out).message == kLine);
        // No more were made than there may be.
        CHECK(out.sky.channels.size() <= 4);
    }
}

}  // namespace pileus
