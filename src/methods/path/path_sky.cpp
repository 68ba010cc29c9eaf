// SPDX-License-Identifier: Apache-2.0
// See path_sky.h.
#include "src/methods/path/path_sky.h"

#include "src/base/angles.h"
#include "src/world/light/sky_map.h"

namespace pileus {
namespace {

/// Row i's sine of the angle from the zenith, at its centre: above 0 in every row.
double row_sine(const SkyMapView& map, int i) {
    return sincos_deg(360.0 * (i + 0.5) / double(map.rows_per_turn)).sine;
}

/// Share of row i that lies above the sky's foot; a row that the horizon cuts has half.
double row_share(const SkyMapView& map, int i) {
    const double above = double(map.foot) - i;
    return above < 1 ? above : 1;
}

double brightest(const SkyMapView& map, std::size_t texel) {
    const std::size_t plane = std::size_t(map.rows) * std::size_t(map.columns);
    double most = 0;
    for (std::size_t c = 0; c < std::size_t(map.planes); ++c) {
        const double v = double(map.radiance[c * plane + texel]);
        most = v > most ? v : most;
    }
    return most;
}

}  // namespace

Status make_path_sky(const SkyMapView& map, PathSky& out) {
    const std::size_t rows = std::size_t(map.rows), columns = std::size_t(map.columns);
    out.view = SkySampler{};
    if (rows == 0 || columns == 0) return Status::ok();
    Buffer<double> power, of_row;
    PILEUS_TRY(allocate(arrays::path_sky_weight(rows, columns), out.weight));
    PILEUS_TRY(allocate(arrays::path_sky_rows(rows), out.row_cdf));
    PILEUS_TRY(allocate(arrays::path_sky_columns(rows, columns), out.column_cdf));
    PILEUS_TRY(power.resize(columns, "path sky"));
    PILEUS_TRY(of_row.resize(rows, "path sky"));
    for (std::size_t i = 0; i < rows; ++i) {
        const double sine = row_sine(map, int(i)), share = row_share(map, int(i));
        for (std::size_t j = 0; j < columns; ++j)
            power[j] = brightest(map, i * columns + j) * sine * share;
        of_row[i] = fill_cdf(power.data(), map.columns, out.column_cdf.data() + i * columns);
    }
    const double total = fill_cdf(of_row.data(), map.rows, out.row_cdf.data());
    if (!(total > 0)) return Status::ok();

    // Weights of mean one: the density in the image is their bilinear value over the texels.
    const double texels = double(rows) * double(columns);
    for (std::size_t i = 0; i < rows; ++i) {
        const double sine = row_sine(map, int(i));
        for (std::size_t j = 0; j < columns; ++j) {
            const std::size_t at = i * columns + j;
            out.weight[at] = float(brightest(map, at) * sine / total * texels);
        }
    }
    const double per_steradian =
        double(map.rows_per_turn) * double(columns) / (kTwoPi64 * kTwoPi64 * texels);
    out.view = {out.weight.data(), out.row_cdf.data(), out.column_cdf.data(), float(per_steradian)};
    return Status::ok();
}

}  // namespace pileus
