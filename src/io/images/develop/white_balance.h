// SPDX-License-Identifier: Apache-2.0
// White balance: light of a colour temperature becomes the white of a display.
// in: kelvins -> out: a matrix for linear sRGB.
// docs/exposure.md, "White balance"
#pragma once

#include <array>

namespace pileus {

using ColorMatrix = std::array<std::array<double, 3>, 3>;

constexpr double kMinWhite = 2000, kMaxWhite = 25000;  // K

/// CIE 1931 x and y of light of this temperature: black bodies up to 4000 K (Kang et al. 2002),
/// daylight from 5000 K on (CIE 15), between them mixed by the reciprocal of the temperature.
std::array<double, 2> white_place(double kelvin);

/// Bradford's adaptation (Lam 1985) from that white to D65, for linear sRGB; luminance of the white
/// stays. `kelvin` within [kMinWhite, kMaxWhite].
ColorMatrix white_matrix(double kelvin);

}  // namespace pileus
