// SPDX-License-Identifier: Apache-2.0
// What a scene says of a file of particles.
// in: keys of medium.density -> out: plain values.
// docs/particles.md, "Data".
#pragma once
#include <cstdint>

namespace pileus {

/// Of particles that a recipe makes.
struct RecipeSettings {
    std::int64_t count = 100000;
    double rise_m_per_s = 5;  ///< of the air; of a plume's at its foot
};

struct ParticleSettings {
    double unit_m = 1;        ///< metres per unit of the file; > 0
    double radius_m = 0;      ///< of every particle; 0: the file's own
    double radius_scale = 1;  ///< on each radius; > 0
    bool cross_section =
        false;  ///< holds = "cross-section": m^2 of a particle; else extinction, 1/m
    RecipeSettings plume, cumulus;  ///< of procedural:plume and procedural:particle-cumulus
    std::int64_t count = 100000;    ///< of the recipe that the medium names; set by the checks
    double rise_m_per_s = 5;        ///< the same
    double share = 1;               ///< of the particles that are kept, denser in return; (0, 1]
    std::int64_t replicate = 1;     ///< children of each particle that is kept; 1: itself
    double replicate_radius = 0.5;  ///< of each, over the parent's; (0, 1]
};

}  // namespace pileus
