// SPDX-License-Identifier: Apache-2.0
// What lies behind the media: sky, ground, solid meshes, or what a depth image hides.
// in: light, camera, solids -> out: radiance and distance per pixel.
// docs/methods.md 3; docs/solids.md. The one way to these kernels for every method.
#pragma once
#include "src/picture/layers.h"
#include "src/run/context.h"
#include "src/world/light/lights.h"

namespace pileus {

/// What shines behind the media, without their shadow on the ground.
BackgroundParams background_params(const MediumView& medium, const CameraParams& camera,
                                   const Lighting& light);

/// Adds light of radiance times solid angle `power` from direction `w` to the harmonics of the
/// irradiance over pi; degrees 0, 1, 2 of the clamped cosine are 1, 2/3, 1/4.
void add_around(const double (&w)[3], double power, double (&k)[kAroundTerms]);

/// Light around a place over the ground, sky and ground, as such harmonics.
void light_around(const Lighting& light, double (&sums)[3][kAroundTerms]);

/// Whether meshes, or an image of what stands there, may end rays.
bool has_meshes(const Lighting& light);
bool has_surfaces(const Lighting& light);

/// Runs background_rows, or its like with solids, and lays the camera's depth image over the
/// result. `light` tells the solids and the light around them; `k` the rest.
Status show_background(const Context& context, const Lighting& light, const BackgroundParams& k,
                       const BackgroundBuffers& b);

/// In place of it where nothing behind the media is wanted: all of the way is free, but for what
/// the camera's depth image shows.
Status show_nothing_behind(const Lighting& light, const CameraParams& camera, int threads,
                           Planes& planes);

/// Channel `shadow` of an image of this camera: of ground, solids and what a depth image shows, the
/// share of the sun's light that media and solids keep from it; 0 in the sky and without a sun.
/// Needs kernels of the host. kLimit: out of memory.
Status add_shadow(const Context& context, const MediumView& medium, const CameraParams& camera,
                  const Lighting& light, Image& image);

}  // namespace pileus
