// SPDX-License-Identifier: Apache-2.0
// The filters of FLIP, separated into passes along x and y, in double.
// in: rows of light -> out: adjusted colours, edges and points.
// Andersson et al. 2020: table 1 (contrast sensitivity), equations 3 to 10; docs/compare.md
#include "lab/compare/flip_filters.h"

#include <algorithm>
#include <cmath>

#include "src/base/angles.h"
#include "src/base/powers.h"

namespace pileus {

namespace {

constexpr double kLog2e = 1.44269504088896340736;
/// White point D65 as FLIP states it.
constexpr double kWhite[3] = {0.950428545, 1.0, 1.088900371};
/// Width of an edge, in degrees.
constexpr double kFeatureWidth = 0.082;

/// Rec. 709 to CIE XYZ, exact fractions.
constexpr double kToXyz[3][3] = {
    {10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
    {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
    {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}};
constexpr double kFromXyz[3][3] = {{3.241003275, -1.537398934, -0.498615861},
                                   {-0.969224334, 1.875930071, 0.041554224},
                                   {0.055639423, -0.204011202, 1.057148933}};

/// Light relative to white: X/Xn, Y/Yn, Z/Zn.
void relative_xyz(const double (&rgb)[3], double (&xyz)[3]) {
    for (int i = 0; i < 3; ++i)
        xyz[i] =
            (kToXyz[i][0] * rgb[0] + kToXyz[i][1] * rgb[1] + kToXyz[i][2] * rgb[2]) / kWhite[i];
}

/// CIELAB's compression: a cube root with a straight foot.
double compress(double t) {
    constexpr double delta = 6.0 / 29.0;
    return t > delta * delta * delta ? cube_root(t) : t / (3 * delta * delta) + 4.0 / 29.0;
}

/// Sensitivity of an eye to contrast as a Gaussian over distance in degrees, up to a factor.
double sensitivity(double x, double b) { return exp2_of(-kPi64 * kPi64 * x * x / b * kLog2e); }

void divide(std::vector<double>& weights, double sum) {
    for (double& w : weights) w /= sum;
}

double sum_of(const std::vector<double>& weights) {
    double sum = 0;
    for (double w : weights) sum += w;
    return sum;
}

/// Scales positive weights to a sum of 1 and negative ones to -1.
void balance(std::vector<double>& weights) {
    double up = 0, down = 0;
    for (double w : weights) (w > 0 ? up : down) += std::fabs(w);
    for (double& w : weights) w /= w > 0 ? up : down;
}

void make_feature_filters(double pixels_per_degree, FlipFilters& f) {
    const double deviation = 0.5 * kFeatureWidth * pixels_per_degree;
    f.feature_radius = int(std::ceil(3 * deviation));
    for (int x = -f.feature_radius; x <= f.feature_radius; ++x) {
        const double t = x / deviation, g = exp2_of(-0.5 * t * t * kLog2e);
        f.smooth.push_back(g);
        f.edge.push_back(-x * g);
        f.point.push_back((t * t - 1) * g);
    }
    divide(f.smooth, sum_of(f.smooth));
    balance(f.edge);
    balance(f.point);
}

/// Adds two taps whose weights are equal (mirror 1) or opposite (mirror -1).
void add_taps(const double* before, const double* after, double mirror, double weight,
              std::size_t count, double* sum) {
    for (std::size_t x = 0; x < count; ++x) sum[x] += weight * (after[x] + mirror * before[x]);
}

}  // namespace

FlipFilters make_flip_filters(double pixels_per_degree) {
    constexpr double kY = 0.0047, kCx = 0.0053, kCz1 = 0.04, kCz2 = 0.025;
    constexpr double kAmount1 = 34.1, kAmount2 = 13.5;
    FlipFilters f;
    f.spatial_radius =
        int(std::ceil(3 * std::sqrt(kCz1 / (2 * kPi64 * kPi64)) * pixels_per_degree));
    // Each Gaussian of Cz is a product of two along x and y: give either the root of its amount.
    const double root1 = std::sqrt(kAmount1 * std::sqrt(kPi64 / kCz1));
    const double root2 = std::sqrt(kAmount2 * std::sqrt(kPi64 / kCz2));
    for (int i = -f.spatial_radius; i <= f.spatial_radius; ++i) {
        const double x = i / pixels_per_degree;
        f.y.push_back(sensitivity(x, kY));
        f.cx.push_back(sensitivity(x, kCx));
        f.cz1.push_back(root1 * sensitivity(x, kCz1));
        f.cz2.push_back(root2 * sensitivity(x, kCz2));
    }
    divide(f.y, sum_of(f.y));
    divide(f.cx, sum_of(f.cx));
    const double s1 = sum_of(f.cz1), s2 = sum_of(f.cz2), both = std::sqrt(s1 * s1 + s2 * s2);
    divide(f.cz1, both);
    divide(f.cz2, both);
    make_feature_filters(pixels_per_degree, f);
    return f;
}

FlipPixel flip_colour(double r, double g, double b) {
    const double rgb[3] = {r, g, b};
    double xyz[3];
    relative_xyz(rgb, xyz);
    const double x = compress(xyz[0]), y = compress(xyz[1]), z = compress(xyz[2]);
    const double lightness = 116 * y - 16;
    // Colours of dark light seem less colourful (Hunt).
    return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z), 0, 0};
}

double hyab(const FlipPixel& p, const FlipPixel& q) {
    const double da = p.a - q.a, db = p.b - q.b;
    return std::fabs(p.lightness - q.lightness) + std::sqrt(da * da + db * db);
}

Status FlipBand::resize(int width, int rows, const FlipFilters& filters) {
    filters_ = &filters;
    width_ = width;
    const std::uint64_t w = std::uint64_t(width), halo = std::uint64_t(filters.halo());
    PILEUS_TRY(rgb_.resize(3 * w, "FLIP row"));
    PILEUS_TRY(ycc_.resize(3 * (w + 2 * halo), "FLIP row"));
    PILEUS_TRY(rows_.resize(7 * w * (std::uint64_t(rows) + 2 * halo), "FLIP band"));
    return sums_.resize(8 * w, "FLIP row");
}

void FlipBand::filter_row(int slot) {
    const int halo = filters_->halo();
    const std::size_t w = std::size_t(width_), stride = w + 2 * std::size_t(halo);
    // Opponent colours, linear in light: luminance, red-green, yellow-blue.
    double* ycc = ycc_.data();
    for (std::size_t x = 0; x < w; ++x) {
        const double rgb[3] = {rgb_[x], rgb_[w + x], rgb_[2 * w + x]};
        double xyz[3];
        relative_xyz(rgb, xyz);
        double* at = ycc + std::size_t(halo) + x;
        at[0] = 116 * xyz[1] - 16;
        at[stride] = 500 * (xyz[0] - xyz[1]);
        at[2 * stride] = 200 * (xyz[1] - xyz[2]);
    }
    for (int c = 0; c < 3; ++c) {
        double* row = ycc + std::size_t(c) * stride;
        std::fill(row, row + halo, row[halo]);
        std::fill(row + stride - halo, row + stride, row[stride - std::size_t(halo) - 1]);
    }

    const auto filter = [&](int n, int channel, const std::vector<double>& weights, int radius,
                            double mirror) {
        double* out = plane(slot, n);
        const double* in = ycc + std::size_t(channel) * stride + halo;
        const double centre = weights[std::size_t(radius)];
        for (std::size_t x = 0; x < w; ++x) out[x] = centre * in[x];
        for (int i = 1; i <= radius; ++i)
            add_taps(in - i, in + i, mirror, weights[std::size_t(radius + i)], w, out);
    };
    const int spatial = filters_->spatial_radius, feature = filters_->feature_radius;
    filter(0, 0, filters_->y, spatial, 1);
    filter(1, 1, filters_->cx, spatial, 1);
    filter(2, 2, filters_->cz1, spatial, 1);
    filter(3, 2, filters_->cz2, spatial, 1);
    // Features are those of luminance in [0, 1].
    for (std::size_t x = 0; x < stride; ++x) ycc[x] = (ycc[x] + 16) / 116;
    filter(4, 0, filters_->smooth, feature, 1);
    filter(5, 0, filters_->edge, feature, -1);
    filter(6, 0, filters_->point, feature, 1);
}

void FlipBand::filter_column(int n, int centre, const std::vector<double>& weights, int radius,
                             double mirror, double* out) {
    const std::size_t w = std::size_t(width_);
    const double* in = plane(centre, n);
    for (std::size_t x = 0; x < w; ++x) out[x] = weights[std::size_t(radius)] * in[x];
    for (int i = 1; i <= radius; ++i)
        add_taps(plane(centre - i, n), plane(centre + i, n), mirror,
                 weights[std::size_t(radius + i)], w, out);
}

void FlipBand::view(int y, FlipPixel* pixels) {
    const FlipFilters& f = *filters_;
    const std::size_t w = std::size_t(width_);
    const int centre = y - begin_ + f.halo();
    double* s = sums_.data();
    filter_column(0, centre, f.y, f.spatial_radius, 1, s);
    filter_column(1, centre, f.cx, f.spatial_radius, 1, s + w);
    filter_column(2, centre, f.cz1, f.spatial_radius, 1, s + 2 * w);
    filter_column(3, centre, f.cz2, f.spatial_radius, 1, s + 3 * w);
    filter_column(5, centre, f.smooth, f.feature_radius, 1, s + 4 * w);  // d/dx
    filter_column(4, centre, f.edge, f.feature_radius, -1, s + 5 * w);   // d/dy
    filter_column(6, centre, f.smooth, f.feature_radius, 1, s + 6 * w);  // d2/dx2
    filter_column(4, centre, f.point, f.feature_radius, 1, s + 7 * w);   // d2/dy2
    for (std::size_t x = 0; x < w; ++x) {
        const double luminance = (s[x] + 16) / 116;
        const double xyz[3] = {(luminance + s[w + x] / 500) * kWhite[0], luminance * kWhite[1],
                               (luminance - (s[2 * w + x] + s[3 * w + x]) / 200) * kWhite[2]};
        double rgb[3];
        for (int c = 0; c < 3; ++c) {
            const double v =
                kFromXyz[c][0] * xyz[0] + kFromXyz[c][1] * xyz[1] + kFromXyz[c][2] * xyz[2];
            rgb[c] = v < 0 ? 0 : v > 1 ? 1 : v;
        }
        pixels[x] = flip_colour(rgb[0], rgb[1], rgb[2]);
        const double dx = s[4 * w + x], dy = s[5 * w + x];
        const double ddx = s[6 * w + x], ddy = s[7 * w + x];
        pixels[x].edge = std::sqrt(dx * dx + dy * dy);
        pixels[x].point = std::sqrt(ddx * ddx + ddy * ddy);
    }
}

}  // namespace pileus
