// SPDX-License-Identifier: Apache-2.0
// Fuzz target: functions of pileus.h one after the other, with arguments of any kind.
// in: arbitrary bytes, read as calls -> out: each call a code and, where that is a fault, a line.
// docs/embedding.md
#include "tests/fuzz/api_calls.h"

namespace {

constexpr const char* kScene =
    "[camera]\nposition_m = [0, -30, 5]\ntarget_m = [0, 0, 5]\nresolution = [3, 2]\n"
    "[sun]\n[sky]\nradiance = 0.1\n[ground]\nalbedo = 0.2\n"
    "[[medium]]\ndensity = \"uniform:box\"\nbounds_m = [[-4, -4, 1], [4, 4, 9]]\n"
    "resolution = [2, 2, 2]\nextinction_per_m = 0.3\n"
    "[collectors]\nphotons = 8\ngenerations = 2\nsamples = 8\n"
    "[photon_grid]\nphotons = 8\ngenerations = 2\nring = true\n"
    "[path]\nsamples_per_pixel = 1\n[raymarch]\nsteps = 4\n";
constexpr const char* kMethods[] = {"raymarch", "optical-depth", "path", "collectors",
                                    "photon-grid"};
constexpr std::uint32_t kPixels = 64;  ///< that buffers have room for
constexpr int kSlots = 2;
constexpr int kMaxCalls = 48;

class Calls : fuzz::ApiCalls {
public:
    Calls(const std::uint8_t* data, std::size_t size) : ApiCalls(data, size) {
        host_ = pileus_host_default();
        host_.threads = 1;
        host_.isa = "scalar";
        // One of each, so that most calls have something to work on.
        const std::string method =
            std::string("method.name=") + kMethods[byte() % std::size(kMethods)];
        const char* const sets[] = {method.c_str()};
        check(pileus_scene_parse(kScene, nullptr, sets, 1, &scene_[0], fault()));
        check(pileus_world_create(scene_[0], &host_, nullptr, 0, &world_[0], fault()));
        check(pileus_session_create(world_[0], scene_[0], &host_, &session_[0], fault()));
        fuzz::require(session_[0] != nullptr, "a sound scene has a session");
    }
    ~Calls() {
        pileus_clouds_free(clouds_);
        for (int i = 0; i < kSlots; ++i) {
            pileus_session_free(session_[i]);
            pileus_world_free(world_[i]);
            pileus_scene_free(scene_[i]);
        }
    }
    Calls(const Calls&) = delete;
    Calls& operator=(const Calls&) = delete;

    using Arguments::done;
    void next();

private:
    int slot() { return byte() % kSlots; }

    void make_scene();
    void make_world();
    void make_session();
    void set_view();
    void set_lights();
    void set_rest();
    void draw();
    void ask();
    void work();
    void sky();

    pileus_host host_;
    pileus_scene* scene_[kSlots] = {};
    pileus_world* world_[kSlots] = {};
    pileus_session* session_[kSlots] = {};
    pileus_clouds* clouds_ = nullptr;
};

void Calls::make_scene() {
    const int at = slot();
    switch (byte() % 4) {
        case 0: {
            pileus_scene_free(scene_[at]);
            scene_[at] = nullptr;
            const std::string method =
                std::string("method.name=") + kMethods[byte() % std::size(kMethods)];
            const char* const sets[] = {method.c_str()};
            check(pileus_scene_parse(kScene, nullptr, sets, 1, &scene_[at], fault()));
            break;
        }
        case 1: {
            const char* const keys[] = {"medium.0.albedo", "medium.0.extinction_per_m", "sun",
                                        "camera.fov_deg",  "medium.0.phase.g",          ""};
            const char* const values[] = {"0.5", "0", "nan", "[1, 2]", "true", "{", ""};
            check(pileus_scene_set(scene_[at], keys[byte() % std::size(keys)],
                                   values[byte() % std::size(values)], fault()));
            break;
        }
        case 2: {
            double values[3];
            numbers(values);
            check(pileus_scene_set_numbers(scene_[at], "medium.0.albedo", values, count() % 4,
                                           fault()));
            break;
        }
        default: {
            char text[64];
            std::size_t needed = 0;
            check(
                pileus_scene_dump(scene_[at], text, byte() % (sizeof text + 1), &needed, fault()));
        }
    }
}

void Calls::make_world() {
    const int at = slot();
    pileus_plan plan = pileus_plan_default();
    check(pileus_plan_scene(scene_[slot()], &host_, aged(plan), fault()));
    pileus_world_free(world_[at]);
    world_[at] = nullptr;
    float cells[8];
    singles(cells);
    pileus_density density = pileus_density_default();
    for (std::uint32_t& n : density.size) n = 2;
    density.medium = count();
    density.values = byte() == 0 ? nullptr : cells;
    check(pileus_world_create(scene_[slot()], &host_, aged(density), byte() % 3, &world_[at],
                              fault()));
}

void Calls::make_session() {
    const int at = slot();
    if (byte() % 4 == 0) {
        check(pileus_session_hand_over(session_[at], session_[slot()], count(), fault()));
        return;
    }
    // A sky keeps its session until it goes.
    pileus_session_free(session_[at]);
    session_[at] = nullptr;
    host_.layers = byte() % 2;
    check(pileus_session_create(world_[slot()], scene_[slot()], &host_, &session_[at], fault()));
}

void Calls::set_view() {
    pileus_session* const s = session_[slot()];
    if (byte() % 2 == 0) {
        pileus_camera camera = pileus_camera_default();
        camera.width = count(), camera.height = count();
        numbers(camera.position_m);
        numbers(camera.target_m);
        if (byte() % 2 == 0) numbers(camera.up);
        camera.fov_deg = number(), camera.height_m = number();
        camera.near_m = number(), camera.far_m = number();
        check(pileus_session_set_camera(s, aged(camera), fault()));
    } else {
        double view[16] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, -5, -30, 1};
        double projection[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -1, 0};
        view[byte() % 16] = number();
        projection[byte() % 16] = number();
        check(pileus_session_set_matrices(s, view, projection, pileus_clip(byte() % 2), count(),
                                          count(), fault()));
    }
}

void Calls::set_lights() {
    pileus_session* const s = session_[slot()];
    switch (byte() % 4) {
        case 0: {
            pileus_sun sun = pileus_sun_default();
            sun.present = byte() % 2;
            sun.azimuth_deg = number(), sun.elevation_deg = number();
            singles(sun.irradiance);
            check(pileus_session_set_sun(s, aged(sun), fault()));
            break;
        }
        case 1: {
            float map[3 * 8];
            singles(map);
            pileus_environment sky = pileus_environment_default();
            singles(sky.radiance);
            if (byte() % 2 == 0) sky.map_size[0] = 4, sky.map_size[1] = 2;
            if (byte() == 9) sky.map_size[0] = count(), sky.map_size[1] = count();
            const bool fits = sky.map_size[0] * std::uint64_t(sky.map_size[1]) <= 8;
            sky.map = fits && byte() != 0 ? map : nullptr;
            sky.map_scale = number(), sky.map_rotation_deg = number();
            check(pileus_session_set_environment(s, aged(sky), fault()));
            break;
        }
        case 2: {
            pileus_ground ground = pileus_ground_default();
            ground.present = byte() % 2;
            ground.altitude_m = number(), ground.albedo = number();
            check(pileus_session_set_ground(s, aged(ground), fault()));
            break;
        }
        default: {
            pileus_lamp lamps[2] = {pileus_lamp_default(), pileus_lamp_default()};
            for (pileus_lamp& lamp : lamps) {
                lamp.type = count();
                numbers(lamp.position_m);
                lamp.radius_m = number();
                numbers(lamp.direction);
                lamp.cone_deg = number(), lamp.penumbra_deg = number();
                lamp.azimuth_deg = number(), lamp.elevation_deg = number();
                singles(lamp.light);
                lamp.shadow_samples = count();
            }
            pileus_lamp* const given = aged(lamps[0]);
            check(pileus_session_set_lamps(s, given, byte() % 3, fault()));
        }
    }
}

void Calls::set_rest() {
    pileus_session* const s = session_[slot()];
    switch (byte() % 4) {
        case 0: {
            pileus_placement place = pileus_placement_default();
            numbers(place.offset_m);
            place.yaw_deg = number();
            check(pileus_session_set_placement(s, aged(place), fault()));
            break;
        }
        case 1: {
            std::uint32_t width = 0, height = 0;
            check(pileus_session_size(s, &width, &height, fault()));
            float depths[kPixels];
            for (float& v : depths) v = 20;
            depths[byte() % kPixels] = single();
            pileus_depth_image image = pileus_depth_image_default();
            image.kind = count();
            image.values =
                std::uint64_t(width) * height <= kPixels && byte() != 0 ? depths : nullptr;
            image.bottom_up = byte() % 2;
            check(pileus_session_set_depth(s, aged(image), fault()));
            break;
        }
        case 2:
            check(pileus_session_set_frame(s, int(count()), fault()));
            break;
        default:
            check(pileus_session_set_media(s, scene_[slot()], fault()));
    }
}

void Calls::draw() {
    pileus_session* const s = session_[slot()];
    std::uint32_t width = 0, height = 0;
    check(pileus_session_size(s, &width, &height, fault()));
    if (byte() % 3 == 0) pileus_session_cancel(s);
    if (byte() % 2 == 0) {
        std::uint32_t units = 0;
        check(pileus_session_step(s, byte() % 4, &units, fault()));
        fuzz::require(units < 4, "no more units than asked for");
    }
    alignas(16) unsigned char colours[16 * kPixels];
    float depths[kPixels], layer[kPixels];
    std::uint64_t hash = 0;
    const bool fits = std::uint64_t(width) * height <= kPixels;
    pileus_frame frame = pileus_frame_default();
    frame.colour = fits && byte() % 2 == 0 ? colours : nullptr;
    frame.format = count(), frame.blend = count();
    frame.bottom_up = byte() % 2;
    frame.exposure_stops = single();
    frame.depth = fits && byte() % 2 == 0 ? depths : nullptr;
    frame.depth_kind = count(), frame.depth_format = count();
    frame.hash = byte() % 2 == 0 ? &hash : nullptr;
    const char* const names[] = {"R", "A", "Z", "tau", "", nullptr};
    pileus_layer one = pileus_layer_default();
    one.name = names[byte() % std::size(names)];
    one.values = fits ? layer : nullptr;
    frame.layers = byte() % 2 == 0 ? aged(one) : nullptr;
    frame.layer_count = byte() % 2;
    if (clouds_ != nullptr && byte() % 2 == 0) {
        frame.colour = nullptr;
        frame.depth = nullptr;
        check(pileus_clouds_render(clouds_, aged(frame), fault()));
    } else {
        check(pileus_session_render(s, aged(frame), fault()));
    }
}

void Calls::ask() {
    const pileus_session* const s = session_[slot()];
    pileus_stats stats = pileus_stats_default();
    check(pileus_session_stats(s, aged(stats), fault()));
    pileus_progress progress = pileus_progress_default();
    check(pileus_session_progress(s, aged(progress), fault()));
    char text[256];
    std::size_t needed = 0;
    if (byte() % 8 == 0)
        check(pileus_session_report(s, text, byte(), byte() % 2 == 0 ? &needed : nullptr, fault()));
    pileus_key key = pileus_key_default();
    check(pileus_key_at(count(), aged(key), fault()));
}

void Calls::work() {
    pileus_session* const s = session_[slot()];
    pileus_work work = pileus_work_default();
    work.scale = count(), work.temporal = count(), work.steps = count();
    work.light_refresh = count(), work.photons = count();
    check(pileus_session_set_work(s, aged(work), fault()));
    pileus_units units = pileus_units_default();
    check(
        pileus_session_most_units(s, byte() % 2 == 0 ? nullptr : aged(work), aged(units), fault()));
    pileus_costs costs = pileus_costs_default();
    costs.fixed = number(), costs.pixel = number(), costs.ray = number();
    check(pileus_session_fit(s, aged(costs), number(), aged(work), fault()));
    pileus_governor governor = pileus_governor_default();
    governor.level = count(), governor.target_s = number();
    check(pileus_session_govern(s, aged(governor), number(), aged(work), fault()));
    check(pileus_session_work(s, aged(work), fault()));
}

void Calls::sky() {
    switch (byte() % 4) {
        case 0:
            pileus_clouds_free(clouds_);
            clouds_ = nullptr;
            check(pileus_clouds_create(session_[slot()], &clouds_, fault()));
            break;
        case 1: {
            std::uint32_t kind = 0;
            check(pileus_clouds_add_kind(clouds_, world_[slot()], scene_[slot()], &kind, fault()));
            break;
        }
        case 2: {
            pileus_cloud cloud = pileus_cloud_default();
            cloud.kind = count();
            numbers(cloud.offset_m);
            cloud.yaw_deg = number(), cloud.scale = number();
            check(pileus_clouds_place(clouds_, aged(cloud), byte() % 2, fault()));
            break;
        }
        default: {
            pileus_cloud_detail detail = pileus_cloud_detail_default();
            detail.off = byte() % 2;
            detail.error_px = number(), detail.near_px = number();
            detail.near_scale = count(), detail.blend_frames = count();
            check(pileus_clouds_set_detail(clouds_, aged(detail), fault()));
            pileus_cloud_stats stats = pileus_cloud_stats_default();
            check(pileus_clouds_stats(clouds_, aged(stats), fault()));
        }
    }
}

void Calls::next() {
    constexpr void (Calls::*kCalls[])() = {
        &Calls::make_scene, &Calls::make_world, &Calls::make_session, &Calls::set_view,
        &Calls::set_view,   &Calls::set_lights, &Calls::set_lights,   &Calls::set_rest,
        &Calls::ask,        &Calls::work,       &Calls::sky,          &Calls::draw};
    call_one(*this, kCalls);
}

}  // namespace

int fuzz::calls(const std::uint8_t* data, std::size_t size) {
    return run_calls<Calls>(data, size, kMaxCalls);
}
