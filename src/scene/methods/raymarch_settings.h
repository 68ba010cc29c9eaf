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

struct RaymarchSettings {
    RaymarchIntegrator integrator = RaymarchIntegrator::kClosed;
    int steps = 256;  ///< of a ray through the medium; 0: it is not seen
    RaymarchSpacing spacing = RaymarchSpacing::kUniform;
    double first_step_m = 0;  ///< geometric: at least; optimal: where steps stop shrinking; 0: auto
    double growth = 1.01;     ///< geometric: of one step over the one before
    bool stretch = false;     ///< occlusion = "stretch"
    bool forward = false;     ///< scattering = "forward"
    bool many = true;         ///< scattering = "auto", "octaves" or "ordinates"
    bool automatic = true;    ///< scattering = "auto"
    bool ordinates = false;   ///< scattering = "ordinates"; lamps have octaves
    int octaves = 8;          ///< 1..8
    double octave_extinction = 0.45, octave_share = 0.65, octave_anisotropy = 0.75;
    double cone_deg = 40;       ///< at its apex
    double forward_share = -1;  ///< >= 0: instead of what the phase function keeps in the cone
    RaymarchLightKind light = RaymarchLightKind::kAuto;
    int light_steps = 0;  ///< 0: of a voxel, to the end
    double light_first_step_m = 0, light_growth = 1;
    bool sky_ambient = true;  ///< sky_light = "ambient"
    bool detail = false;      ///< coarser densities for steps and pixels wider than cells
    bool light_cone = false;  ///< light_path = "cone"
    RaymarchJitterKind jitter = RaymarchJitterKind::kNone;
    double jitter_share = 1;  ///< of a panel
    double grid_lock_m = 0;   ///< 0: none
    RaymarchPowderKind powder = RaymarchPowderKind::kNone;
    double powder_strength = 1;
    Float3 ambient{0, 0, 0};  ///< emission over extinction
    double stop_below = 1e-4;
    UpsampleSettings thin;
    int light_refresh = 1;    ///< frames in which sunlight on nodes follows a sun that moves; 1..64
    bool peak_phase = false;  ///< phase = "peak": over its largest value
};

}  // namespace pileus
