// SPDX-License-Identifier: Apache-2.0
// The step cloud of the I3RC intercomparison: its medium, its suns, its views.
// in: number of the experiment -> out: a periodic rig; quantities per column by path or by photons.
// docs/validation.md; Cahalan et al. 2005, BAMS 86, 1275: phase I, case 1.
#pragma once
#include "src/base/angles.h"
#include "tests/support/path_harness.h"

namespace step_cloud {

using namespace path_test;

constexpr int kColumns = 32;
constexpr double kWidth = 500, kHeight = 250, kThin = 2, kThick = 18;

struct Experiment {
    int number;
    double zenith_deg, albedo;
};
constexpr Experiment kExperiments[] = {{1, 0, 1}, {2, 60, 1}, {4, 60, 0.99}};

/// Extinction, 1/m, of a place along x.
inline double extinction(double x) {
    const double at = x - kWidth * std::floor(x / kWidth);
    return (at < kWidth / 2 ? kThin : kThick) / kHeight;
}

/// Columns 1-16 of optical thickness 2, 17-32 of 18, cells as they are; light travels towards +x;
/// flux 1 on a level plane.
inline Rig make_step(const Experiment& e) {
    Rig rig = make_rig({kColumns, 1, 1}, {kWidth, kWidth, kHeight}, kThick / kHeight);
    for (std::size_t i = 0; i < rig.medium.volume.density.size(); ++i)
        rig.medium.volume.density.data()[i] = i < kColumns / 2 ? float(kThin / kThick) : 1;
    set_albedo(rig, {float(e.albedo), float(e.albedo), float(e.albedo)});
    rig.medium.optics[0].phase.g1 = 0.85f;
    rig.medium.grid.periodic = rig.medium.grid.constant = true;
    set_majorants(rig, 1);
    const SineCosine zenith = sincos_deg(e.zenith_deg);
    shine(rig, {float(-zenith.sine), 0, float(zenith.cosine)}, 1 / zenith.cosine);
    return rig;
}

/// Means and standard errors of the columns.
using Columns = std::array<Mean, kColumns>;

/// A picture of the columns, one pixel each. `travel`: of the light that is seen, in the x-z plane.
inline CameraParams column_view(double sine, double cosine) {
    // The picture's rows lie along the x axis where its rays meet the cloud's top or base.
    const double side = cosine > 0 ? 1 : -1, away = 0.01 + (sine != 0 ? kWidth / 2 : 0);
    CameraParams c{};
    c.origin[0] = float(kWidth / 2 + sine / (cosine * side) * away);
    c.origin[1] = float(kWidth / 2);
    c.origin[2] = float(cosine > 0 ? kHeight + away : -away);
    c.forward[0] = float(-sine), c.forward[2] = float(-cosine);
    c.right[0] = float(cosine * side), c.right[2] = float(-sine * side);
    c.up[1] = 1;
    c.width = kColumns;
    c.height = 1;
    c.half_width = float(kWidth / 2 * cosine * side);
    c.half_height = c.half_width / kColumns;
    c.orthographic = 1;
    return c;
}

inline Columns columns_of(const Film& film, double factor) {
    Columns out;
    for (std::size_t i = 0; i < kColumns; ++i)
        out[i] = {film_mean(film, 0, 0, i) * factor, film_error(film, 0, i) * factor};
    return out;
}

/// The sun's light that reaches the base of each column without a collision.
inline std::array<double, kColumns> straight(const Experiment& e) {
    constexpr int kSteps = 500;
    const SineCosine zenith = sincos_deg(e.zenith_deg);
    std::array<double, kColumns> out{};
    for (int i = 0; i < kColumns; ++i)
        for (int k = 0; k < kSteps; ++k) {
            const double x = (i + (k + 0.5) / kSteps) * kWidth / kColumns;
            double depth = 0;
            for (int step = 0; step < kSteps; ++step) {
                const double z = (step + 0.5) / kSteps * kHeight;
                depth += extinction(x - z * zenith.sine / zenith.cosine) * kHeight / kSteps;
            }
            out[std::size_t(i)] += std::exp(-depth / zenith.cosine) / kSteps;
        }
    return out;
}

/// R, T, Iu, Id, I601 or I602 of every column, as the README of the data defines them.
inline Columns by_path(const Experiment& e, const std::string& quantity, std::uint64_t samples,
                       std::uint64_t seed) {
    const Rig rig = make_step(e);
    const bool flux = quantity == "R" || quantity == "T";
    const SineCosine view = sincos_deg(60);
    CameraParams camera = quantity == "I601"   ? column_view(view.sine, view.cosine)
                          : quantity == "I602" ? column_view(-view.sine, view.cosine)
                          : quantity == "T" || quantity == "Id" ? column_view(0, -1)
                                                                : column_view(0, 1);
    camera.flux = flux ? 1 : 0;
    // The sun's flux on a level plane is 1: fluxes are shares, radiances count times pi.
    Columns out =
        columns_of(trace_film(path_input(rig, camera, seed), samples), flux ? 1 : std::acos(-1.0));
    if (quantity != "T") return out;
    const auto direct = straight(e);
    for (std::size_t i = 0; i < kColumns; ++i) out[i].value += direct[i];
    return out;
}

}  // namespace step_cloud
