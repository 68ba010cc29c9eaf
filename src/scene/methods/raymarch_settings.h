// SPDX-License-Identifier: Apache-2.0
// Settings of method raymarch.
// in: keys of [method.raymarch] -> out: plain values. docs/scene.md
#pragma once
#include <array>

#include "src/base/vectors.h"
#include "src/scene/methods/thin_settings.h"

namespace pileus {

enum class RaymarchIntegrator { kClosed, kRiemann, kTrapezoid, kSimpson, kSimpson38 };
enum class RaymarchSpacing { kUniform, kVoxel, kOptimal, kGeometric };
enum class RaymarchJitterKind { kNone, kHash, kBlueNoise };
enum class RaymarchLightKind { kAuto, kMarch, kBuffer, kBufferExact };
enum class RaymarchPowderKind { kNone, kPowder, kBeerPowder, kDirectional };

/// Steps of a ray from the camera.
struct RaymarchStepSettings {
    RaymarchIntegrator integrator = RaymarchIntegrator::kClosed;
    int steps = 256;  ///< of a ray through the medium; 0: it is not seen
    RaymarchSpacing spacing = RaymarchSpacing::kUniform;
    double first_step_m = 0;  ///< geometric: at least; optimal: where steps stop shrinking; 0: auto
    double growth = 1.01;     ///< geometric: of one step over the one before
    bool stretch = false;     ///< occlusion = "stretch"
    bool detail = false;      ///< coarser densities for steps and pixels wider than cells
    RaymarchJitterKind jitter = RaymarchJitterKind::kNone;
    double jitter_share = 1;  ///< of a panel
    double grid_lock_m = 0;   ///< 0: none
    double stop_below = 1e-4;
};

/// What stands for light that is scattered more than once.
struct RaymarchScatterSettings {
    bool forward = false;    ///< scattering = "forward"
    bool many = true;        ///< scattering = "auto", "octaves" or "ordinates"
    bool automatic = true;   ///< scattering = "auto"
    bool ordinates = false;  ///< scattering = "ordinates"; lamps have octaves
    int octaves = 8;         ///< 1..8
    double octave_extinction = 0.45, octave_share = 0.65, octave_anisotropy = 0.75;
    double cone_deg = 40;       ///< at its apex
    double forward_share = -1;  ///< >= 0: instead of what the phase function keeps in the cone
};

/// How light finds its way to a step.
struct RaymarchLightSettings {
    RaymarchLightKind kind = RaymarchLightKind::kAuto;
    int steps = 0;  ///< towards the sun; 0: of a voxel, to the end
    double first_step_m = 0, growth = 1;
    bool sky_ambient = true;  ///< sky_light = "ambient"
    bool cone = false;        ///< light_path = "cone"
    int refresh = 1;          ///< frames in which sunlight on nodes follows a sun that moves; 1..64
};

/// Appearance, not physics.
struct RaymarchLookSettings {
    RaymarchPowderKind powder = RaymarchPowderKind::kNone;
    double powder_strength = 1;
    Float3 ambient{0, 0, 0};  ///< emission over extinction
    bool peak_phase = false;  ///< phase = "peak": over its largest value
};

struct RaymarchSettings {
    RaymarchStepSettings march;
    RaymarchScatterSettings scattering;
    RaymarchLightSettings light;
    RaymarchLookSettings look;
    UpsampleSettings thin;
};

}  // namespace pileus
