// SPDX-License-Identifier: Apache-2.0
// A procedural sky made ready: its two noise textures and the numbers of its layer.
// in: SkySettings, where the medium lies -> out: SkyParams with what they point into; a grid.
// docs/skies.md.
#pragma once
#include "kernels_cpu/isa/kernels.h"
#include "src/io/volumes/volume.h"
#include "src/scene/scene.h"
#include "src/world/density/noise_volume.h"

namespace pileus {

/// Keep in place once made: `params` points into the textures.
struct SkyField {
    NoiseTexture perlin, worley;
    SkyParams params{};
    double threshold_low = 0, threshold_high = 0;  ///< as the coverage moved them
    int made = 0, read = 0;                        ///< noise volumes, made now or from the cache
};

/// Reads or makes the noises and finds the thresholds. `low_m` is the origin of box-local metres.
/// `turned`: tiles are turned about the vertical, each by an angle of its own. `wind_s`: beside the
/// settings' time. kLimit: out of memory.
Status make_sky(const SkySettings& settings, const Double3& low_m, const KernelTable& kernels,
                int threads, SkyField& sky, bool turned = false, double wind_s = 0);

/// Shows the box [0, extent_m] of the sky and nothing beside it, or with null all of the layer.
void bound_sky(const double* extent_m, SkyField& sky);

/// The sky of a medium on a grid of so many cells of its box; cells wider than texels hold filtered
/// noise. `keep`, if given, becomes the field.
Status bake_sky(const MediumSettings& settings, const std::array<int, 3>& size,
                const KernelTable& kernels, int threads, Volume& volume, SkyField* keep = nullptr,
                double wind_s = 0);

/// Cells of such a grid where the scene leaves them out: cubes, 256 along the longest edge.
std::array<int, 3> default_sky_size(const MediumSettings& settings);

/// Bytes of the textures, and those beside them while they are made.
struct SkyBytes {
    std::uint64_t kept = 0, making = 0;
};
SkyBytes sky_bytes(const SkySettings& settings);

}  // namespace pileus
