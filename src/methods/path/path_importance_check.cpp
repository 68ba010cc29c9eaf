// SPDX-License-Identifier: Apache-2.0
// What importance of paths does not know of scenes, and the memory that it takes; in no flight.
// in: a view -> out: one line; rows of the plan. docs/importance.md, "Bounds"
#include "kernels_cpu/media/phase.h"
#include "src/methods/path/path_importance.h"

namespace pileus {

Status check_importance(const FrameView& view) {
    const World& world = view.world;
    const Medium& medium = world.medium;
    const Lighting& light = view.lighting;
    const char* what = nullptr;
    if (medium.count > 1)
        what = "further medium";
    else if (medium.channels > 1)
        what = "albedo that differs by channel";
    else if (medium.optics[0].phase.type != kPhaseHg)
        what = "phase function but Henyey-Greenstein's";
    else if (emits(medium))
        what = "media that emit";
    else if (world.solids.meshes || view.environment.depth.present)
        what = "solids";
    else if (!view.scene.lights.empty())
        what = "[[light]]";
    else if (light.map.columns > 0 || view.environment.sky_map.size[0] > 0)
        what = "sky map";
    else if (light.air || light.sun_heights.rows > 0)
        what = "[atmosphere]";
    else if (view.scene.sun.angular_radius_deg > 0)
        what = "sun.angular_radius_deg";
    else if (view.scene.path.max_depth > 0)
        what = "path.max_depth";
    else if (view.scene.camera.flux)
        what = "flat detector (camera.projection \"flux\")";
    if (what == nullptr) return Status::ok();
    return Status::bad_input(view.scene.file + ": path.importance: goes with no " + what +
                             " so far, true, allowed: false, or a scene without");
}

void add_importance_rows(const FrameView& view, MemoryTable& table) {
    const Medium& medium = view.world.medium;
    const std::uint64_t nodes = max_ordinate_nodes(medium);
    const std::uint64_t samples = max_ordinate_samples(medium);
    add(table, arrays::ordinate_solution(nodes, kMaxOrdinateSets));
    add(table, arrays::ordinate_light(nodes, kMaxOrdinateSets, kOrdinateMoments));
    add(table, arrays::ordinate_work(nodes));
    add(table, arrays::ordinate_densities(samples));
    add(table, arrays::ordinate_depths(samples));
    add(table, arrays::ordinate_nodes(nodes, Stage::kWrite));
    add(table, renamed(arrays::ordinate_nodes(nodes, Stage::kShadow), "ordinates: numbers at work",
                       Stage::kShadow, Stage::kShadow));
    add(table, arrays::ordinate_places(nodes, Stage::kWrite));
    add(table, renamed(arrays::ordinate_places(nodes, Stage::kShadow), "ordinates: places at work",
                       Stage::kShadow, Stage::kShadow));
    add(table, arrays::beam_tables(1, Stage::kShadow));
    add(table, arrays::importance_moments(nodes));
    add(table, arrays::importance_depths(samples));
    add(table, arrays::importance_lobes());
}

}  // namespace pileus
