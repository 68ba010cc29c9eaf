// SPDX-License-Identifier: Apache-2.0
// Descriptions of files for `pileus info`, one function per kind of file.
// in: a path -> out: lines "name  value", or the reader's fault.
// docs/program.md
#pragma once
#include <string>

#include "src/base/status.h"
#include "src/io/volumes/volume_file.h"

namespace pileus {

/// "name           value\n".
std::string info_line(const char* name, const std::string& value);

/// Name and version of the compiler that built this program.
std::string compiler_text();

/// Lines "size" and, where the place is known, "box".
std::string size_lines(const std::array<int, 3>& size, bool knows_bounds,
                       const std::array<Double3, 2>& bounds_m);

Status scene_lines(const std::string& path, std::string& lines);
Status image_lines(const std::string& path, std::string& lines);
/// The scene that a picture was rendered from, as its file has it.
Status scene_text_of(const std::string& path, std::string& text);
/// A table of angles and values.
Status phase_lines(const std::string& path, std::string& lines);
/// `medium` holds the facts that a raw grid does not state itself.
Status volume_lines(const std::string& path, const MediumSettings& medium, std::string& lines);

/// A NetCDF file: dimensions, variables, times, and the medium that it would be.
Status weather_lines(const std::string& path, const MediumSettings& medium, std::string& lines);
/// "place  19.05 47.5 at x y m" and the map, of a longitude and a latitude.
Status place_line(const std::string& path, const MediumSettings& medium,
                  const std::vector<double>& lon_lat, std::string& lines);

}  // namespace pileus
