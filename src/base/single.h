// SPDX-License-Identifier: Apache-2.0
// What single precision can hold: the one place that decides it for numbers given as doubles.
// in: a number of a scene, a file or a host -> out: the number as it is used; least lengths.
// docs/scene.md, "Small numbers"
#pragma once
#include "src/base/vectors.h"

namespace pileus {

/// Nearer to 0 floats lose digits, and at last all of them.
constexpr double kMinSingle = 0x1p-126;

/// The number as it is used: what a float cannot tell from 0 with all its digits is 0.
constexpr double single_or_0(double v) { return v > -kMinSingle && v < kMinSingle ? 0 : v; }
constexpr float single_or_0(float v) {
    return v > -float(kMinSingle) && v < float(kMinSingle) ? 0 : v;
}
inline Double3 single_or_0(const Double3& v) {
    return {single_or_0(v.x), single_or_0(v.y), single_or_0(v.z)};
}

/// Least of a length or factor that must not be 0: squares and cubes of it are held, too.
constexpr double kMinPositive = 1e-9;

/// Narrower, and all rays of a picture would be one.
constexpr double kMinFovDeg = 1e-6;

/// Least width of what lies between two places along an axis, so that both are told apart as
/// floats: two of their steps.
constexpr double least_width(double low, double high) {
    const double a = low < 0 ? -low : low, b = high < 0 ? -high : high;
    const double far = 0x1p-22 * (a > b ? a : b);
    return far > kMinPositive ? far : kMinPositive;
}

/// Least distance between two points whose direction counts: what doubles lose of it turns it by
/// less than 1e-6.
inline double least_distance(const Double3& a, const Double3& b) {
    double most = 0;
    for (const double v : {a.x, a.y, a.z, b.x, b.y, b.z}) {
        const double size = v < 0 ? -v : v;
        most = size > most ? size : most;
    }
    const double far = 0x1p-32 * most;
    return far > kMinPositive ? far : kMinPositive;
}

/// Most extinction where a medium is densest, 1/m: optical depths through any box are numbers.
constexpr double kMaxSigma = 1e24;
/// Less extinction than this, or optical depth through a whole box, is none.
constexpr double kMinSigma = 0x1p-100;

}  // namespace pileus
