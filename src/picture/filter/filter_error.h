// SPDX-License-Identifier: Apache-2.0
// The error of a filtered picture, smoothed: differences of parts and whole are noise themselves.
// in: squares of pixels and channels -> out: the root of their mean around.
// docs/filter.md, "The error of a filtered picture"
#pragma once
#include "src/base/buffer.h"
#include "src/picture/errors/pixel_errors.h"
#include "src/plan/array.h"

namespace pileus {

namespace arrays {

/// Squares and numbers of pixels, of tiles.
Array<double> error_tiles(int width, int height);

}  // namespace arrays

/// In place of a square: the pixel is not filtered, and says nothing of those that are.
constexpr float kNotFiltered = -1;

/// `error`, [3][pixel]: each square becomes the root of the mean over those of its group in its
/// tile of 8 x 8 pixels and the eight around, 0 where none is filtered. kLimit: out of memory.
Status smooth_error(int threads, const PixelGroups& groups, Buffer<float>& error);

}  // namespace pileus
