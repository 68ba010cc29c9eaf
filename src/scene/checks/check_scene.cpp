// SPDX-License-Identifier: Apache-2.0
// Laws between the keys of a scene that no single key can break.
// in: keys that passed their own checks -> out: what is present, dependent defaults; faults.
// docs/scene.md.
#include <glm/geometric.hpp>

#include "src/base/number_text.h"
#include "src/scene/checks/check_keys.h"
#include "src/scene/frame_fault.h"
#include "src/scene/method_column.h"
#include "src/scene/rows/picture_format.h"
#include "src/scene/rows/volume_format.h"

namespace pileus {
namespace {

/// Places in degrees need a map, which weather data alone has.
void check_places(SceneCheck& check) {
    bool weather = false;
    for (const MediumSettings& medium : check.scene.media) {
        const bool by_name = medium.source.format.empty() && !medium.source.file.empty();
        const VolumeFormat* format = by_name ? volume_format_of(medium.source.file)
                                             : volume_format_named(medium.source.format);
        weather = weather || (format != nullptr && format->is_weather);
    }
    for (const char* name : {"camera.position_", "camera.target_"}) {
        const std::string degrees = std::string(name) + "deg", metres = std::string(name) + "m";
        const Node* node = check.valid_key(degrees);
        if (node == nullptr) continue;
        // A struct has its metres in any case.
        if (check.written) conflict(check, metres.c_str(), degrees.c_str());
        const ViewFiles& by = check.scene.view_files;
        const Double3& place =
            degrees == "camera.position_deg" ? by.position_place : by.target_place;
        if (!is_on_map(place))
            check.faults.add(
                node->at, degrees,
                "out of range, " + value_text(*node) + ", allowed: " + kPlacesOnMap + ", height");
        else if (!weather)
            check.faults.add(node->at, degrees,
                             "no map to find it on, " + value_text(*node) +
                                 ", allowed: with a medium of weather data, or " + metres);
    }
}

/// Pixels that there are, at least one.
void check_crop(SceneCheck& check) {
    const Node* crop = check.valid_key("camera.crop");
    if (crop == nullptr) return;
    const std::array<int, 4>& c = check.scene.crop;
    const std::array<int, 2>& size = check.scene.camera.resolution;
    if (c[0] < c[2] && c[1] < c[3] && c[2] <= size[0] && c[3] <= size[1]) return;
    check.faults.add(crop->at, "camera.crop",
                     "no part of the picture, " + value_text(*crop) +
                         ", allowed: [x0, y0, x1, y1], x0 < x1 <= " + std::to_string(size[0]) +
                         ", y0 < y1 <= " + std::to_string(size[1]));
}

void check_camera(SceneCheck& check) {
    const Camera& camera = check.scene.camera;
    check_crop(check);
    const Node* projection = check.key("camera.projection");
    if (projection == nullptr || check.valid_key("camera.projection") != nullptr) {
        if (camera.orthographic)
            conflict(check, "camera.fov_deg",
                     camera.flux ? "projection \"flux\"" : "projection \"orthographic\"");
        else
            conflict(check, "camera.height_m", "projection \"perspective\"");
    }
    if (const Support* no = refused(check.scene, Feature::kFlux))
        if (camera.flux && projection != nullptr)
            add_refusal(check, *projection, "camera.projection", *no, "\"flux\"");
    check_places(check);
    const Node* target = check.valid_key("camera.target_m");
    const Node* position = check.valid_key("camera.position_m");
    const Node* up_node = check.key("camera.up");
    const bool up_valid = up_node == nullptr || check.valid_key("camera.up") != nullptr;
    if (up_valid && glm::length(camera.up) == 0) {
        check.faults.add(
            up_node->at, "camera.up",
            "no direction, " + value_text(*up_node) + ", allowed: any but the zero vector");
        return;
    }
    // Where places are on the map is known once the map is.
    const ViewFiles& by = check.scene.view_files;
    if (by.position_by_place || by.target_by_place) return;
    if (target == nullptr || position == nullptr) return;
    const FrameFault fault = frame_fault(check.scene.ground, camera);
    if (fault == FrameFault::kAtTarget) {
        check.faults.add(
            target->at, "camera.target_m",
            "same as position_m, " + value_text(*target) + ", allowed: any other point");
        return;
    }
    if (up_valid && fault == FrameFault::kAlongUp) {
        const Node& blamed = up_node != nullptr ? *up_node : *target;
        check.faults.add(blamed.at, "camera.up",
                         "parallel to the view, " +
                             (up_node != nullptr ? value_text(*up_node) : "[0, 0, 1]") +
                             ", allowed: any direction across target_m - position_m");
    }
}

void check_ground(SceneCheck& check) {
    const Node* position = check.valid_key("camera.position_m");
    const Scene& scene = check.scene;
    if (position == nullptr || scene.view_files.position_by_place) return;
    if (is_underground(scene.ground, scene.camera))
        check.faults.add(position->at, "camera.position_m",
                         "below the ground, z " + number_text(scene.camera.position_m[2]) +
                             ", allowed: at least ground.altitude_m " +
                             number_text(scene.ground.altitude_m));
}

/// A sky is constant or a map.
void check_sky(SceneCheck& check) {
    const Node* map = check.valid_key("sky.map");
    if (check.key("sky.map") == nullptr) {
        for (const char* key : {"sky.map_scale", "sky.map_rotation_deg"})
            conflict(check, key, "a sky without a map");
        return;
    }
    conflict(check, "sky.radiance", "sky.map");
    if (map != nullptr)
        check_picture(check, *map, "sky.map", is_radiance, check.scene.view_files.sky_map);
}

void check_output(SceneCheck& check) {
    if (check.scene.output.layer_shadow && check.scene.camera.flux)
        if (const Node* layers = check.key("output.layers"))
            check.faults.add(
                layers->at, "output.layers",
                "a flat detector sees no shadows, \"shadow\", allowed: other layers, or "
                "another camera.projection");
    if (const Support* no = refused(check.scene, Feature::kLayerOcclusion))
        if (const Node* layers = check.key("output.layers"))
            if (check.scene.output.layer_occlusion)
                add_refusal(check, *layers, "output.layers", *no, "\"occlusion\"");
    const Node* files = check.valid_key("output.files");
    if (files == nullptr) return;
    for (const Node& file : files->children) {
        const std::string& name = file.text;
        const PictureFormat* format = picture_format_of(name);
        if (format == nullptr || !is_written(*format))
            check.faults.add(file.at, "output.files",
                             "unknown kind of picture, " + quote_text(name) +
                                 ", allowed: " + picture_extensions(is_written));
    }
}

/// Elek's variant asks for its own display, sampler and split unless told otherwise.
void fill_paper_defaults(SceneCheck& check) {
    CollectorSettings& settings = check.scene.collectors;
    if (!settings.paper) return;
    if (check.key("collectors.display") == nullptr) settings.display.billboards = true;
    if (check.key("collectors.sampler") == nullptr) settings.placement.rejection_sampler = true;
    if (check.key("collectors.first_order_split") == nullptr) settings.first_order_split = false;
}

/// A periodic medium is seen from many sides at once: what is lit towards one camera alone will not
/// do, nor will sprites of one period.
void check_periodic(SceneCheck& check) {
    const Scene& scene = check.scene;
    bool periodic = false;
    for (const MediumSettings& m : scene.media) periodic |= m.box.periodic;
    if (!periodic || !is_of_collectors(method_column(scene))) return;
    const CollectorSettings& c = scene.collectors;
    const auto refuse = [&](const char* key, const char* value, const char* what,
                            const char* allowed) {
        const Node* node = check.key(key);
        if (node == nullptr) node = check.key("collectors.variant");
        if (node != nullptr) add_refusal(check, *node, key, what, value, allowed);
    };
    if (const Support* no = refused(scene, Feature::kPeriodic))
        refuse("collectors.display", "\"billboards\"", no->text, no->allowed);
    constexpr const char* kWhat = "not for periodic media";
    constexpr const char* kAllowed = "sh, or an orthographic camera";
    if (!scene.camera.orthographic && c.closure.lobe)
        refuse("collectors.closure", "\"lobe\"", kWhat, kAllowed);
    if (!scene.camera.orthographic && c.closure.camera)
        refuse("collectors.closure", "\"camera\"", kWhat, kAllowed);
}

/// A foreign compositor draws billboards, and no depth, which needs their order.
void check_compositor(SceneCheck& check) {
    const CollectorSettings& settings = check.scene.collectors;
    const Node* node = check.key("collectors.compositor");
    if (settings.display.compositor == Compositor::kBuiltin || node == nullptr) return;
    if (!settings.display.billboards)
        check.faults.add(node->at, "collectors.compositor",
                         "draws billboards only, " + value_text(*node) +
                             ", allowed: builtin, or display = \"billboards\"");
    if (check.scene.output.layer_depth)
        check.faults.add(node->at, "collectors.compositor",
                         "knows no layer depth, " + value_text(*node) +
                             ", allowed: builtin, or layers without depth");
}

/// Billboards show collectors themselves.
void check_node_filter(SceneCheck& check) {
    const CollectorSettings& settings = check.scene.collectors;
    const Node* node = check.key("collectors.node_filter");
    if (!settings.display.guided_nodes || !settings.display.billboards || node == nullptr) return;
    check.faults.add(node->at, "collectors.node_filter",
                     "filters nodes of the march, which billboards have not, " + value_text(*node) +
                         ", allowed: surroundings, or display = \"march\"");
}

/// Only marched bands are known for all directions.
void check_directions(SceneCheck& check) {
    const CollectorSettings& c = check.scene.collectors;
    const Node* node = check.key("collectors.directions");
    if (c.display.directions != NodeDirections::kAll || node == nullptr) return;
    if (c.display.billboards || c.closure.lobe || c.closure.camera)
        check.faults.add(
            node->at, "collectors.directions",
            "needs bands that are marched through, " + value_text(*node) +
                ", allowed: near, camera, or display = \"march\" and closure = \"sh\"");
}

/// Pictures without noise, or with noise of another kind, have no use of it.
void check_filter(SceneCheck& check) {
    const Scene& scene = check.scene;
    const Node* node = check.key("filter.kind");
    const Support* no = refused(scene, Feature::kFilter);
    if (scene.filter.kind == FilterKind::kNone || no == nullptr || node == nullptr) return;
    add_refusal(check, *node, "filter.kind", *no, value_text(*node));
}

/// A lens and a shutter belong to one display; elsewhere pictures would be sharp unasked.
void check_lens(SceneCheck& check) {
    const Scene& scene = check.scene;
    const auto refuse = [&](const char* key, const char* why, const char* allowed) {
        const Node* node = check.key(key);
        if (node != nullptr) add_refusal(check, *node, key, why, value_text(*node), allowed);
    };
    const bool lens = scene.lens.aperture_radius_m > 0;
    if (const Support* no = refused(scene, Feature::kLens)) {
        if (lens) refuse("camera.aperture_radius_m", no->text, no->allowed);
        if (scene.lens.shutter_s > 0) refuse("camera.shutter_s", no->text, no->allowed);
    } else {
        if (lens && scene.camera.orthographic)
            refuse("camera.aperture_radius_m", "a lens needs perspective", "0");
    }
}

/// What lights places in particles has no walks from bins.
void check_particle_light(SceneCheck& check) {
    const ParticlesSettings& s = check.scene.particles;
    const Node* node = check.key("particles.light");
    if (node == nullptr || s.light != ParticleLight::kExact || !lights_places(s)) return;
    const MethodColumn column = method_column(check.scene);
    if (column != MethodColumn::kParticles && column != MethodColumn::kParticleBillboards) return;
    if (s.billboards)
        add_refusal(check, *node, "particles.light", "for bins of a march alone", value_text(*node),
                    "linear, centre, or particles.display = \"march\"");
    else
        add_refusal(check, *node, "particles.light",
                    "light_bias and occluders are for places in particles", value_text(*node),
                    "linear, centre, or neither of them");
}

}  // namespace

void check_laws(SceneCheck& check) {
    Scene& scene = check.scene;
    if (check.written) {
        scene.sun.present = check.key("sun") != nullptr;
        scene.sky.present = check.key("sky") != nullptr;
        scene.ground.present = check.key("ground") != nullptr;
        scene.animation.present = check.key("animation") != nullptr;
        scene.atmosphere.present = check.key("atmosphere") != nullptr;
        fill_paper_defaults(check);
    }
    check_camera(check);
    check_ground(check);
    check_surface(check);
    check_sky(check);
    check_atmosphere(check);
    check_output(check);
    check_animation(check);
    for (std::size_t i = 0; i < scene.media.size(); ++i) check_medium(check, i);
    check_periodic(check);
    check_compositor(check);
    check_node_filter(check);
    check_directions(check);
    check_filter(check);
    check_lens(check);
    check_particle_light(check);
    check_solids(check);
    check_lights(check);
    check_clouds(check);
}

}  // namespace pileus
