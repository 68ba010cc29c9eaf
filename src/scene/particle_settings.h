// SPDX-License-Identifier: Apache-2.0
// What a scene says of a medium made of particles.
// in: keys medium.N.particles.* -> out: this struct.
// docs/particles.md, "Data".
#pragma once

namespace pileus {

struct ParticleSettings {
    double unit_m = 1;        ///< metres per unit of the file; > 0
    double radius_m = 0;      ///< of every particle; 0: the file's own
    double radius_scale = 1;  ///< on each radius; > 0
    bool cross_section =
        false;         ///< density = "cross-section": m^2 of a particle; else peak extinction
    double share = 1;  ///< of the particles that are kept, densities re-weighted; (0, 1]
};

}  // namespace pileus
