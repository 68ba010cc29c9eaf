// SPDX-License-Identifier: Apache-2.0
// Settings of method particles.
// in: keys of [method.particles] -> out: plain values. docs/scene.md
#pragma once

namespace pileus {

enum class ParticleLight { kCentre, kLinear, kExact };
enum class ParticleScattering { kAuto, kSingle, kEffective, kSimilarity, kOctaves, kByNodes };

/// Light scattered more than once, as each way of it reads.
struct ParticleOrders {
    int count = 8;  ///< of octaves, 1..8
    double extinction = 0.45, share = 0.65, anisotropy = 0.75;
    double cone_deg = 40;  ///< at its apex
};

struct ParticleShadows {
    double density = 1;     ///< factor on extinction towards lights; >= 0
    double occluders = 1;   ///< share of particles that cast shadows, denser in return; (0, 1]
    double bias = 0;        ///< places that are lit, moved to a parallel light, radii
    double solid = 0;       ///< share of light left behind solids; [0, 1]
    double most_depth = 0;  ///< towards the sun, where the walk ends; 0: none
};

/// Method particles; src/scene/keys/particles.cpp says what each means.
struct ParticlesSettings {
    /// As written; scattering_in_use() is what counts.
    ParticleScattering scattering = ParticleScattering::kAuto;
    ParticleOrders octaves;
    bool sky_ambient = true;                      ///< sky_light = "ambient"
    int bins = 256;                               ///< along a ray, 1..4096
    int leaf = 16;                                ///< most particles in one, 1..1024
    ParticleLight light = ParticleLight::kExact;  ///< as written; light_in_use() is what counts
    ParticleShadows shadows;
    bool billboards = false;   ///< display = "billboards"; else marched
    double display_scale = 1;  ///< of billboards: on radii, extinction times area kept; > 0
    double falloff = 2.5;      ///< of billboards: the power of 1 - distance^2; 0..16
    double stop_below = 1e-4;
};

/// Billboards have no bins to walk from, and these two keys shape light at places in particles.
inline bool lights_places(const ParticlesSettings& s) {
    return s.billboards || s.shadows.occluders < 1 || s.shadows.bias != 0;
}
inline ParticleScattering scattering_in_use(const ParticlesSettings& s) {
    if (s.scattering != ParticleScattering::kAuto) return s.scattering;
    return s.sky_ambient ? ParticleScattering::kByNodes : ParticleScattering::kSingle;
}
inline ParticleLight light_in_use(const ParticlesSettings& s) {
    return s.light == ParticleLight::kExact && lights_places(s) ? ParticleLight::kLinear : s.light;
}

}  // namespace pileus
