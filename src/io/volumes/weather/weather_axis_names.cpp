// SPDX-License-Identifier: Apache-2.0
// Words, names and attributes that tell what an axis is.
// in: names, a coordinate -> out: see weather_axes.h.
// docs/weather.md, "Dimensions"; CF conventions 1.10, chapter 4; names of forecast models, of NCL
// and THREDDS, and of DALES, UCLALES, PALM, CM1, SAM and MicroHH.
#include "src/base/printable.h"
#include "src/io/volumes/weather/weather_axes.h"
#include "src/io/volumes/weather/weather_units.h"

namespace pileus {
namespace {

struct NameRow {
    AxisKind kind;
    const char* names;  ///< parted by blanks, with one at either end
};

constexpr NameRow kNames[] = {
    {AxisKind::kTime,
     " time t times valid_time forecast_time time_counter initial_time initial_time0_hours "
     "record "},
    {AxisKind::kMember,
     " member members number realization realisation ensemble ens ensemble_member mem sample "},
    {AxisKind::kX,
     " lon longitude rlon x west_east xc nx i xt xm xu xh xf ni grid_xt grid_x gridlon xdim "
     "easting "},
    {AxisKind::kY,
     " lat latitude rlat y south_north yc ny j yt ym yv yh yf nj grid_yt grid_y gridlat ydim "
     "northing "},
    {AxisKind::kColumn, " column columns col ncol cell cells ncells profile station site "},
    {AxisKind::kLevel,
     " level levels lev levs plev pressure pressure_level isobaricinhpa isobaric height altitude z "
     "zc nz k zt zm zu zw zh zf zu_3d zw_3d nk kk bottom_top hybrid model_level nlev nlevs "
     "half_level full_level ilev bottom_top_stag generalvertical pfull phalf layer layers nlay "
     "vertical sigma eta mlev plevel zlev klev height_above_ground pres press p "},
};

/// NCL's of GRIB files: lv_ISBL0, lat_0, lon_0, ensemble0.
constexpr NameRow kBeginnings[] = {{AxisKind::kLevel, "lv_"},
                                   {AxisKind::kY, "lat_"},
                                   {AxisKind::kX, "lon_"},
                                   {AxisKind::kTime, "initial_time"},
                                   {AxisKind::kTime, "forecast_time"}};

constexpr NameRow kStandardNames[] = {
    {AxisKind::kTime, " time "},
    {AxisKind::kMember, " realization "},
    {AxisKind::kX, " longitude grid_longitude projection_x_coordinate "},
    {AxisKind::kY, " latitude grid_latitude projection_y_coordinate "},
    {AxisKind::kLevel,
     " air_pressure height altitude geopotential_height height_above_mean_sea_level "
     "height_above_geopotential_datum height_above_reference_ellipsoid model_level_number "
     "atmosphere_hybrid_sigma_pressure_coordinate atmosphere_hybrid_height_coordinate "
     "atmosphere_sigma_coordinate atmosphere_ln_pressure_coordinate atmosphere_sleve_coordinate "},
};

/// The attribute _CoordinateAxisType of THREDDS, in lower case.
constexpr NameRow kTypes[] = {
    {AxisKind::kTime, " time "},
    {AxisKind::kMember, " ensemble "},
    {AxisKind::kX, " lon geox "},
    {AxisKind::kY, " lat geoy "},
    {AxisKind::kLevel, " pressure height geoz "},
};

/// CF conventions 1.10, 4.1 and 4.2: these units are of latitudes and longitudes alone.
constexpr NameRow kUnits[] = {
    {AxisKind::kX, " degrees_east degree_east degree_E degrees_E degreeE degreesE "},
    {AxisKind::kY, " degrees_north degree_north degree_N degrees_N degreeN degreesN "},
};

constexpr NameRow kLetters[] = {
    {AxisKind::kTime, " t "}, {AxisKind::kLevel, " z "},  {AxisKind::kY, " y "},
    {AxisKind::kX, " x "},    {AxisKind::kMember, " e "},
};

constexpr NameRow kWords[] = {
    {AxisKind::kTime, " time "}, {AxisKind::kMember, " member "}, {AxisKind::kLevel, " level "},
    {AxisKind::kY, " y "},       {AxisKind::kX, " x "},           {AxisKind::kColumn, " column "},
};

template <std::size_t N>
AxisKind kind_in(const NameRow (&rows)[N], const std::string& name) {
    if (name.empty() || name.find(' ') != std::string::npos) return AxisKind::kUnknown;
    for (const NameRow& row : rows)
        if (std::string(row.names).find(' ' + name + ' ') != std::string::npos) return row.kind;
    return AxisKind::kUnknown;
}

bool is_level_unit(const std::string& unit) {
    UnitScale scale;
    return find_unit(unit, Quantity::kPressure, scale);
}

bool along(const NcVariable& v, std::size_t dimension) {
    return v.dimensions.size() == 1 && v.dimensions[0] == dimension && v.type != NcType::kChar &&
           v.type != NcType::kOther;
}

}  // namespace

AxisKind axis_named(const std::string& word) { return kind_in(kWords, word); }

AxisKind axis_by_name(const std::string& name) {
    std::string text = lower_case(name);
    const AxisKind whole = kind_in(kNames, text);
    if (whole != AxisKind::kUnknown) return whole;
    for (const NameRow& row : kBeginnings)
        if (text.compare(0, std::string(row.names).size(), row.names) == 0) return row.kind;
    // One of several of a kind is counted: time1, isobaric2, height_2.
    while (!text.empty() && text.back() >= '0' && text.back() <= '9') text.pop_back();
    while (!text.empty() && text.back() == '_') text.pop_back();
    return kind_in(kNames, text);
}

AxisKind axis_by_attributes(const NcVariable& v, bool own) {
    AxisKind kind = kind_in(kStandardNames, v.text("standard_name"));
    if (kind == AxisKind::kUnknown) kind = kind_in(kLetters, lower_case(v.text("axis")));
    if (kind == AxisKind::kUnknown)
        kind = kind_in(kTypes, lower_case(v.text("_CoordinateAxisType")));
    if (kind != AxisKind::kUnknown) return kind;
    const std::string units = v.text("units"), positive = lower_case(v.text("positive"));
    kind = kind_in(kUnits, units);
    if (kind != AxisKind::kUnknown) return kind;
    if (units.find(" since ") != std::string::npos) return AxisKind::kTime;
    const bool vertical = positive == "up" || positive == "down" || (own && is_level_unit(units));
    return vertical ? AxisKind::kLevel : AxisKind::kUnknown;
}

std::vector<const NcVariable*> coordinates_of(const NcHead& head, std::size_t dimension,
                                              AxisKind kind) {
    std::vector<const NcVariable*> list;
    const NcVariable* own = head.find(head.dimensions[dimension].name);
    if (own != nullptr && along(*own, dimension)) list.push_back(own);
    for (const NcVariable& v : head.variables) {
        if (&v == own || !along(v, dimension)) continue;
        AxisKind found = axis_by_attributes(v, false);
        if (found == AxisKind::kUnknown) found = axis_by_name(v.name);
        if (found == kind) list.push_back(&v);
    }
    return list;
}

}  // namespace pileus
