// SPDX-License-Identifier: Apache-2.0
// See pixel_errors.h.
#include "src/picture/errors/pixel_errors.h"

namespace pileus {
namespace {

/// What the pixels around count for, in independent differences: measured by which share of pixels
/// is within one error and two.
constexpr double kAround = 4;
/// (light / error)^2 bright paths would have that error if all were alike and nothing else brought
/// light; so many of them count for one independent difference.
constexpr double kSamplesEach = 256;

}  // namespace

int PixelGroups::of(std::size_t i) const {
    const float alpha = 1.0f - transmittance[i];
    const bool solid = opaque_depth != nullptr && opaque_depth[i] < kNothingSolid;
    if (alpha > 0.02f) return solid ? 4 : 2;
    return solid ? 3 : alpha > 0 ? 1 : kSky;
}

ErrorRows::ErrorRows(const PixelGroups& groups, Scatter of, double count)
    : groups_(groups),
      freedom_(count - 1),
      samples_each_(of == Scatter::kSamples ? kSamplesEach : 0),
      width_(std::size_t(groups.width)),
      variance_(3 * width_),
      light_(3 * width_),
      group_(3 * width_) {}

PixelError ErrorRows::at(int x, int y) const {
    const std::size_t own = std::size_t(y % 3) * width_ + std::size_t(x);
    if (group_[own] == PixelGroups::kSky)
        return {float(__builtin_sqrt(double(variance_[own]))), light_[own]};
    double variance = 0, light = 0, count = 0;
    for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < groups_.height; ++v)
        for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < groups_.width; ++u) {
            const std::size_t i = std::size_t(v % 3) * width_ + std::size_t(u);
            if (group_[i] != group_[own]) continue;
            variance += double(variance_[i]), light += double(light_[i]), count += 1;
        }
    variance /= count, light /= count;
    if (!(variance > 0)) return {0, float(light)};
    double own_weight = freedom_;
    if (light * light < own_weight * variance * samples_each_)
        own_weight = light * light / (variance * samples_each_);
    const double around = kAround / (kAround + own_weight);
    const double mixed = around * variance + (1 - around) * double(variance_[own]);
    return {float(__builtin_sqrt(mixed)), float(light)};
}

ErrorSum sum_errors(const PixelGroups& groups, const float* error, const float* light) {
    ErrorSum sum;
    ErrorRows rows(groups, Scatter::kBatches, 1);
    // What the rows add is the light around.
    rows.run(
        0, groups.height, [](std::size_t) { return 0.0f; }, [&](std::size_t i) { return light[i]; },
        [&](std::size_t i, const PixelError& around) {
            sum.add(groups.transmittance[i], error[i], around.light);
        });
    return sum;
}

}  // namespace pileus
