// SPDX-License-Identifier: Apache-2.0
// Power-on check: 64 fixed inputs through every math kernel, digested.
// in: nothing -> out: FNV-1a 64 of the results; wrong flags, modes or silicon change it.
#pragma once
#include "kernels_cpu/core/fixed.h"
#include "kernels_cpu/core/rng.h"
#include "kernels_cpu/core/sh.h"
#include "kernels_cpu/core/vec.h"
#include "kernels_cpu/media/phase.h"

namespace pileus {
inline namespace PILEUS_ISA {

template <class T>
PILEUS_FN void hash_lanes(std::uint64_t* hashes, int first, T v) {
    const auto bits = reinterpret<U_of<T>>(v);
    for (int i = 0; i < width_of<T>; ++i)
        hashes[first + i] = (hashes[first + i] ^ lane(bits, i)) * 0x100000001b3ull;
}

template <int W>
PILEUS_FN std::uint64_t self_test() {
    using T = F<W>;
    std::uint64_t hashes[64];
    for (std::uint64_t& h : hashes) h = 0xcbf29ce484222325ull;
    for (int first = 0; first < 64; first += W) {
        const U<W> number = reinterpret<U<W>>(iota<I<W>>() + first);
        const Words<U<W>> w = threefry(0x12345678u, 0x9abcdef0u, number, all<U<W>>(3u));
        const T u = uniform_open(w.a), v = uniform(w.b);
        hash_lanes(hashes, first, u);
        hash_lanes(hashes, first, log_(u));
        hash_lanes(hashes, first, exp_(v * -20.0f));
        hash_lanes(hashes, first, one_minus_exp(v * v * v));
        const SinCos<T> phi = sincos_turns(v);
        hash_lanes(hashes, first, phi.sine);
        hash_lanes(hashes, first, phi.cosine);
        const Turn<T> turn = hg_sample(all<T>(0.85f), u);
        hash_lanes(hashes, first, turn.one_minus_cos);
        hash_lanes(hashes, first, rayleigh_sample(u).sine);
        hash_lanes(hashes, first, hg_density(all<T>(-0.6f), turn.one_minus_cos));
        const Vec<T> axis = normalized(Vec<T>{u, v, u * v - 0.3f});
        const Vec<T> d = turned(axis, 1.0f - turn.one_minus_cos, turn.sine, phi.cosine, phi.sine);
        T y[64];
        sh_eval<8>(d.x, d.y, d.z, y);
        for (const T& value : y) hash_lanes(hashes, first, value);
        hash_lanes(hashes, first, quantise(d.z, 0x1p20f));
    }
    std::uint64_t digest = 0xcbf29ce484222325ull;
    for (std::uint64_t h : hashes) digest = (digest ^ h) * 0x100000001b3ull;
    return digest;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
