// SPDX-License-Identifier: Apache-2.0
// See path_blocks.h.
// in: majorants -> out: the same in a ring, empty blocks marked.
// docs/path.md, "Flight"
#include "src/methods/path/path_blocks.h"

#include "kernels_cpu/media/flight.h"
#include "src/world/majorant/majorant.h"

namespace pileus {
namespace {

/// The grid with its ring, along each axis.
struct Ringed {
    int size[3];
    explicit Ringed(const std::int32_t counts[3]) {
        for (int a = 0; a < 3; ++a) size[a] = counts[a] + 2;
    }
    std::uint64_t total() const {
        return std::uint64_t(size[0]) * std::uint64_t(size[1]) * std::uint64_t(size[2]);
    }
};

Array<float> ringed_blocks(const Ringed& g) {
    return {"blocks that flights cross", g.total(), Stage::kPaths, Stage::kPaths};
}

}  // namespace

Array<float> arrays::path_blocks(const Grid& grid, int block) {
    std::int32_t counts[3];
    block_counts(grid, block, counts);
    return ringed_blocks(Ringed(counts));
}

Status path_blocks(Span<const float> majorants, const std::int32_t counts[3], int threads,
                   Buffer<float>& out) {
    const Ringed g(counts);
    PILEUS_TRY(allocate(ringed_blocks(g), out));
    const std::size_t nx = std::size_t(g.size[0]), ny = std::size_t(g.size[1]);
    const std::size_t nz = std::size_t(g.size[2]);
    std::size_t from = 0;
    for (std::size_t z = 1; z + 1 < nz; ++z)
        for (std::size_t y = 1; y + 1 < ny; ++y)
            for (std::size_t x = 1; x + 1 < nx; ++x) out[(z * ny + y) * nx + x] = majorants[from++];
    mark_empty_blocks(out.span(), g.size, threads);
    // The ring may be leapt over, but not stood in.
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::size_t x = i % nx, y = i / nx % ny, z = i / (nx * ny);
        if (x == 0 || y == 0 || z == 0 || x + 1 == nx || y + 1 == ny || z + 1 == nz)
            out[i] = kBoundOut;
    }
    return Status::ok();
}

}  // namespace pileus
