// SPDX-License-Identifier: Apache-2.0
// pileus.h: skies of many clouds.
#include "include/pileus/pileus.h"
#include "src/api/c_types.h"
#include "src/clouds/clouds.h"

struct pileus_clouds {
    pileus_session* sky = nullptr;  ///< whose user this is: its host may free it first
    std::unique_ptr<pileus::Clouds> clouds = std::make_unique<pileus::Clouds>();
};

namespace pileus::api {
namespace {

pileus_code no_clouds(pileus_error* error) {
    return finish(Code::kBadInput, "clouds: null, allowed: what pileus_clouds_create made", error);
}

Status place_all(const pileus_cloud* places, std::uint32_t count, Clouds& clouds) {
    if (count > 0 && places == nullptr)
        return Status::bad_input("places: null, allowed: as many as count says");
    if (count > kMaxClouds)
        return Status::bad_input("count: " + std::to_string(count) + ", allowed: up to " +
                                 std::to_string(kMaxClouds));
    std::vector<CloudPlace> own(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        pileus_cloud given;
        if (!take_element(places, i, given)) return no_element("places", i);
        CloudPlace& place = own[i];
        place.kind = given.kind;
        for (int a = 0; a < 3; ++a) place.offset_m[a] = given.offset_m[a];
        place.yaw_deg = given.yaw_deg;
        place.scale = given.scale == 0 ? 1 : given.scale;
        place.presence = given.presence == 0 ? 1 : given.presence;
    }
    return clouds.place(own);
}

Status set_detail(const pileus_cloud_detail& given, Clouds& clouds) {
    CloudDetail own;
    const auto take_number = [](double v, double& to) {
        if (v != 0) to = v;
    };
    const auto take_count = [](std::uint64_t v, std::uint64_t most, auto& to) {
        if (v != 0) to = std::decay_t<decltype(to)>(v < most ? v : most);
    };
    own.on = given.off == 0;
    take_number(given.error_px, own.error_px);
    take_number(given.near_px, own.near_px);
    take_number(given.sharpness, own.sharpness);
    take_number(given.sun_deg, own.sun_deg);
    take_count(given.near_scale, 100, own.near_scale);
    take_count(given.blend_frames, 100000, own.blend_frames);
    take_count(given.frame_pixels, std::uint64_t{1} << 62, own.frame_pixels);
    return clouds.set_detail(own);
}

}  // namespace

Status make_clouds(pileus_session& sky, pileus_clouds*& clouds) {
    if (sky.host->block != nullptr)
        return Status::bad_input("sky: a session of a flight, allowed: another");
    auto made = std::make_unique<pileus_clouds>();
    made->sky = &sky;
    PILEUS_TRY(made->clouds->open(*sky.session));
    ++sky.users;
    clouds = made.release();
    return Status::ok();
}

std::unique_ptr<Clouds>& clouds_of(pileus_clouds& clouds) { return clouds.clouds; }

Status draw_clouds(const pileus_frame* frame, const pileus_depth_image* depth, bool over_host,
                   Session& sky, Clouds& clouds) {
    pileus_frame given;
    if (!take(frame, given)) return no_struct("frame");
    FrameTarget target;
    PILEUS_TRY(take_target(given, sky.camera(), target));
    if (!target.layers.empty())
        return Status::bad_input("frame.layers: of skies of clouds, allowed: none");
    if (depth != nullptr) PILEUS_TRY(set_depth_image(depth, sky));
    std::uint64_t hash = 0;
    target.hash = given.hash != nullptr ? &hash : nullptr;
    clouds.set_over_host(over_host && target.has_colour &&
                         target.colour.blend != PixelBlend::kReplace);
    PILEUS_TRY(clouds.render(target));
    if (given.hash != nullptr) *given.hash = hash;
    return Status::ok();
}

}  // namespace pileus::api

using namespace pileus;
using namespace pileus::api;

extern "C" {

pileus_code pileus_clouds_create(pileus_session* sky, pileus_clouds** clouds, pileus_error* error) {
    if (sky == nullptr) return no_session(error);
    return call(*sky, error, [&]() -> Status {
        if (clouds == nullptr) return Status::bad_input("clouds: null, allowed: where to put them");
        pileus_clouds* made = nullptr;
        PILEUS_TRY(make_clouds(*sky, made));
        *clouds = made;
        return Status::ok();
    });
}

void pileus_clouds_free(pileus_clouds* clouds) {
    if (clouds == nullptr) return;
    // What the host lends is the sky's.
    const std::shared_ptr<const HostParts> host = clouds->sky->host;
    const HostGuard lent(host->host());
    pileus_session* const sky = clouds->sky;
    delete clouds;
    leave(sky);
}

pileus_code pileus_clouds_add_kind(pileus_clouds* clouds, const pileus_world* world,
                                   const pileus_scene* scene, uint32_t* kind, pileus_error* error) {
    if (clouds == nullptr) return no_clouds(error);
    return call(*clouds->sky, error, [&]() -> Status {
        if (world == nullptr) return no_handle("world");
        if (scene == nullptr) return no_handle("scene");
        std::size_t number = 0;
        PILEUS_TRY(clouds->clouds->add_kind(scene->scene, world->world, number));
        if (kind != nullptr) *kind = std::uint32_t(number);
        return Status::ok();
    });
}

pileus_code pileus_clouds_place(pileus_clouds* clouds, const pileus_cloud* places, uint32_t count,
                                pileus_error* error) {
    if (clouds == nullptr) return no_clouds(error);
    return call(*clouds->sky, error,
                [&]() -> Status { return place_all(places, count, *clouds->clouds); });
}

pileus_code pileus_clouds_set_detail(pileus_clouds* clouds, const pileus_cloud_detail* detail,
                                     pileus_error* error) {
    if (clouds == nullptr) return no_clouds(error);
    return call(*clouds->sky, error, [&]() -> Status {
        pileus_cloud_detail given;
        if (!take(detail, given)) return no_struct("detail");
        return set_detail(given, *clouds->clouds);
    });
}

pileus_code pileus_clouds_render(pileus_clouds* clouds, const pileus_frame* frame,
                                 pileus_error* error) {
    if (clouds == nullptr) return no_clouds(error);
    return call(*clouds->sky, error, [&]() -> Status {
        return draw_clouds(frame, nullptr, false, *clouds->sky->session, *clouds->clouds);
    });
}

pileus_code pileus_clouds_stats(const pileus_clouds* clouds, pileus_cloud_stats* stats,
                                pileus_error* error) {
    if (clouds == nullptr) return no_clouds(error);
    return call(*clouds->sky, error, [&]() -> Status {
        const CloudStats& s = clouds->clouds->stats();
        pileus_cloud_stats out{};
        out.clouds = s.clouds;
        out.visible = s.visible;
        out.marched = s.marched;
        out.captured = s.captured;
        out.lit = s.lit;
        out.marched_pixels = s.marched_pixels;
        out.captured_pixels = s.captured_pixels;
        out.worst_px = s.worst_px;
        return give(out, stats, "stats");
    });
}

}  // extern "C"
