// SPDX-License-Identifier: Apache-2.0
// Spheres as the camera sees them: order, rectangle on the screen, list for each tile.
// in: checked spheres in the box's metres -> out: BlendSphere front to back, lists of places.
// docs/methods.md 3, each image frame, step 5.
#pragma once
#include "src/methods/collectors/billboards/composite_billboards.h"
#include "src/plan/array.h"

namespace pileus {

/// Lists as BlendBuffers wants them.
struct BillboardLists {
    Buffer<BlendSphere> spheres;  ///< as numbered in the scene
    Buffer<std::uint32_t> order;  ///< their places, front to back
    Buffer<std::uint64_t> tile_begin;
    Buffer<std::uint32_t> tile_spheres;
};

/// A billboard's distance, as bits that sort, and its place in the scene.
struct BillboardDistance {
    std::uint32_t key, place;
};

namespace arrays {

template <class T>
Array<T> billboards(std::uint64_t count) {
    return {"billboards", count, Stage::kDisplay, Stage::kDisplay};
}
/// Centre, radius and extinction, one after the other.
inline Array<float> billboard_numbers(std::uint64_t count) {
    return billboards<float>(bytes_of(5, count));
}
inline Array<BlendSphere> billboard_spheres(std::uint64_t count) {
    return billboards<BlendSphere>(count);
}
/// Two: the sort moves from one to the other.
inline Array<BillboardDistance> billboard_distances(std::uint64_t count) {
    return billboards<BillboardDistance>(count);
}
inline Array<std::uint32_t> billboard_order(std::uint64_t count) {
    return billboards<std::uint32_t>(count);
}
/// Of all tiles together; as many as there are, known only while they are listed.
inline Array<std::uint32_t> billboards_of_tiles(std::uint64_t count) {
    return {"billboards of tiles", count, Stage::kDisplay, Stage::kDisplay};
}
/// Where each tile's list begins, and where it goes on while it is filled.
inline Array<std::uint64_t> tile_begin(std::uint64_t tiles) {
    return {"billboards of tiles", tiles + 1, Stage::kDisplay, Stage::kDisplay};
}

}  // namespace arrays

/// Fills `lists.spheres`, and `lists.order` by distance of the centre (along the view when
/// orthographic) and then by index. kLimit: no memory.
Status project_billboards(const BillboardScene& scene, const CameraParams& camera, int threads,
                          BillboardLists& lists);

/// Fills the lists of the tiles with places in `lists.spheres`, front to back. kLimit: no memory.
Status bin_billboards(const BlendParams& params, std::uint32_t tiles, BillboardLists& lists);

}  // namespace pileus
