// SPDX-License-Identifier: Apache-2.0
// Pictures of which few pixels are marched, and sums of light: what several methods share.
// in: keys of the methods -> out: plain values. docs/scene.md
#pragma once

namespace pileus {

/// Who adds to which sums: see src/plan/accumulation.h.
enum class AccumulationChoice { kAuto, kPrivate, kShared };

/// Who blends billboards: pileus itself, or OpenGL by a foreign library for comparison.
enum class Compositor { kBuiltin, kOsmesa, kEgl };

enum class UpsampleKind { kDepth, kLinear, kNearest };

/// Few pixels are marched, the others filled in.
struct UpsampleSettings {
    int scale = 1;     ///< one pixel of so many along x and y is marched: 1, 2 or 4
    int temporal = 0;  ///< 2 or 4: the same, another one each frame, the rest from the frame before
    UpsampleKind upsample = UpsampleKind::kDepth;

    /// Marched pixels lie so far apart.
    int every() const { return temporal > 0 ? temporal : scale; }
};

/// Directions in which nodes keep their light: along the line to the camera; around it each ray's
/// own, too; or all.
enum class NodeDirections { kNear, kCamera, kAll };

}  // namespace pileus
