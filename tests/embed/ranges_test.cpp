// SPDX-License-Identifier: Apache-2.0
// Numbers of the C interface's structs just beyond the ranges of their keys: refused as in texts.
// in: the ends of each key's range -> out: the line of the same value in a scene, or a host's
// words. src/scene/number_keys.h; docs/scene.md
#include <cmath>

#include "src/base/number_text.h"
#include "src/scene/keys/all_keys.h"
#include "src/scene/read_scene.h"
#include "tests/embed/clouds_harness.h"

namespace ranges_test {

using namespace clouds_test;
using pileus::KeyKind;
using pileus::KeyRow;

/// Structs with which every setter is content.
struct Given {
    pileus_camera camera = cleared<pileus_camera>();
    pileus_sun sun = cleared<pileus_sun>();
    pileus_environment sky = cleared<pileus_environment>();
    pileus_ground ground = cleared<pileus_ground>();
    pileus_lamp light[3] = {cleared<pileus_lamp>(), cleared<pileus_lamp>(), cleared<pileus_lamp>()};
    pileus_work work = cleared<pileus_work>();
    pileus_density density = cleared<pileus_density>();
    pileus_cloud place = at(0, 0, 0);
    pileus_cloud_detail detail = cleared<pileus_cloud_detail>();
    std::vector<float> map = std::vector<float>(4 * 2 * 3, 0.5f);

    Given() {
        camera.position_m[1] = -4000, camera.position_m[2] = 256, camera.fov_deg = 40;
        sun.present = sky.present = ground.present = 1;
        for (std::uint32_t i = 0; i < 3; ++i) {
            light[i].type = i;
            light[i].position_m[2] = 1200, light[i].direction[2] = -1, light[i].cone_deg = 40;
        }
        for (std::uint32_t& n : density.size) n = 1;
    }
    pileus_code set(const std::string& key, CloudySky& s, pileus_error* e) {
        pileus_session* const session = s.kind.session.get();
        const auto of = [&](const char* table) { return key.rfind(table, 0) == 0; };
        if (of("camera")) return pileus_session_set_camera(session, &camera, e);
        if (of("sun")) return pileus_session_set_sun(session, &sun, e);
        if (of("sky.map")) sky.map_size[0] = 4, sky.map_size[1] = 2, sky.map = map.data();
        if (of("sky")) return pileus_session_set_environment(session, &sky, e);
        if (of("ground")) return pileus_session_set_ground(session, &ground, e);
        if (of("light")) return pileus_session_set_lamps(session, light, 3, e);
        if (of("raymarch")) return pileus_session_set_work(session, &work, e);
        if (of("clouds.place")) return pileus_clouds_place(s.clouds.get(), &place, 1, e);
        if (of("clouds")) return pileus_clouds_set_detail(s.clouds.get(), &detail, e);
        pileus_world* world = nullptr;
        return pileus_world_create(s.kind.scene.get(), nullptr, &density, 1, &world, e);
    }
};

/// `text`: how a scene says it, with @ for the number; null: hosts have words of their own.
const struct {
    const char *key, *text;
    void (*put)(Given&, double);
} kRows[] = {
    {"camera.position_m", "[@,0,600]", [](Given& g, double v) { g.camera.position_m[0] = v; }},
    {"camera.target_m", "[0,@,600]", [](Given& g, double v) { g.camera.target_m[1] = v; }},
    {"camera.up", "[0,0,@]", [](Given& g, double v) { g.camera.up[2] = v; }},
    {"camera.fov_deg", "@", [](Given& g, double v) { g.camera.fov_deg = v; }},
    {"camera.height_m", nullptr, [](Given& g, double v) { g.camera.height_m = v; }},
    {"camera.resolution", nullptr, [](Given& g, double v) { g.camera.width = std::uint32_t(v); }},
    {"sun.azimuth_deg", "@", [](Given& g, double v) { g.sun.azimuth_deg = v; }},
    {"sun.elevation_deg", "@", [](Given& g, double v) { g.sun.elevation_deg = v; }},
    {"sun.irradiance", "[0,@,0]", [](Given& g, double v) { g.sun.irradiance[1] = float(v); }},
    {"sky.radiance", "[0,@,0]", [](Given& g, double v) { g.sky.radiance[1] = float(v); }},
    {"sky.map_scale", "@", [](Given& g, double v) { g.sky.map_scale = v; }},
    {"sky.map_rotation_deg", "@", [](Given& g, double v) { g.sky.map_rotation_deg = v; }},
    {"ground.altitude_m", "@", [](Given& g, double v) { g.ground.altitude_m = v; }},
    {"ground.albedo", "@", [](Given& g, double v) { g.ground.albedo = v; }},
    {"light.0.position_m", "[@,0,0]", [](Given& g, double v) { g.light[0].position_m[0] = v; }},
    {"light.0.intensity", "[@,0,0]", [](Given& g, double v) { g.light[0].light[0] = float(v); }},
    {"light.0.radius_m", "@", [](Given& g, double v) { g.light[0].radius_m = v; }},
    {"light.0.shadow_samples", nullptr,
     [](Given& g, double v) { g.light[0].shadow_samples = std::uint32_t(v); }},
    {"light.1.direction", "[@,0,0]", [](Given& g, double v) { g.light[1].direction[0] = v; }},
    {"light.1.cone_deg", "@", [](Given& g, double v) { g.light[1].cone_deg = v; }},
    {"light.1.penumbra_deg", "@", [](Given& g, double v) { g.light[1].penumbra_deg = v; }},
    {"light.2.azimuth_deg", "@", [](Given& g, double v) { g.light[2].azimuth_deg = v; }},
    {"light.2.elevation_deg", "@", [](Given& g, double v) { g.light[2].elevation_deg = v; }},
    {"light.2.irradiance", "[@,0,0]", [](Given& g, double v) { g.light[2].light[0] = float(v); }},
    {"raymarch.steps", "@", [](Given& g, double v) { g.work.steps = std::uint32_t(v); }},
    {"raymarch.light_refresh", "@",
     [](Given& g, double v) { g.work.light_refresh = std::uint32_t(v); }},
    {"clouds.place.offset_m", nullptr, [](Given& g, double v) { g.place.offset_m[1] = v; }},
    {"clouds.place.yaw_deg", nullptr, [](Given& g, double v) { g.place.yaw_deg = v; }},
    {"clouds.place.scale", nullptr, [](Given& g, double v) { g.place.scale = v; }},
    {"clouds.detail.error_px", nullptr, [](Given& g, double v) { g.detail.error_px = v; }},
    {"clouds.detail.near_px", nullptr, [](Given& g, double v) { g.detail.near_px = v; }},
    {"clouds.detail.blend_frames", nullptr,
     [](Given& g, double v) { g.detail.blend_frames = std::uint32_t(v); }},
    {"clouds.detail.sharpness", nullptr, [](Given& g, double v) { g.detail.sharpness = v; }},
    {"clouds.detail.sun_deg", nullptr, [](Given& g, double v) { g.detail.sun_deg = v; }},
    {"medium.N.density.size", nullptr,
     [](Given& g, double v) { g.density.size[1] = std::uint32_t(v); }},
};

const KeyRow& row_of(std::string path) {
    if (path.rfind("light.", 0) == 0) path[6] = 'N';
    const KeyRow* found = nullptr;
    for (const KeyRow* row : pileus::all_scene_keys()) {
        if (path == row->path) found = row;
        if (row->list == nullptr) continue;
        for (const KeyRow& own : row->list->keys())
            if (path == std::string(row->path) + "." + own.path) found = &own;
    }
    REQUIRE_MESSAGE(found != nullptr, path);
    return *found;
}

double beyond(const KeyRow& row, bool high) {
    const pileus::KeyRange& r = row.allowed.range;
    const double v = high ? r.high + std::fmax(1.0, std::fabs(r.high) * 1e-6) : r.low - 2;
    return row.kind() == KeyKind::kColor ? pileus::node_of(float(v)).number : v;
}

/// What is wrong with a value in a text, from its key on.
std::string line_of(const std::string& key, std::string value, double v) {
    value.replace(value.find('@'), 1, pileus::number_text(v));
    std::string text = kSmallCumulus;
    for (const char* type : {"point", "spot", "directional"})
        text += "[[light]]\ntype = \"" + std::string(type) + "\"\n";
    pileus::Scene scene;
    const std::string all =
        pileus::read_scene_text(text, "s", "", {key + "=" + value}, scene).message;
    const std::size_t from = all.find(key + ": out of range");
    REQUIRE_MESSAGE(from != std::string::npos, all);
    return all.substr(from, all.find('\n', from) - from);
}

TEST_CASE("each number of a host's structs has the range of its key, and its words") {
    CloudySky s({at(0, 0, 0)});
    const std::string before = s.kind.hash();
    for (const auto& number : kRows)
        for (const bool high : {false, true}) {
            const KeyRow& row = row_of(number.key);
            const double v = beyond(row, high);
            CAPTURE(std::string(number.key));
            CAPTURE(v);
            // Of most counts 0 is what the scene has.
            const bool count = row.kind() == KeyKind::kInteger || row.kind() == KeyKind::kInteger2;
            if (count && v <= 0) continue;
            Given given;
            number.put(given, v);
            CHECK(given.set(number.key, s, &s.out.error) == PILEUS_ERROR_INPUT);
            const std::string words = number.text != nullptr
                                          ? line_of(number.key, number.text, v)
                                          : " to " + pileus::end_words(row.allowed.range.high);
            CHECK_MESSAGE(s.out.line().find(words) != std::string::npos, s.out.line());
        }
    CHECK(s.kind.hash() == before);
    CHECK(pileus::end_words(1e12) == "1e12");
    CHECK(pileus::end_words(-1e7) == "-1e7");
}

}  // namespace ranges_test
