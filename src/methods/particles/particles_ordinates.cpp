// SPDX-License-Identifier: Apache-2.0
// Light scattered more than once at every particle, by discrete ordinates on nodes of the grid.
// in: a particle tree, its medium -> out: light from all around, by ball.
// docs/particles.md, "Light"; docs/ordinates.md
#include <algorithm>

#include "kernels_cpu/display/march_ray.h"
#include "platform/threads.h"
#include "src/methods/particles/particles_state.h"

namespace pileus {

Status solve_particles(const Context& context, const FrameView& view, ParticlesState& state) {
    const Medium& medium = view.world.medium;
    LampNodes lamps;
    PILEUS_TRY(make_lamp_nodes(context, medium, state.majorants, view.lighting, lamps));
    OrdinateAsk ask;
    ask.lamps = &lamps;
    ask.lamp_count = view.lighting.lamps.size();
    ask.emission = emits(medium);
    ask.ground = true;
    return make_ordinates(context, medium, state.majorants, view.lighting, ask, state.ordinates);
}

Status light_by_ordinates(const Context& context, const FrameView& view, ParticlesState& state) {
    OrdinateNodes& nodes = state.ordinates;
    const StageClock clock(context, "ordinates");
    PILEUS_TRY(turn_light(context, view.world.medium, state.camera, nodes, nodes.light));
    const std::size_t count = state.tree.balls.size();
    const std::size_t number = std::size_t(node_count(nodes.grid));
    PILEUS_TRY(allocate_once(arrays::particle_sky(count), state.sky));
    parallel_each(context.threads, count, [&](std::size_t i) {
        const float* p = state.tree.balls[i].centre;
        const Corners<float> at = node_corners(
            node_position(nodes.grid, Vec<float>{p[0], p[1], p[2]}), nodes.grid.size, false);
        float colour[3] = {};
        for (std::size_t s = 0; s < nodes.shown.size(); ++s) {
            const float light = std::max(interpolate(nodes.light.data() + s * number, at), 0.0f);
            for (std::size_t c = 0; c < 3; ++c) colour[c] += light * nodes.shown[s].colour[c];
        }
        for (std::size_t c = 0; c < 3; ++c) state.sky[c * count + i] = colour[c];
    });
    return Status::ok();
}

}  // namespace pileus
