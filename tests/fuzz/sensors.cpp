// SPDX-License-Identifier: Apache-2.0
// Fuzz target: files of sensors.
// in: bytes as TOML -> out: lawful sensors, or one line with its place.
// docs/flux.md, "Sensors"
#include "src/io/text/sensor_file.h"
#include "tests/fuzz/target.h"

int fuzz::sensors(const std::uint8_t* data, std::size_t size) {
    using namespace pileus;
    std::vector<Sensor> sensors;
    const Status status = decode_sensors("s.toml", fuzz::text_of(data, size), sensors);
    if (!status) {
        fuzz::check_fault(status, "s.toml:", true);
        return 0;
    }
    fuzz::require(!sensors.empty() && sensors.size() <= kMaxSensors, "some sensors");
    for (const Sensor& s : sensors) {
        const Double3& d = s.direction;
        const double length = d.x * d.x + d.y * d.y + d.z * d.z;
        fuzz::require(length > 0.999999 && length < 1.000001, "directions are unit");
        fuzz::require(s.height_m - s.height_m == 0, "heights are finite");
        fuzz::require(s.samples >= 64, "samples are enough for an error");
        fuzz::require(!s.name.empty() && s.name.size() <= 64, "names are short");
    }
    return 0;
}
