// SPDX-License-Identifier: Apache-2.0
// Members of a prepared world, for archives.
// in: World without solids -> out: every value that a session reads, in a fixed order.
// docs/flight.md, "Packed scenes"
#pragma once
#include "src/flight/archive.h"
#include "src/world/world.h"

namespace pileus {

template <class A>
void fields(A& a, Volume& v) {
    all(a, v.size, v.density, v.knows_bounds, v.bounds_m, v.in_extinction, v.missing, v.clamped,
        v.blank, v.capped, v.plain);
}
template <class A>
void fields(A& a, Grid& v) {
    all(a, v.size, v.cell_m, v.periodic, v.constant);
}
/// Tables are found again by their number: pack.cpp.
template <class A>
void fields(A& a, PhaseParams& v) {
    all(a, v.type, v.g1, v.g2, v.weight, v.alpha);
}
template <class A>
void fields(A& a, Optics& v) {
    all(a, v.albedo, v.albedo_max, v.phase, v.emission);
}
/// Its pointers are those of a store: pack.cpp.
template <class A>
void fields(A& a, PhaseTable& v) {
    all(a, v.cells, v.forward, v.slots, v.draw_steps, v.find_steps, v.peak, v.moment);
}
template <class A>
void fields(A& a, PhaseStore& v) {
    all(a, v.table, v.numbers, v.guides);
}
template <class A>
void fields(A& a, Emitter& v) {
    all(a, v.medium, v.mass_m3, v.below);
}
template <class A>
void fields(A& a, Medium& v) {
    all(a, v.volume, v.grid, v.low_m, v.extent_m, v.detail_m, v.sigma, v.channels, v.density_max,
        v.count, v.optics, v.parts, v.phases, v.emitters);
}
template <class A>
void fields(A& a, NoiseTexture& v) {
    all(a, v.words, v.largest, v.size, v.most, v.lost);
}
template <class A>
void fields(A& a, NoiseView& v) {
    all(a, v.size, v.last, v.per_m, v.offset, v.turn, v.share, v.most, v.lost);
}
template <class A>
void fields(A& a, SkyParams& v) {
    all(a, v.perlin, v.worley, v.middle, v.half_width, v.low_m, v.inverse_m, v.height_m, v.rise,
        v.fall, v.rounding, v.base_weight, v.shift_m, v.curvature_per_m, v.empty, v.least_lift,
        v.boxed, v.extent_m, v.reach_m);
}
template <class A>
void fields(A& a, SkyField& v) {
    all(a, v.perlin, v.worley, v.params, v.threshold_low, v.threshold_high, v.made, v.read);
}
template <class A>
void fields(A& a, ParticleSet& v) {
    all(a, v.count, v.origin, v.position, v.radius, v.density, v.colour, v.emission, v.velocity,
        v.id, v.low, v.high);
}
template <class A>
void fields(A& a, MediumSource& v) {
    field(a, v.mean_density);
}
template <class A>
void fields(A& a, World& v) {
    all(a, v.media, v.medium, v.source, v.direct_sky, v.layer, v.shows_particles, v.particles);
}

}  // namespace pileus
