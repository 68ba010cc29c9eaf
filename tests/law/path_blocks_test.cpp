// SPDX-License-Identifier: Apache-2.0
// The path tracer's grid of bounds: leaps clear nothing but empty blocks, and are as long as can
// be. in: random sparse grids -> out: every entry against a search through all blocks.
// docs/path.md, "Flight"
#include "src/methods/path/path_blocks.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>

#include "kernels_cpu/core/rng.h"
#include "kernels_cpu/media/flight.h"

namespace {

using namespace pileus;

struct Blocks {
    std::int32_t counts[3];
    Buffer<float> majorants;

    std::size_t index(int x, int y, int z) const {
        return (std::size_t(z) * std::size_t(counts[1]) + std::size_t(y)) * std::size_t(counts[0]) +
               std::size_t(x);
    }
    /// Blocks from (x, y, z) to the nearest that holds medium, the longest axis counted; 32 or more
    /// count as 32.
    int distance(int x, int y, int z) const {
        int least = 32;
        for (int k = 0; k < counts[2]; ++k)
            for (int j = 0; j < counts[1]; ++j)
                for (int i = 0; i < counts[0]; ++i)
                    if (majorants[index(i, j, k)] > 0)
                        least = std::min(
                            least, std::max({std::abs(i - x), std::abs(j - y), std::abs(k - z)}));
        return least;
    }
};

Blocks sparse(int nx, int ny, int nz, float share, std::uint32_t seed) {
    Blocks b{{nx, ny, nz}, {}};
    REQUIRE(b.majorants.resize(std::uint64_t(nx) * std::uint64_t(ny) * std::uint64_t(nz), "test"));
    for (std::size_t i = 0; i < b.majorants.size(); ++i) {
        const Words<std::uint32_t> w = threefry(seed, 1u, std::uint32_t(i), 0u);
        b.majorants[i] = uniform(w.a) < share ? 0.25f + uniform(w.b) : 0.0f;
    }
    return b;
}

TEST_CASE("leaps are as long as the emptiness around a block, and end at the ring") {
    const Blocks cases[] = {sparse(9, 7, 5, 0.02f, 1), sparse(16, 3, 12, 0.1f, 2),
                            sparse(1, 1, 1, 0.0f, 3), sparse(70, 2, 1, 0.008f, 4),
                            sparse(6, 6, 6, 1.1f, 5)};
    for (const Blocks& b : cases)
        for (int threads : {1, 3}) {
            Buffer<float> out;
            REQUIRE(path_blocks(b.majorants.span(), b.counts, threads, out));
            std::size_t at = 0;
            for (int z = -1; z <= b.counts[2]; ++z)
                for (int y = -1; y <= b.counts[1]; ++y)
                    for (int x = -1; x <= b.counts[0]; ++x, ++at) {
                        const bool in = x >= 0 && y >= 0 && z >= 0 && x < b.counts[0] &&
                                        y < b.counts[1] && z < b.counts[2];
                        const float bound = in ? b.majorants[b.index(x, y, z)] : kBoundOut;
                        const float leap =
                            in && !(bound > 0) ? float(1 - b.distance(x, y, z)) : bound;
                        CHECK(out[at] == leap);
                    }
            CHECK(at == out.size());
        }
}

}  // namespace
