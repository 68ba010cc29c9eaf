// SPDX-License-Identifier: Apache-2.0
// What importance of paths does not know of scenes, and the memory that it takes; in no flight.
// in: a view -> out: one line; rows of the plan. docs/importance.md, "Bounds"
#include "kernels_cpu/media/phase.h"
#include "src/methods/path/path_importance.h"
#include "src/picture/ordinates/ordinate_plan.h"

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
    OrdinateSizes sizes = ordinate_sizes(medium, {});
    sizes.sets = 3;  // sun, sky and ground
    add_ordinate_rows(sizes, table);
    add(table, arrays::importance_moments(sizes.nodes));
    add(table, arrays::importance_depths(sizes.samples));
    add(table, arrays::importance_lobes());
}

}  // namespace pileus
