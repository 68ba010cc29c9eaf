// SPDX-License-Identifier: Apache-2.0
// Fields of GRIB as they were read, and the NetCDF file that they become.
// in: fields of one grid, in any order -> out: variables without gaps.
// docs/weather.md, "Files"
#pragma once
#include <map>
#include <string>
#include <vector>

#include "src/base/buffer.h"
#include "src/base/status.h"

namespace pileus {

constexpr double kGribMissing = 9.9692099683868690e+36;  ///< NetCDF's own mark

/// Longitudes rise from the first to the last; latitudes go either way.
struct GribGrid {
    long nx = 0, ny = 0;
    double first_lon = 0, last_lon = 0, first_lat = 0, last_lat = 0;
    bool operator==(const GribGrid& o) const {
        return nx == o.nx && ny == o.ny && first_lon == o.first_lon && last_lon == o.last_lon &&
               first_lat == o.first_lat && last_lat == o.last_lat;
    }
};

/// Where a field belongs.
struct GribField {
    std::string variable;
    std::int64_t seconds = 0;    ///< since 1970
    long member = 0, level = 0;  ///< level -1: at the ground
};

struct GribFields {
    GribGrid grid;
    std::vector<GribField> list;
    std::vector<Buffer<float>> values;  ///< of each, nx * ny, freed as they are laid out
    std::map<std::string, std::string> units;
    std::vector<double> pv;  ///< of hybrid levels: a of all faces, then b
    bool hybrid = false;     ///< else levels are pressures in hPa
};

/// kBadInput: a variable without one field for each time, member and level, levels with gaps.
Status encode_grib_fields(const std::string& name, GribFields& fields, Buffer<char>& bytes);

}  // namespace pileus
