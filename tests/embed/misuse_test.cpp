// SPDX-License-Identifier: Apache-2.0
// The C interface used wrongly: one line, a code, and everything as it was.
// in: bad arguments, structs of other ages -> out: checks.
// docs/embedding.md
#include <limits>

#include "tests/embed/host_harness.h"

using namespace host_test;
using render_test::kSmallCumulus;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("misuse: null handles, structs and texts") {
    Outcome out;
    CHECK(pileus_session_render(nullptr, nullptr, &out.error) == PILEUS_ERROR_INPUT);
    CHECK(out.line() == "session: null, allowed: what a function of pileus made");
    CHECK(pileus_session_render(nullptr, nullptr, nullptr) == PILEUS_ERROR_INPUT);
    CHECK(pileus_world_create(nullptr, nullptr, nullptr, 0, nullptr, &out.error) ==
          PILEUS_ERROR_INPUT);
    CHECK(pileus_scene_parse(nullptr, nullptr, nullptr, 0, nullptr, nullptr) == PILEUS_ERROR_INPUT);
    pileus_scene* scene = nullptr;
    CHECK(pileus_scene_parse("[camera]\nfov = 3", nullptr, nullptr, 0, &scene, &out.error) ==
          PILEUS_ERROR_INPUT);
    CHECK(scene == nullptr);
    CHECK_MESSAGE(out.line().find("scene:2:1: camera.fov: ") != std::string::npos, out.line());
    CHECK(pileus_scene_read("/nowhere.toml", nullptr, 0, &scene, &out.error) == PILEUS_ERROR_INPUT);
    pileus_scene_free(nullptr);
    pileus_world_free(nullptr);
    pileus_session_free(nullptr);

    Hosted host(kSmallCumulus, {"method.name=\"raymarch\""});
    pileus_sun sun{};  // without its size
    CHECK(pileus_session_set_sun(host.session.get(), &sun, &out.error) == PILEUS_ERROR_INPUT);
    CHECK(out.line() == "sun: null or not initialised, allowed: what its pileus_*_default() made");
    CHECK(pileus_session_set_sun(host.session.get(), nullptr, &out.error) == PILEUS_ERROR_INPUT);
}

TEST_CASE("misuse: a scene with other media than the world's") {
    Hosted host(kSmallCumulus, {"method.name=\"raymarch\""});
    host.scene = scene_of(
        "[camera]\nposition_m = [0, 0, 0]\ntarget_m = [0, 1, 0]\n[method]\nname = \"raymarch\"",
        {});
    host.open(nullptr);
    CHECK(host.code == PILEUS_ERROR_INPUT);
    CHECK_MESSAGE(host.out.line() == "scene: medium: 0 media, allowed: 1, as the world was made of",
                  host.out.line());
}

TEST_CASE("misuse: values out of range change nothing and name their key") {
    Hosted host(kSmallCumulus, {"method.name=\"raymarch\""});
    const std::string before = host.hash();
    pileus_session* const s = host.session.get();
    pileus_error* const e = &host.out.error;
    const auto refused = [&](pileus_code code, const char* line) {
        CHECK(code == PILEUS_ERROR_INPUT);
        CHECK_MESSAGE(host.out.line().find(line) != std::string::npos, host.out.line());
        CHECK(host.hash() == before);
    };
    auto camera = cleared<pileus_camera>();
    camera.fov_deg = 40;
    refused(pileus_session_set_camera(s, &camera, e), "camera.target_m: same as position_m");
    camera.target_m[1] = 1;
    camera.position_m[2] = 100;
    camera.fov_deg = kNan;
    refused(pileus_session_set_camera(s, &camera, e), "camera.fov_deg");
    camera.fov_deg = 40;
    camera.position_m[0] = kNan;
    refused(pileus_session_set_camera(s, &camera, e), "camera.position_m");
    camera.position_m[0] = 0;
    camera.position_m[2] = -5;
    refused(pileus_session_set_camera(s, &camera, e), "below the ground");
    auto light = cleared<pileus_lamp>();
    light.type = 3;
    refused(pileus_session_set_lamps(s, &light, 1, e), "light.type: 3");
    light.type = PILEUS_LAMP_SPOT;
    refused(pileus_session_set_lamps(s, &light, 1, e), "light.direction: 0, 0, 0");
    light.direction[0] = 1;
    refused(pileus_session_set_lamps(s, &light, 1, e), "light.0.cone_deg");
    light.cone_deg = 20;
    light.position_m[1] = kNan;
    refused(pileus_session_set_lamps(s, &light, 1, e), "light.0.position_m");
    refused(pileus_session_set_lamps(s, nullptr, 1, e), "lights: null");
    refused(pileus_session_set_lamps(s, &light, 65, e), "lights: 65");
    light.struct_size = 0;
    refused(pileus_session_set_lamps(s, &light, 1, e), "lights");
    auto ground = cleared<pileus_ground>();
    ground.present = 1;
    ground.albedo = 0.5;
    ground.altitude_m = 600;
    refused(pileus_session_set_ground(s, &ground, e), "below the ground");
    refused(pileus_session_set_frame(s, -1, e), "frame: below 0");
    auto placement = cleared<pileus_placement>();
    placement.yaw_deg = kNan;
    refused(pileus_session_set_placement(s, &placement, e), "placement.yaw_deg");
    auto depth = cleared<pileus_depth_image>();
    float near = 1;
    depth.values = &near;
    depth.kind = PILEUS_DEPTH_BUFFER;
    refused(pileus_session_set_depth(s, &depth, e), "without a camera's near_m");
    depth.kind = 7;
    refused(pileus_session_set_depth(s, &depth, e), "depth.kind: 7");
    auto frame = cleared<pileus_frame>();
    frame.colour = &near;
    frame.colour_stride = 3;
    refused(pileus_session_render(s, &frame, e), "frame.colour.stride: 3 bytes");
    frame.colour_stride = 0;
    frame.format = 9;
    refused(pileus_session_render(s, &frame, e), "frame.format: 9");
    const double zero[16] = {};
    refused(pileus_session_set_matrices(s, zero, zero, PILEUS_CLIP_ZERO, 0, 0, e), "view: ");
}

TEST_CASE("misuse: structs of an older and of a newer header") {
    Hosted host(kSmallCumulus, {"method.name=\"raymarch\""});
    // Older: only the first members are there; the rest counts as 0.
    auto frame = cleared<pileus_frame>();
    frame.struct_size = marked(offsetof(pileus_frame, colour_stride));
    std::vector<unsigned char> pixels(24 * 14 * 4, 7);
    frame.colour = pixels.data();
    host.check(pileus_session_render(host.session.get(), &frame, &host.out.error));
    CHECK(pixels != std::vector<unsigned char>(24 * 14 * 4, 7));
    // Newer: what this library does not know is left alone.
    struct Newer {
        pileus_stats known;
        std::uint64_t more;
    } newer{};
    newer.more = 99;
    newer.known.struct_size = marked(sizeof newer);
    host.check(pileus_session_stats(host.session.get(), &newer.known, &host.out.error));
    CHECK(newer.known.pictures == 1);
    CHECK(newer.more == 99);
    CHECK(newer.known.struct_size == marked(sizeof newer));
    // A short error holds what fits.
    pileus_error error = cleared<pileus_error>();
    error.struct_size = marked(offsetof(pileus_error, message) + 9);
    CHECK(pileus_session_set_frame(host.session.get(), -1, &error) == PILEUS_ERROR_INPUT);
    CHECK(std::string(error.message) == "frame...");
}

TEST_CASE("misuse: a plan, a report, a version") {
    const SceneHandle scene = scene_of(kSmallCumulus, {"medium.0.extinction_per_m=0.0625"});
    Outcome out;
    auto plan = cleared<pileus_plan>();
    REQUIRE(pileus_plan_scene(scene.get(), nullptr, &plan, &out.error) == PILEUS_OK);
    // Of four optical depths each, 24 in the scene.
    CHECK(plan.cells[0] == 72);
    CHECK(plan.world_bytes >= 24 * 24 * 16 * sizeof(float));
    CHECK(plan.peak_bytes > plan.world_bytes);
    CHECK(plan.high_m[2] == 1536);
    auto host = cleared<pileus_host>();
    host.memory_limit = 1000;
    CHECK(pileus_plan_scene(scene.get(), &host, &plan, &out.error) == PILEUS_ERROR_LIMIT);
    CHECK(out.line().find("limits.memory") != std::string::npos);

    Hosted hosted(kSmallCumulus, {"method.name=\"raymarch\""});
    std::size_t needed = 0;
    hosted.check(pileus_session_report(hosted.session.get(), nullptr, 0, &needed, &out.error));
    // What the process holds meanwhile changes no digit of it.
    const std::vector<char> more(std::size_t{1} << 27, '1');
    std::string text(needed, more[0]);
    CHECK(pileus_session_report(hosted.session.get(), &text[0], needed - 1, nullptr, &out.error) ==
          PILEUS_ERROR_LIMIT);
    hosted.check(
        pileus_session_report(hosted.session.get(), &text[0], needed, nullptr, &out.error));
    CHECK(text.find("\"method\": \"raymarch\"") != std::string::npos);
    CHECK(std::string(pileus_version()) == pileus::kVersion);
    CHECK(pileus_api_version() == PILEUS_API_VERSION);
}
