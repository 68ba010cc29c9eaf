// SPDX-License-Identifier: Apache-2.0
// Reader of the sensors of pileus flux: places that look somewhere, small planes, levels.
// in: TOML -> out: checked sensors.
// docs/flux.md, "Sensors"
#pragma once
#include <string>
#include <vector>

#include "src/base/span.h"
#include "src/base/status.h"
#include "src/base/vectors.h"

namespace pileus {

constexpr std::uint64_t kMaxSensors = 4096;
constexpr std::uint64_t kMaxSensorBytes = std::uint64_t{1} << 20;

enum class SensorKind {
    kLook,   ///< radiance at a place along a direction
    kPlane,  ///< irradiance on a small plane at a place
    kLevel,  ///< fluxes through a level of the media's box
};

struct Sensor {
    std::string name;  ///< at most 64 printable bytes
    SensorKind kind = SensorKind::kLook;
    double height_m = 0;            ///< of a level, world metres
    Double3 position_m{};           ///< world metres
    Double3 direction{0, 0, 1};     ///< unit: where it looks, or the plane's normal
    std::uint64_t samples = 65536;  ///< paths, of a level in each of its two directions
};

/// Reads `[[sensor]]` tables. kBadInput with file:line:column: no TOML, an unknown key, a value out
/// of range, too many sensors or none; kLimit: too long a text.
Status read_sensors(const std::string& path, std::vector<Sensor>& sensors);

/// The same from memory; `name` opens the lines of faults.
Status decode_sensors(const std::string& name, Span<const char> text, std::vector<Sensor>& sensors);

}  // namespace pileus
