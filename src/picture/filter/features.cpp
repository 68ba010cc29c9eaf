// SPDX-License-Identifier: Apache-2.0
// See features.h.
#include "src/picture/filter/features.h"

#include "kernels_cpu/core/math.h"
#include "platform/threads.h"
#include "src/picture/filter/guides.h"

namespace pileus {
namespace {

constexpr float kMinWeighed = 0.02f;
/// Of the ground's light: its noise where nothing is before it, of that in half shadow.
constexpr float kBareNoise = 0.05f;
constexpr float kDarkest = 1e-37f;  // less of the sun than this is no number of its own

/// Calls fill(pixel, features) for pixels that `mine` takes; the others have weight 0.
template <class Mine, class Fill>
void fill_features(const RegressionInput& in, float* out, Mine mine, Fill fill) {
    parallel_for(in.threads, in.height, [&](std::int64_t y, int) {
        for (int x = 0; x < in.width; ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(in.width) + std::size_t(x);
            float* f = out + i * kFilterStored;
            for (int k = 0; k < kFilterStored; ++k) f[k] = 0;
            if (mine(i) && (in.fold < 0 || in.fold == filter_fold(x, y)))
                fill(i, f, (float(x) - 0.5f * float(in.width)) / float(in.width),
                     (float(y) - 0.5f * float(in.height)) / float(in.width));
        }
    });
}

}  // namespace

void media_features(const RegressionInput& in, bool opaque, float* out) {
    const std::size_t pixels = std::size_t(in.width) * std::size_t(in.height);
    const auto mine = [&](std::size_t i) {
        const bool solid = in.opaque_depth != nullptr && in.opaque_depth[i] < kNothingSolid;
        return solid == opaque && 1.0f - in.transmittance[i] > 0.0f;
    };
    fill_features(in, out, mine, [&](std::size_t i, float* f, float x, float y) {
        const float alpha = 1.0f - in.transmittance[i];
        f[0] = alpha;
        f[1] = log_(1.0f + in.optical_depth[i]);
        for (int g = 0; g < 3; ++g) f[2 + g] = in.guides[std::size_t(g) * pixels + i];
        f[5] = alpha * x;
        f[6] = alpha * y;
        f[7] = 1.0f / (alpha + kMinWeighed);
    });
}

void ground_features(const RegressionInput& in, float* out) {
    const auto mine = [&](std::size_t i) {
        return in.opaque_depth[i] < kNothingSolid && in.transmittance[i] > 0.0f;
    };
    fill_features(in, out, mine, [&](std::size_t i, float* f, float x, float y) {
        const float seen = in.transmittance[i], sun = in.sun_on_ground[i];
        const float depth = -log_(sun > kDarkest ? sun : kDarkest);
        f[0] = seen;
        f[1] = seen * sun;
        for (int g = 0; g < kGuidePlanes - 1; ++g) f[2 + g] = seen * exp_(-kGuideShares[g] * depth);
        f[4] = seen * x;
        f[5] = seen * y;
        // A path gets through the media or it does not: its noise is that of a coin.
        f[7] = 1.0f / (seen * (1.0f + kBareNoise - seen) + kMinWeighed);
    });
}

}  // namespace pileus
