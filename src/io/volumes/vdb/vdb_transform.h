// SPDX-License-Identifier: Apache-2.0
// How a grid's indices become places: axes that are scaled, moved, exchanged and mirrored.
// in: the matrix of a file -> out: for each axis of indices the axis of the world and its step.
// docs/formats.md, "OpenVDB"
#pragma once
#include <array>

#include "src/io/text/byte_cursor.h"

namespace pileus {

/// Index axis a runs along world[a] in steps of scale[a] metres, backwards where it is negative.
struct VdbTransform {
    std::array<double, 3> scale{1, 1, 1};
    std::array<double, 3> translation{0, 0, 0};  ///< of the centre of voxel 0 0 0, world axes
    std::array<int, 3> world{0, 1, 2};

    bool is_straight() const {
        return world == std::array<int, 3>{0, 1, 2} && scale[0] > 0 && scale[1] > 0 && scale[2] > 0;
    }
    /// "axes y z -x" for the axes of the world that those of indices run along.
    std::string axes_text() const;
};

/// Row a of `matrix` is the step in metres of index axis a. kBadInput where it has parts along
/// several axes: turned by other than quarters, or sheared.
Status set_vdb_axes(const ByteCursor& in, const std::array<std::array<double, 3>, 3>& matrix,
                    VdbTransform& transform);

/// Refuses a scale or a translation of no use.
Status check_vdb_transform(const ByteCursor& in, const VdbTransform& transform);

}  // namespace pileus
