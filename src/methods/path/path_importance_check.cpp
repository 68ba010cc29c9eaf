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

/// What importance does not know of a scene; null: it knows all.
const char* unknown_part(const FrameView& view) {
    const World& world = view.world;
    const Medium& medium = world.medium;
    const Lighting& light = view.lighting;
    if (medium.count > 1) return "several media";
    if (medium.channels > 1) return "an albedo that differs by channel";
    if (medium.optics[0].phase.type != kPhaseHg) return "a phase function but Henyey-Greenstein's";
    if (emits(medium)) return "media that emit";
    if (world.solids.meshes || view.environment.depth.present) return "solids";
    if (!view.scene.lights.empty()) return "[[light]]";
    if (light.map.columns > 0 || view.environment.sky_map.size[0] > 0) return "a sky map";
    if (light.air || light.sun_heights.rows > 0) return "[atmosphere]";
    if (view.scene.sun.angular_radius_deg > 0) return "sun.angular_radius_deg";
    if (view.scene.path.max_depth > 0) return "path.max_depth";
    if (view.scene.camera.flux) return "a flat detector";
    return nullptr;
}

}  // namespace

bool asks_for_importance(const Scene& scene) {
    const PathSettings& path = scene.path;
    if (path.importance != ImportanceUse::kAuto) return path.importance == ImportanceUse::kOn;
    const std::int64_t samples =
        path.target_error > 0 ? path.max_samples_per_pixel : path.samples_per_pixel;
    const auto& size = scene.camera.resolution;
    return double(size[0]) * double(size[1]) * double(samples) >= kPays;
}

const char* why_no_importance(const FrameView& view) {
    const Scene& scene = view.scene;
    if (scene.path.importance == ImportanceUse::kOff) return "switched off";
    if (const char* part = unknown_part(view)) return part;
    if (scene.path.importance == ImportanceUse::kOn) return nullptr;
    if (!asks_for_importance(scene)) return "too few samples to pay for its solution";
    if (view.world.medium.optics[0].phase.g1 < kGains) return "light is scattered too evenly";
    return nullptr;
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
