// SPDX-License-Identifier: Apache-2.0
// The uniform shapes: a box, and the sphere or ellipsoid inscribed in it.
// in: a resolution -> out: densities 0..1, partly covered cells by their share.
// docs/scene.md, "uniform:box|sphere|ellipsoid".
#pragma once
#include <array>

#include "src/base/status.h"
#include "src/io/volumes/volume.h"

namespace pileus {

/// Fill `volume` with density 1 everywhere, or inside the ellipsoid that touches all six faces of
/// the box; the mean of that tends to pi/6, within 1e-3 from 16 cells on. Errors: kLimit when
/// memory runs out.
Status make_box(const std::array<int, 3>& resolution, Volume& volume);
Status make_ellipsoid(const std::array<int, 3>& resolution, Volume& volume);

}  // namespace pileus
