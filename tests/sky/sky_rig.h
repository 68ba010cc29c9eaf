// SPDX-License-Identifier: Apache-2.0
// A small procedural sky for tests: textures of 32 texels, no file kept.
// in: changes of settings -> out: a SkyField.
#pragma once
#include <doctest/doctest.h>

#include <cstdlib>

#include "kernels_cpu/isa/kernels.h"
#include "src/world/density/sky_field.h"

namespace sky_test {
using namespace pileus;

inline SkySettings small_sky() {
    SkySettings s;
    s.size = 32;
    s.perlin.tile_m = 4096, s.worley.tile_m = 3000;
    s.perlin.cells = s.worley.cells = 2;
    s.base_m = 1000, s.top_m = 2500;
    return s;
}

/// Two independent streams of numbers in [0, 1), the same on every machine.
struct Numbers {
    std::uint64_t state = 1;
    double next() {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        return double(state >> 11) * 0x1p-53;
    }
    float in(double low, double high) { return float(low + (high - low) * next()); }
};

struct Rig {
    SkyField sky;
    explicit Rig(const SkySettings& settings, Double3 low_m = {0, 0, 0}, bool turned = false) {
        unsetenv("HOME"), unsetenv("PILEUS_CACHE_DIR"), unsetenv("XDG_CACHE_HOME");
        REQUIRE(make_sky(settings, low_m, *kernel_table(nullptr), 2, sky, turned));
    }
    const SkyParams& params() const { return sky.params; }
};

}  // namespace sky_test
