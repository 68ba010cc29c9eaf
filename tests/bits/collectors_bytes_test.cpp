// SPDX-License-Identifier: Apache-2.0
// Every array of method collectors by its definition, scratch too, which a run holds at no end.
// in: sizes -> out: bytes of each row of the table.
// docs/report.md, "Memory"
#include <doctest/doctest.h>

#include <map>

#include "src/methods/collectors/billboards/billboard_spheres.h"
#include "src/methods/collectors/collectors_memory.h"
#include "src/methods/collectors/prepare/leaves.h"

using namespace pileus;

namespace {

using Bytes = std::map<std::string, std::uint64_t>;

}  // namespace

TEST_CASE("arrays: the bytes of collectors by their definition, those of scratch, too") {
    CollectorsSizes s;
    s.grid.size[0] = 5, s.grid.size[1] = 7, s.grid.size[2] = 11;
    s.threads = 3, s.media = 2, s.prepared.samples = 100, s.prepared.leaves = 40,
    s.prepared.collectors = 30;
    s.prepared.variance = s.prepared.rejection = s.prepared.paper = true;
    s.picture.marched = false, s.picture.width = 20, s.picture.height = 10;
    s.photons.channels = 3, s.photons.coefficients = 16, s.photons.lights = 2, s.photons.slots = 4,
    s.photons.ground_cells = 9;
    s.prepared.tracking_blocks = 6, s.nodes.shadow_nodes = 13;
    const MemoryTable table = collectors_memory(s);
    Bytes planned;
    for (const MemoryRow& row : table.rows()) planned[row.item] += row.bytes;
    const std::uint64_t voxels = 5 * 7 * 11;
    CHECK(planned["density"] == 4 * voxels);
    CHECK(planned["parts of the media"] == 4 * voxels);
    CHECK(planned["gradient field"] == 4 * voxels);
    // Two sums of 64 bits: per voxel, and for each thread of a slice and a row.
    CHECK(planned["sums of the variance"] == 16 * (voxels + 3 * (5 * 7 + 5)));
    CHECK(planned["samples"] == 16 * 100);
    CHECK(planned["samples being drawn"] == (16 + 4) * 100);
    // Per axis a coordinate, an index and two keys; a density, scratch and a side.
    CHECK(planned["sorted lists of samples"] == (3 * (4 + 4 + 2 * 8) + 4 + 4 + 1) * 100);
    CHECK(planned["growing list of leaves"] == sizeof(Leaf) * (2 * 40 + 1024));
    CHECK(planned["stack of the tree"] == 32 * (5 + 7 + 11 + 2));
    CHECK(planned["leaves"] == sizeof(Leaf) * 40);
    CHECK(planned["collectors"] == sizeof(Collector) * 30);
    CHECK(planned["collector of voxel"] == 4 * voxels);
    CHECK(planned["photon map"] == 8 * 2 * 4 * 3 * (30 * 16 + 9));
    CHECK(planned["photon tallies per thread"] == 2 * 3 * sizeof(TraceTally));
    CHECK(planned["ground map"] == 4 * 3 * 9);
    CHECK(planned["shadow"] == 4 * 13);
    CHECK(planned["majorants"] == 4 * 6);
    CHECK(planned["moments of leaves"] == sizeof(LeafMoments) * 40 + 8 * 5 * 3);
    CHECK(planned["voxel masses of a part"] == 8 * voxels);
    CHECK(planned["shares of the media"] == 4 * 2 * 30);
    CHECK(planned["centroids of samples"] == 32 * 40);
    CHECK(planned["collector colours"] == 4 * 3 * 30);
    CHECK(planned["picture planes"] == 4 * (3 + 1 + 3) * 20 * 10);
    CHECK(planned["rows of the majorants"] == 4 * 3 * (5 * 7 + 5));
    CHECK(planned["blocks to skip"] == 4 * (2 * 2 * 3));
    CHECK(planned["billboards"] == (5 * 4 + sizeof(BlendSphere) + 4 + 2 * 8) * 30);
}
