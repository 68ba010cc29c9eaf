// SPDX-License-Identifier: Apache-2.0
// Places in a particle from which depths to a light are taken, and what follows from them.
// in: settings, a light -> out: offsets in radii; a linear function through depths.
// docs/particles.md, "Light".
#pragma once
#include "src/methods/particles/particles_state.h"

namespace pileus {

/// Offsets from a ball's centre, radii: one or four, moved towards the light by light_bias.
struct LightPlaces {
    int count = 1;
    bool turned = false;  ///< along axes that each ball has by its own way to the lamp
    std::array<float, 3> offset[4]{};
    std::array<float, 3> arm[4]{};  ///< of four: unit vectors from the centre, without the bias
};

/// Towards a light far away, `to_light` a unit vector; or a lamp, whose bias is left out where it
/// has a place, as the direction differs from ball to ball.
LightPlaces light_places(const ParticlesSettings& settings, const std::array<float, 3>& to_light);
LightPlaces light_places(const ParticlesSettings& settings, const LampParams& lamp);

/// Balls that shadow others towards parallel lights.
inline Span<const ParticleBall> casts_of(const ParticlesState& state) {
    return state.settings.shadows.occluders < 1 ? state.occluders.span() : state.tree.balls.span();
}

/// The linear function through the depths at the places, each `stride` numbers after the other.
ParticleShade shade_of(const float* depths, std::size_t stride, const LightPlaces& places);

/// Share of each ball [ball] that a lamp reaches past the solids.
void see_past_solids(const Context& context, const FrameView& view, const ParticlesState& state,
                     const LampParams& lamp, float* seen);

/// Depths to the lamps. kLimit: out of memory. Nothing without lamps.
Status light_by_lamps(const Context& context, const FrameView& view, ParticlesState& state);

/// Light of lamps and sky at each ball, for the camera of `k`. Nothing without lamps.
Status light_around(const Context& context, const FrameView& view, const ParticleMarchParams& k,
                    ParticlesState& state);

}  // namespace pileus
