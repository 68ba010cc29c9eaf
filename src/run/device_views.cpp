// SPDX-License-Identifier: Apache-2.0
// See device_views.h. How long an array is follows from its view.
// in: views -> out: copies.
// docs/crosscheck.md
#include "src/run/device_views.h"

namespace pileus {
namespace {

using Size = DeviceSize;

/// The tree is stored as it is walked: what lies behind all others is the second of two nodes on
/// every level.
Size nodes_of(const SolidsView& solids) {
    std::int32_t last = 0;
    while (solids.nodes[last].count <= 0) last = solids.nodes[last].next;
    return Size(last) + 1;
}

/// The highest row of an array that triangles name.
Size last_row(const SolidsView& solids, std::int32_t SolidTriangle::*row) {
    std::int32_t most = 0;
    for (std::int32_t i = 0; i < solids.count; ++i)
        if (solids.triangles[i].*row > most) most = solids.triangles[i].*row;
    return Size(most);
}

void add_noise(DeviceArrays& a, NoiseView& noise) {
    a.in(noise.words, Size(noise_words(noise.size)));
    // A byte a block, four of them a word.
    a.in(noise.largest, Size(noise_words(noise_blocks(noise.size)) + 3) / 4);
}

}  // namespace

void add_grid(DeviceArrays& a, TrackGrid& grid) {
    a.in(grid.density, product(grid.size));
    a.in(grid.majorant, product(grid.blocks));
}

void add_medium(DeviceArrays& a, MediumView& medium) {
    a.in(medium.density, product(medium.size));
    a.in(medium.majorant, product(medium.blocks));
    if (medium.detail == nullptr) return;
    DetailView detail = *medium.detail;
    const Size edge = Size(detail.cells) + 1;
    a.in(detail.tile, edge * edge * edge);
    medium.detail = &detail;
    a.in(medium.detail, 1);
}

void add_box(MediumView& medium) {
    medium.density = medium.majorant = nullptr;
    medium.detail = nullptr;
}

void add_sky(DeviceArrays& a, SkyMapView& map) {
    const Size rows = Size(map.rows), columns = Size(map.columns);
    a.in(map.radiance, Size(map.planes) * rows * columns);
    a.in(map.row_cdf, rows);
    a.in(map.column_cdf, rows * columns);
    a.in(map.row_bound, 2 * rows);
    a.in(map.column_bound, 2 * columns);
}

void add_heights(DeviceArrays& a, SunHeights& heights) {
    a.in(heights.depth, 3 * Size(heights.rows));
}

void add_solids(DeviceArrays& a, SolidsView& solids) {
    if (solids.count <= 0) {
        solids = SolidsView{};
        return;
    }
    const Size nodes = nodes_of(solids);
    const Size colours = last_row(solids, &SolidTriangle::colour) + 1;
    const Size smooth = last_row(solids, &SolidTriangle::smooth);
    a.in(solids.nodes, nodes);
    a.in(solids.triangles, Size(solids.count));
    a.in(solids.albedo, 3 * colours);
    a.in(solids.normals, solids.normals != nullptr ? 9 * smooth : 0);
}

void add_paint(DeviceArrays& a, GroundPaint& paint) {
    a.in(paint.map.albedo, Size(paint.map.planes) * Size(paint.map.texels));
    a.in(paint.sea, 1);
    add_sky(a, paint.sky);
}

void add_background(DeviceArrays& a, BackgroundParams& k, BackgroundBuffers& b) {
    add_medium(a, k.medium);
    add_sky(a, k.sky_map);
    add_paint(a, k.paint);
    a.in(b.map, 3 * product(k.map.size));
    a.in(b.ground_depth, k.shadow.size[0] > 0 ? product(k.shadow.size) : 0);
    a.both(b.colour, 3 * pixels_in(k.camera));
    a.both(b.opaque_depth, pixels_in(k.camera));
    a.both(b.shadow, pixels_in(k.camera));
    a.in(b.around.number, b.around.count > 0 ? product(b.around.nodes.size) : 0);
    a.in(b.around.light, 3 * Size(kAroundTerms) * Size(b.around.count));
}

void add_layer(DeviceArrays& a, SkyParams& sky) {
    add_noise(a, sky.perlin);
    add_noise(a, sky.worley);
}

}  // namespace pileus
