// SPDX-License-Identifier: Apache-2.0
// How media scatter light that does not turn within the peak of their phase functions.
// in: a medium -> out: optics of nodes.
// docs/ordinates.md, "The peak of the phase function"; Wiscombe 1977
#include <algorithm>

#include "kernels_cpu/core/math.h"
#include "kernels_cpu/media/phase.h"
#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/picture/ordinates/ordinates.h"
#include "src/world/light/behind.h"

namespace pileus {
namespace {

constexpr float kMinRest = 1e-6f;

}  // namespace

float ordinate_peak() { return turn_of_deg(kOrdinatePeakDeg); }

OrdinateOptics ordinate_optics(const Optics& optics, int channel, double f) {
    const double albedo = double(optics.albedo[std::size_t(channel)]);
    OrdinateOptics out;
    out.rest = float(counting_share(optics, std::size_t(channel), f));
    out.albedo = out.rest > kMinRest ? float(albedo * (1 - f) / double(out.rest)) : 1.0f;
    double moment[4] = {1, 0, 0, 0};
    for (int l = 1; l < 4 && 1 - f > 1e-6; ++l)
        moment[l] = (double(phase_moment(optics.phase, l)) - f) / (1 - f);
    // Four moments of a lobe are negative somewhere. Of a narrow one straight back they are so far
    // below that iterations would not end: less of it then.
    double least = 0;
    for (int i = 0; i <= 64; ++i) {
        const double x = -1 + i / 32.0;
        least = std::min(least, 3 * moment[1] * x + 2.5 * moment[2] * (3 * x * x - 1) +
                                    3.5 * moment[3] * x * (5 * x * x - 3));
    }
    const double scale = least < -4 ? -4 / least : 1;
    for (int l = 1; l < 4; ++l) out.moment[l] = float(scale * moment[l]);
    return out;
}

Status prepare_optics(const Context& context, const Medium& medium, bool points,
                      OrdinateNodes& out) {
    const StageClock clock(context, "ordinates");
    PILEUS_TRY(make_beam(medium, ordinate_peak(), points, BeamTurns::kPeak, context.threads,
                         Stage::kShadow, out.peak));
    out.media = medium.count;
    for (int i = 0; i < out.media; ++i)
        for (int c = 0; c < 3; ++c)
            out.optics[i][c] = ordinate_optics(medium.optics[std::size_t(i)],
                                               medium.channels > 1 ? c : 0, out.peak.shares[i]);
    set_horizon(medium, out.peak, kOrdinatePeakDeg, out.behind);
    out.sets.clear();
    // Light on the ground is of another medium.
    out.ground.known.fill(false);
    return Status::ok();
}

}  // namespace pileus
