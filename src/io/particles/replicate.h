// SPDX-License-Identifier: Apache-2.0
// More particles than a file has: each stands for several smaller ones.
// in: particles, how many for each -> out: the same mass in their children.
// docs/particles.md, "Replication"; Monette and Whitehead 2014, 5.4.
#pragma once
#include <string>

#include "src/io/particles/particle_file.h"
#include "src/scene/media/particle_settings.h"

namespace pileus {

/// Puts settings.replicate children in place of each particle, by its id or its own numbers,
/// wherever it stands in `set`. kLimit: more than all readers allow, or out of memory.
Status replicate_particles(const std::string& name, const ParticleSettings& settings,
                           ParticleSet& set);

/// The same number for a particle wherever it stands in its file.
std::uint64_t mark_of(const ParticleSet& set, std::size_t i);

}  // namespace pileus
