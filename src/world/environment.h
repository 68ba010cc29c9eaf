// SPDX-License-Identifier: Apache-2.0
// All that lights a frame beside its media, worked out here alone.
// in: a scene, a world -> out: sky map, air, depths of one camera; lights of a frame.
// docs/architecture.md, "How a frame is made"
#pragma once
#include "src/world/world.h"

namespace pileus {

/// What is seen of a world through one camera and under one sky: each run has its own.
struct Environment {
    Atmosphere air;  ///< of a scene with [atmosphere], whose sky is the map
    SkyMap sky_map;  ///< of a file, of a host, or of the air
    CameraDepth depth;
    GroundLook look;
};

/// What sizes tell. A sky map is read at once, as lights, and with them the plan, depend on its
/// colours; air is made at once, too, for the height of the world's media. `sky`: in place of the
/// map's file; null: that. Errors: the readers'.
Status outline_environment(const Scene& scene, const Context& context, const World& world,
                           const Image* sky, Environment& environment);

/// Reads the rest, of films with a sequence of depths again for each frame.
Status load_environment(const Scene& scene, const Context& context, Environment& environment);

/// The scene's sky map, if it has one.
Status read_sky_map(const Scene& scene, const Context& context, const Image* sky, SkyMap& map);

/// Another sky map, or none: null. The old one stays where memory ends.
Status set_sky_map(const Image* map, const Sky& sky, bool ground, Environment& environment);

/// The air and its sky for another sun, moon or ground.
Status relight_air(const AtmosphereSettings& settings, const FrameState& frame, int threads,
                   const World& world, Environment& environment);

/// The lights of a scene whose sun is at this place. Where the moon lights it, its beams are the
/// moon's, to every method. The result points into `world` and `environment`.
Lighting light_of(const Scene& scene, const SunPlace& sun, const World& world,
                  const Environment& environment);

/// What was left out of them, and why.
void explain_light(const Scene& scene, const SunPlace& sun, const World& world,
                   const Environment& environment, const Lighting& made, Plan& plan);

}  // namespace pileus
