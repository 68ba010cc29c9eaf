// SPDX-License-Identifier: Apache-2.0
// Scenes that a program changes key by key, dumps and lists; steps and pictures that end early.
// in: small scenes, every key -> out: hashes of the same scene by overrides, lines.
// docs/embedding.md, "Scenes by program"
#include <atomic>
#include <cstring>
#include <limits>
#include <thread>

#include "tests/embed/host_harness.h"

using namespace host_test;
using render_test::kSmallCumulus;

namespace {

std::uint64_t hash_of(const pileus_scene* scene) {
    Outcome out;
    pileus_world* world = nullptr;
    pileus_session* session = nullptr;
    REQUIRE_MESSAGE(
        pileus_world_create(scene, nullptr, nullptr, 0, &world, &out.error) == PILEUS_OK,
        out.line());
    const WorldHandle owned(world);
    REQUIRE_MESSAGE(pileus_session_create(world, scene, nullptr, &session, &out.error) == PILEUS_OK,
                    out.line());
    const SessionHandle drawn(session);
    REQUIRE(pileus_session_step(session, 2, nullptr, &out.error) == PILEUS_OK);
    std::uint64_t hash = 0;
    auto frame = pileus_frame_default();
    frame.hash = &hash;
    REQUIRE_MESSAGE(pileus_session_render(session, &frame, &out.error) == PILEUS_OK, out.line());
    return hash;
}

std::string dump_of(const pileus_scene* scene) {
    Outcome out;
    std::size_t needed = 0;
    REQUIRE(pileus_scene_dump(scene, nullptr, 0, &needed, &out.error) == PILEUS_OK);
    std::string text(needed, 'x');
    CHECK(pileus_scene_dump(scene, &text[0], needed - 1, nullptr, &out.error) ==
          PILEUS_ERROR_LIMIT);
    REQUIRE(pileus_scene_dump(scene, &text[0], needed, nullptr, &out.error) == PILEUS_OK);
    CHECK(text.back() == '\0');
    text.pop_back();
    return text;
}

}  // namespace

TEST_CASE("scene by program: keys that are set are the overrides of a scene that is read") {
    const SceneHandle scene = scene_of(kSmallCumulus, {"method.name=raymarch"});
    Outcome out;
    const auto set = [&](const char* key, const char* value) {
        REQUIRE_MESSAGE(pileus_scene_set(scene.get(), key, value, &out.error) == PILEUS_OK,
                        out.line());
    };
    set("medium.0.albedo", "0.9");
    set("sun.elevation_deg", "10");
    set("sun.elevation_deg", "20");
    const double eye[3] = {16, -3500, 700}, steps = 40;
    REQUIRE(pileus_scene_set_numbers(scene.get(), "camera.position_m", eye, 3, &out.error) ==
            PILEUS_OK);
    REQUIRE(pileus_scene_set_numbers(scene.get(), "raymarch.steps", &steps, 1, &out.error) ==
            PILEUS_OK);
    const SceneHandle other = scene_of(
        kSmallCumulus, {"method.name=raymarch", "medium.0.albedo=0.9", "sun.elevation_deg=20",
                        "camera.position_m=[16,-3500,700]", "raymarch.steps=40"});
    const std::uint64_t hash = hash_of(scene.get());
    CHECK(hash == hash_of(other.get()));
    CHECK(hash != hash_of(scene_of(kSmallCumulus, {"method.name=raymarch"}).get()));
    // The dump is that scene without overrides, and the dump of it is the dump.
    const std::string text = dump_of(scene.get());
    const SceneHandle again = scene_of(text, {});
    CHECK(hash_of(again.get()) == hash);
    CHECK(dump_of(again.get()) == text);
}

TEST_CASE("scene by program: sliders that take turns leave one setting of each") {
    const SceneHandle scene = scene_of(kSmallCumulus, {"medium.0.phase.g=0.2"});
    Outcome out;
    const auto number = [&](const char* key, double value) {
        return pileus_scene_set_numbers(scene.get(), key, &value, 1, &out.error);
    };
    for (int i = 0; i < 300; ++i) {
        REQUIRE(number("sun.azimuth_deg", 0.5 + i) == PILEUS_OK);
        REQUIRE(number("sun.elevation_deg", 0.25 * i) == PILEUS_OK);
    }
    REQUIRE(number("medium.0.phase.g", 0.5) == PILEUS_OK);
    const SceneHandle other =
        scene_of(kSmallCumulus,
                 {"medium.0.phase.g=0.5", "sun.azimuth_deg=299.5", "sun.elevation_deg=74.75"});
    CHECK(dump_of(scene.get()) == dump_of(other.get()));
    // A table that is set after its key, and before it.
    REQUIRE(pileus_scene_set(scene.get(), "sun", "{azimuth_deg = 1, elevation_deg = 2}",
                             &out.error) == PILEUS_OK);
    REQUIRE(number("sun.elevation_deg", 3) == PILEUS_OK);
    CHECK(dump_of(scene.get()).find("azimuth_deg = 1\nelevation_deg = 3\n") != std::string::npos);
    // Whole numbers of any size.
    REQUIRE(number("seed", 1e16) == PILEUS_OK);
    CHECK(dump_of(scene.get()).find("seed = 10000000000000000\n") != std::string::npos);
    CHECK(number("seed", 1e19) == PILEUS_ERROR_INPUT);
    CHECK(number("sun.azimuth_deg", 12345678901234567890.0) == PILEUS_ERROR_INPUT);
    CHECK_MESSAGE(out.line().find("allowed: number in") != std::string::npos, out.line());
}

TEST_CASE("scene by program: what is wrong is a line, and the scene stays as it was") {
    const SceneHandle scene = scene_of(kSmallCumulus, {});
    const std::string before = dump_of(scene.get());
    Outcome out;
    const auto refused = [&](pileus_code code, const char* words) {
        CHECK(code == PILEUS_ERROR_INPUT);
        CHECK_MESSAGE(out.line().find(words) != std::string::npos, out.line());
        CHECK(dump_of(scene.get()) == before);
    };
    pileus_scene* const s = scene.get();
    pileus_error* const e = &out.error;
    refused(pileus_scene_set(s, "medium.0.albedo", "2", e), "medium.0.albedo");
    refused(pileus_scene_set(s, "medium.0.nothing", "2", e), "medium.0.nothing");
    refused(pileus_scene_set(s, "medium.9.albedo", "0.5", e), "medium.9");
    refused(pileus_scene_set(s, "", "0.5", e), "key: ");
    refused(pileus_scene_set(s, "a=b", "0.5", e), "key: a=b");
    refused(pileus_scene_set(s, "seed\n", "0.5", e), "key: ");
    refused(pileus_scene_set(s, "seed", "", e), "seed: wrong type");
    refused(pileus_scene_set(s, "seed", "1\n2", e), "not a value");
    refused(pileus_scene_set(s, nullptr, "1", e), "key, value: null");
    refused(pileus_scene_set(s, "seed", nullptr, e), "key, value: null");
    refused(pileus_scene_set(nullptr, "seed", "1", e), "scene: null");
    double numbers[2] = {1, std::numeric_limits<double>::quiet_NaN()};
    refused(pileus_scene_set_numbers(s, "camera.position_m", numbers, 2, e), "values[1]: nan");
    refused(pileus_scene_set_numbers(s, "camera.position_m", numbers, 1, e), "camera.position_m");
    refused(pileus_scene_set_numbers(s, "seed", numbers, 0, e), "count: 0");
    refused(pileus_scene_set_numbers(s, "seed", numbers, 0x80000000u, e), "count: 2147483648");
    refused(pileus_scene_set_numbers(s, "seed", nullptr, 1, e), "key, values: null");
    refused(pileus_scene_dump(nullptr, nullptr, 0, nullptr, e), "scene: null");
    refused(pileus_scene_dump(s, nullptr, 9, nullptr, e), "text: null");
}

TEST_CASE("scene by program: the shipped scenes read the same from their dumps") {
    for (const char* name : {"fair_weather", "cumulus_over_terrain", "clouds_sky", "island"}) {
        CAPTURE(name);
        pileus_scene* read = nullptr;
        Outcome out;
        const std::string path = std::string("assets/scenes/") + name + ".toml";
        REQUIRE(pileus_scene_read(path.c_str(), nullptr, 0, &read, &out.error) == PILEUS_OK);
        const SceneHandle scene(read);
        const std::string text = dump_of(scene.get());
        pileus_scene* parsed = nullptr;
        REQUIRE_MESSAGE(pileus_scene_parse(text.c_str(), "assets/scenes", nullptr, 0, &parsed,
                                           &out.error) == PILEUS_OK,
                        out.line());
        const SceneHandle again(parsed);
        CHECK(dump_of(again.get()) == text);
    }
}

TEST_CASE("scene by program: keys are listed with ranges, units and defaults") {
    const std::uint32_t count = pileus_key_count();
    CHECK(count > 200);
    Outcome out;
    bool albedo = false;
    for (std::uint32_t i = 0; i < count; ++i) {
        auto key = pileus_key_default();
        REQUIRE(pileus_key_at(i, &key, &out.error) == PILEUS_OK);
        CAPTURE(key.name);
        CHECK(std::strlen(key.help) > 0);
        CHECK(key.unit != nullptr);
        CHECK(std::strlen(key.allowed) > 0);
        CHECK(std::strlen(key.allowed) < sizeof key.allowed);
        if (key.numbers > 0) CHECK(key.low <= key.high);
        if (std::strcmp(key.name, "medium.N.albedo") != 0) continue;
        albedo = true;
        CHECK(key.numbers == 3);
        CHECK(key.low == 0);
        CHECK(key.high == 1);
        CHECK(std::string(key.value) == "1");
    }
    CHECK(albedo);
    auto key = pileus_key_default();
    CHECK(pileus_key_at(count, &key, &out.error) == PILEUS_ERROR_INPUT);
    CHECK(pileus_key_at(0, nullptr, &out.error) == PILEUS_ERROR_INPUT);
}

TEST_CASE("cancel: one step ends early, and the next is whole") {
    Hosted host(kSmallCumulus, {"method.name=\"path\""});
    REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
    pileus_session* const s = host.session.get();
    std::uint32_t done = 9;
    pileus_session_cancel(nullptr);
    pileus_session_cancel(s);
    host.check(pileus_session_step(s, 4, &done, &host.out.error));
    CHECK(done == 0);
    host.check(pileus_session_step(s, 4, &done, &host.out.error));
    CHECK(done == 4);
    // A call that is refused is the one that it ends.
    pileus_session_cancel(s);
    auto wrong = pileus_frame_default();
    wrong.format = 99;
    CHECK(pileus_session_render(s, &wrong, &host.out.error) == PILEUS_ERROR_INPUT);
    host.check(pileus_session_step(s, 4, &done, &host.out.error));
    CHECK(done == 4);
    // While it runs, from another thread.
    std::atomic<bool> started{false};
    std::thread other([&] {
        while (!started) std::this_thread::yield();
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        pileus_session_cancel(s);
    });
    started = true;
    host.check(pileus_session_step(s, 1u << 30, &done, &host.out.error));
    other.join();
    CHECK(done < (1u << 30));
}

TEST_CASE("cancel: a marched picture ends with a code, and the next is the picture") {
    Hosted host(kSmallCumulus, {"method.name=\"raymarch\""});
    REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
    const std::string hash = host.hash();
    pileus_session_cancel(host.session.get());
    auto frame = pileus_frame_default();
    CHECK(pileus_session_render(host.session.get(), &frame, &host.out.error) == PILEUS_ERROR_CHECK);
    CHECK(host.out.line().find("interrupted") == 0);
    CHECK(host.hash() == hash);
}
