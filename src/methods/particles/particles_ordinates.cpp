// SPDX-License-Identifier: Apache-2.0
// Light scattered more than once at every particle, by discrete ordinates on nodes of the grid.
// in: a particle tree, its medium -> out: light from all around, by ball.
// docs/particles.md, "Light"; docs/ordinates.md
#include <algorithm>

#include "src/methods/particles/particles_state.h"

namespace pileus {

Status solve_particles(const Context& context, const FrameView& view, ParticlesState& state) {
    const Medium& medium = view.world.medium;
    LampNodes lamps;
    PILEUS_TRY(make_lamp_nodes(context, medium, state.majorants, view.lighting, true, lamps));
    OrdinateAsk ask;
    ask.lamps = &lamps;
    ask.lamp_count = lamps.lamps.size();
    ask.emission = emits(medium);
    ask.ground = true;
    return make_ordinates(context, medium, state.majorants, view.lighting, ask, state.ordinates);
}

Status light_by_ordinates(const Context& context, const FrameView& view, ParticlesState& state) {
    OrdinateNodes& nodes = state.ordinates;
    const StageClock clock(context, "ordinates");
    PILEUS_TRY(turn_light(context, view.world.medium, state.camera, nodes));
    PILEUS_TRY(allocate_once(arrays::particle_sky(state.tree.balls.size()), state.sky));
    float colours[kMaxShown][3];
    for (std::size_t s = 0; s < nodes.shown.size(); ++s)
        std::copy_n(nodes.shown[s].colour.data(), 3, colours[s]);
    light_by_nodes(context, nodes.grid, nodes.light.data(), nodes.shown.size(), colours, state);
    return Status::ok();
}

}  // namespace pileus
