// SPDX-License-Identifier: Apache-2.0
// Conserving resampling of columns.
// in: layers -> out: see weather_grid.h.
// docs/weather.md, "What is conserved"
#include "src/io/volumes/weather/weather_grid.h"

#include "src/io/volumes/volume_file.h"

namespace pileus {
namespace {

constexpr double kSnap = 1e-6;  // of a cell
constexpr int kMaxLayers = 1024;

/// Light is kept by cell, so a thick layer of the file is cut into cells of two optical depths, up
/// to sixteen to a layer, as long as the grid stays below 2^24 cells.
constexpr double kDepthOfCell = 2, kMaxOfLayer = 16, kMaxCells = 0x1p24;

/// Footprint of a column: its edges in metres.
struct Rectangle {
    double x0, x1, y0, y1;
};

Rectangle footprint(const WeatherSource& s, std::uint64_t row, std::size_t column) {
    const Footprints& g = s.ground;
    // A list of columns along a meridian counts along y.
    const bool turned = s.axes.column != kNoDimension && g.ny() > 1;
    std::size_t i = turned ? 0 : column, j = turned ? column : std::size_t(row);
    if (g.x_flipped) i = g.nx() - 1 - i;
    if (g.y_flipped) j = g.ny() - 1 - j;
    const double scale = g.row_scale[j];
    return {scale * g.x_edges[i], scale * g.x_edges[i + 1], g.y_edges[j], g.y_edges[j + 1]};
}

/// Place of an edge in cells; edges within a millionth of a cell's face lie on it.
double in_cells(double edge, double low, double step, int size) {
    const double at = (edge - low) / step;
    if (!(at > 0)) return 0;
    if (at > size) return size;
    const double whole = double(static_cast<std::int64_t>(at + 0.5));
    return at - whole < kSnap && whole - at < kSnap ? whole : at;
}

/// Calls use(cell, share of the cell) for the cells between two places.
template <class Use>
void for_overlaps(double from, double to, int size, Use use) {
    for (int cell = int(from); cell < size && double(cell) < to; ++cell) {
        const double low = from > cell ? from : cell;
        const double high = to < cell + 1 ? to : cell + 1;
        if (high > low) use(cell, high - low);
    }
}

void survey_column(const WeatherSource& s, const CloudLayers& layers, std::size_t column,
                   double area, WeatherSurvey& survey) {
    const std::size_t n = s.levels();
    double depth = 0;
    survey.area_m2 += area;
    for (std::size_t k = 0; k < n; ++k) {
        const double low = layers.faces_m.at(column * (n + 1) + k);
        const double high = layers.faces_m.at(column * (n + 1) + k + 1);
        const double kappa = s.seen(layers.extinction.at(column * n + k)), thickness = high - low;
        if (!(kappa > 0) || !(thickness > 0)) continue;
        survey.low_m = survey.any_cloud && survey.low_m < low ? survey.low_m : low;
        survey.high_m = survey.any_cloud && survey.high_m > high ? survey.high_m : high;
        survey.any_cloud = true;
        survey.thickness_m += thickness;
        ++survey.cloudy;
        if (kappa > survey.most_extinction) survey.most_extinction = kappa;
        survey.liquid_kg += layers.liquid.at(column * n + k) * thickness * area;
        survey.ice_kg += layers.ice.at(column * n + k) * thickness * area;
        depth += kappa * thickness;
    }
    survey.depth_m2 += depth * area;
    if (depth > survey.most_depth) survey.most_depth = depth;
}

}  // namespace

Status survey_weather(const WeatherSource& s, WeatherSurvey& survey) {
    CloudLayers layers;
    return survey_weather(s, layers, survey);
}

Status survey_weather(const WeatherSource& s, CloudLayers& layers, WeatherSurvey& survey) {
    survey = WeatherSurvey();
    const std::uint64_t step = block_rows(s);
    double lowest = 1e30, highest = -1e30;
    for (std::uint64_t row = 0; row < s.axes.ny; row += step) {
        const std::uint64_t rows = s.axes.ny - row < step ? s.axes.ny - row : step;
        PILEUS_TRY(read_layers(s, row, rows, layers, survey.counts));
        for (std::uint64_t y = 0; y < rows; ++y)
            for (std::size_t x = 0; x < s.row_columns(); ++x) {
                const Rectangle r = footprint(s, row + y, x);
                survey_column(s, layers, std::size_t(y) * s.row_columns() + x,
                              (r.x1 - r.x0) * (r.y1 - r.y0), survey);
            }
        const std::size_t faces = std::size_t(rows) * s.row_columns() * (s.levels() + 1);
        for (const double z : layers.faces_m.span().part(0, faces)) {
            if (z < lowest) lowest = z;
            if (z > highest) highest = z;
        }
    }
    if (survey.counts.values > 0 && survey.counts.missing == survey.counts.values)
        return nc_fault(s.file->name(), *s.water, "all values missing, allowed: some");
    if (survey.counts.blank == s.axes.nx * s.axes.ny)
        return nc_fault(s.file->name(), *s.water, "no column has values of it and of its air");
    if (!survey.any_cloud) {
        survey.low_m = lowest;
        survey.high_m = highest;
    }
    return Status::ok();
}

Status weather_grid(const WeatherSource& s, const WeatherSurvey& survey,
                    const std::array<int, 3>& resolution, WeatherGrid& grid) {
    const Footprints& g = s.ground;
    grid.low[0] = g.low_x();
    grid.high[0] = g.high_x();
    grid.low[1] = g.y_edges.front();
    grid.high[1] = g.y_edges.back();
    grid.low[2] = survey.low_m;
    grid.high[2] = survey.high_m;
    std::int64_t layers = 1;
    if (survey.cloudy > 0) {
        const double mean = survey.thickness_m / double(survey.cloudy);
        const double count = (survey.high_m - survey.low_m) / mean + 0.5;
        layers = count < kMaxLayers ? std::int64_t(count) : kMaxLayers;
        if (layers < 1) layers = 1;
        double cut = survey.most_extinction * (survey.high_m - survey.low_m) / kDepthOfCell;
        const double columns = double(g.nx()) * double(g.ny());
        for (const double most :
             {kMaxOfLayer * double(layers), kMaxCells / columns, double(kMaxLayers)})
            cut = cut < most ? cut : most;
        if (cut > double(layers)) layers = std::int64_t(cut + 0.5);
    }
    std::array<std::int64_t, 3> size{std::int64_t(g.nx()), std::int64_t(g.ny()), layers};
    if (resolution[0] > 0) size = {resolution[0], resolution[1], resolution[2]};
    PILEUS_TRY(check_volume_size(s.file->name() + ": grid of the medium (key resolution)", size));
    for (std::size_t a = 0; a < 3; ++a) {
        grid.size[a] = int(size[a]);
        if (!(grid.high[a] > grid.low[a]))
            return nc_fault(s.file->name(), *s.water, "region: no extent");
    }
    return Status::ok();
}

void lay_block(const WeatherSource& s, const WeatherGrid& grid, std::uint64_t first_row,
               std::uint64_t rows, const CloudLayers& layers, Span<double> sums,
               Span<double> known) {
    const bool shown = s.has(Role::kShown);
    const std::size_t n = s.levels(), nx = std::size_t(grid.size[0]),
                      ny = std::size_t(grid.size[1]);
    const double dx = grid.step(0), dy = grid.step(1), dz = grid.step(2);
    for (std::uint64_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < s.row_columns(); ++x) {
            const std::size_t column = std::size_t(y) * s.row_columns() + x;
            const Rectangle r = footprint(s, first_row + y, x);
            const double x0 = in_cells(r.x0, grid.low[0], dx, grid.size[0]);
            const double x1 = in_cells(r.x1, grid.low[0], dx, grid.size[0]);
            const double y0 = in_cells(r.y0, grid.low[1], dy, grid.size[1]);
            const double y1 = in_cells(r.y1, grid.low[1], dy, grid.size[1]);
            for (std::size_t k = 0; k < n; ++k) {
                const double kappa = layers.extinction.at(column * n + k);
                if (shown ? kappa != kappa : !(kappa > 0)) continue;
                const double* face = &layers.faces_m.at(column * (n + 1) + k);
                const double z0 = in_cells(face[0], grid.low[2], dz, grid.size[2]);
                const double z1 = in_cells(face[1], grid.low[2], dz, grid.size[2]);
                for_overlaps(z0, z1, grid.size[2], [&](int cz, double high) {
                    for_overlaps(y0, y1, grid.size[1], [&](int cy, double wide) {
                        for_overlaps(x0, x1, grid.size[0], [&](int cx, double across) {
                            const std::size_t cell =
                                (std::size_t(cz) * ny + std::size_t(cy)) * nx + std::size_t(cx);
                            sums.at(cell) += kappa * high * wide * across;
                            if (shown) known.at(cell) += high * wide * across;
                        });
                    });
                });
            }
        }
}

}  // namespace pileus
