// SPDX-License-Identifier: Apache-2.0
// pileus.h: the whole sky of a scene, and what a host's world needs of it.
#include "include/pileus/pileus.h"
#include "src/api/c_types.h"
#include "src/base/number_text.h"
#include "src/base/single.h"
#include "src/clouds/scene_clouds.h"
#include "src/clouds/sky_probe.h"
#include "src/clouds/weather_clouds.h"
#include "src/scene/number_keys.h"

struct pileus_sky {
    pileus_session* session = nullptr;
    pileus_clouds* clouds = nullptr;
    pileus::Scene scene;  ///< as it was read: its date, its sun
    pileus::RenderOptions options;
};

namespace pileus::api {
namespace {

pileus_code no_sky(pileus_error* error) {
    return finish(Code::kBadInput, "sky: null, allowed: what pileus_sky_create made", error);
}

/// A call of a sky.
template <class Work>
pileus_code with_sky(pileus_sky* sky, pileus_error* error, Work work) {
    if (sky == nullptr) return no_sky(error);
    return call(*sky->session, error,
                [&]() -> Status { return work(*sky->session->session, *clouds_of(*sky->clouds)); });
}

Status check_finite(const char* name, const double* v, std::size_t count, double most) {
    for (std::size_t i = 0; i < count; ++i)
        if (!(v[i] >= -most && v[i] <= most))
            return Status::bad_input(std::string(name) + ": " + number_text(v[i]) +
                                     ", allowed: within " + end_words(most));
    return Status::ok();
}

constexpr double kMaxPlaceM = 1e9;

Status take_shadow(const pileus_shadow_map& given, ShadowMapTarget& target) {
    constexpr std::uint32_t kMaxTexels = 16384;
    for (const std::uint32_t n : {given.width, given.height})
        if (n < 1 || n > kMaxTexels)
            return Status::bad_input("shadow.width, height: " + std::to_string(n) +
                                     ", allowed: 1 to " + std::to_string(kMaxTexels));
    PILEUS_TRY(check_finite("shadow.low_m", given.low_m, 2, kMaxPlaceM));
    for (const double m : given.size_m)
        if (!(m >= 1e-3 && m <= 1e7))
            return Status::bad_input("shadow.size_m: " + number_text(m) +
                                     ", allowed: 0.001 to 1e7");
    PILEUS_TRY(check_finite("shadow.altitude_m", &given.altitude_m, 1, 1e6));
    if (given.format > PILEUS_SHADOW_R32F)
        return Status::bad_input("shadow.format: " + std::to_string(given.format) +
                                 ", allowed: PILEUS_SHADOW_R8, PILEUS_SHADOW_RGBA8, "
                                 "PILEUS_SHADOW_R16F, PILEUS_SHADOW_R32F");
    if (given.texels == nullptr)
        return Status::bad_input("shadow.texels: null, allowed: where to write them");
    if (given.first_row >= given.height)
        return Status::bad_input("shadow.first_row: " + std::to_string(given.first_row) +
                                 ", allowed: below height");
    const std::uint32_t rest = given.height - given.first_row;
    if (given.rows > rest)
        return Status::bad_input("shadow.rows: " + std::to_string(given.rows) +
                                 ", allowed: up to " + std::to_string(rest) +
                                 ", 0: all from first_row on");
    target.format = ShadowFormat(given.format);
    target.width = int(given.width);
    target.height = int(given.height);
    target.first = int(given.first_row);
    target.count = int(given.rows > 0 ? given.rows : rest);
    for (std::size_t a = 0; a < 2; ++a) {
        target.low_m[a] = given.low_m[a];
        target.size_m[a] = given.size_m[a];
    }
    target.altitude_m = given.altitude_m;
    target.heights = given.heights;
    target.rows.first = static_cast<unsigned char*>(given.texels);
    target.rows.bottom_up = given.bottom_up != 0;
    const std::int64_t least = std::int64_t(given.width) * std::int64_t(texel_bytes(target.format));
    return take_stride("shadow", given.stride, least, given.height, target.rows);
}

}  // namespace
}  // namespace pileus::api

using namespace pileus;
using namespace pileus::api;

extern "C" {

pileus_code pileus_sky_create(const pileus_scene* scene, const pileus_host* host, pileus_sky** sky,
                              pileus_error* error) {
    return call_with(host, error, [&](const auto& parts, const RenderOptions& options) -> Status {
        if (scene == nullptr) return no_handle("scene");
        if (sky == nullptr) return Status::bad_input("sky: null, allowed: where to put it");
        std::unique_ptr<pileus_sky, decltype(&pileus_sky_free)> made(new pileus_sky,
                                                                     pileus_sky_free);
        made->scene = scene->scene;
        made->options = options;
        Scene filled = scene->scene;
        PILEUS_TRY(apply_weather(filled));
        auto session = std::make_unique<pileus_session>();
        session->host = parts;
        PILEUS_TRY(open_sky(filled, with_cancel(options, *session), *session->session));
        made->session = session.release();
        PILEUS_TRY(make_clouds(*made->session, made->clouds));
        CloudCounts told;
        PILEUS_TRY(fill_scene_clouds(filled, options, *made->session->session,
                                     *clouds_of(*made->clouds), told));
        *sky = made.release();
        return Status::ok();
    });
}

void pileus_sky_free(pileus_sky* sky) {
    if (sky == nullptr) return;
    pileus_clouds_free(sky->clouds);
    pileus_session_free(sky->session);
    delete sky;
}

pileus_session* pileus_sky_session(pileus_sky* sky) {
    return sky != nullptr ? sky->session : nullptr;
}

pileus_clouds* pileus_sky_clouds(pileus_sky* sky) { return sky != nullptr ? sky->clouds : nullptr; }

pileus_code pileus_sky_add_layer(pileus_sky* sky, const pileus_world* world,
                                 const pileus_scene* scene, pileus_error* error) {
    return with_sky(sky, error, [&](Session&, Clouds& clouds) -> Status {
        if (world == nullptr) return no_handle("world");
        if (scene == nullptr) return no_handle("scene");
        return clouds.add_layer(scene->scene, world->world);
    });
}

pileus_code pileus_sky_set_weather(pileus_sky* sky, const char* metar, uint32_t seed,
                                   double elevation_m, pileus_error* error) {
    return with_sky(sky, error, [&](Session& session, Clouds& clouds) -> Status {
        if (metar == nullptr || *metar == 0)
            return Status::bad_input("metar: null or empty, allowed: a report");
        Scene filled = sky->scene;
        filled.clouds = CloudsSettings{};
        filled.clouds.detail = clouds.detail();
        // Towers stand around the camera as it is, over the ground as it is.
        filled.camera = session.camera();
        filled.camera.position_m -= clouds.offset();
        filled.ground = session.ground();
        filled.places.clear();
        if (!filled.atmosphere.present)
            return Status::bad_input(
                "metar: of a sky without air, allowed: a scene with [atmosphere]");
        filled.clouds.weather.metar = metar;
        filled.clouds.weather.seed = seed;
        filled.clouds.weather.elevation_m = elevation_m;
        PILEUS_TRY(check_finite("elevation_m", &elevation_m, 1, 1e4));
        PILEUS_TRY(apply_weather(filled));
        auto next = std::make_unique<Clouds>();
        CloudCounts told;
        // What is wrong with it shows before the old clouds go.
        PILEUS_TRY(open_scene_clouds(filled, sky->options, session, *next, told));
        PILEUS_TRY(next->move(clouds.offset()));
        PILEUS_TRY(session.set_turbidity(filled.atmosphere.turbidity));
        clouds_of(*sky->clouds) = std::move(next);
        return Status::ok();
    });
}

pileus_code pileus_sky_set_time(pileus_sky* sky, double hours, pileus_error* error) {
    return with_sky(sky, error, [&](Session& session, Clouds&) -> Status {
        PILEUS_TRY(check_finite("hours", &hours, 1, 1e6));
        return session.set_hours(hours, sky->scene.sun);
    });
}

pileus_code pileus_sky_move(pileus_sky* sky, const double offset_m[3], pileus_error* error) {
    return with_sky(sky, error, [&](Session&, Clouds& clouds) -> Status {
        if (offset_m == nullptr) return Status::bad_input("offset_m: null, allowed: three numbers");
        return clouds.move({offset_m[0], offset_m[1], offset_m[2]});
    });
}

pileus_code pileus_sky_render(pileus_sky* sky, const pileus_depth_image* depth,
                              const pileus_frame* frame, pileus_error* error) {
    return with_sky(sky, error, [&](Session& session, Clouds& clouds) -> Status {
        return draw_clouds(frame, depth, true, session, clouds);
    });
}

pileus_code pileus_sky_light_at(pileus_sky* sky, pileus_sky_light* places, uint32_t count,
                                pileus_error* error) {
    return with_sky(sky, error, [&](Session& session, Clouds& clouds) -> Status {
        if (count > 0 && places == nullptr)
            return Status::bad_input("places: null, allowed: as many as count says");
        constexpr std::uint32_t kMaxPlaces = 65536;
        if (count > kMaxPlaces)
            return Status::bad_input("count: " + std::to_string(count) + ", allowed: up to " +
                                     std::to_string(kMaxPlaces));
        for (std::uint32_t i = 0; i < count; ++i) {
            pileus_sky_light given;
            if (!take_element(places, i, given)) return no_element("places", i);
            PILEUS_TRY(check_finite("places.position_m", given.position_m, 3, kMaxPlaceM));
        }
        std::vector<Double3> at(count);
        std::vector<PlaceLight> found(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            pileus_sky_light given;
            (void)take_element(places, i, given);
            at[i] = {given.position_m[0], given.position_m[1], given.position_m[2]};
        }
        PILEUS_TRY(light_at(session, clouds, {at.data(), at.size()}, {found.data(), found.size()}));
        for (std::uint32_t i = 0; i < count; ++i) {
            pileus_sky_light own;
            (void)take_element(places, i, own);
            const PlaceLight& light = found[i];
            own.sun_share = light.sun_share;
            for (std::size_t c = 0; c < 3; ++c) {
                own.sun[c] = light.sun[c];
                own.level[c] = light.level[c];
                for (std::size_t k = 0; k < 9; ++k) own.around[c][k] = light.around[c][k];
            }
            own.extinction_per_m = light.extinction_per_m;
            give_element(own, places, i);
        }
        return Status::ok();
    });
}

pileus_code pileus_sky_shadow(pileus_sky* sky, const pileus_shadow_map* map, pileus_error* error) {
    return with_sky(sky, error, [&](Session& session, Clouds& clouds) -> Status {
        pileus_shadow_map given;
        if (!take(map, given)) return no_struct("shadow");
        ShadowMapTarget target;
        PILEUS_TRY(take_shadow(given, target));
        return draw_shadow_map(session, clouds, target);
    });
}

pileus_code pileus_sky_air(pileus_sky* sky, const double direction[3], double metres, float left[3],
                           float light[3], pileus_error* error) {
    return with_sky(sky, error, [&](Session& session, Clouds&) -> Status {
        if (direction == nullptr || left == nullptr || light == nullptr)
            return Status::bad_input("direction, left, light: null, allowed: three numbers each");
        PILEUS_TRY(check_finite("direction", direction, 3, 1e9));
        const Double3 to = single_or_0({direction[0], direction[1], direction[2]});
        if (to == Double3{}) return Status::bad_input("direction: 0, 0, 0, allowed: any other");
        if (!(metres > 0))
            return Status::bad_input("metres: " + number_text(metres) +
                                     ", allowed: above 0, infinity: the sky");
        AirWay way;
        PILEUS_TRY(air_along(session, to, metres, way));
        for (std::size_t c = 0; c < 3; ++c) left[c] = way.left[c], light[c] = way.light[c];
        return Status::ok();
    });
}

}  // extern "C"
