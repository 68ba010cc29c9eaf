// SPDX-License-Identifier: Apache-2.0
// Laws between the keys of an animation and what they move.
// in: keys that passed their own checks -> out: faults.
// docs/animation.md
#include <algorithm>

#include "src/base/number_text.h"
#include "src/scene/above_ground.h"
#include "src/scene/checks/check_keys.h"
#include "src/scene/frame_fault.h"
#include "src/scene/frames.h"
#include "src/scene/rows/density_row.h"

namespace pileus {
namespace {

constexpr int kMaxChecked = 10000;

/// Of keys that have a track: a fault at the first of them.
class Keys {
public:
    explicit Keys(SceneCheck& check) : check_(check), node_(check.valid_key("animation.keys")) {}

    bool have(Track track) const {
        return node_ != nullptr && has_track(check_.scene.animation, track);
    }
    void refuse(Track track, const std::string& why, const std::string& allowed = "left out") {
        if (!have(track)) return;
        const char* name = kTracks[std::size_t(track)].name;
        for (std::size_t i = 0; i < node_->children.size(); ++i)
            if (const Node* value = node_->children[i].find(name)) {
                add(value->key_at, "animation.keys." + std::to_string(i) + "." + name,
                    why + ", " + value_text(*value) + ", allowed: " + allowed);
                return;
            }
    }
    void refuse_all(const std::string& why, const std::string& allowed) {
        fault_of_all(why + ", allowed: " + allowed);
    }
    void fault_of_all(const std::string& text) {
        if (node_ != nullptr) add(node_->at, "animation.keys", text);
    }

private:
    void add(const Place& at, const std::string& key, const std::string& text) {
        check_.faults.add(at, key, text);
    }

    SceneCheck& check_;
    const Node* node_;
};

bool has_medium_with_time(const Scene& scene) {
    for (const MediumSettings& medium : scene.media) {
        const DensityRow* row = density_row(medium.density);
        if (row != nullptr && (row->has_field || medium.cloud.lives())) return true;
    }
    return false;
}

/// The faults that a camera which stands may have, at the first frame that has one.
void check_cameras(SceneCheck& check, Keys& keys) {
    const Scene& scene = check.scene;
    if (!keys.have(Track::kPosition) && !keys.have(Track::kTarget)) return;
    if (scene.view_files.position_by_place || scene.view_files.target_by_place) return;
    // Of longer films some frames, so that no scene takes long to check.
    const int step = 1 + (scene.animation.frames - 1) / kMaxChecked;
    for (int frame = 0; frame < scene.animation.frames; frame += step) {
        const Camera c = camera_at(scene.animation, scene.camera, frame);
        const std::string at = "frame " + std::to_string(frame) + ", ";
        switch (frame_fault(scene.ground, c)) {
            case FrameFault::kAtTarget:
                return keys.refuse_all(at + "the camera is at its target", "anywhere else");
            case FrameFault::kAlongUp:
                return keys.refuse_all(at + "the view is along camera.up",
                                       "any direction across it");
            case FrameFault::kUnderground:
                return keys.refuse_all(
                    at + "the camera is below the ground, z " + number_text(c.position_m[2]),
                    "at least ground.altitude_m " + number_text(scene.ground.altitude_m));
            default:
                break;
        }
    }
}

/// Where keys move media whose bounds are in the text below the ground; session.cpp asks the same
/// of files that know their place.
void check_moved_media(SceneCheck& check, Keys& keys) {
    const Scene& scene = check.scene;
    double low = 0;
    bool known = false;
    for (const MediumSettings& medium : scene.media) {
        if (!medium.box.has_bounds) continue;
        low = known ? std::min(low, medium.box.bounds_m[0][2]) : medium.box.bounds_m[0][2];
        known = true;
    }
    if (!known || !keys.have(Track::kOffset)) return;
    const int step = 1 + (scene.animation.frames - 1) / kMaxChecked;
    for (int frame = 0; frame < scene.animation.frames; frame += step) {
        const double moved = placement_at(scene, frame).offset_m.z;
        if (is_below_ground(scene.ground, low + moved, moved))
            return keys.fault_of_all("frame " + std::to_string(frame) + ", the media are " +
                                     below_ground_text(scene.ground, low + moved, moved));
    }
}

void check_media(SceneCheck& check, Keys& keys) {
    const Scene& scene = check.scene;
    for (const Track track : {Track::kOffset, Track::kYaw}) {
        if (!scene.solids.empty()) keys.refuse(track, "solids stay where they are");
        if (scene.clouds.present()) keys.refuse(track, "clouds stay where they are");
        if (scene.animation.moves_sun && track == Track::kYaw)
            keys.refuse(track, "conflicts with animation.sun_elevation_deg",
                        "left out, or sun_elevation_deg in keys");
    }
    if (scene.atmosphere.present || !scene.view_files.sky_map.empty())
        keys.refuse(Track::kYaw, "not below a sky that is not even", "left out");
}

}  // namespace

void check_animation(SceneCheck& check) {
    const Scene& scene = check.scene;
    const bool dated = scene.atmosphere.present && !scene.atmosphere.date.empty();
    if (!dated) conflict(check, "animation.hours", "a scene without atmosphere.date");
    if (!scene.sun.present) conflict(check, "animation.sun_elevation_deg", "a scene without a sun");
    Keys keys(check);
    for (const Track track : {Track::kAzimuth, Track::kElevation}) {
        if (dated)
            keys.refuse(track, "conflicts with atmosphere.date");
        else if (!scene.sun.present)
            keys.refuse(track, "conflicts with a scene without a sun");
    }
    if (scene.animation.moves_sun)
        keys.refuse(Track::kElevation, "conflicts with animation.sun_elevation_deg");
    if (!dated)
        keys.refuse(Track::kHours, "conflicts with a scene without atmosphere.date");
    else if (scene.animation.moves_time)
        keys.refuse(Track::kHours, "conflicts with animation.hours");
    if (!has_medium_with_time(scene) && !scene.surface.sea)
        keys.refuse(
            Track::kWind,
            "conflicts with a scene without a procedural sky, a cloud with an age_s or a sea");
    if (scene.camera.orthographic) keys.refuse(Track::kFov, "conflicts with parallel rays");
    if (scene.view_files.position_by_place)
        keys.refuse(Track::kPosition, "conflicts with camera.position_deg");
    if (scene.view_files.target_by_place)
        keys.refuse(Track::kTarget, "conflicts with camera.target_deg");
    check_media(check, keys);
    check_moved_media(check, keys);
    check_cameras(check, keys);
}

}  // namespace pileus
