// SPDX-License-Identifier: Apache-2.0
// The bytes of each array, written beside the stage that allocates it.
// in: see collectors_memory.h -> out: rows.
// docs/report.md, "Memory".
#include "src/methods/collectors/collectors_memory.h"

#include "kernels_cpu/display/blend_params.h"
#include "src/methods/collectors/prepare/leaves.h"

namespace pileus {
namespace {

using Size = std::uint64_t;
constexpr Size kFloat = sizeof(float);

Size voxels_of(const CollectorsSizes& s) { return voxel_count(s.grid); }

Size side(const CollectorsSizes& s, int axis) { return Size(s.grid.size[axis]); }

/// stages/prepare.cpp draw_samples and what it calls.
void add_samples(const CollectorsSizes& s, MemoryTable& t) {
    if (s.cells) return;
    const Size slice = side(s, 0) * side(s, 1);
    t.add("gradient field", Stage::kSamples, Stage::kSamples, bytes_of(voxels_of(s), kFloat));
    if (s.variance)
        t.add("sums of the variance", Stage::kSamples, Stage::kSamples,
              bytes_of(16, voxels_of(s) + (slice + side(s, 0)) * s.threads));
    t.add(
        "cumulative sums", Stage::kSamples, Stage::kSamples,
        8 * (side(s, 1) * side(s, 2) + 1) + kFloat * side(s, 0) + sizeof(FieldStats) * side(s, 2));
    if (s.rejection)
        t.add("samples being drawn", Stage::kSamples, Stage::kSamples,
              s.samples * (sizeof(Sample) + 4));
    t.add("samples", Stage::kSamples, Stage::kLeafGrid, s.samples * sizeof(Sample));
}

/// stages/prepare_tree.cpp: three lists sorted by two arrays of keys of 8 bytes, and a list of
/// leaves that grows by doubling.
void add_tree(const CollectorsSizes& s, MemoryTable& t) {
    const Size leaves = bytes_of(s.leaves, sizeof(Leaf));
    t.add("leaves", Stage::kTree, Stage::kWrite, leaves);
    if (s.cells) return;
    constexpr Size kNode = sizeof(std::int32_t) * 6 + sizeof(std::uint32_t) * 2;
    t.add("sorted lists of samples", Stage::kTree, Stage::kTree,
          s.samples * (3 * (4 + 4 + 2 * 8) + 4 + 4 + 1));
    t.add("growing list of leaves", Stage::kTree, Stage::kTree,
          bytes_of(2 * s.leaves + 1024, sizeof(Leaf)));
    t.add("stack of the tree", Stage::kTree, Stage::kTree,
          kNode * (side(s, 0) + side(s, 1) + side(s, 2) + 2));
}

/// stages/prepare.cpp finish_leaves, stages/prepare_majorant.cpp.
void add_collectors(const CollectorsSizes& s, MemoryTable& t) {
    const Size voxels = voxels_of(s);
    const Stage traced = s.shoots_again ? Stage::kWrite : Stage::kPhotons;
    t.add("moments of leaves", Stage::kCollectors, Stage::kLeafGrid,
          bytes_of(s.leaves, sizeof(LeafMoments)) + bytes_of(side(s, 0), s.threads, 8));
    t.add("collector of voxel", Stage::kLeafGrid, traced, bytes_of(voxels, 4));
    t.add("collectors", Stage::kCollectors, Stage::kWrite,
          bytes_of(s.collectors, sizeof(Collector)));
    if (s.media > 1) {
        t.add("voxel masses of a part", Stage::kLeafGrid, Stage::kLeafGrid, bytes_of(voxels, 8));
        t.add("shares of the media", Stage::kLeafGrid, Stage::kWrite,
              bytes_of(s.collectors, s.media, kFloat));
    }
    if (s.paper)
        t.add("centroids of samples", Stage::kLeafGrid, Stage::kLeafGrid,
              bytes_of(s.leaves, 4 * sizeof(double)));
    add_majorant_rows(s.grid, s.tracking_blocks, s.threads, traced, t);
}

/// Bytes of the sums of one light.
Size sums_of_light(const CollectorsSizes& s) {
    return bytes_of(
        bytes_of(s.collectors, s.channels, s.coefficients) + s.ground_cells * s.channels,
        sizeof(std::int64_t));
}

/// stages/trace.cpp: sums per light and slot, and each thread's own where they do not share.
void add_photons(const CollectorsSizes& s, MemoryTable& t) {
    const Stage traced = s.shoots_again ? Stage::kWrite : Stage::kPhotons;
    t.add("photon map", Stage::kPhotons, Stage::kWrite,
          bytes_of(sums_of_light(s), s.lights, s.slots));
    t.add("photon tallies per thread", Stage::kPhotons, traced,
          bytes_of(2 * sizeof(TraceTally), s.threads));
    t.add("photon sums per thread", Stage::kPhotons, traced, s.private_sums);
}

/// methods/collectors_show.cpp, up to the display.
void add_light(const CollectorsSizes& s, MemoryTable& t) {
    const Size pixels = s.width * s.height;
    const Size source = s.harmonics > 0 ? s.harmonics : s.planes;
    t.add("collector colours", Stage::kReconstruct, Stage::kLayers,
          bytes_of(kFloat * source, s.collectors));
    // Colours with their batches, transmittance, background; depths where something asks for them.
    const Size planes = s.planes + 4 + (s.ground ? 1u : 0u) + (s.depth ? 1u : 0u) + s.extra_planes;
    t.add("picture planes", Stage::kBackground, Stage::kLayers, bytes_of(kFloat * planes, pixels));
    if (s.extra_planes > 0)
        t.add("planes of a part", Stage::kDisplay, Stage::kDisplay,
              bytes_of(kFloat * ((s.parts ? 7u : 1u) + (s.ground ? 1u : 0u)), pixels));
    if (s.parts)
        t.add("colours of a part", Stage::kDisplay, Stage::kDisplay,
              bytes_of(3 * kFloat, s.collectors));
    t.add("ground map", Stage::kBackground, Stage::kBackground, 3 * kFloat * s.ground_cells);
    if (s.planes > 3 && s.ground_cells > 0)
        t.add("ground light of a batch", Stage::kLayers, Stage::kLayers,
              bytes_of(3 * kFloat, pixels) + 3 * kFloat * s.ground_cells);
    t.add("shadow", s.shoots_again ? Stage::kPhotons : Stage::kShadow, Stage::kWrite,
          kFloat * s.shadow_nodes);
    if (s.marched) {
        t.add("source grid", Stage::kSplat, Stage::kDisplay,
              bytes_of(kFloat * source, s.source_nodes));
        t.add("source by node", Stage::kSplat, Stage::kDisplay, kFloat * s.numbers_by_node);
        t.add("source weights", Stage::kSplat, Stage::kSplat, kFloat * s.source_nodes);
    }
}

/// stages/composite_billboards.cpp: no tile is smaller than 256 by one row, or than the picture.
void add_billboards(const CollectorsSizes& s, MemoryTable& t) {
    if (s.marched) return;
    const Size wide = s.width < 256 ? s.width : 256;
    Size high = (Size{1} << 17) / ((Size(kBlendPlanes) + s.planes) * wide);
    high = high < 1 ? 1 : (high > 32 ? 32 : high);
    if (high > s.height) high = s.height;
    const Size tiles = ((s.width + wide - 1) / wide) * ((s.height + high - 1) / high);
    t.add("billboards", Stage::kDisplay, Stage::kDisplay,
          bytes_of(s.collectors, 5 * kFloat + sizeof(BlendSphere) + 4 + 16));
    t.add("billboards of tiles", Stage::kDisplay, Stage::kDisplay,
          bytes_of(s.collectors, tiles, 4) + 16 * (tiles + 1));
    const Size row = (wide + 15) / 16 * 16;
    t.add(
        "planes of tiles", Stage::kDisplay, Stage::kDisplay,
        bytes_of(kFloat * s.threads,
                 row * (high * (Size(kBlendPlanes) + s.planes) + 1 + 2 * kBlendBlock) + high + 16));
}

}  // namespace

std::uint64_t bytes_of_sums(const CollectorsSizes& s) { return sums_of_light(s) + 256; }

MemoryTable collectors_memory(const CollectorsSizes& sizes) {
    MemoryTable table;
    add_density_rows(sizes.grid, sizes.source, sizes.media, sizes.phases, sizes.threads, sizes.sky,
                     table);
    add_samples(sizes, table);
    add_tree(sizes, table);
    add_collectors(sizes, table);
    add_photons(sizes, table);
    add_light(sizes, table);
    add_billboards(sizes, table);
    add_image_rows(sizes.width, sizes.height, sizes.layers, table);
    return table;
}

}  // namespace pileus
