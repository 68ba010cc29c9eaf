// SPDX-License-Identifier: Apache-2.0
// See scatter.h.
#include "src/photons/scatter.h"

#include "src/base/angles.h"

namespace pileus {

int useful_axis_degrees(const Medium& medium, int bands, int wanted) {
    constexpr float kNothing = 1e-3f;  // of a moment
    // Moments of tables end at a degree of their own.
    const int most = kPhaseMoments - bands;
    for (int n = wanted < most ? wanted : most; n > 0; --n)
        for (int i = 0; i < medium.count; ++i) {
            const float chi = phase_moment(medium.optics[std::size_t(i)].phase, bands + n - 1);
            if (chi > kNothing || chi < -kNothing) return n;
        }
    return 0;
}

Window band_window(int bands, bool sinc) {
    Window w{};
    for (int l = 0; l < bands; ++l) {
        w.factor[l] = 1;
        if (!sinc || l == 0) continue;
        const double x = double(l) / bands;
        w.factor[l] = float(sincos_deg(180.0 * x).sine / (kPi64 * x));
    }
    return w;
}

BandWeights band_weights(const DepositPlan& deposit, const Window& window, const Mixture& mix,
                         const Direction& to) {
    BandWeights out;
    float y[kMaxBands * kMaxBands];
    sh_values(deposit.bands, to, y);
    for (int i = 0; i < deposit.bands * deposit.bands; ++i) out.y[i] = double(y[i]);
    for (int l = 0; l < deposit.bands; ++l) {
        const float moment = deposit.mode == kDepositOutgoing ? 1.0f : mix.moment(l);
        out.factor[l] = double(moment * window.factor[l]);
    }
    return out;
}

double sh_power(int bands, const BandWeights& weights, const double* sums) {
    double power = 0;
    for (int l = 0, i = 0; l < bands; ++l) {
        double band = 0;
        for (int m = -l; m <= l; ++m, ++i) band += sums[i] * weights.y[i];
        power += band * weights.factor[l];
    }
    return power;
}

AxisWeights axis_weights(const DepositPlan& deposit, const Mixture& mix, const Direction& sun,
                         const Direction& to) {
    AxisWeights out;
    float p[kMaxAxisDegrees];
    axis_values(deposit.bands, deposit.axis_degrees, 1.0f - one_minus_cosine(sun, to), p);
    for (int j = 0; j < deposit.axis_degrees; ++j) {
        const int l = deposit.bands + j;
        const double weight = double(2 * l + 1) * 0.079577471545947667884;  // 1 / 4 pi
        out.w[j] = weight * double(mix.moment(l)) * double(p[j]);
    }
    return out;
}

double axis_power(int degrees, const AxisWeights& weights, const double* sums) {
    double power = 0;
    for (int j = 0; j < degrees; ++j) power += weights.w[j] * sums[j];
    return power;
}

double lobe_power(const DepositPlan& deposit, const Mixture& mix, const double* sums,
                  const Direction& to, float most) {
    const double flux = sums[0] * 3.5449077018110320546;  // sqrt(4 pi)
    if (!(flux > 0) || deposit.bands < 2) return flux * 0.079577471545947667884;
    // y_1m is sqrt(3/4pi) times y, z, x.
    const double scale = 2.0466534158929769770 / flux;
    const double x = sums[3] * scale, y = sums[1] * scale, z = sums[2] * scale;
    const double length = __builtin_sqrt(x * x + y * y + z * z);
    const float mean = length < 0.999 ? float(length) : 0.999f;
    const float g = deposit.mode == kDepositOutgoing ? mean : mean * mix.moment(1);
    const double safe = length > 1e-9 ? 1.0 / length : 0.0;
    const float cosine = float((x * double(to.x) + y * double(to.y) + z * double(to.z)) * safe);
    return flux * double(min_(hg_density(g, 1.0f - cosine), most));
}

}  // namespace pileus
