// SPDX-License-Identifier: Apache-2.0
// What flows up, down and in every direction at any level of a slab, by path.
// in: a slab of trace_harness.h, a level -> out: fluxes, radiances, mean intensities with errors.
// docs/validation.md; the flux camera and parallel rays of docs/path.md.
#pragma once
#include "tests/support/path_harness.h"

namespace path_slab {

using namespace path_test;

/// A camera's place at height `z` of a slab one metre thick: its middle.
inline std::array<float, 3> place(double z) {
    return {float(kSlabWidth / 2), float(kSlabWidth / 2), float(z)};
}

/// Diffuse flux through a level, up or down, per horizontal area: sunlight that was never scattered
/// is not in it, the light of the sky is.
inline Mean flux(const Rig& rig, double z, bool up, std::uint64_t samples, std::uint64_t seed) {
    const CameraParams camera = make_flux_view(place(z), {0, 0, up ? -1.0f : 1.0f}, 1e-3f);
    return film_average(trace_film(path_input(rig, camera, seed), samples));
}

/// Radiance at a level that travels along `travel`.
inline Mean radiance(const Rig& rig, double z, const Double3& travel, std::uint64_t samples,
                     std::uint64_t seed) {
    const CameraParams camera = make_flat_view(
        place(z), {float(-travel[0]), float(-travel[1]), float(-travel[2])}, 1e-3f, 1, 1);
    PathInput in = path_input(rig, camera, seed);
    in.jitter = false;
    return film_average(trace_film(in, samples));
}

/// Solid angle of the rectangle [0, x] x [0, y] at distance 1.
inline double corner_angle(double x, double y) {
    return std::atan(x * y / std::sqrt(1 + x * x + y * y));
}

/// Diffuse radiance of all directions together, 4 pi times its mean, by the six faces of a cube of
/// `edge` x `edge` pixels; each pixel's mean counts with its solid angle.
inline Mean all_directions(const Rig& rig, double z, int edge, std::uint64_t samples,
                           std::uint64_t seed) {
    Mean sum;
    for (int face = 0; face < 6; ++face) {
        std::array<float, 3> forward{};
        forward[std::size_t(face / 2)] = face % 2 == 0 ? 1.0f : -1.0f;
        CameraParams camera = make_view(place(z), forward, edge, edge);
        camera.half_width = camera.half_height = 1;
        // The pictures of the sides stand upright, so that the horizon lies between two rows.
        if (face < 4) {
            for (std::size_t a = 0; a < 3; ++a) camera.up[a] = a == 2 ? 1.0f : 0.0f;
            camera.right[0] = forward[1], camera.right[1] = -forward[0], camera.right[2] = 0;
        }
        const Film film = trace_film(path_input(rig, camera, seed + std::uint64_t(face)), samples);
        for (int y = 0; y < edge; ++y)
            for (int x = 0; x < edge; ++x) {
                const auto at = [&](int i) { return 2.0 * i / edge - 1; };
                const double angle = corner_angle(at(x + 1), at(y + 1)) -
                                     corner_angle(at(x), at(y + 1)) -
                                     corner_angle(at(x + 1), at(y)) + corner_angle(at(x), at(y));
                const std::size_t p = std::size_t(y) * std::size_t(edge) + std::size_t(x);
                const double error = angle * film_error(film, 0, p);
                sum.value += angle * film_mean(film, 0, 0, p);
                sum.error += error * error;
            }
    }
    sum.error = std::sqrt(sum.error);
    return sum;
}

/// Where the sun stands whose light travels down with cosine `mu0` towards -x.
inline std::array<float, 3> sun_at(double mu0) {
    return {float(std::sqrt(1 - mu0 * mu0)), 0, float(mu0)};
}

/// Travel with cosine `mu` upward, turned by `phi_deg` from the azimuth of that sun's light.
inline Double3 travel_of(double mu, double phi_deg) {
    const double s = std::sqrt(std::fmax(0.0, 1 - mu * mu)), phi = phi_deg * std::acos(-1.0) / 180;
    return {-s * std::cos(phi), -s * std::sin(phi), mu};
}

}  // namespace path_slab
