// SPDX-License-Identifier: Apache-2.0
// Weather data as a volume of extinction.
// in: an open file -> out: see volume_file.h.
// docs/weather.md

#include <limits>

#include "src/io/volumes/volume.h"
#include "src/io/volumes/volume_file.h"
#include "src/io/volumes/weather/weather_grid.h"

namespace pileus {
namespace {

std::array<Double3, 2> bounds_of(const WeatherGrid& grid, double vertical_scale) {
    return {{{grid.low[0], grid.low[1], grid.low[2] * vertical_scale},
             {grid.high[0], grid.high[1], grid.high[2] * vertical_scale}}};
}

const char* vertical_text(const WeatherSource& s) {
    switch (s.vertical) {
        case Vertical::kHeightFaces:
            return "heights of faces";
        case Vertical::kHeightLevels:
            return s.hybrid_heights ? "hybrid heights of levels" : "heights of levels";
        case Vertical::kPressureFaces:
            return s.hybrid_b.empty() ? "pressures of faces" : "hybrid faces";
        case Vertical::kPressureLevels:
            break;
    }
    return s.hybrid_b.empty() ? "pressure levels" : "hybrid levels";
}

std::string detail_of(const WeatherSource& s, const WeatherSurvey& survey) {
    std::string text;
    for (const Role role : {Role::kShown, Role::kLiquid, Role::kIce})
        if (s.has(role))
            text += std::string(text.empty() ? "" : ", ") + role_key(role) + ' ' +
                    s.fields[role].name();
    text += "; " + std::to_string(s.axes.levels) + ' ' + vertical_text(s) +
            (s.top_down ? " from above" : " from below");
    if (s.has(Role::kHeight) && s.fields[Role::kHeight].above_ground && !s.hybrid_heights)
        text += s.has(Role::kSurfaceHeight) ? ", above the ground"
                                            : ", above the ground, which is not known: at 0 m";
    for (const WeatherField& field : s.fields.of)
        for (const NcVariable* part : field.parts)
            if (part->text("units") == kDalesUnit)
                text += "; " + part->name + " in " + kDalesUnit + " of DALES is in kg/kg";
    if (!s.axes.time_text.empty()) text += "; " + s.axes.time_text;
    if (!s.axes.member_text.empty()) text += "; member " + s.axes.member_text;
    text += "; " + s.ground.text;
    if (survey.counts.missing > 0)
        text += "; " + std::to_string(survey.counts.missing) + " missing values are no cloud";
    if (survey.counts.blank > 0)
        text += "; " + std::to_string(survey.counts.blank) + " columns without a value are clear";
    if (survey.counts.capped > 0)
        text += "; " + std::to_string(survey.counts.capped) +
                " cells have more water than their cloud fraction tells, at most 10 times as dense "
                "in cloud";
    if (survey.counts.clamped > 0)
        text += "; " + std::to_string(survey.counts.clamped) + " negative values are none";
    return printable_line(text);
}

/// What reading holds beside the file and the volume.
std::uint64_t working_bytes(const WeatherSource& s, const WeatherGrid& grid) {
    const std::uint64_t sums = s.has(Role::kShown) ? 2 : 1;
    // A GRIB file is in memory twice while it is made.
    std::uint64_t bytes =
        block_bytes(s) + sums * grid.cells() * sizeof(double) + 2 * s.file->held_bytes();
    const NcHead& head = s.file->head();
    if (!head.on_hdf5) return bytes;
    for (const WeatherField& field : s.fields.of)
        for (const NcVariable* part : field.parts) {
            const std::uint64_t values = whole_block(head, *part).values();
            const bool small = values < kNcCacheBytes / 8;
            bytes += small ? values * nc_bytes(part->type) : kNcCacheBytes;
        }
    return bytes + kNcLibraryBytes;
}

/// The mean of what is known in a cell; none where that is less than half of it.
void fill_shown(Span<const double> sums, Span<const double> known, Volume& volume) {
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t i = 0; i < sums.size; ++i)
        volume.density[i] = known[i] >= 0.5 - 1e-6 ? float(sums[i] / known[i]) : kNone;
}

Status fill(const WeatherSource& s, const WeatherGrid& grid, CloudLayers& layers, Volume& volume) {
    const bool shown = s.has(Role::kShown);
    Buffer<double> sums, known;
    PILEUS_TRY(sums.resize(grid.cells(), "sums of weather data"));
    if (shown) PILEUS_TRY(known.resize(grid.cells(), "known shares of weather data"));
    WeatherCounts counts;
    const std::uint64_t step = block_rows(s);
    for (std::uint64_t row = 0; row < s.axes.ny; row += step) {
        const std::uint64_t rows = s.axes.ny - row < step ? s.axes.ny - row : step;
        PILEUS_TRY(read_layers(s, row, rows, layers, counts));
        lay_block(s, grid, row, rows, layers, sums.span(), known.span());
    }
    PILEUS_TRY(volume.density.resize(grid.cells(), "density grid of weather data"));
    if (shown) {
        fill_shown(sums.span(), known.span(), volume);
        return Status::ok();
    }
    const double scale = s.settings->place.vertical_scale;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double kappa = sums[i] / scale;
        if (!(kappa <= 1e12))
            return nc_fault(s.file->name(), *s.water,
                            "extinction: too large, allowed: at most 1e12 per m");
        volume.density[i] = float(kappa);
    }
    return Status::ok();
}

}  // namespace

Status weather_head(const MediumSettings& medium, const NcFile& file, VolumeHead& head) {
    if (const NcVariable* grid = netcdf_grid(file.head(), medium.weather))
        return netcdf_grid_head(medium, file, *grid, head);
    WeatherSource source;
    WeatherSurvey survey;
    WeatherGrid grid;
    head = VolumeHead();
    PILEUS_TRY(open_weather(file, medium.weather, source));
    source.transfer = &medium.optics.transfer;
    PILEUS_TRY(survey_weather(source, survey));
    PILEUS_TRY(weather_grid(source, survey, medium.box.resolution, grid));
    head.size = grid.size;
    head.knows_bounds = true;
    head.in_extinction = !source.has(Role::kShown);
    head.bounds_m = bounds_of(grid, medium.weather.place.vertical_scale);
    head.in_pieces = true;
    head.unpacked_bytes = working_bytes(source, grid);
    head.kind = file.head().kind;
    head.detail = detail_of(source, survey);
    return Status::ok();
}

Status weather_volume(const MediumSettings& medium, const NcFile& file, Volume& volume) {
    if (const NcVariable* grid = netcdf_grid(file.head(), medium.weather))
        return read_netcdf_grid(medium, file, *grid, volume);
    WeatherSource source;
    WeatherSurvey survey;
    WeatherGrid grid;
    PILEUS_TRY(open_weather(file, medium.weather, source));
    source.transfer = &medium.optics.transfer;
    CloudLayers layers;
    PILEUS_TRY(survey_weather(source, layers, survey));
    PILEUS_TRY(weather_grid(source, survey, medium.box.resolution, grid));
    volume.size = grid.size;
    volume.knows_bounds = true;
    volume.in_extinction = !source.has(Role::kShown);
    volume.bounds_m = bounds_of(grid, medium.weather.place.vertical_scale);
    volume.missing = survey.counts.missing;
    volume.clamped = survey.counts.clamped;
    volume.blank = survey.counts.blank;
    volume.capped = survey.counts.capped;
    return fill(source, grid, layers, volume);
}

Status read_weather_volume(const MediumSettings& medium, const std::string& path, Volume& volume) {
    NcFile file;
    PILEUS_TRY(file.open(path));
    return weather_volume(medium, file, volume);
}

Status read_weather_head(const MediumSettings& medium, const std::string& path, VolumeHead& head) {
    NcFile file;
    PILEUS_TRY(file.open(path));
    return weather_head(medium, file, head);
}

}  // namespace pileus
