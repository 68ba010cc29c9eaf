// SPDX-License-Identifier: Apache-2.0
// Standard errors of a picture's pixels: their own scatter, steadied by that of the pixels around.
// in: variances of pixels' means, their light -> out: standard errors, their mean over the media.
// docs/methods.md, "The error of a pixel"
#pragma once
#include <cstddef>
#include <vector>

namespace pileus {

/// Distances from here on are no solid thing's.
constexpr float kNothingSolid = 3e38f;

/// Mean of standard error / light and of squared errors over the pixels with A > 0.02, by green.
struct ErrorSum {
    double relative = 0, square = 0, count = 0;

    /// `light`: of the pixel and those around, as a dark pixel of few samples is dark by luck.
    void add(float transmittance, float error, float light) {
        if (1.0f - transmittance <= 0.02f) return;
        const double e = double(error), l = double(light);
        relative += l > 0 ? e / l : 0;
        square += e * e;
        count += 1;
    }
    void add(const ErrorSum& more) {
        relative += more.relative, square += more.square, count += more.count;
    }
    /// 0 where there is no such pixel.
    double mean_relative() const { return count > 0 ? relative / count : 0; }
    double rms() const { return count > 0 ? __builtin_sqrt(square / count) : 0; }
};

/// Pixels that may speak for one another: those that show media, before the sky or before something
/// solid, those that hardly do, and those of what is solid. Those of the sky alone speak for
/// themselves.
struct PixelGroups {
    int width = 0, height = 0;
    const float* transmittance = nullptr;  ///< [pixel]
    const float* opaque_depth = nullptr;   ///< [pixel]; infinity for the sky; null: sky alone

    static constexpr int kSky = 0, kCount = 5;
    int of(std::size_t i) const;
};

/// What variances are of. Few bright paths make light of samples, so that those without one look
/// calmer than they are; sums of photons are nearly normal.
enum class Scatter { kSamples, kBatches };

/// Of one pixel: its standard error, and the mean light of its group around.
struct PixelError {
    float error = 0, light = 0;
};

/// Three rows of variances and light, of which those around a pixel are means.
class ErrorRows {
public:
    /// `count`: how many samples or batches each variance comes from.
    ErrorRows(const PixelGroups& groups, Scatter of, double count);

    /// Calls use(pixel, PixelError) for rows `first` to `last` - 1, row by row. variance(pixel) is
    /// that of the mean of a pixel's samples, light(pixel) that mean.
    template <class Variance, class Light, class Use>
    void run(int first, int last, Variance variance, Light light, Use use) {
        const auto fill = [&](int y) {
            const std::size_t row = std::size_t(y) * width_, at = std::size_t(y % 3) * width_;
            for (std::size_t x = 0; x < width_; ++x) {
                variance_[at + x] = float(variance(row + x));
                light_[at + x] = float(light(row + x));
                group_[at + x] = groups_.of(row + x);
            }
        };
        for (int y = first > 0 ? first - 1 : 0; y <= first && y < groups_.height; ++y) fill(y);
        for (int y = first; y < last; ++y) {
            if (y + 1 < groups_.height) fill(y + 1);
            for (int x = 0; x < groups_.width; ++x)
                use(std::size_t(y) * width_ + std::size_t(x), at(x, y));
        }
    }

private:
    PixelError at(int x, int y) const;

    const PixelGroups& groups_;
    const double freedom_, samples_each_;
    const std::size_t width_;
    std::vector<float> variance_, light_;
    std::vector<int> group_;
};

/// Of errors that are known, [pixel], beside the light of their pixels.
ErrorSum sum_errors(const PixelGroups& groups, const float* error, const float* light);

}  // namespace pileus
