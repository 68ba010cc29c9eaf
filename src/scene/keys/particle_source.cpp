// SPDX-License-Identifier: Apache-2.0
// Keys of a file of particles: its unit, radii, what its densities mean.
// in: checked values <-> out: fields of ParticleSettings.
// docs/particles.md.
#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

template <auto... Members>
constexpr KeyField particles = field<&MediumSettings::particles, Members...>;

using P = ParticleSettings;

constexpr KeyRow kRows[] = {
    {"medium.N.density.unit_m", particles<&P::unit_m>, positive(1e9), "m",
     "particles: metres of the file's unit of length"},
    {"medium.N.density.radius_m", particles<&P::radius_m>, positive(1e12), "m",
     "radius of every particle; left out: the file's own", kNoNote},
    {"medium.N.density.radius_scale", particles<&P::radius_scale>, positive(1e6), "",
     "factor on every radius"},
    {"medium.N.density.holds", particles<&P::cross_section>, one_of("extinction|cross-section"), "",
     "what the file's `density` is: a particle's extinction at its centre in 1/m, or its "
     "cross-section in "
     "m^2, which a larger radius spreads thinner"},
    {"medium.N.density.share", particles<&P::share>, positive(1), "",
     "share of the particles that are kept, chosen by number or by their own bits; they are denser "
     "in return"},
    {"medium.N.density.replicate", particles<&P::replicate>, from_to(1, 10000), "",
     "so many smaller particles in place of each, with its extinction in all, spread about as its "
     "extinction is"},
    {"medium.N.density.replicate_radius", particles<&P::replicate_radius>, positive(1), "",
     "their radius over that of the particle that they stand for"},
};

constexpr KeyRow kRecipeRows[] = {
    {"medium.N.plume.particles", particles<&P::plume, &RecipeSettings::count>, from_to(1, 1e8), "",
     "how many particles a procedural plume is made of"},
    {"medium.N.plume.rise_m_per_s", particles<&P::plume, &RecipeSettings::rise_m_per_s>,
     from_to(0, 1000), "m/s", "how fast it rises at its foot; slower above, as it widens"},
    {"medium.N.particle_cumulus.particles", particles<&P::cumulus, &RecipeSettings::count>,
     from_to(1, 1e8), "", "how many particles a procedural cumulus of particles is made of"},
    {"medium.N.particle_cumulus.rise_m_per_s",
     particles<&P::cumulus, &RecipeSettings::rise_m_per_s>, from_to(0, 1000), "m/s",
     "how fast it rises; its largest bubble turns as fast"},
};

}  // namespace

Span<const KeyRow> recipe_keys() {
    return {kRecipeRows, sizeof kRecipeRows / sizeof kRecipeRows[0]};
}

Span<const KeyRow> particle_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
