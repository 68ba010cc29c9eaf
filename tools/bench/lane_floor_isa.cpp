// SPDX-License-Identifier: Apache-2.0
// Compiled once per instruction set, with the definitions and flags of kernels_cpu/isa/isa.cpp.
// in: see lane_floor.h -> out: checksums that depend on every number read.
// Read with README.md in this folder.
#include <cstring>

#include "kernels_cpu/core/rng.h"
#include "kernels_cpu/media/medium.h"
#include "tools/bench/lane_floor.h"

namespace bench {
namespace {

using namespace pileus;

constexpr int W = PILEUS_WIDTH;
using T = F<W>;

std::uint32_t sum(T v) {
    std::uint32_t total = 0;
    for (int l = 0; l < W; ++l) total += lane(reinterpret<U<W>>(v), l);
    return total;
}

T read(const FloorGrid& g, const Vec<T>& share) {
    const Vec<T> p{share.x * float(g.size[0]), share.y * float(g.size[1]),
                   share.z * float(g.size[2])};
    return interpolate(g.values, corners(p, g.size));
}

/// Rows of neighbouring pixels go through the grid side by side, one voxel a step.
std::uint32_t march(const MarchFloorWork& work) {
    const FloorGrid& g = work.density;
    const std::int64_t nodes =
        std::int64_t(work.source.size[0]) * work.source.size[1] * work.source.size[2];
    T light[3] = {}, left = all<T>(1.0f);
    const float deep = 1.0f / float(g.size[1]), pitch = work.apart / float(g.size[0]);
    float x = 0, y = 0, z = 0;
    for (std::uint64_t i = 0; i < work.samples; i += W) {
        const Vec<T> at{x + pitch * to_float(iota<I<W>>()), all<T>(y), all<T>(z)};
        const T optical = read(g, at);
        const T alpha = one_minus_exp(optical), sun = exp_(T{} - read(work.sun, at));
        for (int c = 0; c < 3; ++c) {
            const FloorGrid own{{work.source.size[0], work.source.size[1], work.source.size[2]},
                                work.source.values + c * nodes};
            light[c] = light[c] + alpha * (read(own, at) + sun);
        }
        left = left * (1.0f - alpha);
        // On to the next step, the next pixels, the next row of pixels.
        y = y + deep;
        if (y < 1.0f) continue;
        y = 0;
        x = x + pitch * float(W);
        if (x < 1.0f) continue;
        x = 0;
        z = z + pitch < 1.0f ? z + pitch : 0.0f;
    }
    return sum(light[0] + light[1] + light[2] + left);
}

double reconstruct(const ReconstructFloorWork& work) {
    double total = 0;
    for (std::uint64_t r = 0; r < work.rows; ++r) {
        double power = 0, weight = 1;
        for (std::uint64_t i = 0; i < work.numbers; ++i, weight += 0.125)
            power += double(work.sums[r * work.numbers + i]) * 0x1p-20 * weight;
        total += power;
    }
    return total;
}

template <class Function>
std::uint32_t each(const float* x, std::uint32_t count, Function function) {
    U<W> total{};
    for (std::uint32_t i = 0; i < count; i += W) {
        T v;
        std::memcpy(&v, x + i, sizeof v);
        total = total + reinterpret<U<W>>(function(v));
    }
    return sum(reinterpret<T>(total));
}

std::uint32_t math(MathKind kind, const float* x, std::uint32_t count) {
    switch (kind) {
        case MathKind::kLog:
            return each(x, count, [](T v) { return log_(v); });
        case MathKind::kExp:
            return each(x, count, [](T v) { return exp_(T{} - v); });
        case MathKind::kSinCos:
            return each(x, count, [](T v) {
                const SinCos<T> a = sincos_turns(v);
                return a.sine + a.cosine;
            });
        case MathKind::kAtan2:
            return each(x, count, [](T v) { return atan2_turns(v, 1.0f - v); });
        case MathKind::kThreefry:
            break;
    }
    return each(x, count, [](T v) {
        const Words<U<W>> w = threefry(0x13579bdfu, 0x2468ace0u, reinterpret<U<W>>(v), U<W>{});
        return reinterpret<T>(w.a + w.b);
    });
}

}  // namespace

#define BENCH_JOIN(a, b) a##b
#define BENCH_FLOORS(isa) BENCH_JOIN(lane_floors_, isa)
extern const LaneFloors BENCH_FLOORS(PILEUS_ISA);
const LaneFloors BENCH_FLOORS(PILEUS_ISA) = {march, reconstruct, math};

}  // namespace bench
