// SPDX-License-Identifier: Apache-2.0
// Tells dimensions apart and finds those of the variable of water.
// in: a head -> out: see weather_axes.h.
// docs/weather.md, "Dimensions"; CF conventions 1.10, chapter 4.
#include "src/io/volumes/weather/weather_axes.h"

#include "src/io/volumes/weather/weather_hints.h"

namespace pileus {
namespace {

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

/// By coordinates of other names, where all that tell say the same.
AxisKind by_others(const NcHead& head, std::size_t dimension) {
    AxisKind kind = AxisKind::kUnknown;
    for (const NcVariable& v : head.variables) {
        if (v.dimensions.size() != 1 || v.dimensions[0] != dimension) continue;
        AxisKind found = axis_by_attributes(v, false);
        if (found == AxisKind::kUnknown) found = axis_by_name(v.name);
        if (found == AxisKind::kUnknown) continue;
        if (kind != AxisKind::kUnknown && found != kind) return AxisKind::kUnknown;
        kind = found;
    }
    return kind;
}

/// A scene that chooses one of what the file has not.
Status check_choices(const NcFile& file, const WeatherSettings& settings, const WeatherAxes& axes) {
    const auto fault = [&](const char* key, const char* what) {
        return Status::bad_input(file.name() + ": " + key + ": the variable has no dimension of " +
                                 what + ", allowed: left out");
    };
    const WeatherChoice first;
    if (axes.time == kNoDimension && settings.time != first) return fault("time", "times");
    if (axes.member == kNoDimension && settings.member != first) return fault("member", "members");
    return Status::ok();
}

}  // namespace

AxisKind axis_kind(const NcHead& head, std::size_t dimension, const WeatherSettings& settings) {
    const std::string& name = head.dimensions[dimension].name;
    AxisKind kind = axis_named(hinted_axis(settings, name));
    if (kind != AxisKind::kUnknown) return kind;
    if (const NcVariable* v = head.find(name)) kind = axis_by_attributes(*v, true);
    if (kind == AxisKind::kUnknown) kind = axis_by_name(name);
    return kind == AxisKind::kUnknown ? by_others(head, dimension) : kind;
}

Status find_axes(const NcFile& file, const NcVariable& water, const WeatherSettings& settings,
                 WeatherAxes& axes) {
    const NcHead& head = file.head();
    axes = WeatherAxes();
    for (const std::size_t d : water.dimensions) {
        const NcDimension& dimension = head.dimensions[d];
        const AxisKind kind = axis_kind(head, d, settings);
        std::size_t* place = place_of(kind, axes);
        if (dimension.size == 0)
            return nc_fault(file.name(), water,
                            "dimension " + dimension.name + ": no elements, allowed: at least 1");
        if (place == nullptr && dimension.size == 1) continue;
        if (place == nullptr)
            return nc_fault(file.name(), water,
                            "dimension " + dimension.name +
                                ": neither time, member, level, y, x nor column by its name, "
                                "attribute axis or standard_name, nor by its unit, allowed: the "
                                "key axes of the density");
        // Of two of a kind one may be a single element, as a time beside forecast times.
        if (*place != kNoDimension && dimension.size == 1) continue;
        if (*place != kNoDimension && head.dimensions[*place].size > 1)
            return nc_fault(file.name(), water,
                            "dimension " + dimension.name + ": means the same as " +
                                head.dimensions[*place].name +
                                ", allowed: the key axes of the density, which tells them apart");
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
    PILEUS_TRY(check_choices(file, settings, axes));
    if (axes.time != kNoDimension) PILEUS_TRY(choose_time(file, settings.time, axes));
    if (axes.member != kNoDimension) PILEUS_TRY(choose_member(file, settings.member, axes));
    return Status::ok();
}

}  // namespace pileus
