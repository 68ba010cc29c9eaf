// SPDX-License-Identifier: Apache-2.0
// What a scene says of a file that does not say it itself: axes and units, by the file's names.
// in: the keys `axes` and `units` -> out: the word for a dimension, the unit of a variable.
// docs/weather.md, "What a file does not tell"
#pragma once
#include <string>

#include "src/io/netcdf/netcdf_file.h"
#include "src/scene/media/medium_settings.h"

namespace pileus {

/// Both keys can be read and name what the file has: else kBadInput.
Status check_hints(const NcFile& file, const WeatherSettings& settings);

/// "x" where the scene says `axes = "x: ni"` and the dimension is ni; "" where it says nothing.
std::string hinted_axis(const WeatherSettings& settings, const std::string& dimension);

/// The unit of a variable by the scene, else by its attribute; `there` false: by neither. An
/// attribute that is no text: kBadInput.
Status read_unit(const NcFile& file, const WeatherSettings& settings, const NcVariable& variable,
                 std::string& text, bool& there);

}  // namespace pileus
