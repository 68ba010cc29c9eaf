// SPDX-License-Identifier: Apache-2.0
// Lays fields of GRIB out as variables.
// in: fields -> out: see grib_fields.h.
// docs/weather.md, "Files"
#include "src/io/netcdf/grib_fields.h"

#include <algorithm>

#include "src/io/netcdf/netcdf_write.h"

namespace pileus {
namespace {

Status fault(const std::string& name, const std::string& line) {
    return Status::bad_input(name + ": GRIB: " + printable_line(line));
}

template <class Value>
std::size_t place_in(const std::vector<Value>& list, Value value) {
    return std::size_t(std::lower_bound(list.begin(), list.end(), value) - list.begin());
}

template <class Value>
std::vector<Value> sorted(std::vector<Value> values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

NcNewVariable axis(const std::string& name, std::size_t dimension, double first, double last,
                   long n, const NcTexts& texts) {
    NcNewVariable v;
    v.name = name;
    v.dimensions = {dimension};
    v.texts = texts;
    for (long i = 0; i < n; ++i)
        v.doubles.push_back(n < 2 ? first : first + (last - first) * (double(i) / double(n - 1)));
    return v;
}

Status hybrid_faces(const std::string& name, const std::vector<double>& pv,
                    const std::vector<long>& levels, NcNewFile& file) {
    const std::size_t faces = pv.size() / 2;
    for (std::size_t k = 0; k < levels.size(); ++k)
        if (levels[k] != levels[0] + long(k) || levels[k] < 1 || std::size_t(levels[k]) >= faces)
            return fault(name, "levels: gaps or beyond pv, allowed: all from " +
                                   std::to_string(levels.front()) + " to " +
                                   std::to_string(levels.back()));
    file.dimensions.emplace_back("nhyi", levels.size() + 1);
    for (int b = 0; b < 2; ++b) {
        NcNewVariable v;
        v.name = b == 0 ? "hyai" : "hybi";
        v.dimensions = {file.dimensions.size() - 1};
        v.texts = {{"units", b == 0 ? "Pa" : "1"}};
        for (std::size_t k = 0; k <= levels.size(); ++k)
            v.doubles.push_back(pv[std::size_t(b) * faces + std::size_t(levels[0]) - 1 + k]);
        file.variables.push_back(v);
    }
    return Status::ok();
}

}  // namespace

Status encode_grib_fields(const std::string& name, GribFields& fields, Buffer<char>& bytes) {
    const GribGrid& grid = fields.grid;
    std::vector<std::int64_t> times;
    std::vector<long> members, levels;
    for (const GribField& f : fields.list) {
        times.push_back(f.seconds);
        members.push_back(f.member);
        if (f.level >= 0) levels.push_back(f.level);
    }
    times = sorted(times);
    members = sorted(members);
    levels = sorted(levels);
    if (levels.empty())
        return fault(name, "no field on levels, nothing, allowed: hybrid or pressure");
    NcNewFile file;
    file.texts = {{"source", "GRIB"}};
    file.dimensions = {{"time", times.size()},
                       {"member", members.size()},
                       {"level", levels.size()},
                       {"latitude", std::uint64_t(grid.ny)},
                       {"longitude", std::uint64_t(grid.nx)}};
    file.variables.push_back(
        axis("longitude", 4, grid.first_lon, grid.last_lon, grid.nx, {{"units", "degrees_east"}}));
    file.variables.push_back(
        axis("latitude", 3, grid.first_lat, grid.last_lat, grid.ny, {{"units", "degrees_north"}}));
    NcNewVariable time, level, member;
    member.name = "member";
    member.dimensions = {1};
    member.texts = {{"units", "1"}, {"standard_name", "realization"}};
    for (const long m : members) member.doubles.push_back(double(m));
    time.name = "time";
    time.dimensions = {0};
    time.texts = {{"units", "seconds since 1970-01-01 00:00:00"}};
    for (const std::int64_t t : times) time.doubles.push_back(double(t));
    level.name = "level";
    level.dimensions = {2};
    level.texts = {{"units", fields.hybrid ? "1" : "hPa"}, {"axis", "Z"}};
    for (const long l : levels) level.doubles.push_back(double(l));
    file.variables.push_back(time);
    file.variables.push_back(member);
    file.variables.push_back(level);
    if (fields.hybrid) PILEUS_TRY(hybrid_faces(name, fields.pv, levels, file));
    // Each variable has its floats apart, in the order of its dimensions, without a gap.
    const std::size_t cells = std::size_t(grid.nx) * std::size_t(grid.ny);
    std::map<std::string, Buffer<float>> floats;
    for (const auto& [variable, unit] : fields.units) {
        bool on_levels = false;
        std::size_t found = 0;
        for (const GribField& f : fields.list)
            if (f.variable == variable) {
                on_levels = f.level >= 0;
                ++found;
            }
        // What holds for all times, as the ground's height, may be there once.
        const bool once = found == 1 && !on_levels;
        const std::size_t slots =
            once ? 1 : times.size() * members.size() * (on_levels ? levels.size() : 1);
        std::vector<bool> filled(slots, false);
        if (found != slots)
            return fault(name, variable + ": fields: " + std::to_string(found) + ", allowed: " +
                                   std::to_string(slots) + ", one for each time, member and level");
        Buffer<float>& to = floats[variable];
        PILEUS_TRY(to.resize(std::uint64_t(slots) * cells, "variable of a GRIB file"));
        for (std::size_t i = 0; i < fields.list.size(); ++i) {
            const GribField& f = fields.list[i];
            if (f.variable != variable) continue;
            std::size_t slot =
                place_in(times, f.seconds) * members.size() + place_in(members, f.member);
            if (on_levels) slot = slot * levels.size() + place_in(levels, f.level);
            if (once) slot = 0;
            if (filled[slot]) return fault(name, variable + ": a field is given twice");
            filled[slot] = true;
            std::copy(fields.values[i].data(), fields.values[i].data() + cells,
                      to.data() + slot * cells);
            fields.values[i] = Buffer<float>();
        }
        NcNewVariable v;
        v.name = variable;
        v.dimensions = {0, 1, 3, 4};
        if (on_levels) v.dimensions = {0, 1, 2, 3, 4};
        if (once) v.dimensions = {3, 4};
        v.texts = {{"units", unit}};
        if (variable == "surface_z") v.texts.emplace_back("standard_name", "surface_geopotential");
        v.floats = to.span();
        file.variables.push_back(v);
    }
    return encode_netcdf(file, bytes);
}

}  // namespace pileus
