// SPDX-License-Identifier: Apache-2.0
// What recipes of particles share: arrays, random numbers, the grid.
// in: a medium's settings -> out: an empty set that fills its box, or a volume.
// docs/particles.md, "A plume" and "A cumulus".
#pragma once
#include "kernels_cpu/core/math.h"
#include "kernels_cpu/core/rng.h"
#include "src/io/particles/particles.h"
#include "src/scene/checks/check_keys.h"
#include "src/scene/rows/density_row.h"

namespace pileus {

/// Number `number` of a particle, uniform in [0, 1); it depends on nothing else.
inline double recipe_draw(const Key& key, std::uint64_t particle, std::uint32_t number) {
    const auto words = threefry<std::uint32_t>(key.k0, key.k1, std::uint32_t(particle), number);
    return double(uniform(words.a));
}

struct RecipeTurn {
    double sine, cosine;
};

/// Sine and cosine of an angle in turns, any number of them.
inline RecipeTurn recipe_turn(double turns) {
    const double whole = double(std::int64_t(turns)) - (turns < 0 ? 1 : 0);
    const auto at = sincos_turns(float(turns - whole < 1 ? turns - whole : 0));
    return {double(at.sine), double(at.cosine)};
}

/// Room for the particles that the medium asks for, numbered, and their box; places are counted
/// from its middle. kLimit: out of memory.
Status begin_recipe(const MediumSettings& medium, ParticleSet& out);

/// A row's check: the recipe of its own keys is the medium's.
template <RecipeSettings ParticleSettings::*Recipe>
void choose_recipe(SceneCheck& check, std::size_t medium) {
    ParticleSettings& particles = check.scene.media[medium].particles;
    particles.count = (particles.*Recipe).count;
    particles.rise_m_per_s = (particles.*Recipe).rise_m_per_s;
}

/// Size, memory and mean of the grid that a recipe's particles are laid on.
DensityOutline outline_recipe(const MediumSettings& medium, double mean);

/// Makes the particles and lays them.
Status lay_recipe(const MediumSettings& medium, const DensityMaking& with,
                  Status (*make)(const MediumSettings&, int, ParticleSet&), Volume& volume);

/// The row of a recipe; `Make` makes its particles.
template <RecipeSettings ParticleSettings::*Recipe,
          Status (*Make)(const MediumSettings&, int, ParticleSet&)>
constexpr DensityRow recipe_row(const char* name, const char* table, const char* working,
                                DensityOutline (*outline)(const MediumSettings&)) {
    DensityRow row;
    row.name = name;
    row.takes_seed = true;
    row.table = table;
    row.check = choose_recipe<Recipe>;
    row.outline = outline;
    row.mean_within = 1.1;
    row.working = working;
    row.make = [](const MediumSettings& medium, const DensityMaking& with, Volume& volume) {
        return lay_recipe(medium, with, Make, volume);
    };
    row.make_particles = Make;
    return row;
}

}  // namespace pileus
