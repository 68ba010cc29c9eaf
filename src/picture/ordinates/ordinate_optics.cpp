// SPDX-License-Identifier: Apache-2.0
// How media scatter light that does not turn within the peak of their phase functions, and what a
// peak sees of the horizon.
// in: a medium -> out: optics of nodes.
// docs/ordinates.md, "The peak of the phase function"; Wiscombe 1977
#include <algorithm>

#include "kernels_cpu/core/math.h"
#include "kernels_cpu/media/phase.h"
#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/picture/ordinates/ordinates.h"

namespace pileus {
namespace {

constexpr float kMinRest = 1e-6f;

constexpr int kRings = 64, kAround = 64;

/// Shares of circles around a direction above the horizon, which has these sine and cosine of its
/// height; the circles' angles likewise. `along`: cosines around them.
void set_shares(const SineCosine& height, const SineCosine (&angle)[kRings],
                const double (&along)[kAround], double (&out)[kRings]) {
    for (int r = 0; r < kRings; ++r) {
        int above = 0;
        for (const double cosine : along)
            above += height.sine * angle[r].cosine + height.cosine * angle[r].sine * cosine > 0;
        out[r] = double(above) / kAround;
    }
}

/// OrdinateNodes::horizon of all media, by their shares within the peak.
void set_horizon(const Medium& medium, OrdinateNodes& nodes) {
    double along[kAround], width[kRings], turn[kRings];
    SineCosine angle[kRings];
    for (int i = 0; i < kAround; ++i) along[i] = sincos_deg(180.0 * (i + 0.5) / kAround).cosine;
    for (int r = 0; r < kRings; ++r) {
        // Rings are narrow near the direction itself, where most turns end.
        const double from = double(r) / kRings, to = double(r + 1) / kRings;
        turn[r] = 0.5 * kOrdinatePeakDeg * (from * from + to * to);
        angle[r] = sincos_deg(turn[r]);
        width[r] = to * to - from * from;
    }
    for (int h = 0; h < kHorizon; ++h) {
        const double sine = sincos_deg(kOrdinatePeakDeg).sine * h / (kHorizon - 1);
        double shares[kRings], above = 0, all = 0;
        set_shares({sine, __builtin_sqrt(1 - sine * sine)}, angle, along, shares);
        for (int i = 0; i < medium.count; ++i)
            for (int r = 0; r < kRings; ++r) {
                const PhaseParams& phase = medium.optics[std::size_t(i)].phase;
                const double light = double(phase_density(phase, turn_of_deg(turn[r]))) *
                                     angle[r].sine * width[r] * double(nodes.peak.shares[i]);
                all += light;
                above += light * shares[r];
            }
        nodes.horizon[h] = all > 0 ? float(above / all) : 1.0f;
    }
}

}  // namespace

float ordinate_peak() { return turn_of_deg(kOrdinatePeakDeg); }

OrdinateOptics ordinate_optics(const Optics& optics, int channel, double f) {
    const double albedo = double(optics.albedo[std::size_t(channel)]);
    OrdinateOptics out;
    out.rest = float(1 - albedo * f);
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
    set_horizon(medium, out);
    out.sets.clear();
    // Light on the ground is of another medium.
    out.ground.known.fill(false);
    return Status::ok();
}

}  // namespace pileus
