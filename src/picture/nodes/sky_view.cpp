// SPDX-License-Identifier: Apache-2.0
// See sky_view.h.
// in: what nodes see -> out: what of it goes towards the camera, by kernels.
// docs/raymarch.md, "Skylight".
#include "src/picture/nodes/sky_view.h"

#include "kernels_cpu/core/math.h"
#include "src/base/angles.h"
#include "src/world/phase/forward_share.h"

namespace pileus {
namespace {

/// Cosine of the rim of a disc that is as large as a part.
constexpr double kRim = 1 - 2.0 / kSkyParts;

double arc_cosine_share(double cosine) {
    if (cosine >= 1) return 0;
    if (cosine <= -1) return 1;
    const double sine = __builtin_sqrt(1 - cosine * cosine);
    return 2 * double(atan2_turns(float(sine), float(cosine)));
}

/// Rings about the way ahead: where they lie and how much of the scattered light is in each.
struct Rings {
    static constexpr int kCount = 180;
    double cosine[kCount], sine[kCount], share[kCount];
};

Rings rings_of(const Medium& medium) {
    Rings r{};
    for (int n = 0; n < Rings::kCount; ++n) {
        const SineCosine middle = sincos_deg(n + 0.5);
        r.cosine[n] = middle.cosine;
        r.sine[n] = middle.sine;
    }
    for (int i = 0; i < medium.count; ++i) {
        double before = 0;
        for (int n = 0; n < Rings::kCount; ++n) {
            const double within = n + 1 < Rings::kCount
                                      ? forward_share(medium.optics[std::size_t(i)].phase, n + 1.0)
                                      : 1;
            r.share[n] += (within - before) / medium.count;
            before = within;
        }
    }
    return r;
}

}  // namespace

std::array<float, 3> sky_direction(int part, double u, double v) {
    const int band = part / kSphereAround, turn = part % kSphereAround;
    const double z = -1 + 2 * (band + u) / kSphereBands;
    // Every other band turns by half a part.
    const double around = 360.0 / kSphereAround * (turn + v + 0.5 * (band % 2));
    const SineCosine a = sincos_deg(around);
    const double r = __builtin_sqrt(1 - z * z);
    return {float(a.cosine * r), float(a.sine * r), float(z)};
}

SkyDirections sky_directions() {
    SkyDirections d;
    for (int p = 0; p < kSkyParts; ++p) d[std::size_t(p)] = sky_direction(p);
    return d;
}

SkyPhase sky_phase(const Medium& medium) {
    const Rings r = rings_of(medium);
    SkyPhase phase{};
    for (int k = 0; k <= kSkyPhaseSteps; ++k) {
        const double cosine = -1 + 2.0 * k / kSkyPhaseSteps;
        const double sine = __builtin_sqrt(1 - cosine * cosine);
        double sum = 0;
        for (int n = 0; n < Rings::kCount; ++n) {
            // Share of a ring within the disc: by the angle where it meets the rim.
            const double across = r.sine[n] * sine, rim = kRim - r.cosine[n] * cosine;
            const double within = across > 1e-12 ? arc_cosine_share(rim / across) : rim <= 0;
            sum += r.share[n] * within;
        }
        phase[std::size_t(k)] = float(sum * kSkyParts);
    }
    return phase;
}

SkyTurnParams sky_turn_params(const SkyViewInput& in) {
    SkyTurnParams k{};
    k.grid = in.grid;
    k.camera = in.view->camera;
    // Within two nodes of the camera rays of all directions pass.
    for (float per_metre : in.grid.per_metre) {
        const float spacing = 1 / per_metre;
        k.reach = 2 * spacing > k.reach ? 2 * spacing : k.reach;
    }
    for (std::size_t p = 0; p < kSkyParts; ++p) {
        for (std::size_t a = 0; a < 3; ++a) k.middles[p][a] = (*in.middles)[p][a];
        for (int s = 0; s < in.sets; ++s) k.share[s][p] = float(in.share[s][p]);
    }
    k.sets = in.sets;
    k.later = in.octaves > 1 ? 1 : 0;
    return k;
}

void turn_sky_nodes(const SkyViewInput& in, const KernelTable& kernels, std::uint32_t begin,
                    std::uint32_t end, float* light) {
    kernels.turn_sky(sky_turn_params(in), {in.phase->data(), in.seen.data, light}, begin, end);
}

}  // namespace pileus
