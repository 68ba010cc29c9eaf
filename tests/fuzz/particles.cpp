// SPDX-License-Identifier: Apache-2.0
// Fuzz target: particles as PRT, PLY, Houdini, Maya or text, by what the bytes begin with, and on a
// grid. in: bytes as a file -> out: lawful particles and a lawful volume, or one line.
// docs/particles.md, "Data"
#include "src/io/volumes/particle_volume.h"
#include "tests/fuzz/target.h"

int fuzz::particles(const std::uint8_t* data, std::size_t size) {
    // The magic of Houdini's geometry is looked at by its reader.
    const struct {
        std::uint8_t first;
        const char* extension;
    } kKinds[] = {{0xc0, ".prt"}, {'p', ".ply"},   {'B', ".bgeo"}, {'P', ".bgeo"},
                  {'[', ".bgeo"}, {0x7f, ".bgeo"}, {0x9e, ".pdb"}, {'A', ".pda"}};
    const char* extension = ".csv";
    for (const auto& kind : kKinds)
        if (size >= 1 && data[0] == kind.first) extension = kind.extension;
    pileus::ParticleReading reading;
    reading.most = 1 << 12;
    reading.most_unpacked = 1 << 16;
    reading.radius = size % 2 == 0 ? 0 : 0.5;
    pileus::ParticleSet set;
    pileus::Status status =
        pileus::decode_particles("p.x", extension, fuzz::text_of(data, size), reading, set);
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
