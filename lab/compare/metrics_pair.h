// SPDX-License-Identifier: Apache-2.0
// Two pictures laid side by side: their channels, error layers, and which pixels count.
// in: a picture and its reference -> out: planes that point into them.
// docs/compare.md
#pragma once
#include <cmath>
#include <cstddef>

#include "src/base/buffer.h"
#include "src/base/status.h"
#include "src/io/images/image.h"

namespace pileus {

/// What is compared, as planes; a missing layer is null.
struct PicturePair {
    int width = 0, height = 0;
    const float* a[3] = {};
    const float* r[3] = {};
    const float* a_error[3] = {};
    const float* r_error[3] = {};
    const double* smooth[3] = {};  ///< of smooth_squares, or null
    const float* alpha = nullptr;
    double alpha_least = 0;

    std::size_t pixels() const { return std::size_t(width) * std::size_t(height); }
    bool in_cloud(std::size_t i) const {
        return alpha == nullptr || alpha_least < 0 || double(alpha[i]) > alpha_least;
    }
    bool finite(std::size_t i) const {
        for (int c = 0; c < 3; ++c) {
            if (!std::isfinite(a[c][i]) || !std::isfinite(r[c][i])) return false;
            if (a_error[c] != nullptr && !std::isfinite(a_error[c][i])) return false;
            if (r_error[c] != nullptr && !std::isfinite(r_error[c][i])) return false;
        }
        return true;
    }
    bool counted(std::size_t i) const { return in_cloud(i) && finite(i); }
    /// a - r of a channel.
    double difference(int c, std::size_t i) const { return double(a[c][i]) - double(r[c][i]); }
    /// What a squared difference is measured against: r^2, smooth where the reference is noisy.
    double square(int c, std::size_t i) const {
        return smooth[c] != nullptr ? smooth[c][i] : double(r[c][i]) * double(r[c][i]);
    }
    /// se_a^2 + se_r^2 of a channel; a layer that is not there adds nothing.
    double variance(int c, std::size_t i) const {
        const double ea = a_error[c] != nullptr ? double(a_error[c][i]) : 0;
        const double er = r_error[c] != nullptr ? double(r_error[c][i]) : 0;
        return ea * ea + er * er;
    }
};

/// Finds R G B (or Y), alpha of the reference, and error layers (all three or none). Different
/// sizes or missing channels: kBadInput. The planes live as long as the pictures.
Status pair_pictures(const Image& a, const Image& reference, double alpha_least, PicturePair& pair);

/// The planes of smooth_squares, one after the other.
struct SmoothSquares {
    Buffer<double> planes;
};

/// Fills `smooth` and points `pair.smooth` into it: the mean of half1 * half2 over the counted
/// pixels of the 5 x 5 around each, itself left out, per channel, never below 0. A product of
/// independent halves holds no noise squared, the mean of 24 hardly any noise, and none that the
/// pixel's own difference shares: so 1/r^2 neither grows nor leans by it.
/// Sizes and channels as merge_halves found them; memory: kLimit. docs/compare.md
Status smooth_squares(const Image& half1, const Image& half2, PicturePair& pair,
                      SmoothSquares& smooth);

/// Calls `add(pixel, row)` for every counted pixel, rows from the top.
template <class Function>
void each_counted(const PicturePair& pair, Function&& add) {
    for (int y = 0; y < pair.height; ++y)
        for (int x = 0; x < pair.width; ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(pair.width) + std::size_t(x);
            if (pair.counted(i)) add(i, y);
        }
}

}  // namespace pileus
