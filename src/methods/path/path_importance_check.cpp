// SPDX-License-Identifier: Apache-2.0
// Where importance splits paths, and the memory that it takes; in no flight.
// in: a scene, a view -> out: why it does not; rows of the plan. docs/importance.md, "Bounds"
#include "kernels_cpu/media/phase.h"
#include "src/methods/path/path_importance.h"
#include "src/picture/ordinates/ordinate_plan.h"

namespace pileus {

namespace {

/// Samples of a picture from which the solution pays (docs/importance.md, "Gain").
constexpr double kPays = 8e6;
/// Mean cosine of a phase function from which it gains.
constexpr float kGains = 0.75f;

constexpr const char* kPainted = "a map, colours or a sea on the ground";

/// What importance does not know of media; null: it knows them.
const char* unknown_media(const World& world) {
    const Medium& medium = world.medium;
    if (medium.count > 1) return "several media";
    if (medium.channels > 1) return "an albedo that differs by channel";
    if (medium.optics[0].phase.type != kPhaseHg) return "a phase function but Henyey-Greenstein's";
    if (emits(medium)) return "media that emit";
    if (world.solids.meshes) return "solids";
    return nullptr;
}

/// The same of what a scene says beside them.
const char* unknown_keys(const Scene& scene) {
    if (!scene.lights.empty()) return "[[light]]";
    if (scene.sun.angular_radius_deg > 0) return "sun.angular_radius_deg";
    if (scene.path.max_depth > 0) return "path.max_depth";
    if (scene.camera.flux) return "a flat detector";
    if (!is_grey_land(scene.surface)) return kPainted;
    return nullptr;
}

/// Why a scene's key or its samples ask for none; null: they do.
const char* unasked(const Scene& scene, const World& world) {
    const PathSettings& path = scene.path;
    if (path.importance == ImportanceUse::kOff) return "switched off";
    if (path.importance == ImportanceUse::kOn) return nullptr;
    const std::int64_t samples =
        path.target_error > 0 ? path.max_samples_per_pixel : path.samples_per_pixel;
    if (double(scene.camera.whole_pixels()) * double(samples) < kPays)
        return "too few samples to pay for its solution";
    const bool even = world.medium.optics[0].phase.g1 < kGains;
    return even ? "light is scattered too evenly" : nullptr;
}

}  // namespace

bool asks_for_importance(const Scene& scene, const World& world) {
    const bool lit_by_more = scene.sky.mapped || !scene.view_files.sky_map.empty() ||
                             scene.atmosphere.present || !scene.view_files.depth.empty();
    return !lit_by_more && unknown_media(world) == nullptr && unknown_keys(scene) == nullptr &&
           unasked(scene, world) == nullptr;
}

bool may_have_importance(const FrameView& view) {
    return view.scene.path.importance != ImportanceUse::kOff &&
           unknown_media(view.world) == nullptr;
}

const char* why_no_importance(const FrameView& view) {
    const Lighting& light = view.lighting;
    if (view.scene.path.importance == ImportanceUse::kOff) return "switched off";
    if (const char* part = unknown_media(view.world)) return part;
    if (const char* part = unknown_keys(view.scene)) return part;
    if (!light.lamps.empty()) return "[[light]]";
    if (view.environment.depth.present) return "solids";
    if (light.ground.paint.on != 0) return kPainted;
    if (light.map.columns > 0 || view.environment.sky_map.size[0] > 0) return "a sky map";
    if (light.air || light.sun_heights.rows > 0) return "[atmosphere]";
    return unasked(view.scene, view.world);
}

void add_importance_rows(const FrameView& view, MemoryTable& table) {
    const Medium& medium = view.world.medium;
    OrdinateSizes sizes = ordinate_sizes(medium, {});
    sizes.sets = 3;  // sun, sky and ground
    add_ordinate_rows(sizes, table);
    add(table, arrays::importance_moments(sizes.nodes));
    add(table, arrays::importance_depths(sizes.samples));
    add(table, arrays::importance_lobes());
}

}  // namespace pileus
