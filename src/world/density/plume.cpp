// SPDX-License-Identifier: Apache-2.0
// A rising, widening, turbulent plume of particles.
// in: a box, a number of particles, a seed -> out: places, radii, densities, numbers; or a grid.
// Morton, Taylor, Turner 1956: a plume widens in proportion to its height by what it entrains.
#include <algorithm>

#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/base/powers.h"
#include "src/base/random_streams.h"
#include "src/io/particles/placed_particles.h"
#include "src/world/density/particle_recipe.h"

namespace pileus {
namespace {

// Shares of the box: lengths across in the narrower side, along in the height.
constexpr double kFoot = 0.07, kSpread = 0.19;  ///< half width at the foot, and its growth
constexpr double kWander = 0.07;                ///< of the axis
constexpr int kPuffs = 240;
constexpr double kPuffOff = 0.55, kMinBall = 0.2;  ///< from the axis, and size, in half widths
/// Numbers of puffs lie beyond those of particles.
constexpr std::uint64_t kPuffNumbers = 0xf0000000u;
constexpr double kMaxRadius = 0.06;  ///< of a particle
constexpr double kOverlap = 1.5;     ///< radius in mean distances of particles
constexpr double kTurnsUp = 1.3;     ///< turns of the axis
/// Measured: density at mid-height over that at the foot; mean over the box.
constexpr double kFootShare = 0.05, kMeanDensity = 0.00277;

struct Plume {
    Double3 low, extent;
    double width;    ///< the narrower side
    double spacing;  ///< mean distance of particles, m
    double mass;     ///< of each, 1/m m^3, before dilution
    double rise;     ///< speed at the foot, m/s
    Key key;

    double draw(std::uint64_t particle, std::uint32_t number) const {
        return recipe_draw(key, particle, number);
    }
    double half_width(double height) const { return (kFoot + kSpread * height) * width; }
    void make(std::uint64_t particle, float* place, float* velocity, float& radius,
              float& density) const;
};

void Plume::make(std::uint64_t i, float* place, float* velocity, float& radius,
                 float& density) const {
    // The particle's puff: a ball that the axis carries, so that the edge billows.
    const std::uint64_t puff = std::uint64_t(draw(i, 0) * kPuffs);
    const std::uint64_t p = puff + kPuffNumbers;
    const double u = (double(puff) + 0.5) / kPuffs;
    // As many particles per second at every height: more of them where they rise slowly.
    const double height = u * (0.6 + 0.4 * u);
    const double wide = half_width(height), thin = kFoot * width / wide;
    const auto axis = recipe_turn(kTurnsUp * height), where = recipe_turn(draw(p, 0));
    const double off = double(sqrt_(float(draw(p, 1)))) * kPuffOff * wide;
    const double ball = wide * (kMinBall + (1 - kPuffOff - kMinBall) * draw(p, 2));
    // Uniform in the ball.
    const auto around = recipe_turn(draw(i, 1));
    const double up = 2 * draw(i, 2) - 1, level = double(sqrt_(float(1 - up * up)));
    const double out = ball * cube_root(draw(i, 3) + 1e-9);
    const double r = std::min(kOverlap * spacing * (0.6 + 0.8 * height), kMaxRadius * width);
    radius = float(r);
    const double at[3] = {
        kWander * width * axis.sine * height + off * where.cosine + out * level * around.cosine,
        kWander * width * (1 - axis.cosine) * height + off * where.sine + out * level * around.sine,
        // From the middle of the box.
        (height - 0.5) * (extent[2] - 2 * kSpread * width) + out * up};
    // It rises as its width to the power -1/3, and widens as it rises.
    const double speed = rise * cube_root(thin);
    const double axis_x = kWander * width * axis.sine * height;
    const double axis_y = kWander * width * (1 - axis.cosine) * height;
    const double spread = speed * kSpread * width / (extent[2] * wide);
    velocity[0] = float((at[0] - axis_x) * spread);
    velocity[1] = float((at[1] - axis_y) * spread);
    velocity[2] = float(speed);
    for (std::size_t a = 0; a < 3; ++a) {
        const double room = extent[int(a)] / 2 - r * 1.0001;
        place[a] = float(std::min(std::max(at[a], -room), room));
    }
    density = float(mass * (0.25 + 0.75 * thin) / (r * r * r));
}

Status make_plume(const MediumSettings& medium, int threads, ParticleSet& out) {
    PILEUS_TRY(begin_recipe(medium, out));
    const std::uint64_t n = out.count;
    Plume plume;
    plume.low = medium.box.bounds_m[0];
    plume.extent = medium.box.bounds_m[1] - medium.box.bounds_m[0];
    plume.width = std::min(plume.extent[0], plume.extent[1]);
    const double middle = plume.half_width(0.5);
    const double volume = kPi64 * middle * middle * plume.extent[2];
    plume.spacing = cube_root(volume / double(n));
    // Overlapping particles add up to about 1 at the foot, where they are densest.
    plume.mass = kFootShare * volume / double(n) / kBallMass;
    plume.rise = medium.particles.rise_m_per_s;
    plume.key = make_key(std::uint64_t(medium.shape_seed), kPlumeStream, 0);
    parallel_each(threads, n, [&](std::size_t i) {
        plume.make(i, &out.position[3 * i], &out.velocity[3 * i], out.radius[i], out.density[i]);
    });
    return Status::ok();
}

DensityOutline outline_plume(const MediumSettings& medium) {
    return outline_recipe(medium, kMeanDensity);
}

}  // namespace

extern const DensityRow kPlumeDensity;
constexpr DensityRow kPlumeDensity = recipe_row<&ParticleSettings::plume, make_plume>(
    "procedural:plume", "plume", "particles of the plume", outline_plume);

}  // namespace pileus
