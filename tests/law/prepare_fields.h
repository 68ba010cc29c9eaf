// SPDX-License-Identifier: Apache-2.0
// Density fields for the tests of the preparation.
// in: a size and a seed -> out: a grid and its densities.
// docs: tests.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kernels_cpu/core/rng.h"
#include "src/base/digest.h"
#include "src/base/span.h"
#include "src/methods/collectors/prepare/prepared.h"
#include "src/world/grid/grid.h"

namespace prepare_test {

using pileus::Grid;
using pileus::Span;

struct Field {
    Grid grid;
    std::vector<float> rho;
    Span<const float> span() const { return {rho.data(), rho.size()}; }
    float& at(int i, int j, int k) { return rho[pileus::voxel_index(grid, i, j, k)]; }
};

inline Field zeros(int nx, int ny, int nz, float cx = 1, float cy = 1, float cz = 1) {
    Field f{{{nx, ny, nz}, {cx, cy, cz}}, {}};
    f.rho.assign(pileus::voxel_count(f.grid), 0.0f);
    return f;
}

/// Uniform in [0, 1) per (seed, index).
inline float noise(std::uint32_t seed, std::uint32_t index) {
    return pileus::uniform(pileus::threefry(seed, 99u, index, 0u).a);
}

/// Independent noise, about half of it empty.
inline Field speckle(int nx, int ny, int nz, std::uint32_t seed) {
    Field f = zeros(nx, ny, nz, 1.0f, 2.0f, 0.5f);
    for (std::size_t v = 0; v < f.rho.size(); ++v)
        f.rho[v] = std::max(0.0f, 2.0f * noise(seed, std::uint32_t(v)) - 1.0f);
    return f;
}

/// Forty overlapping soft balls with flat cores in an otherwise empty box.
inline Field balls(int nx, int ny, int nz, std::uint32_t seed) {
    Field f = zeros(nx, ny, nz, 10.0f, 10.0f, 10.0f);
    const float n[3] = {float(nx), float(ny), float(nz)};
    const float smallest = std::min(n[0], std::min(n[1], n[2]));
    for (std::uint32_t b = 0; b < 40; ++b) {
        const float radius = smallest * (0.06f + 0.14f * noise(seed, 8 * b + 3));
        float c[3];
        for (std::uint32_t a = 0; a < 3; ++a)
            c[a] = n[a] * 0.5f + (noise(seed, 8 * b + a) - 0.5f) * (0.9f * n[a] - 2 * radius);
        for (int k = 0; k < nz; ++k)
            for (int j = 0; j < ny; ++j)
                for (int i = 0; i < nx; ++i) {
                    const float x = float(i) + 0.5f - c[0], y = float(j) + 0.5f - c[1];
                    const float z = float(k) + 0.5f - c[2];
                    const float d = std::sqrt(x * x + y * y + z * z) / radius;
                    const float soft = std::min(1.0f, std::max(0.0f, (1.0f - d) * 3.0f));
                    f.at(i, j, k) = std::max(f.at(i, j, k), soft);
                }
    }
    return f;
}

}  // namespace prepare_test
