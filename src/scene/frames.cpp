// SPDX-License-Identifier: Apache-2.0
// See frames.h.
#include "src/scene/frames.h"

#include <algorithm>

namespace pileus {
namespace {

/// Of a range from the first frame to the last.
double in_range(const Animation& a, const std::array<double, 2>& range, int frame) {
    const double share = a.frames > 1 ? double(frame) / (a.frames - 1) : 0.0;
    return range[0] + (range[1] - range[0]) * share;
}

double number_at(const Scene& scene, Track track, int frame, double rest) {
    double number = rest;
    if (scene.animation.present) track_at(scene.animation, track, frame, &number);
    return number;
}

void take_at(const Animation& animation, Track track, int frame, Double3& v) {
    double numbers[3];
    if (track_at(animation, track, frame, numbers)) v = {numbers[0], numbers[1], numbers[2]};
}

bool has(const Scene& scene, Track track) {
    return scene.animation.present && has_track(scene.animation, track);
}

/// The sun of a frame in the scene's coordinates: the media's yaw is their placement's.
SunPlace unturned_sun(const Scene& scene, const Sun& rest, int frame) {
    const Animation& a = scene.animation;
    SunPlace at = place_of(rest);
    if (!a.present) return at;
    if (a.moves_sun) at.elevation_deg = in_range(a, a.sun_elevation_deg, frame);
    at.azimuth_deg = number_at(scene, Track::kAzimuth, frame, at.azimuth_deg);
    at.elevation_deg = number_at(scene, Track::kElevation, frame, at.elevation_deg);
    return at;
}

}  // namespace

SunPlace sun_at(const Scene& scene, const Sun& rest, int frame) {
    SunPlace at = unturned_sun(scene, rest, frame);
    if (scene.animation.present) at.azimuth_deg += number_at(scene, Track::kYaw, frame, 0);
    return at;
}

void frame_state_at(const Scene& scene, const FrameState& rest, int frame, FrameState& out) {
    out = rest;
    out.camera = camera_at(scene.animation, rest.camera, frame);
    out.placement = placement_at(scene, frame);
    const SunPlace sun = unturned_sun(scene, rest.sun, frame);
    out.sun.azimuth_deg = sun.azimuth_deg;
    out.sun.elevation_deg = sun.elevation_deg;
}

void place_at_frame(const FrameState& rest, int frame, Scene& scene) {
    FrameState at;
    frame_state_at(scene, rest, frame, at);
    put_in_media(at, scene);
}

double orbit_at(const Scene& scene, int frame) {
    const Animation& a = scene.animation;
    return a.present && a.moves_camera ? in_range(a, a.camera_orbit_deg, frame) : 0.0;
}

Camera camera_at(const Animation& animation, const Camera& rest, int frame) {
    Camera camera = rest;
    take_at(animation, Track::kPosition, frame, camera.position_m);
    take_at(animation, Track::kTarget, frame, camera.target_m);
    track_at(animation, Track::kFov, frame, &camera.fov_deg);
    return camera;
}

double hours_at(const Scene& scene, int frame) {
    const Animation& a = scene.animation;
    const double rest = a.present && a.moves_time ? in_range(a, a.hours, frame) : 0.0;
    return number_at(scene, Track::kHours, frame, rest);
}

double wind_at(const Scene& scene, int frame) { return number_at(scene, Track::kWind, frame, 0); }

WorldKey world_key_at(const Scene& scene, int frame) { return {frame, wind_at(scene, frame)}; }

Placement placement_at(const Scene& scene, int frame) {
    Placement at;
    if (!scene.animation.present) return at;
    take_at(scene.animation, Track::kOffset, frame, at.offset_m);
    at.yaw_deg = number_at(scene, Track::kYaw, frame, 0);
    return at;
}

bool moves_sun(const Scene& scene) {
    const Animation& a = scene.animation;
    return (a.present && a.moves_sun) || has(scene, Track::kAzimuth) ||
           has(scene, Track::kElevation) || has(scene, Track::kYaw);
}
bool moves_time(const Scene& scene) {
    const Animation& a = scene.animation;
    return ((a.present && a.moves_time) || has(scene, Track::kHours));
}
bool moves_wind(const Scene& scene) { return has(scene, Track::kWind); }
bool moves_media(const Scene& scene) {
    return has(scene, Track::kOffset) || has(scene, Track::kYaw);
}

const char* mover_of_view(const Scene& scene) {
    if (scene.animation.present && scene.animation.moves_camera)
        return "animation.camera_orbit_deg";
    const bool by_keys = has(scene, Track::kPosition) || has(scene, Track::kTarget) ||
                         has(scene, Track::kFov) || moves_media(scene);
    return by_keys ? "animation.keys" : nullptr;
}

double highest_sun(const Scene& scene, const Sun& rest) {
    const Animation& a = scene.animation;
    double most = sun_at(scene, rest, 0).elevation_deg;
    if (a.present && a.moves_sun) most = std::max(a.sun_elevation_deg[0], a.sun_elevation_deg[1]);
    for (const AnimationKey& key : a.keys)
        if (key.given[std::size_t(Track::kElevation)])
            most = std::max(most, key.numbers[std::size_t(kTracks[int(Track::kElevation)].first)]);
    return most;
}

}  // namespace pileus
