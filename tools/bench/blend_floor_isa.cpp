// SPDX-License-Identifier: Apache-2.0
// Compiled once per instruction set, with the definitions and flags of kernels_cpu/isa/isa.cpp.
// in: BlendFloorWork -> out: one pixel's colour, which depends on every layer it took.
// Per W pixels: 5 loads, 4 stores, 16 multiplications, 15 additions and a root, all lanes full, in
// one pass over the rows of a tile and again; then the picture's floats, past the caches.
#include "kernels_cpu/display/blend_layer.h"
#include "tools/bench/blend_floor.h"

namespace bench {
namespace {

using namespace pileus;

constexpr int W = PILEUS_WIDTH;

/// One layer over W pixels with two doublings, thin, so that nothing ever gets too small to count.
void blend_vector(float* tile, std::uint64_t at, F<W> dx) {
    using T = F<W>;
    float* plane[kFloorPlanes];
    for (std::uint64_t k = 0; k < kFloorPlanes; ++k) plane[k] = tile + k * kFloorTile + at;
    const T before = blend_load<T>(plane[0]);
    const T q = 1.0f - 1e-6f * dx * dx;
    const T depth = sqrt_(q) * (blend_load<T>(plane[1]) * 1e-6f);
    const T taken = before * layer_share(depth, 2);
    blend_store(plane[0], before - taken);
    for (std::uint64_t k = 2; k < kFloorPlanes; ++k)
        blend_store(plane[k], blend_load<T>(plane[k]) + taken * 0.5f);
}

float run_floor(const BlendFloorWork& work) {
    for (std::uint64_t i = 0; i < 2 * kFloorTile; ++i) work.tile[i] = 1.0f;
    for (std::uint64_t i = 0; i < work.pixels; i += W) {
        const std::uint64_t at = i % kFloorTile;
        blend_vector(work.tile, at, to_float(iota<I<W>>()) + float(std::int32_t(at & 63u)));
    }
    for (std::uint64_t i = 0; i + W <= work.frame; i += W)
        stream_(work.image + i, blend_load<F<W>>(work.tile + i % (kFloorPlanes * kFloorTile)));
    end_stream();
    return work.tile[4 * kFloorTile];
}

}  // namespace

#define BENCH_JOIN(a, b) a##b
#define BENCH_FLOOR(isa) BENCH_JOIN(blend_floor_, isa)
extern const BlendFloor BENCH_FLOOR(PILEUS_ISA);
const BlendFloor BENCH_FLOOR(PILEUS_ISA) = run_floor;

}  // namespace bench
