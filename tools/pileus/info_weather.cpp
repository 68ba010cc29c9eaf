// SPDX-License-Identifier: Apache-2.0
// What a NetCDF file holds, and the medium that it would be.
// in: a path -> out: see info.h.
// docs/weather.md
#include <fmt/format.h>

#include "src/io/netcdf/netcdf_packing.h"
#include "src/io/volumes/volume_file.h"
#include "src/io/volumes/weather/weather_axes.h"
#include "src/io/volumes/weather_file.h"
#include "tools/pileus/info.h"

namespace pileus {

namespace {

constexpr std::uint64_t kMaxValues = std::uint64_t{1} << 24;  // of a variable whose range is told

std::string dimension_lines(const NcFile& file) {
    std::string text;
    for (const NcDimension& d : file.head().dimensions)
        text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", d.name, d.size,
                            d.unlimited ? " (unlimited)" : "");
    return info_line("dimensions", printable(text));
}

/// "0 to 2.5, 3 missing" of the values in the variable's own unit; nothing of texts.
Status range_text(const NcFile& file, const NcVariable& v, std::string& text) {
    const NcBlock block = whole_block(file.head(), v);
    const std::uint64_t count = block.values();
    if (v.type == NcType::kChar || v.type == NcType::kOther || count == 0) return Status::ok();
    if (count > kMaxValues) {
        text = fmt::format(", {} values", count);
        return Status::ok();
    }
    Buffer<double> values;
    PILEUS_TRY(values.resize(count, "values of a variable"));
    PILEUS_TRY(file.read(v, block, values.span()));
    // What says nothing is told where the variable is used.
    NcPacking packing;
    if (!NcPacking::of(file.name(), v, packing)) {
        text = ", packed in a way that is not understood";
        return Status::ok();
    }
    double least = 0, most = 0;
    std::uint64_t missing = 0, found = 0;
    for (const double number : values.span()) {
        double value = 0;
        if (number != number || !packing.take(number, value)) {
            ++missing;
            continue;
        }
        if (found == 0 || value < least) least = value;
        if (found == 0 || value > most) most = value;
        ++found;
    }
    if (found > 0) text = fmt::format(", {:.6g} to {:.6g}", least, most);
    if (missing > 0) text += fmt::format(", {} missing", missing);
    return Status::ok();
}

Status variable_line(const NcFile& file, const NcVariable& v, std::string& lines) {
    std::string dimensions, range;
    for (const std::size_t d : v.dimensions)
        dimensions += (dimensions.empty() ? "" : ", ") + file.head().dimensions[d].name;
    PILEUS_TRY(range_text(file, v, range));
    const std::string units = v.text("units"), standard = v.text("standard_name");
    lines += info_line("variable", printable(fmt::format("{} ({}), {}{}{}{}", v.name, dimensions,
                                                         nc_type_name(v.type), range,
                                                         units.empty() ? "" : " " + units,
                                                         standard.empty() ? "" : ", " + standard)));
    return Status::ok();
}

}  // namespace

Status weather_lines(const std::string& path, const MediumSettings& medium, std::string& lines) {
    NcFile file;
    PILEUS_TRY(file.open(path));
    const NcHead& head = file.head();
    lines += info_line("file", path);
    lines += info_line("kind", head.kind);
    lines += dimension_lines(file);
    for (const NcVariable& v : head.variables) PILEUS_TRY(variable_line(file, v, lines));
    for (std::size_t d = 0; d < head.dimensions.size(); ++d) {
        std::vector<std::string> dates;
        std::string text, why;
        if (axis_kind(head, d, medium.weather) != AxisKind::kTime) continue;
        PILEUS_TRY(weather_times(file, d, dates, why));
        if (!why.empty()) lines += info_line("times", printable("not understood: " + why));
        for (const std::string& date : dates) text += (text.empty() ? "" : ", ") + date;
        if (!dates.empty()) lines += info_line("times", printable(text, 400, " ..."));
    }
    // A file without cloud water is described as well; what it lacks is said.
    VolumeHead cloud;
    const Status status = weather_head(medium, file, cloud);
    if (!status) {
        lines += info_line("no medium", status.message);
        return Status::ok();
    }
    return volume_lines(path, medium, lines);
}

Status place_line(const std::string& path, const MediumSettings& medium,
                  const std::vector<double>& lon_lat, std::string& lines) {
    WeatherMap map;
    Double3 metres{};
    PILEUS_TRY(read_weather_map(medium, path, map));
    PILEUS_TRY(map.place("--place", {lon_lat[0], lon_lat[1], 0}, metres));
    lines += info_line("place", fmt::format("{:g} {:g} at {:.1f} {:.1f} m", lon_lat[0], lon_lat[1],
                                            metres[0], metres[1]));
    lines += info_line("map", map.projection());
    return Status::ok();
}

}  // namespace pileus
