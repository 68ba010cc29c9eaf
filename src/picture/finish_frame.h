// SPDX-License-Identifier: Apache-2.0
// The one tail of every method: planes -> layers -> image, and what the report tells of both.
// in: planes of a picture, what it shows -> out: Image, Report; the planes are given back.
// docs/formats.md, "Pictures out"; docs/report.md
#pragma once
#include "src/picture/layers.h"
#include "src/run/context.h"
#include "src/world/world.h"

namespace pileus {

/// Layers, camera and the counts of numbers that were none or below 0, in place of the counts of
/// the picture before. kLimit: out of memory.
Status finish_layers(const OutputSettings& output, const CameraParams& camera, const Double3& low_m,
                     const Planes& planes, Image& image, Report& report);

/// What of a method's picture the report tells.
struct FinishedParts {
    bool colours = false;  ///< a digest of the planes' colours
    bool batches = false;  ///< the light has parts to tell an error by
    bool media = true;     ///< media are told apart on the grid
    double cell_m = 0;     ///< shortest edge of the cells that hold scattered light; 0: none do
    bool wide = false;     ///< light of narrow phase functions is kept in wider angles
    int film = 0;          ///< parts of the light that a film tells apart; 0: no film
};

/// The same for a method's picture, with what was executed for it and the world's solids. `planes`
/// are empty afterwards.
Status finish_frame(const Context& context, const OutputSettings& output, const World& world,
                    const CameraDepth& depth, const CameraParams& camera,
                    const FinishedParts& parts, Planes& planes, Image& image, Report& report);

}  // namespace pileus
