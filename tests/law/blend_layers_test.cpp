// SPDX-License-Identifier: Apache-2.0
// What one layer takes of the light and leaves, against double precision.
// in: optical depths -> out: largest relative errors.
// docs/methods.md 3, each image frame, step 5.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels_cpu/display/blend.h"

using namespace pileus;

namespace {
constexpr float kInfinity = std::numeric_limits<float>::infinity();
}

TEST_CASE("blend: what a layer takes and leaves is right to 2^-22 at every depth") {
    double worst_taken = 0, worst_after = 0;
    for (int i = 0; i <= 87 * 1024; ++i) {
        const float depth = float(i) / 1024.0f;
        const Attenuated<float> a = attenuate(1.0f, depth);
        const double taken = -std::expm1(-double(depth)), after = std::exp(-double(depth));
        if (i > 0) worst_taken = std::max(worst_taken, std::fabs(double(a.taken) / taken - 1));
        worst_after = std::max(worst_after, std::fabs(double(a.after) / after - 1));
    }
    MESSAGE("largest relative errors: taken ", worst_taken, ", after ", worst_after);
    CHECK(worst_taken <= 0x1p-22);
    CHECK(worst_after <= 0x1p-22);
    CHECK(attenuate(1.0f, 88.0f).after == 0.0f);
    CHECK(attenuate(1.0f, kInfinity).after == 0.0f);
    CHECK(attenuate(1.0f, kInfinity).taken == 1.0f);
}

TEST_CASE(
    "blend: the shares of thinner layers are right to 2^-22, and never leave less than none") {
    // What is left is before - taken, whose error is that of the share and one rounding of 1.
    double worst_taken = 0, worst_after = 0;
    for (int doublings = 0; doublings <= kMaxDoublings; ++doublings)
        for (int i = 1; i <= 4096; ++i) {
            const float part = kThinLayer * float(i) / 4096.0f;
            const double depth = std::ldexp(double(part), doublings);
            const Attenuated<float> a = take_layer(1.0f, part, doublings);
            const double taken = -std::expm1(-depth);
            worst_taken = std::max(worst_taken, std::fabs(double(a.taken) / taken - 1));
            worst_after = std::max(worst_after, std::fabs(double(a.after) - std::exp(-depth)));
            if (a.after < 0.0f || a.after > 1.0f) CHECK(a.after == 0.5f);
        }
    MESSAGE("largest errors: share, relative ", worst_taken, ", left ", worst_after);
    CHECK(worst_taken <= 0x1p-22);
    CHECK(worst_after <= 0x1p-22);
    CHECK(take_layer(0.25f, 0.0f, 3).taken == 0.0f);
    CHECK(take_layer(0.25f, 0.0f, 3).after == 0.25f);
}
