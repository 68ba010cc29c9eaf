// SPDX-License-Identifier: Apache-2.0
// Grids on x, y, z in metres, to NetCDF and back.
// in: a Volume or an open file -> out: see volume_file.h.
// docs/formats.md, "NetCDF"; CF conventions 1.10, section 7.1 (bounds)

#include "src/base/file.h"
#include "src/io/netcdf/netcdf_packing.h"
#include "src/io/netcdf/netcdf_write.h"
#include "src/io/volumes/undershoot.h"
#include "src/io/volumes/volume_file.h"
#include "src/io/volumes/weather/weather_axes.h"
#include "src/io/volumes/weather/weather_ground.h"
#include "src/io/volumes/weather/weather_units.h"

namespace pileus {
namespace {

constexpr double kEven = 1e-6;  // of a step

/// Dimensions of a grid, slowest first, and where each goes in x, y, z.
constexpr AxisKind kOrder[3] = {AxisKind::kLevel, AxisKind::kY, AxisKind::kX};

/// The first key of weather data that the scene gives, for which a grid has no use.
const char* useless_key(const MediumSettings& medium) {
    const WeatherSettings &w = medium.weather, usual;
    if (medium.box.resolution[0] > 0) return "resolution";
    if (w.time != usual.time) return "time";
    if (w.member != usual.member) return "member";
    if (!w.names.axes.empty()) return "axes";
    if (!w.names.units.empty()) return "units";
    if (w.in_cloud) return "fraction";
    if (w.sizes.liquid_radius_um > 0) return "liquid_radius_um";
    if (w.sizes.ice_radius_um > 0) return "ice_radius_um";
    if (w.sizes.ice_dge_um > 0) return "ice_dge_um";
    if (w.place.plain_degrees) return "geometry";
    if (w.place.origin_deg != usual.place.origin_deg) return "origin_deg";
    if (w.place.width_m > 0) return "width_m";
    return w.place.vertical_scale != usual.place.vertical_scale ? "vertical_scale" : nullptr;
}

bool is_extinction(const NcVariable& v) { return v.name == "extinction"; }

Status read_numbers(const NcFile& file, const NcVariable& v, std::uint64_t count,
                    std::vector<double>& values) {
    const NcBlock block = whole_block(file.head(), v);
    if (block.values() != count || v.type == NcType::kChar)
        return nc_fault(file.name(), v,
                        "values: " + std::to_string(block.values()) +
                            ", allowed: " + std::to_string(count) + " numbers");
    values.assign(std::size_t(count), 0.0);
    return read_unpacked(file, v, block, {values.data(), values.size()});
}

/// Faces of the box along one dimension; `found` false where the file has no coordinate.
Status box_of(const NcFile& file, const NcVariable& grid, std::size_t k, double& low, double& high,
              bool& found) {
    const NcHead& head = file.head();
    const std::uint64_t n = head.size(grid, k);
    const NcVariable* v = head.find(head.dimensions[grid.dimensions[k]].name);
    found = v != nullptr && v->dimensions.size() == 1 && v->dimensions[0] == grid.dimensions[k];
    if (!found) return Status::ok();
    UnitScale unit;
    if (!find_unit(v->text("units"), Quantity::kHeight, unit))
        return nc_fault(file.name(), *v,
                        "units: \"" + v->text("units") + "\", allowed: m, km along a grid");
    std::vector<double> places, faces;
    PILEUS_TRY(read_numbers(file, *v, n, places));
    bool flipped = false;
    const NcVariable* bounds = head.find(v->text("bounds"));
    if (bounds != nullptr) {
        PILEUS_TRY(read_numbers(file, *bounds, 2 * n, faces));
        low = faces.front();
        high = faces.back();
    } else if (n > 1 && edges_of(places, 0, faces, flipped) && !flipped) {
        low = faces.front();
        high = faces.back();
    } else {
        low = high = 0;  // neither bounds nor rising places
    }
    low *= unit.factor;
    high *= unit.factor;
    if (!(low >= -1e9 && high <= 1e9 && low < high))
        return nc_fault(file.name(), *v,
                        "values: no box, allowed: rising metres within 1e9, and bounds where there "
                        "is one cell");
    for (std::uint64_t i = 0; i < n; ++i) {
        const double step = (high - low) / double(n);
        const double off = places[std::size_t(i)] * unit.factor - (low + (double(i) + 0.5) * step);
        if (!(off <= kEven * step && off >= -kEven * step))
            return nc_fault(file.name(), *v, "values: not evenly spaced, allowed: equal cells");
    }
    return Status::ok();
}

}  // namespace

const NcVariable* netcdf_grid(const NcHead& head, const WeatherSettings& settings) {
    if (!settings.names.liquid.empty() || !settings.names.ice.empty() ||
        !settings.names.variable.empty())
        return nullptr;
    for (const char* name : {"extinction", "density"}) {
        const NcVariable* v = head.find(name);
        if (v != nullptr && v->dimensions.size() == 3 && v->type != NcType::kChar &&
            v->type != NcType::kOther)
            return v;
    }
    return nullptr;
}

Status netcdf_grid_head(const MediumSettings& medium, const NcFile& file, const NcVariable& grid,
                        VolumeHead& head) {
    const NcHead& of = file.head();
    head = VolumeHead();
    if (const char* key = useless_key(medium))
        return Status::bad_input(file.name() + ": " + key + ": not for a grid of " +
                                 printable_line(grid.name) + ", allowed: left out");
    const std::string unit = grid.text("units");
    const bool known = is_extinction(grid) ? unit == "m-1" || unit == "1/m" || unit == "m^-1"
                                           : unit == "1" || unit.empty();
    if (!known)
        return nc_fault(
            file.name(), grid,
            "units: \"" + unit + "\", allowed: " + (is_extinction(grid) ? "m-1, 1/m, m^-1" : "1"));
    std::array<std::int64_t, 3> size{};
    bool found[3] = {};
    for (std::size_t k = 0; k < 3; ++k) {
        const NcDimension& d = of.dimensions[grid.dimensions[k]];
        if (axis_kind(of, grid.dimensions[k], medium.weather) != kOrder[k])
            return nc_fault(file.name(), grid,
                            "dimension " + d.name + ": out of order, allowed: z, y, x");
        if (d.size > std::uint64_t(kMaxVolumeSide))
            size[2 - k] = kMaxVolumeSide + 1;
        else
            size[2 - k] = std::int64_t(d.size);
    }
    PILEUS_TRY(check_volume_size(file.name(), size));
    PILEUS_TRY(file.check_room(grid, whole_block(of, grid)));
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t a = 2 - k;
        head.size[a] = int(size[a]);
        PILEUS_TRY(
            box_of(file, grid, k, head.bounds_m[0][int(a)], head.bounds_m[1][int(a)], found[a]));
    }
    head.knows_bounds = found[0] && found[1] && found[2];
    head.in_extinction = true;
    head.in_pieces = true;
    head.unpacked_bytes = std::uint64_t(size[0]) * std::uint64_t(size[1]) * sizeof(double) +
                          (of.on_hdf5 ? kNcCacheBytes + kNcLibraryBytes : 0);
    head.kind = of.kind;
    head.detail = is_extinction(grid) ? "a grid of extinction"
                                      : "a grid of density: extinction_scale is that of density 1";
    return Status::ok();
}

Status read_netcdf_grid(const MediumSettings& medium, const NcFile& file, const NcVariable& grid,
                        Volume& volume) {
    VolumeHead head;
    PILEUS_TRY(netcdf_grid_head(medium, file, grid, head));
    volume = Volume();
    volume.size = head.size;
    volume.knows_bounds = head.knows_bounds;
    volume.bounds_m = head.bounds_m;
    volume.in_extinction = head.in_extinction;
    const std::uint64_t plane = std::uint64_t(head.size[0]) * std::uint64_t(head.size[1]);
    PILEUS_TRY(volume.density.resize(plane * std::uint64_t(head.size[2]), "density grid"));
    Buffer<double> values;
    PILEUS_TRY(values.resize(plane, "layer of a NetCDF file"));
    Undershoot undershoot;
    std::size_t lowest = 0;
    NcPacking packing;
    PILEUS_TRY(NcPacking::of(file.name(), grid, packing));
    NcBlock block = whole_block(file.head(), grid);
    block.count[0] = 1;
    for (std::size_t z = 0; z < std::size_t(head.size[2]); ++z) {
        block.start[0] = z;
        PILEUS_TRY(file.read(grid, block, values.span()));
        for (std::size_t i = 0; i < values.size(); ++i) {
            const std::size_t at = z * std::size_t(plane) + i;
            double value = 0;
            if (!packing.take(values[i], value)) {
                if (medium.weather.missing_is_fault)
                    return nc_fault(file.name(), grid,
                                    voxel_name(volume.size, at) +
                                        ": missing value, allowed: none (missing = \"fault\")");
                ++volume.missing;
                value = 0;
            }
            if (!(value >= -1e12 && value <= 1e12))
                return nc_fault(file.name(), grid,
                                voxel_name(volume.size, at) +
                                    ": too large or not a number, allowed: 0 to 1e12");
            float& voxel = volume.density[at];
            voxel = float(value);
            if (undershoot.take(voxel)) lowest = at;
        }
    }
    if (undershoot.is_fault())
        return nc_fault(file.name(), grid,
                        voxel_name(volume.size, lowest) + ": negative, " + undershoot.text());
    undershoot.settle(volume);
    return Status::ok();
}

Status encode_netcdf_volume(const Volume& volume, Buffer<char>& bytes) {
    static const char* const kNames[3] = {"x", "y", "z"};
    static const char* const kLetters[3] = {"X", "Y", "Z"};
    NcNewFile file;
    file.texts = {{"Conventions", "CF-1.10"}, {"source", "pileus convert"}};
    for (std::size_t a = 3; a-- > 0;)
        file.dimensions.emplace_back(kNames[a], std::uint64_t(volume.size[a]));
    file.dimensions.emplace_back("bnds", 2);
    for (std::size_t a = 3; a-- > 0 && volume.knows_bounds;) {
        const double low = volume.bounds_m[0][int(a)], high = volume.bounds_m[1][int(a)];
        const std::uint64_t n = std::uint64_t(volume.size[a]);
        const std::string name = kNames[a], of_faces = name + "_bnds";
        file.variables.push_back(nc_middles(name, 2 - a, low, high, n));
        NcTexts& texts = file.variables.back().texts;
        texts = {{"units", "m"}, {"axis", kLetters[a]}, {"bounds", of_faces}};
        if (a == 2) texts.emplace_back("positive", "up");
        file.variables.push_back(nc_bounds(of_faces, 2 - a, 3, low, high, n));
    }
    NcNewVariable grid;
    grid.name = volume.in_extinction ? "extinction" : "density";
    grid.dimensions = {0, 1, 2};
    grid.texts = {{"units", volume.in_extinction ? "m-1" : "1"},
                  {"long_name", volume.in_extinction ? "volume extinction coefficient of cloud"
                                                     : "relative density of cloud"}};
    grid.floats = volume.density.span();
    file.variables.push_back(grid);
    return encode_netcdf(file, bytes);
}

Status write_netcdf_volume(const std::string& path, const Volume& volume) {
    PILEUS_TRY(can_write_file(path));
    Buffer<char> bytes;
    PILEUS_TRY(encode_netcdf_volume(volume, bytes));
    return write_file(path, bytes.span());
}

}  // namespace pileus
