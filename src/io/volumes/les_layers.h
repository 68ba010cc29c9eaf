// SPDX-License-Identifier: Apache-2.0
// Equal layers for a grid whose levels stand at heights of their own.
// in: heights of cell centres -> out: a stack of equal layers, and values laid onto it.
// docs/formats.md
#pragma once
#include <vector>

#include "src/io/volumes/volume.h"

namespace pileus {

/// Levels this near to an even ladder, as a share of its step, are taken as even: printed heights
/// are rounded, 0.5 m of a 25 m step in published grids, and 1/20 of a cell moves no cloud.
constexpr double kEvenLevels = 0.05;

/// Layers between faces[i] and faces[i + 1] in metres, upwards, and the equal ones that replace
/// them.
struct LayerStack {
    std::vector<double> faces_m;  ///< of the file's layers, one more than layers
    int layers = 0;               ///< equal layers between the first and the last face
    bool even = true;             ///< the file's layers are equal already

    double step_m() const { return (faces_m.back() - faces_m.front()) / layers; }
};

/// Even levels: faces of the least-squares ladder through them, half a step below the first and
/// above the last. Others: faces midway between levels, the outer ones mirrored, and as many equal
/// layers as the thinnest asks for. At least two levels, ascending. `layers` may exceed any limit:
/// up to 2^30.
LayerStack stack_of_levels(const std::vector<double>& levels_m);

/// Lays volume.density (size[2] file layers) onto the stack's equal layers: each takes of every
/// file layer the share that overlaps, so that a column's sum of value times thickness stays. Out
/// of memory: kLimit.
Status lay_on_even_layers(const LayerStack& stack, Volume& volume);

}  // namespace pileus
