// SPDX-License-Identifier: Apache-2.0
// Weather data as a medium: a NetCDF file of cloud water on levels becomes extinction on a grid.
// in: a file's variables and the scene's words on them -> out: a Volume in 1/m with its place.
// docs/weather.md
#pragma once
#include <string>

#include "src/base/status.h"
#include "src/scene/scene.h"

namespace pileus {

struct Volume;
struct VolumeHead;
class NcFile;

/// Faults of the data: kBadInput, one line; more cells or memory than allowed: kLimit.
Status read_weather_volume(const MediumSettings& medium, const std::string& path, Volume& volume);
Status read_weather_head(const MediumSettings& medium, const std::string& path, VolumeHead& head);

/// The same of an open file.
Status weather_volume(const MediumSettings& medium, const NcFile& file, Volume& volume);
Status weather_head(const MediumSettings& medium, const NcFile& file, VolumeHead& head);

}  // namespace pileus
