// SPDX-License-Identifier: Apache-2.0
// Fuzz target: functions of pileus.h for whole skies one after the other, with arguments of any
// kind. in: arbitrary bytes, read as calls -> out: each call a code and, where that is a fault, a
// line. docs/whole-sky.md
#include "tests/fuzz/api_calls.h"

namespace {

constexpr const char* kSky =
    "[camera]\nposition_m = [0, -30, 5]\ntarget_m = [0, 0, 5]\nresolution = [3, 2]\n"
    "[sun]\n[sky]\nradiance = 0.1\n[ground]\nalbedo = 0.2\n";
constexpr const char* kMedium =
    "[camera]\nposition_m = [0, -30, 5]\ntarget_m = [0, 0, 5]\nresolution = [3, 2]\n"
    "[[medium]]\ndensity = \"uniform:box\"\nbounds_m = [[-4, -4, 1], [4, 4, 9]]\n"
    "resolution = [2, 2, 2]\nextinction_per_m = 0.3\n"
    "[method]\nname = \"raymarch\"\n[raymarch]\nsteps = 4\n";
constexpr int kMaxCalls = 24;
constexpr std::uint32_t kTexels = 16;

class SkyCalls : fuzz::ApiCalls {
public:
    SkyCalls(const std::uint8_t* data, std::size_t size) : ApiCalls(data, size) {
        host_ = pileus_host_default();
        host_.threads = 1;
        host_.isa = "scalar";
        pileus_scene* scene = nullptr;
        check(pileus_scene_parse(kSky, nullptr, nullptr, 0, &scene, fault()));
        check(pileus_sky_create(scene, &host_, &sky_, fault()));
        pileus_scene_free(scene);
        fuzz::require(sky_ != nullptr, "a sound scene has a sky");
        check(pileus_scene_parse(kMedium, nullptr, nullptr, 0, &scene_, fault()));
        check(pileus_world_create(scene_, &host_, nullptr, 0, &world_, fault()));
    }
    ~SkyCalls() {
        pileus_world_free(world_);
        pileus_scene_free(scene_);
        pileus_sky_free(sky_);
    }
    SkyCalls(const SkyCalls&) = delete;
    SkyCalls& operator=(const SkyCalls&) = delete;

    using Arguments::done;
    void next();

private:
    pileus_sky* sky() { return byte() % 32 == 0 ? nullptr : sky_; }

    void set();
    void place();
    void draw();
    void light();
    void shadow();

    pileus_host host_;
    pileus_sky* sky_ = nullptr;
    pileus_scene* scene_ = nullptr;
    pileus_world* world_ = nullptr;
};

void SkyCalls::set() {
    double v[3];
    numbers(v);
    const char* const reports[] = {"EGLL 271020Z 24015KT CAVOK", "NIL", "", nullptr};
    switch (byte() % 5) {
        case 0:
            check(pileus_sky_set_time(sky(), number(), fault()));
            break;
        case 1:
            check(pileus_sky_move(sky(), byte() % 16 == 0 ? nullptr : v, fault()));
            break;
        case 2:
            check(pileus_sky_set_weather(sky(), reports[byte() % std::size(reports)], count(),
                                         number(), fault()));
            break;
        case 3:
            check(pileus_sky_add_layer(sky(), byte() % 8 == 0 ? nullptr : world_,
                                       byte() % 8 == 0 ? nullptr : scene_, fault()));
            break;
        default: {
            pileus_sun sun = pileus_sun_default();
            sun.azimuth_deg = number(), sun.elevation_deg = number();
            check(pileus_session_set_sun(pileus_sky_session(sky()), aged(sun), fault()));
        }
    }
}

void SkyCalls::place() {
    pileus_clouds* const clouds = pileus_sky_clouds(sky());
    if (byte() % 2 == 0) {
        std::uint32_t kind = 0;
        // Memory is not what is tried here.
        if (byte() % 4 == 0) check(pileus_clouds_add_kind(clouds, world_, scene_, &kind, fault()));
        return;
    }
    pileus_cloud cloud = pileus_cloud_default();
    cloud.kind = count();
    numbers(cloud.offset_m);
    cloud.yaw_deg = number(), cloud.scale = number(), cloud.presence = number();
    check(pileus_clouds_place(clouds, aged(cloud), byte() % 2, fault()));
}

void SkyCalls::draw() {
    float colours[4 * 6], depths[6], given[6];
    for (float& metres : given) metres = single();
    pileus_depth_image depth = pileus_depth_image_default();
    depth.values = byte() % 8 == 0 ? nullptr : given;
    depth.kind = count();
    pileus_frame frame = pileus_frame_default();
    for (float& c : colours) c = single();
    frame.colour = colours;
    frame.format = count(), frame.blend = count();
    frame.depth = byte() % 2 == 0 ? depths : nullptr;
    check(pileus_sky_render(sky(), byte() % 2 == 0 ? aged(depth) : nullptr, aged(frame), fault()));
}

void SkyCalls::light() {
    pileus_sky_light place = pileus_sky_light_default();
    numbers(place.position_m);
    check(pileus_sky_light_at(sky(), aged(place), byte() % 2, fault()));
    double to[3];
    numbers(to);
    float left[3], sent[3];
    check(pileus_sky_air(sky(), byte() % 16 == 0 ? nullptr : to, number(), left, sent, fault()));
}

void SkyCalls::shadow() {
    float texels[kTexels], heights[kTexels];
    for (float& z : heights) z = single();
    pileus_shadow_map map = pileus_shadow_map_default();
    map.width = byte() % 16 == 0 ? count() : 4;
    map.height = byte() % 16 == 0 ? count() : 4;
    map.format = count();
    for (int a = 0; a < 2; ++a) map.low_m[a] = number(), map.size_m[a] = number();
    map.altitude_m = number();
    map.first_row = byte() % 8, map.rows = byte() % 8;
    map.bottom_up = byte() % 2;
    map.stride = byte() % 16 == 0 ? std::int64_t(count()) : 0;
    const bool fits = std::uint64_t(map.width) * map.height <= kTexels && map.stride <= 16;
    map.texels = fits ? texels : nullptr;
    map.heights = fits && byte() % 2 == 0 ? heights : nullptr;
    check(pileus_sky_shadow(sky(), aged(map), fault()));
}

void SkyCalls::next() {
    constexpr void (SkyCalls::*kCalls[])() = {&SkyCalls::set,  &SkyCalls::set,   &SkyCalls::place,
                                              &SkyCalls::draw, &SkyCalls::light, &SkyCalls::shadow};
    call_one(*this, kCalls);
}

}  // namespace

int fuzz::sky_calls(const std::uint8_t* data, std::size_t size) {
    return run_calls<SkyCalls>(data, size, kMaxCalls);
}
