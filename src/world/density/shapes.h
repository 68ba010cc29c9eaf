// SPDX-License-Identifier: Apache-2.0
// The uniform shapes: a box, and the sphere or ellipsoid inscribed in it.
// in: a kind, a resolution -> out: densities 0..1, partly covered cells by their share.
// docs/scene.md, "uniform:box|sphere|ellipsoid".
#pragma once
#include <array>

#include "src/base/status.h"
#include "src/io/volumes/volume.h"
#include "src/scene/scene.h"

namespace pileus {

/// What a resolution of {0, 0, 0} stands for.
std::array<int, 3> default_shape_size(DensityKind kind);

/// Share of its box that an ellipsoid fills.
constexpr double kEllipsoidMean = 3.14159265358979323846 / 6;

/// Fills `volume` with the shape that touches all six faces of the box; a resolution of {0, 0, 0}
/// stands for one cell (box) or 64 x 64 x 64. The sphere is the ellipsoid: it is round in metres
/// when the box is a cube. The mean of either tends to pi/6; within 1e-3 from 16 cells on.
/// Errors: kBadInput for a kind that isn't uniform or a resolution outside 1..4096; kLimit when
/// memory runs out.
Status make_shape(DensityKind kind, std::array<int, 3> resolution, Volume& volume);

}  // namespace pileus
