// SPDX-License-Identifier: Apache-2.0
// A cumulus of particles: bubbles upon bubbles, each a rising vortex, over a flat base.
// in: a box, a number of particles, a seed -> out: places, radii, densities, velocities; or a grid.
// Hill 1894, "On a spherical vortex"; Rogers and Yau 1989, "A short course in cloud physics",
// ch. 3.
#include <algorithm>

#include "platform/threads.h"
#include "src/base/powers.h"
#include "src/base/random_streams.h"
#include "src/io/particles/placed_particles.h"
#include "src/world/density/cumulus.h"
#include "src/world/density/particle_recipe.h"

namespace pileus {
namespace {

constexpr std::uint64_t kFirstShape = 4;  ///< seed 0 is the shape of procedural:cumulus
constexpr double kRim = 0.02;             ///< of the box, left free about the bubbles
constexpr double kShell = 0.2;            ///< power of the share of a bubble's radius; 1/3: uniform
constexpr double kBallOverlap = 1.5;      ///< radius in mean distances within a bubble
constexpr double kMaxOfBubble = 0.5;      ///< radius of a particle in that of its bubble
/// Measured: what bubbles that overlap add up to in the cloud's upper half, were each 1; mean over
/// the box.
constexpr double kBubblesUpon = 6.5, kMeanCumulus = 0.0675;

struct ParticleCumulus {
    BubbleList list;
    Buffer<double> share;  ///< of particles in the bubbles up to this one
    double particles, rise, largest;
    Double3 extent;
    Key key;

    void make(std::uint64_t particle, float* place, float* velocity, float& radius,
              float& density) const;
};

void ParticleCumulus::make(std::uint64_t i, float* place, float* velocity, float& radius,
                           float& density) const {
    const double lot = recipe_draw(key, i, 0) * share[list.count - 1];
    const std::size_t b = std::size_t(
        std::upper_bound(share.data(), share.data() + list.count - 1, lot) - share.data());
    const Bubble& bubble = list.bubbles[b];
    const double size = double(bubble.r);
    // Denser towards the shell.
    const RecipeTurn around = recipe_turn(recipe_draw(key, i, 1));
    const double up = 2 * recipe_draw(key, i, 2) - 1, level = double(sqrt_(float(1 - up * up)));
    const double out = size * power_of(recipe_draw(key, i, 3) + 1e-9, kShell);
    const double own = share[b] - (b > 0 ? share[b - 1] : 0);
    const double room = size * size * size / (own / share[list.count - 1] * particles);
    const double r = std::min(kBallOverlap * cube_root(room), kMaxOfBubble * size);
    radius = float(r);
    // The base cuts the bubbles: what is below is put above, and none reaches through it.
    const double height = double(bubble.z) + out * up;
    const double above = double(sqrt_(float(height * height + r * r)));
    const double at[3] = {double(bubble.x) + out * level * around.cosine,
                          double(bubble.y) + out * level * around.sine, above - extent[2] / 2};
    double from[3] = {};
    for (std::size_t a = 0; a < 3; ++a) {
        const double end = extent[int(a)] / 2 - r * 1.0001;
        const double v = std::min(std::max(at[a], -end), end);
        place[a] = float(v);
        const double middle = a == 0   ? double(bubble.x)
                              : a == 1 ? double(bubble.y)
                                       : double(bubble.z) - extent[2] / 2;
        from[a] = (v - middle) / size;
    }
    // Hill's vortex: it rises along the bubble's axis, sinks at its rim, and has no divergence.
    // Of thermals alike in buoyancy the speed goes with the root of the size.
    const double turn = 1.5 * rise * double(sqrt_(float(size / largest)));
    const double across = from[0] * from[0] + from[1] * from[1];
    velocity[0] = float(turn * from[0] * from[2]);
    velocity[1] = float(turn * from[1] * from[2]);
    velocity[2] = float(rise + turn * (1 - 2 * across - from[2] * from[2]));
    // Water grows with height above the base, and extinction of as many drops with its power 2/3.
    const double root = cube_root((double(place[2]) + extent[2] / 2) / double(list.top));
    const double mass = 4.18879020478639 * room / kBubblesUpon;
    density = float(root * root * mass / (kBallMass * r * r * r));
}

Status make_particle_cumulus(const MediumSettings& medium, int threads, ParticleSet& out) {
    PILEUS_TRY(begin_recipe(medium, out));
    ParticleCumulus c;
    c.extent = out.high - out.low;
    const Double3 space = c.extent * (1 - 2 * kRim);
    PILEUS_TRY(grow_bubbles(std::uint64_t(medium.shape_seed) + kFirstShape, float(space[0] / 2),
                            float(space[1] / 2), float(space[2]), c.list));
    PILEUS_TRY(c.share.resize(c.list.count, "cumulus bubbles"));
    double sum = 0, largest = 0;
    for (std::size_t i = 0; i < c.list.count; ++i) {
        const Bubble& b = c.list.bubbles[i];
        // As many as there is surface to cover; what is centred below the base stays empty.
        if (b.z > 0) sum += double(b.r) * double(b.r);
        if (b.z > 0) largest = std::max(largest, double(b.r));
        c.share[i] = sum;
    }
    c.largest = largest;
    c.particles = double(out.count);
    c.rise = medium.particles.rise_m_per_s;
    c.key = make_key(std::uint64_t(medium.shape_seed), kParticleCumulusStream, 0);
    parallel_each(threads, out.count, [&](std::size_t i) {
        c.make(i, &out.position[3 * i], &out.velocity[3 * i], out.radius[i], out.density[i]);
    });
    return Status::ok();
}

DensityOutline outline_particle_cumulus(const MediumSettings& medium) {
    DensityOutline outline = outline_recipe(medium, kMeanCumulus);
    outline.bytes += kMaxBubbles * (sizeof(Bubble) + sizeof(double));
    return outline;
}

}  // namespace

extern const DensityRow kParticleCumulusDensity;
constexpr DensityRow kParticleCumulusDensity =
    recipe_row<&ParticleSettings::cumulus, make_particle_cumulus>(
        "procedural:particle-cumulus", "particle_cumulus", "particles of the cumulus",
        outline_particle_cumulus);

}  // namespace pileus
