// SPDX-License-Identifier: Apache-2.0
// Structs as pileus_*_default() make them are accepted as they are; those that nobody made are not.
// in: every struct of pileus.h -> out: values, lines. docs/embedding.md, "Structs"
#include <cstring>

#include "tests/embed/host_harness.h"

using namespace host_test;
using render_test::kSmallCumulus;

namespace {

/// The default of a struct is marked, and what an older header knows of it is the same.
template <class T>
void check_struct(T made, std::uint32_t kind) {
    CHECK(made.struct_size == marked(sizeof made));
    T cleared_one = cleared<T>();
    pileus_default(kind, &cleared_one, sizeof cleared_one);
    CHECK(std::memcmp(&made, &cleared_one, sizeof made) == 0);
    const std::uint32_t half = sizeof made / 2;
    unsigned char older[sizeof made];
    std::memset(older, 0xa5, sizeof older);
    pileus_default(kind, older, half);
    std::uint32_t mark = 0;
    std::memcpy(&mark, older, sizeof mark);
    CHECK(mark == marked(half));
    CHECK(std::memcmp(older + 4, reinterpret_cast<unsigned char*>(&made) + 4, half - 4) == 0);
    for (std::size_t i = half; i < sizeof older; ++i) REQUIRE(older[i] == 0xa5);
    // A newer header's struct is larger: what the library does not know is 0.
    unsigned char newer[sizeof made + 16];
    std::memset(newer, 0xa5, sizeof newer);
    pileus_default(kind, newer, sizeof newer);
    for (std::size_t i = sizeof made; i < sizeof newer; ++i) REQUIRE(newer[i] == 0);
}

}  // namespace

TEST_CASE("defaults: every struct is marked, for headers of any age") {
    check_struct(pileus_error_default(), 0);
    check_struct(pileus_host_default(), 0);
    check_struct(pileus_plan_default(), 0);
    check_struct(pileus_particles_default(), 1);
    check_struct(pileus_density_default(), 0);
    check_struct(pileus_camera_default(), 2);
    check_struct(pileus_sun_default(), 3);
    check_struct(pileus_environment_default(), 4);
    check_struct(pileus_ground_default(), 5);
    check_struct(pileus_lamp_default(), 6);
    check_struct(pileus_placement_default(), 0);
    check_struct(pileus_depth_image_default(), 0);
    check_struct(pileus_progress_default(), 0);
    check_struct(pileus_frame_default(), 0);
    check_struct(pileus_stats_default(), 0);
    check_struct(pileus_work_default(), 0);
    check_struct(pileus_governor_default(), 7);
    check_struct(pileus_units_default(), 0);
    check_struct(pileus_costs_default(), 0);
    check_struct(pileus_cloud_default(), 8);
    check_struct(pileus_cloud_detail_default(), 9);
    check_struct(pileus_cloud_stats_default(), 0);
    check_struct(pileus_packed_default(), 0);
    check_struct(pileus_flight_default(), 0);
    check_struct(pileus_flight_use_default(), 0);
    check_struct(pileus_picture_default(), 10);
    check_struct(pileus_figures_default(), 0);
    check_struct(pileus_key_default(), 0);
    CHECK(pileus_camera_default().up[2] == 1);
    CHECK(pileus_camera_default().fov_deg == 40);
    CHECK(pileus_sun_default().present == 1);
    CHECK(pileus_sun_default().irradiance[1] == 1);
    CHECK(pileus_particles_default().position_stride == 12);
    CHECK(pileus_cloud_detail_default().frame_pixels == 60000);
}

TEST_CASE("the header says the version of the library that it came with") {
    const std::string version = std::to_string(PILEUS_VERSION_MAJOR) + "." +
                                std::to_string(PILEUS_VERSION_MINOR) + "." +
                                std::to_string(PILEUS_VERSION_PATCH);
    CHECK(std::string(pileus_version()).rfind(version, 0) == 0);
    CHECK(std::string(PILEUS_VERSION_STRING) == pileus_version());
    CHECK(pileus_api_version() == PILEUS_API_VERSION);
}

TEST_CASE("defaults: a session takes them as they are") {
    Hosted host(kSmallCumulus, {"method.name=\"raymarch\""});
    REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
    pileus_session* const s = host.session.get();
    pileus_error* const e = &host.out.error;
    auto camera = pileus_camera_default();
    camera.position_m[1] = -4000, camera.position_m[2] = 900, camera.target_m[2] = 1000;
    host.check(pileus_session_set_camera(s, &camera, e));
    const auto sun = pileus_sun_default();
    host.check(pileus_session_set_sun(s, &sun, e));
    auto sky = pileus_environment_default();
    host.check(pileus_session_set_environment(s, &sky, e));
    const auto ground = pileus_ground_default();
    host.check(pileus_session_set_ground(s, &ground, e));
    const auto placement = pileus_placement_default();
    host.check(pileus_session_set_placement(s, &placement, e));
    const auto depth = pileus_depth_image_default();
    host.check(pileus_session_set_depth(s, &depth, e));
    const auto work = pileus_work_default();
    host.check(pileus_session_set_work(s, &work, e));
    auto governor = pileus_governor_default();
    auto next = pileus_work_default();
    host.check(pileus_session_govern(s, &governor, 0, &next, e));
    pileus_lamp lamps[3] = {pileus_lamp_default(), pileus_lamp_default(), pileus_lamp_default()};
    lamps[1].type = PILEUS_LAMP_SPOT, lamps[2].type = PILEUS_LAMP_DIRECTIONAL;
    host.check(pileus_session_set_lamps(s, lamps, 3, e));
    const auto frame = pileus_frame_default();
    host.check(pileus_session_render(s, &frame, e));
}

TEST_CASE("defaults: memory that nobody made a struct of is refused, whatever it holds") {
    Hosted host(kSmallCumulus, {"method.name=\"raymarch\""});
    REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
    pileus_sun sun;
    for (const int byte : {0, 1, 0x49, 0x50, 0x7f, 0xa5, 0xff}) {
        CAPTURE(byte);
        std::memset(&sun, byte, sizeof sun);
        CHECK(pileus_session_set_sun(host.session.get(), &sun, &host.out.error) ==
              PILEUS_ERROR_INPUT);
        CHECK(host.out.line().find("sun: null or not initialised, allowed: ") == 0);
    }
    sun = pileus_sun_default();
    sun.struct_size = sizeof sun;
    CHECK(pileus_session_set_sun(host.session.get(), &sun, &host.out.error) == PILEUS_ERROR_INPUT);
    // Sizes that no struct has leave memory alone.
    unsigned char few[4] = {7, 7, 7, 7};
    pileus_default(3, few, 3);
    pileus_init(few, 0);
    CHECK(few[0] == 7);
    pileus_default(3, nullptr, 64);
    pileus_init(nullptr, 64);
    std::vector<unsigned char> large(0x10000, 7);
    pileus_default(99, large.data(), 0x10000);
    CHECK(large[0] == 7);
}
