// SPDX-License-Identifier: Apache-2.0
// Traces camera paths through media made by hand, and averages the films they give.
// in: a rig of trace_harness.h, a light, a camera -> out: films, means with standard errors.
// docs/path.md; verdicts by check_mean of trace_harness.h.
#pragma once
#include "src/methods/path/trace_paths.h"
#include "tests/support/trace_harness.h"

namespace path_test {

using namespace trace_test;

/// A camera at `origin` (box-local metres) that looks along `forward`, a unit vector.
inline CameraParams make_view(std::array<float, 3> origin, std::array<float, 3> forward, int width,
                              int height) {
    CameraParams c{};
    // Any right angle will do: the axis that `forward` has least of.
    std::size_t least = 0;
    for (std::size_t a = 1; a < 3; ++a)
        if (std::fabs(forward[a]) < std::fabs(forward[least])) least = a;
    double right[3] = {}, length = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        right[a] = (a == least ? 1.0 : 0.0) - double(forward[a]) * double(forward[least]);
        length += right[a] * right[a];
    }
    for (std::size_t a = 0; a < 3; ++a) {
        c.origin[a] = origin[a];
        c.forward[a] = forward[a];
        c.right[a] = float(right[a] / std::sqrt(length));
    }
    for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3, d = (a + 2) % 3;
        c.up[a] = c.right[b] * c.forward[d] - c.right[d] * c.forward[b];
    }
    c.width = width;
    c.height = height;
    c.half_width = c.half_height = 0.5f;
    return c;
}

/// A square detector of `edge` metres whose front side faces along `forward`.
inline CameraParams make_flux_view(std::array<float, 3> centre, std::array<float, 3> forward,
                                   float edge) {
    CameraParams c = make_view(centre, forward, 1, 1);
    c.half_width = c.half_height = 0.5f * edge;
    c.orthographic = c.flux = 1;
    return c;
}

/// Parallel rays through a window of `edge` metres.
inline CameraParams make_flat_view(std::array<float, 3> origin, std::array<float, 3> forward,
                                   float edge, int width, int height) {
    CameraParams c = make_view(origin, forward, width, height);
    c.half_width = c.half_height = 0.5f * edge;
    c.orthographic = 1;
    return c;
}

inline PathInput path_input(const Rig& rig, const CameraParams& camera, std::uint64_t seed) {
    PathInput in;
    in.medium = &rig.medium;
    in.lighting = &rig.lighting;
    in.majorants = rig.majorants.span();
    in.block = rig.block;
    in.camera = camera;
    in.seed = seed;
    in.threads = rig.threads;
    in.kernels = rig.kernels;
    return in;
}

inline Film trace_film(const PathInput& in, std::uint64_t samples) {
    Film film;
    PathScratch scratch;
    REQUIRE(make_film(in, film));
    REQUIRE(trace_paths(in, samples, scratch, film));
    CHECK(film.tally.nan == 0);
    CHECK(film.tally.majorant_violations == 0);
    CHECK(film.tally.terminated == 0);
    return film;
}

/// Mean over the pixels of one channel of the total.
inline Mean film_average(const Film& film, int channel = 0) {
    Mean m;
    const double n = double(film.pixels());
    for (std::size_t p = 0; p < film.pixels(); ++p) {
        const double error = film_error(film, channel, p);
        m.value += film_mean(film, 0, channel, p) / n;
        m.error += error * error / (n * n);
    }
    m.error = std::sqrt(m.error);
    return m;
}

inline void shine(Rig& rig, std::array<float, 3> to_sun, double irradiance = 1) {
    rig.lighting.sunlit = true;
    rig.lighting.to_sun = to_sun;
    rig.lighting.sun_irradiance = {irradiance, irradiance, irradiance};
}

inline void set_sky(Rig& rig, double radiance) {
    rig.lighting.sky = {radiance, radiance, radiance};
}

inline void set_ground(Rig& rig, double z, double albedo) {
    rig.lighting.ground.present = true;
    rig.lighting.ground.z = z;
    rig.lighting.ground.albedo = albedo;
}

}  // namespace path_test
