// SPDX-License-Identifier: Apache-2.0
// See glare.h.
// in: a plane -> out: the plane. A Gaussian is three box filters one after the other (Wells 1986,
// "Efficient synthesis of Gaussian filters by cascaded uniform filters"), each a running sum in
// double: the same bits on every machine and for any number of threads.
#include "src/io/images/develop/glare.h"

#include "src/base/buffer.h"

namespace pileus {
namespace {

constexpr std::size_t kColumns = 8;  // at once: they share lines of the cache

/// A place outside is that of its mirror image; the pixel at the edge comes twice.
std::size_t reflected(std::int64_t i, std::int64_t n) {
    if (i >= 0 && i < n) return std::size_t(i);
    const std::int64_t period = 2 * n;
    i %= period;
    if (i < 0) i += period;
    return std::size_t(i < n ? i : period - 1 - i);
}

/// Means over 2 radius + 1 values along kLanes neighbouring lines of `n`, whose values are `step`
/// apart; `line` holds kLanes n of them.
template <std::size_t kLanes>
void box_lines(double* values, std::size_t step, std::int64_t n, std::int64_t radius,
               double* line) {
    for (std::size_t i = 0; i < std::size_t(n); ++i)
        for (std::size_t k = 0; k < kLanes; ++k) line[i * kLanes + k] = values[i * step + k];
    double sum[kLanes] = {};
    for (std::int64_t i = -radius; i <= radius; ++i)
        for (std::size_t k = 0; k < kLanes; ++k) sum[k] += line[reflected(i, n) * kLanes + k];
    const double scale = 1 / double(2 * radius + 1);
    for (std::int64_t i = 0; i < n; ++i) {
        const double* const next = line + reflected(i + radius + 1, n) * kLanes;
        const double* const last = line + reflected(i - radius, n) * kLanes;
        double* const to = values + std::size_t(i) * step;
        for (std::size_t k = 0; k < kLanes; ++k) {
            to[k] = sum[k] > 0 ? sum[k] * scale : 0;
            sum[k] += next[k] - last[k];
        }
    }
}

/// Radius of three boxes whose variances together are that of the Gaussian, to the nearest pixel.
std::int64_t box_radius(double sigma) {
    std::int64_t r = 0;
    // Variance of a box of 2r + 1: r(r + 1)/3.
    while (double(r + 1) * double(r + 1) <= sigma * sigma) ++r;
    return r;
}

}  // namespace

Status add_glare(int width, int height, double side, double share, Span<float> plane) {
    Buffer<double> sum, blurred, line;
    const std::size_t w = std::size_t(width), h = std::size_t(height);
    PILEUS_TRY(sum.resize(plane.size, "glare"));
    PILEUS_TRY(blurred.resize(plane.size, "glare"));
    PILEUS_TRY(line.resize(w > kColumns * h ? w : kColumns * h, "glare"));
    for (const double part : {256.0, 64.0, 16.0, 4.0}) {
        const std::int64_t radius = box_radius(side / part);
        for (std::size_t i = 0; i < plane.size; ++i) {
            const float v = plane.data[i];
            blurred[i] = v > 0 && v <= 3.402823466e38f ? double(v) : 0;
        }
        for (int pass = 0; pass < 3 && radius > 0; ++pass) {
            for (std::size_t y = 0; y < h; ++y)
                box_lines<1>(blurred.data() + y * w, 1, width, radius, line.data());
            std::size_t x = 0;
            for (; x + kColumns <= w; x += kColumns)
                box_lines<kColumns>(blurred.data() + x, w, height, radius, line.data());
            for (; x < w; ++x) box_lines<1>(blurred.data() + x, w, height, radius, line.data());
        }
        for (std::size_t i = 0; i < plane.size; ++i) sum[i] += blurred[i] / 4;
    }
    for (std::size_t i = 0; i < plane.size; ++i) {
        float& v = plane.data[i];
        if (v >= 0 && v <= 3.402823466e38f) v = float((1 - share) * double(v) + share * sum[i]);
    }
    return Status::ok();
}

}  // namespace pileus
