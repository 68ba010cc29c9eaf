// SPDX-License-Identifier: Apache-2.0
// Files of sensors: what is taken over, and a line for each fault.
// in: texts -> out: sensors, or file:line:column.
// docs/flux.md, "Sensors"
#include "src/io/text/sensor_file.h"

#include <doctest/doctest.h>

#include <cmath>

namespace sensor_file_test {

using namespace pileus;

Status decode(const std::string& text, std::vector<Sensor>& sensors) {
    return decode_sensors("s.toml", {text.data(), text.size()}, sensors);
}

TEST_CASE("sensor file: places, directions, levels") {
    std::vector<Sensor> s;
    REQUIRE(decode(R"(
[[sensor]]
name = "up"
position_m = [1, 2, 3.5]
direction = [0, 3e-5, 4e-5]
samples = 64
[[sensor]]
position_m = [0, 0, 0]
elevation_deg = 30
azimuth_deg = 90
[[sensor]]
height_m = -12.5
[[sensor]]
position_m = [0, 0, 0]
normal = [0, 0, -3]
)",
                   s));
    REQUIRE(s.size() == 4);
    CHECK(s[0].name == "up");
    CHECK(s[0].kind == SensorKind::kLook);
    CHECK(s[0].position_m == Double3{1, 2, 3.5});
    CHECK(s[0].direction.y == doctest::Approx(0.6));
    CHECK(s[0].direction.z == doctest::Approx(0.8));
    CHECK(s[0].samples == 64);
    CHECK(s[1].name == "sensor 1");
    CHECK(s[1].direction.x == doctest::Approx(std::sqrt(0.75)));
    CHECK(std::fabs(s[1].direction.y) < 1e-15);
    CHECK(s[1].direction.z == doctest::Approx(0.5));
    CHECK(s[1].samples == 65536);
    CHECK(s[2].kind == SensorKind::kLevel);
    CHECK(s[3].kind == SensorKind::kPlane);
    CHECK(s[3].direction == Double3{0, 0, -1});
    CHECK(s[2].height_m == -12.5);
}

TEST_CASE("sensor file: each fault has its line") {
    const std::string head = "[[sensor]]\n", at = head + "position_m = [0, 0, 0]\n";
    const std::pair<std::string, const char*> faults[] = {
        {"", "s.toml:1:1: sensor: none"},
        {"[[sensor]", "s.toml:1:10: not TOML"},
        {"[other]\n", "s.toml:1:2: \"other\": unknown table"},
        {"sensor = 3\n", "s.toml:1:1: sensor: none"},
        {"sensor = [3]\n", "s.toml:1:11: sensor: 3, allowed: a table"},
        {head + "colour = 1\n", "s.toml:2:1: sensor.\"colour\": unknown key"},
        {head + "name = \"a\"\n", "s.toml:1:1: sensor: is nowhere or at two places"},
        {at + "height_m = 3\n", "s.toml:1:1: sensor: is nowhere or at two places"},
        {at, "s.toml:1:1: sensor: looks nowhere or twice"},
        {at + "direction = [0,0,1]\nelevation_deg = 3\n", "s.toml:1:1: sensor: looks nowhere or"},
        {at + "direction = [0,0,1]\nazimuth_deg = 3\n", "s.toml:4:1: sensor.azimuth_deg: without"},
        {at + "direction = [0,0,1]\nnormal = [0,0,1]\n", "s.toml:1:1: sensor: looks nowhere or"},
        {at + "normal = [0,0,0]\n", "s.toml:3:10: sensor.normal: out of range"},
        {head + "height_m = 1\nnormal = [0,0,1]\n", "s.toml:3:1: sensor.normal: beside"},
        {at + "direction = [0,0,0]\n", "s.toml:3:13: sensor.direction: out of range"},
        {at + "direction = [0,0]\n", "s.toml:3:13: sensor.direction: out of range"},
        {at + "direction = [0,nan,1]\n", "s.toml:3:13: sensor.direction: out of range"},
        {at + "elevation_deg = 90.5\n", "s.toml:3:17: sensor.elevation_deg: out of range, 90.5"},
        {head + "height_m = inf\n", "s.toml:2:12: sensor.height_m: out of range"},
        {head + "height_m = 1\ndirection = [0,0,1]\n", "s.toml:3:1: sensor.direction: beside"},
        {head + "height_m = 1\nsamples = 63\n", "s.toml:3:11: sensor.samples: out of range, 63"},
        {head + "height_m = 1\nsamples = 1e9\n", "s.toml:3:11: sensor.samples: out of range"},
        {head + "height_m = 1\nname = \"\"\n", "s.toml:3:8: sensor.name: out of range"},
        {head + "height_m = 1\nname = \"a\\nb\"\n", "s.toml:3:8: sensor.name: out of range"},
        {head + "position_m = [0, 0, 1e10]\n", "s.toml:2:14: sensor.position_m: out of range"},
    };
    for (const auto& one : faults) {
        const std::string &text = one.first, fault = one.second;
        CAPTURE(text);
        std::vector<Sensor> sensors;
        const Status status = decode(text, sensors);
        CHECK(status.code == Code::kBadInput);
        CHECK_MESSAGE(status.message.find(fault) == 0, status.message);
        CHECK(status.message.find('\n') == std::string::npos);
    }
    std::vector<Sensor> sensors;
    std::string many;
    for (int i = 0; i < 4097; ++i) many += head + "height_m = 1\n";
    CHECK(decode(many, sensors).message.find("sensor: too many, 4097") != std::string::npos);
    CHECK(decode(std::string(kMaxSensorBytes + 1, '#'), sensors).code == Code::kLimit);
}

}  // namespace sensor_file_test
