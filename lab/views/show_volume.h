// SPDX-License-Identifier: Apache-2.0
// Fields on a grid as a picture: X-rays, largest values, leaves as solid translucent boxes.
// in: one number per voxel or leaf, a camera -> out: planes of pixels, or a canvas painted over.
// docs/how-it-works.md; Elek 2011, figures 5.1 and 5.6.
#pragma once
#include "lab/views/canvas.h"
#include "src/methods/collectors/prepare/prepared.h"
#include "src/world/grid/grid.h"

namespace pileus {

/// What the rays through the pixel centres meet of a field, voxel by voxel without interpolation.
struct FieldView {
    Buffer<float> largest;   ///< [pixel], unit of the field
    Buffer<float> integral;  ///< [pixel], unit of the field times metres
};

/// `field` holds one number per voxel, >= 0. kLimit: no memory.
Status look_through(Span<const float> field, const Grid& grid, const CameraParams& camera,
                    int threads, FieldView& out);

/// The plane across the view through the middle of the grid's box: points x with
/// normal . x = offset, metres; what lies in front of it has less.
struct MiddlePlane {
    double normal[3];
    double offset;
};
MiddlePlane middle_plane(const Grid& grid, const CameraParams& camera);

/// The field where the rays meet the middle plane, trilinear; 0 outside the box. kLimit: no memory.
Status look_at_plane(Span<const float> field, const Grid& grid, const CameraParams& camera,
                     int threads, Buffer<float>& values);

/// Veils the canvas in `colour` with alpha = 1 - exp(-per_unit * integral).
void paint_veil(Span<const float> integral, float per_unit, const Float3& colour, int threads,
                Canvas& canvas);

/// Colours every pixel that has a value by its share of `full`.
void paint_heat(Span<const float> values, float full, int threads, Canvas& canvas);

struct LeafBoxes {
    Span<const Leaf> leaves;
    Span<const Collector> collectors;
    Span<const std::int32_t> collector_of_voxel;  ///< -1 where there is nothing
    float sigma = 0;                              ///< shown extinction at density 1, 1/m
    float full = 1;                               ///< mean density of the brightest colour
};

/// Leaves as boxes of constant extinction, from the middle plane on backwards, coloured by their
/// mean density; faces are shaded by their axis and darkened along their edges.
void paint_leaf_boxes(const LeafBoxes& boxes, const Grid& grid, const CameraParams& camera,
                      int threads, Canvas& canvas);

}  // namespace pileus
