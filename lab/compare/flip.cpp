// SPDX-License-Identifier: Apache-2.0
// FLIP of two pictures: exposures, tone curve, and the difference of what an eye sees of each.
// in: two pictures -> out: FlipResult, the same bits from any number of threads.
// Andersson et al. 2020, section 4.3; Andersson et al. 2021, sections 3 and 4; docs/compare.md
#include "lab/compare/flip.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lab/compare/flip_filters.h"
#include "lab/compare/metrics.h"
#include "platform/threads.h"
#include "src/base/powers.h"
#include "src/io/images/image_file.h"

namespace pileus {

namespace {

constexpr int kBandRows = 64;
constexpr float kLargest = 3.402823466e38f;
/// The darkest median that exposures are chosen for: the published code's least float step.
constexpr double kDarkest = 1.0 / 8388608.0;

/// (k0 x^2 + k1 x + k2)/(k3 x^2 + k4 x + k5); Reinhard's divides by 1 + luminance instead.
struct ToneCurve {
    double k[6];
    bool by_luminance;
};

ToneCurve tone_curve_of(FlipTone tone) {
    if (tone == FlipTone::kHable) return {{0.231683, 0.013791, 0, 0.18, 0.3, 0.018}, false};
    if (tone == FlipTone::kReinhard) return {{0, 1, 0, 0, 1, 1}, true};
    // Narkowicz' fit of ACES with its exposure of 0.6 taken back.
    return {{0.36 * 2.51, 0.6 * 0.03, 0, 0.36 * 2.43, 0.6 * 0.59, 0.14}, false};
}

double luminance_of(const double (&rgb)[3]) {
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

double unit(double v) { return v < 0 ? 0 : v > 1 ? 1 : v; }

/// Light at an exposure as a display shows it.
void display(const ToneCurve& curve, double gain, double (&rgb)[3]) {
    for (double& v : rgb) v *= gain;
    const double y = luminance_of(rgb);
    for (double& v : rgb) {
        const double* k = curve.k;
        v = unit(curve.by_luminance
                     ? v / (1 + y)
                     : ((k[0] * v + k[1]) * v + k[2]) / ((k[3] * v + k[4]) * v + k[5]));
    }
}

/// The larger x at which the curve reaches 0.85: brighter light is hard to tell apart.
double bright_end(const ToneCurve& curve) {
    const double* k = curve.k;
    const double a = k[0] - 0.85 * k[3], b = k[1] - 0.85 * k[4], c = k[2] - 0.85 * k[5];
    if (!(a < 0 || a > 0)) return -c / b;
    const double half = -0.5 * (b / a);
    return half + std::sqrt(half * half - c / a);
}

/// Light of one picture, without what no eye can be shown.
struct ShownLight {
    const float* plane[3] = {};

    static double clean(float v) {
        if (!(v > 0)) return 0;  // NaN too
        return double(v > kLargest ? kLargest : v);
    }
    void at(std::size_t i, double (&rgb)[3]) const {
        for (int c = 0; c < 3; ++c) rgb[c] = clean(plane[c][i]);
    }
};

Status find_light(const Image& image, ShownLight& light) {
    const Channel* rgb[3];
    PILEUS_TRY(check_image(image));
    PILEUS_TRY(color_channels(image, rgb));
    for (int c = 0; c < 3; ++c) light.plane[c] = rgb[c]->pixels.data();
    return Status::ok();
}

/// From where the brightest pixel nears white to where the median does, a stop apart at most.
Status choose_exposures(const ShownLight& reference, std::size_t pixels, const ToneCurve& curve,
                        FlipResult& result) {
    Buffer<double> buffer;
    PILEUS_TRY(buffer.resize(pixels, "luminances"));
    const Span<double> y = buffer.span();
    double brightest = kDarkest;
    for (std::size_t i = 0; i < pixels; ++i) {
        double rgb[3];
        reference.at(i, rgb);
        y[i] = luminance_of(rgb);
        brightest = y[i] > brightest ? y[i] : brightest;
    }
    std::nth_element(y.begin(), y.begin() + pixels / 2, y.end());
    const double median = std::max(y[pixels / 2], kDarkest), end = bright_end(curve);
    result.start = log2_of(end / brightest);
    result.stop = log2_of(end / median);
    result.exposures = std::max(2, int(std::ceil(log2_of(brightest / median))));
    return Status::ok();
}

/// Greatest distance of two colours, that of green from blue, and the law that maps distances to
/// [0, 1]: small ones (up to 0.4 of the greatest) share [0, 0.95].
struct ColourLaw {
    double greatest;
    ColourLaw() : greatest(power_of(hyab(flip_colour(0, 1, 0), flip_colour(0, 0, 1)), 0.7)) {}
    double operator()(double distance) const {
        const double d = power_of(distance, 0.7), knee = 0.4 * greatest;
        return d < knee ? d * (0.95 / knee) : 0.95 + (d - knee) / (greatest - knee) * 0.05;
    }
};

/// Features raise a difference of colour, as they draw the eye.
double flip_value(const ColourLaw& law, const FlipPixel& p, const FlipPixel& q) {
    const double edge = std::fabs(p.edge - q.edge), point = std::fabs(p.point - q.point);
    const double feature = std::sqrt(std::max(edge, point) * 0.70710678118654752440);
    return power_of(law(hyab(p, q)), 1 - feature);
}

/// What one thread works with.
struct Worker {
    FlipBand bands[2];
    std::vector<FlipPixel> pixels[2];
};

/// One exposure of all rows; keeps the larger value of each pixel.
void add_exposure(const ShownLight (&light)[2], const FlipOptions& options, const ToneCurve& curve,
                  double gain, std::vector<Worker>& workers, FlipResult& result) {
    const ColourLaw law;
    const int width = result.width, height = result.height;
    auto band = [&](std::int64_t piece, int thread) {
        Worker& worker = workers[std::size_t(thread)];
        const int begin = int(piece) * kBandRows, end = std::min(begin + kBandRows, height);
        for (int n = 0; n < 2; ++n)
            worker.bands[n].load(height, begin, end, [&](int y, double* out) {
                for (int x = 0; x < width; ++x) {
                    double rgb[3];
                    light[n].at(std::size_t(y) * std::size_t(width) + std::size_t(x), rgb);
                    if (options.hdr) display(curve, gain, rgb);
                    for (int c = 0; c < 3; ++c) out[c * width + x] = unit(rgb[c]);
                }
            });
        for (int y = begin; y < end; ++y) {
            for (int n = 0; n < 2; ++n) worker.bands[n].view(y, worker.pixels[n].data());
            float* out = result.value.data() + std::size_t(y) * std::size_t(width);
            for (std::size_t x = 0; x < std::size_t(width); ++x)
                out[x] = std::max(out[x],
                                  float(flip_value(law, worker.pixels[0][x], worker.pixels[1][x])));
        }
    };
    parallel_for(options.threads, (height + kBandRows - 1) / kBandRows, band);
}

/// Mean over rows, the largest value and the percentile by nearest rank.
Status pool(FlipResult& result) {
    const std::size_t pixels = result.value.size(), width = std::size_t(result.width);
    double sum = 0;
    for (std::size_t begin = 0; begin < pixels; begin += width) {
        double row = 0;
        for (std::size_t i = begin; i < begin + width; ++i) row += double(result.value[i]);
        sum += row;
    }
    result.mean = sum / double(pixels);
    Buffer<float> sorted;
    PILEUS_TRY(sorted.resize(pixels, "FLIP values"));
    std::copy(result.value.data(), result.value.data() + pixels, sorted.data());
    const std::size_t rank = (99 * pixels + 99) / 100 - 1;
    std::nth_element(sorted.data(), sorted.data() + rank, sorted.data() + pixels);
    result.percentile_99 = double(sorted[rank]);
    result.largest = double(*std::max_element(sorted.data() + rank, sorted.data() + pixels));
    return Status::ok();
}

}  // namespace

Status flip(const Image& a, const Image& reference, const FlipOptions& options,
            FlipResult& result) {
    result = FlipResult();
    if (!(options.pixels_per_degree >= 1 && options.pixels_per_degree <= 1000))
        return Status::bad_input("FLIP: pixels per degree: out of range, allowed: 1 to 1000");
    ShownLight light[2];
    PILEUS_TRY(find_light(a, light[0]));
    PILEUS_TRY(find_light(reference, light[1]));
    PILEUS_TRY(check_same_size("FLIP", a, reference));
    result.width = a.width;
    result.height = a.height;
    const std::size_t pixels = std::size_t(a.width) * std::size_t(a.height);
    PILEUS_TRY(result.value.resize(pixels, "FLIP values"));
    for (const ShownLight& one : light)
        for (const float* plane : one.plane)
            for (std::size_t i = 0; i < pixels; ++i)
                result.not_finite += std::isfinite(plane[i]) ? 0 : 1;

    FlipOptions chosen = options;
    if (chosen.threads < 1) chosen.threads = hardware_threads();
    const FlipFilters filters = make_flip_filters(options.pixels_per_degree);
    std::vector<Worker> workers(std::size_t(chosen.threads));
    for (Worker& worker : workers)
        for (int n = 0; n < 2; ++n) {
            PILEUS_TRY(worker.bands[n].resize(a.width, std::min(kBandRows, a.height), filters));
            worker.pixels[n].resize(std::size_t(a.width));
        }

    const ToneCurve curve = tone_curve_of(options.tone);
    if (options.hdr) PILEUS_TRY(choose_exposures(light[1], pixels, curve, result));
    for (int i = 0; i < result.exposures; ++i) {
        const double share = result.exposures > 1 ? double(i) / (result.exposures - 1) : 0;
        const double gain = exp2_of(result.start + share * (result.stop - result.start));
        add_exposure(light, chosen, curve, gain, workers, result);
    }
    return pool(result);
}

}  // namespace pileus
