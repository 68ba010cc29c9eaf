// SPDX-License-Identifier: Apache-2.0
// Fuzz target: particles as PRT, PLY or text, by what the bytes begin with, and on a grid.
// in: bytes as a file -> out: lawful particles and a lawful volume, or one line.
// docs/particles.md, "Data"
#include "src/io/volumes/particle_volume.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const bool prt = size >= 1 && data[0] == 0xc0;
    const bool ply = size >= 3 && data[0] == 'p' && data[1] == 'l' && data[2] == 'y';
    pileus::ParticleReading reading;
    reading.most = 1 << 12;
    reading.radius = size % 2 == 0 ? 0 : 0.5;
    pileus::ParticleSet set;
    pileus::Status status = pileus::decode_particles("p.x",
                                                     prt   ? ".prt"
                                                     : ply ? ".ply"
                                                           : ".csv",
                                                     fuzz::text_of(data, size), reading, set);
    if (status) status = pileus::place_particles("p.x", pileus::ParticleSettings{}, set);
    if (!status) {
        fuzz::check_fault(status, "p.x:", true);
        return 0;
    }
    fuzz::require(set.count <= reading.most, "as many as allowed");
    for (std::size_t i = 0; i < set.count; ++i) {
        fuzz::require(set.radius[i] > 0 && set.radius[i] <= 1.0001e12f, "radii are above 0");
        fuzz::require(set.density[i] >= 0 && set.density[i] <= 1.0001e12f, "densities are >= 0");
    }
    for (const int cells : pileus::particle_cells(set))
        fuzz::require(cells >= 1 && cells <= 256, "cells are as many as allowed");
    pileus::Volume volume;
    fuzz::require(bool(pileus::grid_particles(set, {5, 4, 3}, 1, volume)), "particles have a grid");
    fuzz::check_volume(volume);
    return 0;
}
