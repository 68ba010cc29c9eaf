// SPDX-License-Identifier: Apache-2.0
// What media scatter of the light that sums of photons stand for, towards one direction.
// in: sums of one light at one place, media mixed there -> out: power per steradian.
// docs/methods.md 3, each image frame, step 4.
#pragma once
#include "kernels_cpu/core/sh.h"
#include "kernels_cpu/media/phase.h"
#include "src/photons/trace.h"

namespace pileus {

/// Degrees beyond the bands that a phase function still sends on, as far as they were asked for.
int useful_axis_degrees(const Medium& medium, int bands, int wanted);

/// What the sinc window multiplies each band by.
struct Window {
    float factor[kMaxBands];
};
Window band_window(int bands, bool sinc);

/// All media of one place as one, in one channel: albedo, and whose phase function how much of
/// the scattered light follows. One medium has weight 1, to the bit.
struct Mixture {
    float albedo = 0;
    float weight[kMaxMedia] = {};
    const Medium* medium = nullptr;
    const DepositPlan* apart = nullptr;  ///< turns within the peak do not count; null: all do

    float moment(int l) const {
        float sum = 0;
        for (int i = 0; i < medium->count; ++i) {
            const float all = phase_moment(medium->optics[std::size_t(i)].phase, l);
            sum += weight[i] * (apart != nullptr ? all - apart->kept[i][l] : all);
        }
        return sum;
    }
    float density(float one_minus_cos) const {
        float sum = 0;
        for (int i = 0; i < medium->count; ++i)
            sum += weight[i] * phase_density(medium->optics[std::size_t(i)].phase, one_minus_cos);
        return sum;
    }
};

/// Of one set of sums: bands, degrees about axes, the first order.
constexpr int kMaxNumbers = kMaxPacked + 1;
using Direction = Vec<float>;

/// What multiplies the sums of one place and channel towards `to`: the same for all slots.
struct BandWeights {
    double y[kMaxBands * kMaxBands], factor[kMaxBands];
};
BandWeights band_weights(const DepositPlan& deposit, const Window& window, const Mixture& mix,
                         const Direction& to);

/// Power per steradian and unit light scattered that way, from all bands.
double sh_power(int bands, const BandWeights& weights, const double* sums);

/// What multiplies the sums of degrees beyond the bands, of light spread evenly around a direction,
/// `sun`: sum_l (2l+1)/4pi chi_l m_l P_l(cosine), m_l the sum of P_l over the light.
struct AxisWeights {
    double w[kMaxAxisDegrees];
};
AxisWeights axis_weights(const DepositPlan& deposit, const Mixture& mix, const Direction& sun,
                         const Direction& to);
double axis_power(int degrees, const AxisWeights& weights, const double* sums);

/// The same from flux and mean direction alone: one HG lobe (docs/methods.md 3, closure `lobe`).
/// `most`: of a phase function's mean, 1/sr (most_density).
double lobe_power(const DepositPlan& deposit, const Mixture& mix, const double* sums,
                  const Direction& to, float most);

}  // namespace pileus
