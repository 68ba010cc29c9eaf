// SPDX-License-Identifier: Apache-2.0
// A medium ready to be prepared: its grid, where it lies, and its optical properties.
// in: the scene's words about one medium -> out: plain numbers in kernel units.
// docs/methods.md 1; mix_media.h lays several on one grid, which then is one of these too.
#pragma once
#include "kernels_cpu/optics.h"
#include "src/io/volume.h"
#include "src/scene/scene.h"
#include "src/stages/prepared.h"

namespace pileus {

struct Medium {
    Volume volume;
    Grid grid;
    Double3 low_m{};      ///< low corner of the box in the world; the origin of box-local metres
    double extent_m[3];   ///< box edges
    double detail_m = 0;  ///< length that the preparation's shares are of; 0: the box's diagonal
    float sigma = 0;      ///< extinction at density 1, 1/m
    int channels = 1;     ///< 1: achromatic
    float density_max = 0;
    int count = 1;  ///< media on this grid, 1..kMostMedia; `volume` holds their sum
    std::array<Optics, kMostMedia> optics{};
    Buffer<float> parts;  ///< [medium - 1][voxel]; medium 0 is what is left of the sum
};

/// Whether no medium absorbs anything.
bool is_white(const Medium& medium);

/// Largest phase function of all media over all angles, 1/sr.
float phase_peak(const Medium& medium);

/// "medium.N" of settings that belong to the scene, as its keys are named.
std::string medium_key(const Scene& scene, const MediumSettings& settings);

/// Reads or makes the density and places it. A file that holds extinction becomes densities up to 1
/// (value over largest value) with sigma = extinction_scale times the largest value. Errors: those
/// of the readers; kBadInput for a file that does not know its place while `bounds_m` is left out.
Status load_medium(const Scene& scene, const MediumSettings& settings, int threads, Medium& out);

}  // namespace pileus
