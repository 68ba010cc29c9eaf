// SPDX-License-Identifier: Apache-2.0
// Several media on one grid, made by hand.
// in: a rig of one medium, boxes with random densities -> out: the same with parts; masses.
// docs/methods.md 2, "Several media".
#pragma once
#include "src/world/medium/mix_media.h"
#include "tests/support/trace_harness.h"

namespace trace_test {

inline Optics optics_of(std::array<float, 3> albedo, PhaseParams phase) {
    Optics o;
    for (std::size_t c = 0; c < 3; ++c) o.albedo[c] = albedo[c];
    o.albedo_max = std::max(albedo[0], std::max(albedo[1], albedo[2]));
    o.phase = phase;
    return o;
}

/// Gives `share(voxel)` of the rig's density to a second medium; the first keeps the rest.
template <class Share>
void split(Rig& rig, const Optics& second, Share share) {
    Medium& m = rig.medium;
    m.count = 2;
    m.optics[1] = second;
    if (second.albedo[0] != second.albedo[1] || second.albedo[1] != second.albedo[2])
        m.channels = 3;
    const Span<const float> density = m.volume.density.span();
    REQUIRE(m.parts.resize(density.size, "parts"));
    for (std::size_t v = 0; v < density.size; ++v) m.parts[v] = density[v] * float(share(v));
}

/// A box of random densities in [0, 1), one in three of them 0.
inline Medium make_box(Double3 low_m, Double3 extent_m, std::array<int, 3> size, double sigma,
                       std::uint32_t seed) {
    Medium m;
    m.low_m = low_m;
    m.volume.size = size;
    for (std::size_t a = 0; a < 3; ++a) {
        m.extent_m[a] = extent_m[a];
        m.grid.size[a] = size[a];
        m.grid.cell_m[a] = float(extent_m[a] / size[a]);
    }
    REQUIRE(m.volume.density.resize(voxel_count(m.grid), "density"));
    std::uint32_t v = 0;
    for (float& density : m.volume.density.span()) {
        const Words<std::uint32_t> w = threefry(seed, 17u, v++, 0u);
        density = w.b % 3 == 0 ? 0.0f : uniform(w.a);
        m.density_max = std::max(m.density_max, density);
    }
    m.sigma = float(sigma);
    return m;
}

inline MixBox box_of(const Medium& m) {
    return {m.low_m, {m.extent_m[0], m.extent_m[1], m.extent_m[2]}, m.volume.size};
}

/// Extinction of a grid over its box: sigma times the integral of the trilinear field, m^2, which
/// is that of its voxels.
inline double cross_section(Span<const float> density, const Medium& m) {
    double sum = 0;
    for (float v : density) sum += double(v);
    return sum * double(m.sigma) * (m.extent_m[0] / m.volume.size[0]) *
           (m.extent_m[1] / m.volume.size[1]) * (m.extent_m[2] / m.volume.size[2]);
}

/// Extinction of medium i on the common grid.
inline double cross_section_of(const Medium& m, std::size_t i) {
    const std::size_t voxels = m.volume.density.size();
    if (i > 0) return cross_section({m.parts.data() + (i - 1) * voxels, voxels}, m);
    double left = cross_section(m.volume.density.span(), m);
    for (std::size_t k = 1; k < std::size_t(m.count); ++k) left -= cross_section_of(m, k);
    return left;
}

}  // namespace trace_test
