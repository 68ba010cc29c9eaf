// SPDX-License-Identifier: Apache-2.0
// See work.h.
#include "src/plan/work.h"

namespace pileus {
namespace {

constexpr double kThick = 2.3094;  // 4 / sqrt(3): absorbed share of a half space over sqrt(1 - a)
constexpr double kMinForward = 1e-6;

double at_most(double a, double b) { return a < b ? a : b; }

/// Mean path through the box where nothing scatters, which no scattering changes.
double mean_path_m(const double (&e)[3]) {
    return 2 * e[0] * e[1] * e[2] / (e[0] * e[1] + e[1] * e[2] + e[2] * e[0]);
}

}  // namespace

WorkEstimate estimate_work(const WorkInput& in) {
    WorkEstimate out;
    out.photons = in.photons;
    const double lost = 1 - in.albedo;
    const double forward = 1 - in.mean_cosine > kMinForward ? 1 - in.mean_cosine : kMinForward;
    const double cut =
        at_most(1.1284 * kThick * __builtin_sqrt(in.max_events / forward), in.max_events);
    double least = cut;
    out.law = "thick: given up after the largest number of events";
    if (lost > 0) {
        const double share = kThick * __builtin_sqrt(lost / (forward + in.mean_cosine * lost));
        const double absorbing = at_most(share, 1) / lost;
        if (absorbing < least) least = absorbing, out.law = "thick: absorbed";
    }
    if (in.mean_density >= 0) {
        const double crossing = in.extinction_per_m * in.mean_density * mean_path_m(in.extent_m);
        if (crossing < least) least = crossing, out.law = "mean path 4V/S";
        out.known = true;
    }
    out.scatterings_per_photon = least;
    out.scatterings = least * in.photons;
    return out;
}

}  // namespace pileus
