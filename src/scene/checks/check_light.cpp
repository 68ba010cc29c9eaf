// SPDX-License-Identifier: Apache-2.0
// Laws between the keys of lights besides sun and sky, and which methods know them.
// in: keys that passed their own checks -> out: faults.
// docs/scene.md; docs/lights.md.
#include "src/base/number_text.h"
#include "src/scene/checks/check_keys.h"
#include "src/scene/frame_fault.h"
#include "src/scene/method_column.h"

namespace pileus {
namespace {

/// Which kinds of light have a key: bits of 1 << LampKind.
struct LightKey {
    const char* name;
    int kinds;
    const char* of;
};
constexpr int kPointBit = 1, kSpotBit = 2, kDirectionalBit = 4;
constexpr LightKey kLightKeys[] = {
    {"position_m", kPointBit | kSpotBit, "point, spot"},
    {"intensity", kPointBit | kSpotBit, "point, spot"},
    {"radius_m", kPointBit | kSpotBit, "point, spot"},
    {"shadow_samples", kPointBit | kSpotBit, "point, spot"},
    {"direction", kSpotBit, "spot"},
    {"target_m", kSpotBit, "spot"},
    {"cone_deg", kSpotBit, "spot"},
    {"penumbra_deg", kSpotBit, "spot"},
    {"azimuth_deg", kDirectionalBit, "directional"},
    {"elevation_deg", kDirectionalBit, "directional"},
    {"irradiance", kDirectionalBit, "directional"},
};

class LightCheck {
public:
    LightCheck(SceneCheck& check, std::size_t index)
        : check_(check),
          light_(check.scene.lights[index]),
          path_("light." + std::to_string(index) + ".") {}

    void run() {
        type_ = check_.valid_key(path_ + "type");
        if (type_ == nullptr) return;
        known();
        const int kind = 1 << int(light_.type);
        for (const LightKey& key : kLightKeys) {
            const Node* node = check_.key(path_ + key.name);
            if (node != nullptr && (key.kinds & kind) == 0)
                fault(*node, key.name,
                      "not of a light of type " + type_->text + ", " + value_text(*node) +
                          ", allowed: left out, or type " + key.of);
        }
        const bool placed = light_.type != LampKind::kDirectional;
        if (placed && check_.written && check_.key(path_ + "position_m") == nullptr)
            fault(*type_, "position_m", "missing, nothing, allowed: 3 numbers, metres");
        if (light_.type == LampKind::kSpot) spot();
        if (placed) sphere();
    }

private:
    void fault(const Node& node, const char* key, const std::string& text) {
        check_.faults.add(node.at, path_ + key, text);
    }

    /// Methods and media that lights are not for.
    void known() {
        const Scene& scene = check_.scene;
        // Cells that are lit towards the camera are marched, whatever the display.
        const Support* no = refused(scene, feature());
        if (no != nullptr && !has_camera_closure(scene))
            add_refusal(check_, *type_, path_ + "type", *no, value_text(*type_));
        if (!scene.solids.empty() && excludes(FeaturePair::kLampsAndSolids, method_column(scene)))
            refuse("with solids by method " + scene.method,
                   "method path, or a scene without [[solid]]");
        bool periodic = false, direct = false;
        for (const MediumSettings& m : scene.media) {
            periodic = periodic || m.box.periodic;
            direct = direct || m.sky.evaluate == SkyEvaluation::kDirect;
        }
        if (periodic) refuse("with a periodic medium", "boundary = \"open\"");
        if (direct) refuse("with a sky that is not on a grid", "sky.evaluate = \"grid\"");
    }

    Feature feature() const {
        constexpr Feature kFeatures[] = {Feature::kLampPoint, Feature::kLampSpot,
                                         Feature::kLampParallel};
        return kFeatures[int(light_.type)];
    }

    void refuse(const std::string& what, const std::string& allowed) {
        fault(*type_, "type",
              "not " + what + " in this version, " + value_text(*type_) + ", allowed: " + allowed);
    }

    /// What would shine from below the ground.
    void sphere() {
        const Ground& ground = check_.scene.ground;
        const Node* radius = check_.valid_key(path_ + "radius_m");
        if (reaches_below(ground, light_))
            fault(radius != nullptr ? *radius : *type_, "radius_m",
                  "reaches below the ground, " + number_text(light_.radius_m) +
                      ", allowed: at most " +
                      number_text(light_.position_m[2] - ground.altitude_m) +
                      ", or shadow_samples = 1");
    }

    void spot() {
        const Node* direction = check_.valid_key(path_ + "direction");
        const Node* target = check_.valid_key(path_ + "target_m");
        if (check_.key(path_ + "direction") != nullptr && check_.key(path_ + "target_m") != nullptr)
            fault(*check_.key(path_ + "target_m"), "target_m",
                  "conflicts with direction, " + value_text(*check_.key(path_ + "target_m")) +
                      ", allowed: one of both");
        else if (check_.written && check_.key(path_ + "direction") == nullptr &&
                 check_.key(path_ + "target_m") == nullptr)
            fault(*type_, "direction", "missing, nothing, allowed: direction or target_m");
        else if (direction != nullptr && light_.direction == Double3{})
            fault(*direction, "direction",
                  "no direction, " + value_text(*direction) + ", allowed: any but the zero vector");
        else if (light_.direction == Double3{} && is_at(light_.position_m, light_.target_m))
            fault(target != nullptr ? *target : *type_, "target_m",
                  "same as position_m, " +
                      (target != nullptr ? value_text(*target) : std::string("nothing")) +
                      ", allowed: any other point");
        const Node* edge = check_.valid_key(path_ + "penumbra_deg");
        if (edge != nullptr && is_wide_edge(light_))
            fault(*edge, "penumbra_deg",
                  "wider than the cone, " + value_text(*edge) +
                      ", allowed: at most half of cone_deg " + number_text(light_.cone_deg));
    }

    SceneCheck& check_;
    const LightSettings& light_;
    const std::string path_;
    const Node* type_ = nullptr;
};

}  // namespace

void check_lights(SceneCheck& check) {
    for (std::size_t i = 0; i < check.scene.lights.size(); ++i) LightCheck(check, i).run();
}

}  // namespace pileus
