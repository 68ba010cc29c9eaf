// SPDX-License-Identifier: Apache-2.0
// FLIP's view of one picture: what an eye resolves of its colours, and its edges and points.
// in: display-linear R G B, a band of rows -> out: per pixel an adjusted colour, edge and point.
// Andersson et al. 2020, sections 4.1 to 4.2; docs/compare.md
#pragma once
#include <vector>

#include "src/base/buffer.h"
#include "src/base/span.h"

namespace pileus {

/// Weights of taps -radius...radius of the separable filters; `edge` is odd, the others even.
struct FlipFilters {
    int spatial_radius = 0, feature_radius = 0;
    std::vector<double> y, cx, cz1, cz2;      ///< contrast sensitivity; Cz is a sum of two products
    std::vector<double> smooth, edge, point;  ///< a Gaussian and its first two derivatives
    int halo() const { return spatial_radius > feature_radius ? spatial_radius : feature_radius; }
};

FlipFilters make_flip_filters(double pixels_per_degree);

/// What is compared of a pixel. Lightness and the two colour axes of CIELAB after Hunt's
/// adjustment; strengths of edge and point in [0, sqrt(2)].
struct FlipPixel {
    double lightness, a, b, edge, point;
};

/// Display-linear colour after the filters' clamp, as lightness, a, b.
FlipPixel flip_colour(double r, double g, double b);

/// City-block distance of lightness plus Euclidean distance of colour.
double hyab(const FlipPixel& p, const FlipPixel& q);

/// Scratch of one band: filtered rows of one picture.
class FlipBand {
public:
    /// Room for bands of `rows` rows of pictures `width` wide.
    Status resize(int width, int rows, const FlipFilters& filters);

    /// Filters along x the rows [begin - halo, end + halo); rows and columns beyond the picture
    /// repeat its border. `row(y, rgb)` fills rgb[c][x] with light in [0, 1].
    template <class Row>
    void load(int height, int begin, int end, Row&& row) {
        begin_ = begin;
        const int halo = filters_->halo();
        for (int y = begin - halo; y < end + halo; ++y) {
            const int held = y < 0 ? 0 : y >= height ? height - 1 : y;
            row(held, rgb_.data());
            filter_row(y - begin + halo);
        }
    }
    /// Filters along y: the pixels of row `y` of the band last loaded.
    void view(int y, FlipPixel* pixels);

private:
    void filter_row(int slot);
    double* plane(int slot, int n) {
        return rows_.data() + (std::size_t(slot) * 7 + std::size_t(n)) * std::size_t(width_);
    }
    /// One plane along y around a row; `mirror`: 1 for even weights, -1 for odd ones.
    void filter_column(int n, int centre, const std::vector<double>& weights, int radius,
                       double mirror, double* out);

    const FlipFilters* filters_ = nullptr;
    int width_ = 0, begin_ = 0;
    Buffer<double> rgb_;   ///< [3][width]
    Buffer<double> ycc_;   ///< [3][halo + width + halo]
    Buffer<double> rows_;  ///< [slot][7: Y Cx Cz1 Cz2 smooth edge point][width]
    Buffer<double> sums_;  ///< [8][width]
};

}  // namespace pileus
