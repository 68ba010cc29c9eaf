// SPDX-License-Identifier: Apache-2.0
// What stands in place of the files and recipes of media: cells and particles in a host's memory,
// particles that are read already, files that are open. in: pointers that outlive the reading ->
// out: one per medium. docs/embedding.md, "Three handles"
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pileus {

struct ParticleSet;
class WeatherFiles;

/// Particles in a host's memory; strides in bytes. None of `density`: 1; none of `id`,
/// `velocity`, `colour` or `emission`: none.
struct HostParticles {
    std::uint64_t count = 0;
    const float *position = nullptr, *radius = nullptr, *density = nullptr;
    const float *velocity = nullptr, *colour = nullptr, *emission = nullptr;
    const std::uint64_t* id = nullptr;
    std::size_t position_stride = 0, radius_stride = 0, density_stride = 0, id_stride = 0;
    std::size_t velocity_stride = 0, colour_stride = 0, emission_stride = 0;
};

/// Of one medium; all left out: what the scene says.
struct MediumValues {
    const float* cells = nullptr;              ///< [z][y][x], of these sizes
    std::array<int, 3> size{};                 ///< along x, y, z
    const HostParticles* particles = nullptr;  ///< instead of the file
    const ParticleSet* placed = nullptr;       ///< what is read already
    bool shadows_only = false;                 ///< the grid of particles is for shadows alone
    WeatherFiles* weather = nullptr;           ///< those that are open; null: it is opened
};

struct HostMedia {
    std::vector<MediumValues> media;  ///< the first ones of a scene; others have none
    WeatherFiles* weather = nullptr;  ///< of all media; null: each reader opens its own

    MediumValues of(std::size_t medium) const {
        MediumValues values = medium < media.size() ? media[medium] : MediumValues{};
        values.weather = weather;
        return values;
    }
};

}  // namespace pileus
