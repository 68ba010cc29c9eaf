// SPDX-License-Identifier: Apache-2.0
// pileus.h: sessions and what a host sets in them.
#include <cstring>
#include <glm/gtc/type_ptr.hpp>

#include "include/pileus/pileus.h"
#include "src/api/c_types.h"
#include "src/base/number_text.h"
#include "src/base/single.h"
#include "src/scene/number_keys.h"

namespace pileus::api {
namespace {

template <class From, class To>
void copy3(const From (&from)[3], To& to) {
    for (std::size_t a = 0; a < 3; ++a) to[a] = from[a];
}

bool is_zero(const double (&v)[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

/// A call that changes a session by one struct.
template <class Given, class Set>
pileus_code change(pileus_session* session, const Given* given, const char* name,
                   pileus_error* error, Set set) {
    if (session == nullptr) return no_session(error);
    return call(*session, error, [&]() -> Status {
        Given own;
        if (!take(given, own)) return no_struct(name);
        return set(own, *session->session);
    });
}

Status take_size(std::uint32_t width, std::uint32_t height, Camera& camera) {
    for (const std::uint32_t n : {width, height})
        if (n > 0)
            PILEUS_TRY(check_number("camera.", "resolution", n, range_of(&Camera::resolution)));
    if (width > 0) camera.resolution[0] = int(width);
    if (height > 0) camera.resolution[1] = int(height);
    return Status::ok();
}

/// What a camera has beside its place and view; 0 is none.
Status check_lens(const pileus_camera& given) {
    constexpr double kFar = 1e15;
    const auto refuse = [](const char* what, double v, const char* allowed) {
        return Status::bad_input(std::string("camera.") + what + ": " + number_text(v) +
                                 ", allowed: " + allowed);
    };
    const double highest = range_of(&Camera::height_m).high;
    if (!holds({0, highest}, given.height_m))
        return refuse("height_m", given.height_m,
                      ("above 0 to " + end_words(highest) + " m; 0: perspective").c_str());
    const bool parallel = given.height_m > 0;
    const KeyRange depths{parallel ? -kFar : 0, kFar};
    if (!holds(depths, given.near_m))
        return refuse("near_m", given.near_m,
                      parallel ? "-1e15 to 1e15 m" : "0 (no depth buffer) to 1e15 m");
    if (!holds(depths, given.far_m))
        return refuse("far_m", given.far_m,
                      parallel ? "-1e15 to 1e15 m" : "0 (infinite) to 1e15 m");
    if (given.far_m != 0 && !(given.far_m > given.near_m))
        return refuse("far_m", given.far_m, "0, or beyond near_m");
    return Status::ok();
}

Status set_camera(const pileus_camera& given, Session& session) {
    Camera camera = session.camera();
    PILEUS_TRY(check_lens(given));
    PILEUS_TRY(take_size(given.width, given.height, camera));
    copy3(given.position_m, camera.position_m);
    copy3(given.target_m, camera.target_m);
    if (is_zero(given.up))
        camera.up = {0, 0, 1};
    else
        copy3(given.up, camera.up);
    camera.has_frustum = false;
    camera.orthographic = given.height_m > 0;
    const Camera plain;
    camera.fov_deg = camera.orthographic ? plain.fov_deg : given.fov_deg;
    camera.height_m = camera.orthographic ? given.height_m : plain.height_m;
    PILEUS_TRY(session.set_camera(camera));
    return session.set_depth_scale(depth_scale(camera.orthographic, given.near_m, given.far_m));
}

/// A map of three floats a texel as an image.
Status map_image(const pileus_environment& given, Image& image) {
    image.width = int(given.map_size[0]);
    image.height = int(given.map_size[1]);
    const std::size_t texels = std::size_t(image.width) * std::size_t(image.height);
    const char* const names[3] = {"R", "G", "B"};
    image.channels.resize(3);
    for (std::size_t c = 0; c < 3; ++c) {
        image.channels[c].name = names[c];
        PILEUS_TRY(image.channels[c].pixels.resize(texels, "sky map"));
        for (std::size_t i = 0; i < texels; ++i) image.channels[c].pixels[i] = given.map[3 * i + c];
    }
    return Status::ok();
}

Status set_sky(const pileus_environment& given, Session& session) {
    Sky sky;
    sky.present = given.present != 0;
    copy3(given.radiance, sky.radiance);
    sky.map_scale = given.map_scale == 0 ? 1 : given.map_scale;
    sky.map_rotation_deg = given.map_rotation_deg;
    const std::uint64_t columns = given.map_size[0], rows = given.map_size[1];
    constexpr std::uint64_t kMaxRows = 8192;
    if (columns != 2 * rows || rows > kMaxRows)
        return Status::bad_input("sky.map_size: " + std::to_string(columns) + " x " +
                                 std::to_string(rows) + ", allowed: columns = 2 rows, at most " +
                                 std::to_string(2 * kMaxRows) + " x " + std::to_string(kMaxRows) +
                                 "; 0 x 0: no map");
    if (given.present == 0 || columns == 0) return session.set_sky(sky, nullptr, false);
    if (given.map == nullptr) {
        if (!session.has_sky_map())
            return Status::bad_input("sky.map: null, and there is none to keep, allowed: texels");
        return session.set_sky(sky, nullptr, true);
    }
    Image image;
    PILEUS_TRY(map_image(given, image));
    return session.set_sky(sky, &image, false);
}

Status take_light(const pileus_lamp& given, LightSettings& own) {
    if (given.type > PILEUS_LAMP_DIRECTIONAL)
        return Status::bad_input(
            "light.type: " + std::to_string(given.type) +
            ", allowed: PILEUS_LAMP_POINT, PILEUS_LAMP_SPOT, PILEUS_LAMP_DIRECTIONAL");
    own.type = LampKind(given.type);
    if (own.type == LampKind::kDirectional) {
        own.azimuth_deg = given.azimuth_deg;
        own.elevation_deg = given.elevation_deg;
        copy3(given.light, own.irradiance);
        return Status::ok();
    }
    own.position_m = glm::make_vec3(given.position_m);
    own.radius_m = given.radius_m;
    const double most = range_of(&LightSettings::shadow_samples).high;
    PILEUS_TRY(check_number("light.", "shadow_samples", given.shadow_samples, {0, most}));
    if (given.shadow_samples > 0) own.shadow_samples = int(given.shadow_samples);
    copy3(given.light, own.intensity);
    if (own.type != LampKind::kSpot) return Status::ok();
    own.direction = glm::make_vec3(given.direction);
    if (single_or_0(own.direction) == Double3{})
        return Status::bad_input("light.direction: 0, 0, 0, allowed: any other of a spot");
    own.cone_deg = given.cone_deg;
    own.penumbra_deg = given.penumbra_deg;
    return Status::ok();
}

Status set_depth(const pileus_depth_image& given, Session& session) {
    if (given.kind > PILEUS_DEPTH_BUFFER)
        return Status::bad_input(
            "depth.kind: " + std::to_string(given.kind) +
            ", allowed: PILEUS_DEPTH_DISTANCE, PILEUS_DEPTH_VIEW_Z, PILEUS_DEPTH_BUFFER");
    if (given.values == nullptr) return session.set_depth(nullptr, DepthKind::kDistance);
    const auto width = std::int64_t(session.camera().resolution[0]) * std::int64_t(sizeof(float));
    // Read only: rows are shared with those that are written.
    Rows rows;
    rows.first = reinterpret_cast<unsigned char*>(const_cast<float*>(given.values));
    PILEUS_TRY(take_stride("depth", given.stride, width,
                           std::uint32_t(session.camera().resolution[1]), rows));
    rows.bottom_up = given.bottom_up != 0;
    return session.set_depth(&rows, DepthKind(given.kind));
}

}  // namespace

Status take_stride(const char* name, std::int64_t stride, std::int64_t least, std::uint32_t count,
                   Rows& rows) {
    const std::int64_t most = PTRDIFF_MAX / (count > 0 ? count : 1);
    rows.stride = stride == 0 ? least : stride;
    if (rows.stride >= least && rows.stride <= most) return Status::ok();
    return Status::bad_input(std::string(name) + ".stride: " + std::to_string(stride) +
                             " bytes, allowed: 0, or " + std::to_string(least) + " to " +
                             std::to_string(most));
}

RenderOptions with_cancel(const RenderOptions& options, pileus_session& session) {
    RenderOptions own = options;
    own.interrupted = [asked = options.interrupted, cancelled = &session.cancelled] {
        return *cancelled || (asked && asked());
    };
    return own;
}

Status set_depth_image(const pileus_depth_image* given, Session& session) {
    pileus_depth_image own;
    if (!take(given, own)) return no_struct("depth");
    return set_depth(own, session);
}

void leave(pileus_session* session) {
    if (session->users.fetch_sub(1) == 1) delete session;
}

}  // namespace pileus::api

using namespace pileus;
using namespace pileus::api;

extern "C" {

pileus_code pileus_session_create(const pileus_world* world, const pileus_scene* scene,
                                  const pileus_host* host, pileus_session** session,
                                  pileus_error* error) {
    return call_with(host, error, [&](const auto& parts, const RenderOptions& options) -> Status {
        if (world == nullptr) return no_handle("world");
        if (scene == nullptr) return no_handle("scene");
        if (session == nullptr) return Status::bad_input("session: null, allowed: where to put it");
        auto made = std::make_unique<pileus_session>();
        made->host = parts;
        PILEUS_TRY(
            made->session->open(scene->scene, with_cancel(options, *made), true, world->world));
        *session = made.release();
        return Status::ok();
    });
}

void pileus_session_free(pileus_session* session) {
    if (session == nullptr) return;
    if (session->host->block != nullptr) return pileus_flight_close(session);
    leave(session);
}

pileus_code pileus_session_set_camera(pileus_session* session, const pileus_camera* camera,
                                      pileus_error* error) {
    return change(session, camera, "camera", error, set_camera);
}

pileus_code pileus_session_set_matrices(pileus_session* session, const double view[16],
                                        const double projection[16], pileus_clip clip,
                                        uint32_t width, uint32_t height, pileus_error* error) {
    if (session == nullptr) return no_session(error);
    return call(*session, error, [&]() -> Status {
        if (view == nullptr || projection == nullptr)
            return Status::bad_input("view, projection: null, allowed: 16 numbers each");
        // A host may hand over any number; in C++ an enumeration holds none but its own.
        std::underlying_type_t<pileus_clip> range{};
        std::memcpy(&range, &clip, sizeof range);
        if (range != PILEUS_CLIP_ZERO && range != PILEUS_CLIP_MINUS_ONE)
            return Status::bad_input("clip: " + std::to_string(int(range)) +
                                     ", allowed: PILEUS_CLIP_MINUS_ONE, PILEUS_CLIP_ZERO");
        Camera camera = session->session->camera();
        DepthScale scale;
        PILEUS_TRY(take_size(width, height, camera));
        PILEUS_TRY(camera_from_matrices(glm::make_mat4(view), glm::make_mat4(projection),
                                        range == PILEUS_CLIP_ZERO, camera, scale));
        PILEUS_TRY(session->session->set_camera(camera));
        return session->session->set_depth_scale(scale);
    });
}

pileus_code pileus_session_size(const pileus_session* session, uint32_t* width, uint32_t* height,
                                pileus_error* error) {
    if (session == nullptr) return no_session(error);
    return call(*session, error, [&]() -> Status {
        if (width == nullptr || height == nullptr)
            return Status::bad_input("width, height: null, allowed: where to put them");
        *width = std::uint32_t(session->session->camera().resolution[0]);
        *height = std::uint32_t(session->session->camera().resolution[1]);
        return Status::ok();
    });
}

pileus_code pileus_session_set_sun(pileus_session* session, const pileus_sun* sun,
                                   pileus_error* error) {
    return change(session, sun, "sun", error, [](const pileus_sun& given, Session& s) {
        Sun own;
        own.present = given.present != 0;
        own.azimuth_deg = given.azimuth_deg;
        own.elevation_deg = given.elevation_deg;
        copy3(given.irradiance, own.irradiance);
        return s.set_sun(own);
    });
}

pileus_code pileus_session_set_environment(pileus_session* session, const pileus_environment* sky,
                                           pileus_error* error) {
    return change(session, sky, "sky", error, set_sky);
}

pileus_code pileus_session_set_ground(pileus_session* session, const pileus_ground* ground,
                                      pileus_error* error) {
    return change(session, ground, "ground", error, [](const pileus_ground& given, Session& s) {
        Ground own;
        own.present = given.present != 0;
        own.altitude_m = given.altitude_m;
        own.albedo = given.albedo;
        return s.set_ground(own);
    });
}

pileus_code pileus_session_set_lamps(pileus_session* session, const pileus_lamp* lights,
                                     uint32_t count, pileus_error* error) {
    if (session == nullptr) return no_session(error);
    return call(*session, error, [&]() -> Status {
        if (count > 0 && lights == nullptr)
            return Status::bad_input("lights: null, allowed: as many as `count`");
        if (count > kMaxLights)
            return Status::bad_input("lights: " + std::to_string(count) + ", allowed: at most " +
                                     std::to_string(kMaxLights));
        std::vector<LightSettings> own(count);
        for (std::size_t i = 0; i < own.size(); ++i) {
            pileus_lamp given;
            if (!take_element(lights, i, given)) return no_element("lights", i);
            PILEUS_TRY(take_light(given, own[i]));
            own[i] = held(own[i]);
        }
        return session->session->set_lights(own);
    });
}

pileus_code pileus_session_set_placement(pileus_session* session, const pileus_placement* placement,
                                         pileus_error* error) {
    return change(session, placement, "placement", error,
                  [](const pileus_placement& given, Session& s) {
                      return s.set_placement(
                          {given.offset_m[0], given.offset_m[1], given.offset_m[2]}, given.yaw_deg);
                  });
}

pileus_code pileus_session_set_depth(pileus_session* session, const pileus_depth_image* depth,
                                     pileus_error* error) {
    return change(session, depth, "depth", error, set_depth);
}

pileus_code pileus_session_set_frame(pileus_session* session, int32_t number, pileus_error* error) {
    if (session == nullptr) return no_session(error);
    return call(*session, error, [&] { return session->session->set_frame(number); });
}

}  // extern "C"
