// SPDX-License-Identifier: Apache-2.0
// Tells dimensions apart and finds those of the variable of water.
// in: a head -> out: see weather_axes.h.
// docs/weather.md, "Dimensions"; CF conventions 1.10, chapter 4.
#include "src/io/volumes/weather/weather_axes.h"

#include <charconv>

#include "src/io/netcdf/netcdf_values.h"
#include "src/io/volumes/weather/weather_units.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {
namespace {

struct NameRow {
    AxisKind kind;
    const char* name;
};

constexpr NameRow kNames[] = {
    {AxisKind::kTime, "time"},
    {AxisKind::kTime, "t"},
    {AxisKind::kTime, "valid_time"},
    {AxisKind::kTime, "forecast_time"},
    {AxisKind::kMember, "member"},
    {AxisKind::kMember, "number"},
    {AxisKind::kMember, "realization"},
    {AxisKind::kMember, "ensemble"},
    {AxisKind::kMember, "ens"},
    {AxisKind::kMember, "ensemble_member"},
    {AxisKind::kX, "lon"},
    {AxisKind::kX, "longitude"},
    {AxisKind::kX, "rlon"},
    {AxisKind::kX, "x"},
    {AxisKind::kX, "west_east"},
    {AxisKind::kX, "xc"},
    {AxisKind::kX, "nx"},
    {AxisKind::kX, "i"},
    {AxisKind::kY, "lat"},
    {AxisKind::kY, "latitude"},
    {AxisKind::kY, "rlat"},
    {AxisKind::kY, "y"},
    {AxisKind::kY, "south_north"},
    {AxisKind::kY, "yc"},
    {AxisKind::kY, "ny"},
    {AxisKind::kY, "j"},
    {AxisKind::kColumn, "column"},
    {AxisKind::kColumn, "col"},
    {AxisKind::kColumn, "ncol"},
    {AxisKind::kColumn, "cell"},
    {AxisKind::kColumn, "ncells"},
    {AxisKind::kColumn, "profile"},
    {AxisKind::kLevel, "level"},
    {AxisKind::kLevel, "lev"},
    {AxisKind::kLevel, "plev"},
    {AxisKind::kLevel, "pressure"},
    {AxisKind::kLevel, "pressure_level"},
    {AxisKind::kLevel, "isobaricinhpa"},
    {AxisKind::kLevel, "height"},
    {AxisKind::kLevel, "altitude"},
    {AxisKind::kLevel, "z"},
    {AxisKind::kLevel, "zc"},
    {AxisKind::kLevel, "nz"},
    {AxisKind::kLevel, "k"},
    {AxisKind::kLevel, "bottom_top"},
    {AxisKind::kLevel, "hybrid"},
    {AxisKind::kLevel, "model_level"},
    {AxisKind::kLevel, "nlev"},
    {AxisKind::kLevel, "half_level"},
    {AxisKind::kLevel, "ilev"},
    {AxisKind::kLevel, "bottom_top_stag"},
    {AxisKind::kLevel, "height_2"},
    {AxisKind::kLevel, "generalvertical"},
};

constexpr NameRow kStandardNames[] = {
    {AxisKind::kTime, "time"},
    {AxisKind::kMember, "realization"},
    {AxisKind::kX, "longitude"},
    {AxisKind::kX, "grid_longitude"},
    {AxisKind::kX, "projection_x_coordinate"},
    {AxisKind::kY, "latitude"},
    {AxisKind::kY, "grid_latitude"},
    {AxisKind::kY, "projection_y_coordinate"},
    {AxisKind::kLevel, "air_pressure"},
    {AxisKind::kLevel, "height"},
    {AxisKind::kLevel, "altitude"},
    {AxisKind::kLevel, "atmosphere_hybrid_sigma_pressure_coordinate"},
    {AxisKind::kLevel, "atmosphere_hybrid_height_coordinate"},
    {AxisKind::kLevel, "atmosphere_sigma_coordinate"},
    {AxisKind::kLevel, "model_level_number"},
};

std::string lower(const std::string& text) {
    std::string out = text;
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return out;
}

template <std::size_t N>
AxisKind kind_in(const NameRow (&rows)[N], const std::string& name) {
    for (const NameRow& row : rows)
        if (name == row.name) return row.kind;
    return AxisKind::kUnknown;
}

AxisKind kind_of_letter(const std::string& axis) {
    if (axis == "T") return AxisKind::kTime;
    if (axis == "Z") return AxisKind::kLevel;
    if (axis == "Y") return AxisKind::kY;
    return axis == "X" ? AxisKind::kX : AxisKind::kUnknown;
}

/// Where the dimension of each kind goes; null for unknown ones.
std::size_t* place_of(AxisKind kind, WeatherAxes& axes) {
    switch (kind) {
        case AxisKind::kTime:
            return &axes.time;
        case AxisKind::kMember:
            return &axes.member;
        case AxisKind::kLevel:
            return &axes.level;
        case AxisKind::kY:
            return &axes.y;
        case AxisKind::kX:
            return &axes.x;
        case AxisKind::kColumn:
            return &axes.column;
        case AxisKind::kUnknown:
            break;
    }
    return nullptr;
}

Status key_fault(const NcFile& file, const char* key, const std::string& line) {
    return Status::bad_input(file.name() + ": " + key + ": " + printable_line(line));
}

/// "2005-08-28 12" and "2005-08-28_12" are "2005-08-28T12".
std::string date_form(std::string text) {
    for (char& c : text)
        if (c == '_' || c == ' ') c = 'T';
    if (!text.empty() && text.back() == 'Z') text.pop_back();
    return text;
}

bool whole_number(const std::string& text, std::uint64_t& value) {
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    return read.ec == std::errc() && read.ptr == end;
}

Status choose_time(const NcFile& file, const std::string& wanted, WeatherAxes& axes) {
    std::vector<std::string> dates;
    PILEUS_TRY(weather_times(file, axes.time, dates));
    const std::uint64_t size = file.head().dimensions[axes.time].size;
    if (!whole_number(wanted, axes.time_index)) {
        const std::string start = date_form(wanted);
        std::size_t hits = 0;
        for (std::size_t i = 0; i < dates.size(); ++i)
            if (dates[i].compare(0, start.size(), start) == 0) {
                axes.time_index = i;
                ++hits;
            }
        if (hits != 1)
            return key_fault(
                file, "time",
                std::string(hits == 0 ? "not in the file, " : "several in the file, ") +
                    quote_text(wanted) + ", allowed: 0 to " + std::to_string(size - 1) +
                    (dates.empty() ? std::string()
                                   : " or the beginning of one date from " + dates.front() +
                                         " to " + dates.back()));
    }
    if (axes.time_index >= size)
        return key_fault(
            file, "time",
            "not in the file, " + wanted + ", allowed: 0 to " + std::to_string(size - 1));
    if (axes.time_index < dates.size()) axes.time_text = dates[std::size_t(axes.time_index)];
    return Status::ok();
}

/// By index, or the value of the coordinate written as text.
Status choose_member(const NcFile& file, const std::string& wanted, WeatherAxes& axes) {
    const NcHead& head = file.head();
    const std::uint64_t size = head.dimensions[axes.member].size;
    if (whole_number(wanted, axes.member_index)) {
        if (axes.member_index < size) return Status::ok();
    } else if (const NcVariable* v = head.find(head.dimensions[axes.member].name)) {
        const NcBlock block = whole_block(head, *v);
        if (v->type == NcType::kChar && v->dimensions.size() == 2 && block.values() < 65536) {
            std::vector<double> letters(std::size_t(block.values()));
            PILEUS_TRY(file.read(*v, block, {letters.data(), letters.size()}));
            const std::size_t length = letters.size() / std::size_t(size);
            for (std::uint64_t i = 0; i < size; ++i) {
                std::string name;
                for (std::size_t k = 0; k < length; ++k) {
                    const char c = nc_letter(letters[std::size_t(i) * length + k]);
                    if (c != '\0' && c != ' ') name += c;
                }
                axes.member_index = i;
                if (name == wanted) return Status::ok();
            }
        }
    }
    return key_fault(
        file, "member",
        "not in the file, " + quote_text(wanted) + ", allowed: 0 to " + std::to_string(size - 1));
}

}  // namespace

AxisKind axis_kind(const NcHead& head, std::size_t dimension) {
    const std::string& name = head.dimensions[dimension].name;
    if (const NcVariable* v = head.find(name)) {
        AxisKind kind = kind_in(kStandardNames, v->text("standard_name"));
        if (kind == AxisKind::kUnknown) kind = kind_of_letter(v->text("axis"));
        if (kind == AxisKind::kUnknown && v->text("units").find(" since ") != std::string::npos)
            kind = AxisKind::kTime;
        if (kind != AxisKind::kUnknown) return kind;
    }
    return kind_in(kNames, lower(name));
}

Status find_axes(const NcFile& file, const NcVariable& water, const WeatherSettings& settings,
                 WeatherAxes& axes) {
    const NcHead& head = file.head();
    axes = WeatherAxes();
    for (const std::size_t d : water.dimensions) {
        const NcDimension& dimension = head.dimensions[d];
        const AxisKind kind = axis_kind(head, d);
        std::size_t* place = place_of(kind, axes);
        if (dimension.size == 0)
            return nc_fault(file.name(), water,
                            "dimension " + dimension.name + ": no elements, allowed: at least 1");
        if (place == nullptr && dimension.size == 1) continue;
        if (place == nullptr)
            return nc_fault(file.name(), water,
                            "dimension " + dimension.name +
                                ": neither time, member, level, y, x nor column by its name, "
                                "attribute axis or standard_name");
        if (*place != kNoDimension)
            return nc_fault(file.name(), water,
                            "dimension " + dimension.name + ": means the same as " +
                                head.dimensions[*place].name);
        *place = d;
    }
    if (axes.column != kNoDimension && (axes.x != kNoDimension || axes.y != kNoDimension))
        return nc_fault(file.name(), water, "dimensions: a list of columns beside x or y");
    if (axes.level == kNoDimension)
        return nc_fault(file.name(), water, "dimensions: none of levels, allowed: one of them");
    axes.levels = head.dimensions[axes.level].size;
    if (axes.column != kNoDimension) axes.nx = head.dimensions[axes.column].size;
    if (axes.x != kNoDimension) axes.nx = head.dimensions[axes.x].size;
    if (axes.y != kNoDimension) axes.ny = head.dimensions[axes.y].size;
    if (axes.time != kNoDimension) PILEUS_TRY(choose_time(file, settings.time, axes));
    if (axes.member != kNoDimension) PILEUS_TRY(choose_member(file, settings.member, axes));
    return Status::ok();
}

}  // namespace pileus
