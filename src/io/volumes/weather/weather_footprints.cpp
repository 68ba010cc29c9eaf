// SPDX-License-Identifier: Apache-2.0
// Edges of footprints between places.
// in: places of columns -> out: see weather_ground.h.
// docs/weather.md, "Place"
#include "src/io/volumes/weather/weather_ground.h"

namespace pileus {
namespace {

constexpr double kEven = 0.01;  // of a step

double absolute(double x) { return x < 0 ? -x : x; }

}  // namespace

double Footprints::low_x() const {
    double low = row_scale[0] * x_edges.front();
    for (const double s : row_scale)
        if (s * x_edges.front() < low) low = s * x_edges.front();
    return low;
}

double Footprints::high_x() const {
    double high = row_scale[0] * x_edges.back();
    for (const double s : row_scale)
        if (s * x_edges.back() > high) high = s * x_edges.back();
    return high;
}

bool edges_of(std::vector<double> places, double width, std::vector<double>& edges, bool& flipped) {
    const std::size_t n = places.size();
    flipped = n > 1 && places[0] > places[n - 1];
    if (flipped)
        for (std::size_t i = 0; i < n / 2; ++i) std::swap(places[i], places[n - 1 - i]);
    edges.assign(n + 1, 0.0);
    if (n == 1) {
        edges[0] = places[0] - 0.5 * width;
        edges[1] = places[0] + 0.5 * width;
        return width > 0;
    }
    const double step = (places[n - 1] - places[0]) / double(n - 1);
    bool even = step > 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (i > 0 && !(places[i] > places[i - 1])) return false;
        even = even && absolute(places[i] - places[0] - double(i) * step) <= kEven * step;
    }
    for (std::size_t i = 1; i < n; ++i) edges[i] = 0.5 * (places[i - 1] + places[i]);
    edges[0] = 2 * places[0] - edges[1];
    edges[n] = 2 * places[n - 1] - edges[n - 1];
    for (std::size_t i = 0; even && i <= n; ++i) edges[i] = places[0] + (double(i) - 0.5) * step;
    return true;
}

}  // namespace pileus
