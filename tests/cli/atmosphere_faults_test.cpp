// SPDX-License-Identifier: Apache-2.0
// Faults of [atmosphere], at their places.
// in: small scene texts with one fault each -> out: the expected line of the message.
// docs/scene.md, section Messages; docs/atmosphere.md.
#include "tests/cli/scene_faults.h"

namespace {

using namespace scene_faults;

const std::string kPlace = "latitude_deg = 47\nlongitude_deg = 8\n";

TEST_CASE("atmosphere: keys that do not go together, dates that do not exist") {
    const std::string air = kCamera + "[atmosphere]\n";
    const Row rows[] = {
        {air, "s.toml:4:1: atmosphere.date: missing, nothing, allowed: a date, or the table [sun]"},
        {air + "date = \"2026-02-29\"\n" + kPlace,
         "s.toml:5:8: atmosphere.date: no such day, \"2026-02-29\", allowed: 01 to 28 in that "
         "month"},
        {air + "date = \"noon\"\n" + kPlace,
         "s.toml:5:8: atmosphere.date: no date, \"noon\", allowed: year-month-day, as "
         "\"2026-06-21\""},
        {air + "date = \"1850-01-01\"\n" + kPlace,
         "s.toml:5:8: atmosphere.date: out of range, \"1850-01-01\", allowed: years 1900 to 2100"},
        {air + "date = \"2026-06-21\"\ntime = \"25:00\"\n" + kPlace,
         "s.toml:6:8: atmosphere.time: no such time, \"25:00\", allowed: 00:00 to 23:59:59.999999"},
        {air + "date = \"2026-06-21\"\nlongitude_deg = 8\n",
         "s.toml:5:8: atmosphere.latitude_deg: missing, nothing, allowed: degrees, with a date"},
        {air + "date = \"2026-06-21\"\nlatitude_deg = 91\nlongitude_deg = 8\n",
         "s.toml:6:16: atmosphere.latitude_deg: out of range, 91, allowed: number in [-90, 90]"},
        {air + "time = \"12:00\"\n[sun]\n",
         "s.toml:5:8: atmosphere.time: without a date, \"12:00\", allowed: left out, or "
         "atmosphere.date"},
        {air + "date = \"2026-06-21\"\n" + kPlace + "[sun]\nelevation_deg = 5\n",
         "s.toml:9:1: sun.elevation_deg: conflicts with atmosphere.date, 5, allowed: left out, or "
         "no date"},
        {air + "[sun]\n[sky]\nradiance = 1\n",
         "s.toml:7:12: sky.radiance: conflicts with [atmosphere], 1, allowed: left out"},
        {kCamera + "projection = \"orthographic\"\n[atmosphere]\n[sun]\n",
         "s.toml:4:14: camera.projection: looks from no single place in the air, "
         "\"orthographic\", allowed: perspective, flux"},
        {air + "[sun]\n[output]\nlayers = [\"light\"]\n",
         "s.toml:7:10: output.layers: no light or order through the air, [\"light\"], allowed: "
         "other layers, or no [atmosphere]"},
        {air + "[sun]\n[animation]\nhours = [0, 6]\n",
         "s.toml:7:1: animation.hours: conflicts with a scene without atmosphere.date, [0, 6], "
         "allowed: left out"},
        {air + "moon = true\n[sun]\n",
         "s.toml:5:8: atmosphere.moon: without a date, true, allowed: false, or atmosphere.date"},
        {air + "stars = true\n[sun]\n",
         "s.toml:5:9: atmosphere.stars: without a date, true, allowed: false, or atmosphere.date"},
        {air + "turbidity = 0.9\n[sun]\n",
         "s.toml:5:13: atmosphere.turbidity: out of range, 0.9, allowed: number in [1, 10]"},
    };
    for (const Row& row : rows) check(row);
    // Dates and times of TOML, without quotes.
    CHECK(read(air + "date = 2026-06-21\ntime = 08:30:00\n" + kPlace));
    CHECK_FALSE(read(air + "date = 2026-06-21T08:30:00Z\n" + kPlace));
    CHECK_FALSE(read("seed = 2026-06-21\n" + kCamera));
    CHECK(read(air + "[sun]\n"));
    CHECK(read(air + "airglow = true\nmoon = false\nstars = false\n[sun]\n"));
    CHECK(read(air + "date = \"2024-02-29\"\n" + kPlace + "[sun]\nirradiance = 3\n"));
}

}  // namespace
