// SPDX-License-Identifier: Apache-2.0
// Spheres as the camera sees them: order, rectangle on the screen, list for each tile.
// in: checked spheres in the box's metres -> out: BlendSphere front to back, lists of places.
// docs/methods.md 3, each image frame, step 5.
#pragma once
#include "src/methods/collectors/billboards/composite_billboards.h"

namespace pileus {

/// Lists as BlendBuffers wants them.
struct BillboardLists {
    Buffer<BlendSphere> spheres;  ///< as numbered in the scene
    Buffer<std::uint32_t> order;  ///< their places, front to back
    Buffer<std::uint64_t> tile_begin;
    Buffer<std::uint32_t> tile_spheres;
};

/// Fills `lists.spheres`, and `lists.order` by distance of the centre (along the view when
/// orthographic) and then by index. kLimit: no memory.
Status project_billboards(const BillboardScene& scene, const CameraParams& camera, int threads,
                          BillboardLists& lists);

/// Fills the lists of the tiles with places in `lists.spheres`, front to back. kLimit: no memory.
Status bin_billboards(const BlendParams& params, std::uint32_t tiles, BillboardLists& lists);

}  // namespace pileus
