// SPDX-License-Identifier: Apache-2.0
// Which dimension of a file is what: time, member, level, y, x, or a list of columns.
// in: the variable of water and its dimensions' names and attributes -> out: their places.
// docs/weather.md, "Dimensions"; CF conventions 1.10, chapter 4.
#pragma once
#include "src/io/netcdf/netcdf_file.h"
#include "src/scene/media/medium_settings.h"

namespace pileus {

constexpr std::size_t kNoDimension = ~std::size_t{0};

struct WeatherAxes {
    /// Indices of dimensions of the file; kNoDimension where there is none.
    std::size_t time = kNoDimension, member = kNoDimension, level = kNoDimension, y = kNoDimension,
                x = kNoDimension, column = kNoDimension;
    std::uint64_t levels = 0, ny = 1, nx = 1;  ///< a list of columns counts along x
    std::uint64_t time_index = 0, member_index = 0;
    std::string time_text;    ///< date of the time; empty where the file has none
    std::string member_text;  ///< what the file calls the member; empty where it does not
};

enum class AxisKind { kUnknown, kTime, kMember, kLevel, kY, kX, kColumn };

/// Of the word for an axis in a scene: "x".
AxisKind axis_named(const std::string& word);
/// Of the name of a dimension or a coordinate: "lon", "ni", "lv_ISBL0".
AxisKind axis_by_name(const std::string& name);
/// Of a coordinate by its standard_name, axis, units and positive; no name is looked at. A unit of
/// pressure tells of levels where the coordinate is the dimension's own: others hold coefficients.
AxisKind axis_by_attributes(const NcVariable& coordinate, bool own);

/// By the scene, by the variable of the same name, by the dimension's name, by other variables
/// along it.
AxisKind axis_kind(const NcHead& head, std::size_t dimension, const WeatherSettings& settings);

/// Variables of numbers along one dimension alone that tell of an axis, that of its own name first.
std::vector<const NcVariable*> coordinates_of(const NcHead& head, std::size_t dimension,
                                              AxisKind kind);

/// Dimensions of the variable of water, and the time and member that the scene names.
Status find_axes(const NcFile& file, const NcVariable& water, const WeatherSettings& settings,
                 WeatherAxes& axes);

/// The time or member that the scene names: `axes.time` and `axes.member` are known.
Status choose_time(const NcFile& file, const WeatherChoice& wanted, WeatherAxes& axes);
Status choose_member(const NcFile& file, const WeatherChoice& wanted, WeatherAxes& axes);

/// Dates of all times, "2005-08-28T12:00:00", by variable `Times` or the coordinate's units; empty
/// where the file tells none, and `why` says what of it is not understood.
Status weather_times(const NcFile& file, std::size_t dimension, std::vector<std::string>& dates,
                     std::string& why);

/// "2005-08-28T12:00:00" of seconds since 1970, proleptic Gregorian.
std::string date_text(std::int64_t seconds);

}  // namespace pileus
