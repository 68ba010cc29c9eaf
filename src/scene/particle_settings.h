// SPDX-License-Identifier: Apache-2.0
// What a scene says of a file of particles.
// in: keys of medium.density -> out: plain values.
// docs/particles.md, "Data".
#pragma once

namespace pileus {

struct ParticleSettings {
    double unit_m = 1;        ///< metres per unit of the file; > 0
    double radius_m = 0;      ///< of every particle; 0: the file's own
    double radius_scale = 1;  ///< on each radius; > 0
    bool cross_section =
        false;         ///< holds = "cross-section": m^2 of a particle; else extinction, 1/m
    double share = 1;  ///< of the particles that are kept, denser in return; (0, 1]
    bool shadows_only = false;  ///< the method shows particles; their grid is for shadows alone
};

}  // namespace pileus
