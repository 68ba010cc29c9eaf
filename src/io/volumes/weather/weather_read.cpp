// SPDX-License-Identifier: Apache-2.0
// Blocks of columns of one field.
// in: numbers as they are packed -> out: SI units from below, missing ones as NaN.
// docs/weather.md, "Missing and bad values"
#include <limits>

#include "src/base/exponential.h"
#include "src/io/netcdf/netcdf_packing.h"
#include "src/io/volumes/weather/weather_source.h"

namespace pileus {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// How far apart neighbours along each direction stand in a block.
struct Strides {
    std::size_t y = 0, x = 0, level = 0;
};

NcBlock block_of(const WeatherSource& s, const NcVariable& v, std::uint64_t first_row,
                 std::uint64_t rows, Strides& strides) {
    const WeatherAxes& axes = s.axes;
    NcBlock block = whole_block(s.file->head(), v);
    for (std::size_t k = 0; k < v.dimensions.size(); ++k) {
        const std::size_t d = v.dimensions[k];
        if (d == axes.time || d == axes.member) {
            block.start[k] = d == axes.time ? axes.time_index : axes.member_index;
            block.count[k] = 1;
        } else if (d == axes.y) {
            block.start[k] = first_row;
            block.count[k] = rows;
        }
    }
    std::size_t step = 1;
    for (std::size_t k = v.dimensions.size(); k-- > 0;) {
        const std::size_t d = v.dimensions[k];
        if (d == axes.y)
            strides.y = step;
        else if (d == axes.x || d == axes.column)
            strides.x = step;
        else if (d != axes.time && d != axes.member && block.count[k] > 1)
            strides.level = step;
        step *= std::size_t(block.count[k]);
    }
    return block;
}

/// A number that is neither finite nor marked as missing.
Status not_finite(const WeatherSource& s, const NcVariable& v, std::uint64_t row,
                  std::size_t column, std::size_t level, double value) {
    return nc_fault(s.file->name(), v,
                    column_name(s, row, column) + ", level " + std::to_string(level) +
                        (value != value ? ": not a number" : ": infinite") +
                        ", allowed: finite numbers, or the variable's _FillValue");
}

double finish(const WeatherField& field, double sum) {
    const double value = field.unit.factor * sum + field.unit.offset;
    if (field.meaning == Meaning::kGeopotential) return value / field.gravity;
    if (field.meaning == Meaning::kLogarithm)
        return value > -700 && value < 700 ? exponential(value) : kMissing;
    return value;
}

}  // namespace

std::string column_name(const WeatherSource& s, std::uint64_t row, std::size_t column) {
    if (s.axes.y == kNoDimension) return "column " + std::to_string(column);
    return "row " + std::to_string(row) + ", column " + std::to_string(column);
}

Status make_room(std::uint64_t count, const char* what, Buffer<double>& room) {
    return room.size() < count ? room.resize(count, what) : Status::ok();
}

Status read_field(const WeatherSource& s, Role role, std::uint64_t first_row, std::uint64_t rows,
                  Buffer<double>& values) {
    Buffer<double> raw;
    return read_field(s, role, first_row, rows, raw, values);
}

Status read_field(const WeatherSource& s, Role role, std::uint64_t first_row, std::uint64_t rows,
                  Buffer<double>& raw, Buffer<double>& values) {
    const WeatherField& field = s.fields[role];
    const bool ground = role == Role::kSurfacePressure || role == Role::kSurfaceHeight;
    const std::size_t n = ground ? 1 : s.levels() + (field.on_faces ? 1 : 0), nx = s.row_columns();
    for (const NcVariable* part : field.parts) {
        Strides strides;
        PILEUS_TRY(s.file->check_room(*part, block_of(s, *part, first_row, rows, strides)));
    }
    PILEUS_TRY(make_room(rows * nx * n, "columns of weather data", values));
    for (const NcVariable* part : field.parts) {
        Strides strides;
        const NcBlock block = block_of(s, *part, first_row, rows, strides);
        const std::uint64_t count = block.values();
        // A dimension may stand twice, or a level where another variable has a column.
        const std::uint64_t last =
            (rows - 1) * strides.y + (nx - 1) * strides.x + (n - 1) * strides.level;
        if (rows == 0 || nx == 0 || n == 0 || count > rows * nx * n || last >= count)
            return nc_fault(s.file->name(), *part,
                            "dimensions: not those of its columns and levels, allowed: each once");
        PILEUS_TRY(make_room(count, "values of a variable", raw));
        PILEUS_TRY(s.file->read(*part, block, raw.span().part(0, std::size_t(count))));
        NcPacking packing;
        PILEUS_TRY(NcPacking::of(s.file->name(), *part, packing));
        const bool first = part == field.parts[0];
        std::size_t to = 0;
        for (std::uint64_t y = 0; y < rows; ++y)
            for (std::size_t x = 0; x < nx; ++x)
                for (std::size_t k = 0; k < n; ++k, ++to) {
                    const std::size_t level = s.top_down ? n - 1 - k : k;
                    const double number =
                        raw.at(std::size_t(y) * strides.y + x * strides.x + level * strides.level);
                    double value = kMissing;
                    const bool missing = !packing.take(number, value);
                    if (!missing && !(value - value == 0))
                        return not_finite(s, *part, first_row + y, x, level, value);
                    const double known = missing ? kMissing : value;
                    values[to] = first ? known : values[to] + known;
                }
    }
    for (double& value : values.span().part(0, std::size_t(rows) * nx * n))
        value = finish(field, value);
    return Status::ok();
}

}  // namespace pileus
