// SPDX-License-Identifier: Apache-2.0
// See behind.h.
#include "src/world/light/behind.h"

#include "kernels_cpu/core/math.h"
#include "kernels_cpu/media/phase.h"
#include "src/base/angles.h"

namespace pileus {
namespace {

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

}  // namespace

void set_horizon(const Medium& medium, const Beam& peak, double peak_deg, BehindView& out) {
    double along[kAround], width[kRings], turn[kRings];
    SineCosine angle[kRings];
    for (int i = 0; i < kAround; ++i) along[i] = sincos_deg(180.0 * (i + 0.5) / kAround).cosine;
    for (int r = 0; r < kRings; ++r) {
        // Rings are narrow near the direction itself, where most turns end.
        const double from = double(r) / kRings, to = double(r + 1) / kRings;
        turn[r] = 0.5 * peak_deg * (from * from + to * to);
        angle[r] = sincos_deg(turn[r]);
        width[r] = to * to - from * from;
    }
    const double widest = sincos_deg(peak_deg).sine;
    for (int h = 0; h < kHorizon; ++h) {
        const double sine = widest * h / (kHorizon - 1);
        double shares[kRings], above = 0, all = 0;
        set_shares({sine, __builtin_sqrt(1 - sine * sine)}, angle, along, shares);
        for (int i = 0; i < medium.count; ++i)
            for (int r = 0; r < kRings; ++r) {
                const PhaseParams& phase = medium.optics[std::size_t(i)].phase;
                const double light = double(phase_density(phase, turn_of_deg(turn[r]))) *
                                     angle[r].sine * width[r] * peak.shares[i];
                all += light;
                above += light * shares[r];
            }
        out.horizon[h] = all > 0 ? float(above / all) : 1.0f;
    }
    out.per_horizon = float((kHorizon - 1) / widest);
}

void set_behind(const Lighting& light, const Double3& ground, BehindView& out) {
    out.map = light.map;
    out.has_ground = light.ground.present ? 1 : 0;
    for (std::size_t c = 0; c < 3; ++c) {
        out.sky[c] = float(light.sky[c]);
        out.ground[c] = float(ground[c]);
    }
}

}  // namespace pileus
