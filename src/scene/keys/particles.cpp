// SPDX-License-Identifier: Apache-2.0
// Keys of method `particles`.
// in: checked values <-> out: fields of ParticlesSettings.
// docs/scene.md; docs/particles.md says what each does.
#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

template <auto... Members>
constexpr KeyField particles = field<&Scene::particles, Members...>;
using Settings = ParticlesSettings;
template <auto Member>
constexpr KeyField octaves = particles<&Settings::octaves, Member>;
template <auto Member>
constexpr KeyField shadows = particles<&Settings::shadows, Member>;

constexpr KeyRow kRows[] = {
    {"particles.scattering", particles<&Settings::scattering>,
     one_of("auto|single|effective|similarity|octaves|ordinates"), "",
     "`auto`: ordinates, or single where sky_light = `none`; the sun's light scattered once; the "
     "same with less extinction towards the sun, for what the phase function keeps within a cone, "
     "or by its mean cosine; octaves of it; or all light, scattered any number of times, by "
     "discrete ordinates on the grid's nodes"},
    {"particles.octaves", octaves<&ParticleOrders::count>, from_to(1, 8), "",
     "how many, the first included"},
    {"particles.octave_extinction", octaves<&ParticleOrders::extinction>, from_to(0, 1), "",
     "factor on the extinction from one to the next"},
    {"particles.octave_share", octaves<&ParticleOrders::share>, from_to(0, 1), "",
     "factor on the light from one to the next"},
    {"particles.octave_anisotropy", octaves<&ParticleOrders::anisotropy>, from_to(0, 1), "",
     "factor on the mean cosine from one to the next"},
    {"particles.cone_deg", octaves<&ParticleOrders::cone_deg>, positive(360), "deg",
     "of scattering = `effective`: angle at the cone's apex"},
    {"particles.sky_light", particles<&Settings::sky_ambient>, one_of("none|ambient"), "",
     "light of sky and ground in the particles: none, or from 24 directions on coarse nodes"},
    {"particles.bins", particles<&Settings::bins>, from_to(1, 4096), "",
     "parts of a ray's way through the box of all particles; within each, order is forgotten"},
    {"particles.leaf", particles<&Settings::leaf>, from_to(1, 1024), "",
     "most particles in a leaf of the octree; no pixel depends on it but by rounding"},
    {"particles.light", particles<&Settings::light>, one_of("centre|linear|exact"), "",
     "optical depth towards the sun: at each particle's centre; at four places of each, linear in "
     "between; or by a walk from each bin of each ray. Left out with billboards, `occluders` or "
     "`light_bias`: linear"},
    {"particles.most_depth", shadows<&ParticleShadows::most_depth>, from_to(0, 1e9), "",
     "a walk towards the sun ends where it has met this optical depth; 0: never"},
    {"particles.shadow_density", shadows<&ParticleShadows::density>, from_to(0, 1000), "",
     "factor on the extinction towards lights: above 1 darker shadows, 0 none"},
    {"particles.occluders", shadows<&ParticleShadows::occluders>, positive(1), "",
     "share of the particles that cast shadows on others towards the sun and directional lights, "
     "denser in return, chosen by their own numbers; all are lit and shown"},
    {"particles.light_bias", shadows<&ParticleShadows::bias>, from_to(-2, 2), "",
     "moves the places that are lit towards the sun and directional lights, in radii: less of a "
     "particle's own shade"},
    {"particles.solid_shadow", shadows<&ParticleShadows::solid>, from_to(0, 1), "",
     "share of the light that is left in the shadow of solids"},
    {"particles.display", particles<&Settings::billboards>, one_of("march|billboards"), "",
     "exact depths in bins along each ray; or one colour a particle, sorted by distance: faster, "
     "and with a lens and a shutter"},
    {"particles.display_scale", particles<&Settings::display_scale>, from_to(0.01, 100), "",
     "of billboards: factor on the radius that is shown, not on that which is lit; depth times "
     "area "
     "is kept"},
    {"particles.falloff", particles<&Settings::falloff>, from_to(0, 16), "",
     "of billboards: depth falls with the distance q from the middle, in radii, as (1 - q^2) to "
     "this power; 2.5: what a ray through the particle meets"},
    {"particles.stop_below", particles<&Settings::stop_below>, from_to(0, 1), "",
     "light of a ray ends where less of what lies behind is seen"},
};

}  // namespace

Span<const KeyRow> particles_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
