// SPDX-License-Identifier: Apache-2.0
// A medium ready to be prepared: its grid, where it lies, and its optical properties.
// in: the scene's words about one medium -> out: plain numbers in kernel units.
// docs/methods.md 1.
#pragma once
#include "kernels_cpu/phase.h"
#include "src/io/volume.h"
#include "src/scene/scene.h"
#include "src/stages/prepared.h"

namespace pileus {

struct Medium {
    Volume volume;
    Grid grid;
    Double3 low_m{};     ///< low corner of the box in the world; the origin of box-local metres
    double extent_m[3];  ///< box edges
    float sigma = 0;     ///< extinction at density 1, 1/m
    Float3 albedo{1, 1, 1};
    float albedo_max = 1;
    int channels = 1;  ///< 1: achromatic
    PhaseParams phase{};
    float density_max = 0;
};

/// Reads or makes the density and places it. A file that holds extinction becomes densities up to 1
/// (value over largest value) with sigma = extinction_scale times the largest value. Errors: those
/// of the readers; kBadInput for a file that does not know its place while `bounds_m` is left out.
Status load_medium(const Scene& scene, const MediumSettings& settings, int threads, Medium& out);

}  // namespace pileus
