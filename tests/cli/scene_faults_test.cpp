// SPDX-License-Identifier: Apache-2.0
// Every fault of one key is reported once, at its place, with what is allowed.
// in: small scene texts with one fault each -> out: the expected line of the message.
// docs/scene.md, section Messages.
#include "tests/cli/scene_faults.h"

#include <doctest/doctest.h>

#include <string>

namespace {

using namespace scene_faults;

TEST_CASE("a fault of the text itself") {
    check({"seed = 1\nseed = 2\n",
           "s.toml:2:8: not TOML, Error while parsing key-value pair: "
           "cannot redefine existing integer 'seed'"});
    check({"seed = \n", "s.toml:1:8: not TOML, ..."});
    check({"a = \"\xff\"\n", "s.toml:1:5: not TOML, ..."});
    check({"a = 99999999999999999999\n", "s.toml:1:25: not TOML, ..."});
    check({"a = 1e999\n", "s.toml:1:10: not TOML, ..."});
    check({"[=]\n", "s.toml:1:2: not TOML, ..."});
    check({"[camera]\n[camera]\n", "s.toml:2:1: not TOML, ..."});
}

TEST_CASE("unknown, missing and ill-typed keys") {
    const Row rows[] = {
        {"sed = 1\n" + kCamera,
         "s.toml:1:1: sed: unknown key, \"sed\", allowed: seed, camera, sun, ...; did you mean "
         "seed?"},
        {kCamera + "fov_dg = 1\n",
         "s.toml:4:1: camera.fov_dg: unknown key, \"fov_dg\", allowed: position_m, target_m, "
         "up, ...; did you mean fov_deg?"},
        // A name without its unit, or with another, in the same table and elsewhere.
        {kCamera + "[sun]\nelevation = 1\n",
         "s.toml:5:1: sun.elevation: unknown key, \"elevation\", allowed: azimuth_deg, ...; did "
         "you mean elevation_deg?"},
        {kCamera + "fov = 1\n", "s.toml:4:1: camera.fov: ...; did you mean fov_deg?"},
        {kCamera + "height_km = 1\n", "s.toml:4:1: camera.height_km: ...; did you mean height_m?"},
        {kCamera + "elevation = 1\n",
         "s.toml:4:1: camera.elevation: ...; did you mean sun.elevation_deg?"},
        {kCamera + "photons = 1\n",
         "s.toml:4:1: camera.photons: unknown key, \"photons\", allowed: position_m, ...; did you "
         "mean collectors.photons?"},
        {kCamera + "[sun]\n\"a\\nb\" = 1\n",
         "s.toml:5:1: sun.\"a\\x0ab\": unknown key, \"a\\x0ab\", allowed: azimuth_deg, "
         "elevation_deg, irradiance, angular_radius_deg"},
        {"[camera]\nposition_m = [0, -9, 5]\n",
         "s.toml:1:1: camera.target_m: missing, nothing, allowed: 3 numbers in [-1e+09, 1e+09]"},
        {kCamera + "[[medium]]\ndensity = \"uniform:box\"\nbounds_m = [[0, 0, 0], [1, 1, 1]]\n",
         "s.toml:4:1: medium.0.extinction_per_m: missing, nothing, allowed: number in [0, 1e+12]"},
        {kCamera + kMedium + "phase = { g = 0.5 }\n",
         "s.toml:8:9: medium.0.phase.type: missing, nothing, allowed: isotropic, rayleigh, "
         "henyey-greenstein, ..."},
        {"camera = 3\n", "s.toml:1:10: camera: wrong type, 3, allowed: a table"},
        {kCamera + "[medium]\ndensity = \"uniform:box\"\n",
         "s.toml:4:1: medium: wrong type or too many, a table, allowed: up to 64 tables, each "
         "headed [[medium]]"},
        {"seed = \"x\"\n" + kCamera,
         "s.toml:1:8: seed: wrong type, \"x\", allowed: whole number in [0, 9223372036854775807]"},
        {"seed = 1.5\n" + kCamera, "s.toml:1:8: seed: not a whole number, 1.5, ..."},
        {"seed = 2024-01-01\n" + kCamera, "s.toml:1:8: seed: wrong type, a date, ..."},
        {"seed = true\n" + kCamera, "s.toml:1:8: seed: wrong type, true, ..."},
        {kCamera + "up = 1\n", "s.toml:4:6: camera.up: wrong type, 1, ..."},
        {kCamera + "up = [0, 1]\n", "s.toml:4:6: camera.up: wrong length, [0, 1], ..."},
        {kCamera + "up = [0, 0, \"z\"]\n", "s.toml:4:13: camera.up: wrong type, \"z\", ..."},
        {kCamera + kMedium + "y_up = 1\n",
         "s.toml:8:8: medium.0.y_up: wrong type, 1, allowed: true, false"},
        {kCamera + kMedium + "phase = \"isotropic\"\n",
         "s.toml:8:9: medium.0.phase: wrong type, \"isotropic\", allowed: a table"},
        {kCamera + "[output]\nfiles = \"a.png\"\n",
         "s.toml:5:9: output.files: wrong type, \"a.png\", allowed: list of up to 16 texts"},
        {kCamera + "[particles]\nbins = 1\nleaf = 2\n\n[sky]\nradiance = {}\n",
         "s.toml:9:12: sky.radiance: wrong type, a table, allowed: number or [r, g, b] in "
         "[0, 1e+12]"},
        {"particles = 1\n" + kCamera, "s.toml:1:13: particles: wrong type, 1, allowed: a table"},
    };
    for (const Row& row : rows) check(row);
}

TEST_CASE("values out of range") {
    const Row rows[] = {
        {"seed = -1\n" + kCamera, "s.toml:1:8: seed: out of range, -1, ..."},
        {kCamera + "fov_deg = 0\n",
         "s.toml:4:11: camera.fov_deg: out of range, 0, allowed: number in [1e-06, 180)"},
        {kCamera + "fov_deg = 180\n", "s.toml:4:11: camera.fov_deg: out of range, 180, ..."},
        {kCamera + "fov_deg = nan\n", "s.toml:4:11: camera.fov_deg: not finite, nan, ..."},
        {kCamera + "up = [0, inf, 1]\n", "s.toml:4:10: camera.up: not finite, inf, ..."},
        {kCamera + "resolution = [0, 10]\n",
         "s.toml:4:15: camera.resolution: out of range, 0, allowed: 2 whole numbers in [1, 32768]"},
        {kCamera + "resolution = [10, 32769]\n",
         "s.toml:4:19: camera.resolution: out of range, 32769, ..."},
        {kCamera + "[sun]\nirradiance = [1, -1, 1]\n",
         "s.toml:5:18: sun.irradiance: out of range, -1, allowed: number or [r, g, b] in "
         "[0, 1e+12]"},
        {kCamera + "[sun]\nelevation_deg = 91\n", "s.toml:5:17: sun.elevation_deg: out of ..."},
        {kCamera + "[sky]\nradiance = -0.5\n", "s.toml:5:12: sky.radiance: out of range, -0.5,..."},
        {kCamera + "[ground]\nalbedo = 1.01\n",
         "s.toml:5:10: ground.albedo: out of range, 1.01, allowed: number in [0, 1]"},
        {kCamera + kMedium + "albedo = [1, 1, 1.5]\n",
         "s.toml:8:17: medium.0.albedo: out of range, 1.5, ..."},
        {kCamera + kMedium + "phase = { type = \"henyey-greenstein\", g = 1.001 }\n",
         "s.toml:8:43: medium.0.phase.g: out of range, 1.001, allowed: number in [-1, 1]"},
        {kCamera + kMedium + "phase = { type = \"cloud\", effective_radius_um = 3.99 }\n",
         "s.toml:8:49: medium.0.phase.effective_radius_um: out of range, 3.99, allowed: number in "
         "[4, 20]"},
        {kCamera + kMedium + "phase = { type = \"hg-draine\", droplet_diameter_um = 51 }\n",
         "s.toml:8:53: medium.0.phase.droplet_diameter_um: out of range, 51, allowed: number in "
         "[5, 50]"},
        {kCamera + kMedium + "resolution = [1, 1, 4097]\n",
         "s.toml:8:21: medium.0.resolution: out of range, 4097, ..."},
        {kCamera + "[collectors]\nphotons = 1099511627777\n",
         "s.toml:5:11: collectors.photons: out of range, 1099511627777, allowed: whole number in "
         "[0, 1099511627776]"},
        {kCamera + "[collectors]\ngenerations = 1001\n", "s.toml:5:15: collectors.generations:..."},
        {kCamera + "[collectors]\nbands = 9\n",
         "s.toml:5:9: collectors.bands: out of range, 9, allowed: whole number in [1, 8]"},
        {kCamera + "[collectors]\ninfluence_radius = 0\n",
         "s.toml:5:20: collectors.influence_radius: out of range, 0, allowed: number in [1e-09, "
         "1]"},
        {kCamera + "[collectors]\ndisplay = \"marsh\"\n",
         "s.toml:5:11: collectors.display: unknown value, \"marsh\", allowed: march, billboards"},
        {kCamera + "[path]\nsamples_per_pixel = 0\n", "s.toml:5:21: path.samples_per_pixel: ..."},
        {kCamera + "[animation]\nframes = 0\n", "s.toml:5:10: animation.frames: out of range, ..."},
        {kCamera + "[[medium]]\ndensity = \"uniform:box\"\nextinction_per_m = 2e12\n"
                   "bounds_m = [[0, 0, 0], [1, 1, 1]]\n",
         "s.toml:6:20: medium.0.extinction_per_m: out of range, 2e+12, ..."},
    };
    for (const Row& row : rows) check(row);
}

TEST_CASE("parts of the format that this version cannot use") {
    const Row rows[] = {
        {kCamera + "[method]\nname = \"radiosity\"\n",
         "s.toml:5:8: method.name: unknown value, \"radiosity\", allowed: collectors, path, ..."},
        {kCamera + "[sky]\nmodel = \"atmosphere\"\n", "s.toml:5:1: sky.model: not in this ..."},
    };
    for (const Row& row : rows) check(row);
}

TEST_CASE("all faults are listed, in the order of the text, overrides last") {
    const std::string text =
        "[sun]\nirradiance = [-1, -2, 0]\n[camera]\nposition_m = 1\nfov = 3\n[ground]\nalbedo = "
        "2\n";
    const Status status = read(text, {"collectors.bands=0", "seed=x"});
    CHECK(status.code == Code::kBadInput);
    const char* const starts[] = {
        "s.toml:2:15: sun.irradiance: ",
        "s.toml:2:19: sun.irradiance: ",
        "s.toml:3:1: camera.target_m: ",
        "s.toml:4:14: camera.position_m: ",
        "s.toml:5:1: camera.fov: ",
        "s.toml:7:10: ground.albedo: ",
        "--set collectors.bands=0: collectors.bands: out of range, 0, ",
        "--set seed=x: seed: wrong type, \"x\", ",
    };
    std::string rest = status.message + "\n";
    for (const char* start : starts) {
        CHECK(rest.substr(0, std::string(start).size()) == start);
        rest.erase(0, rest.find('\n') + 1);
    }
    CHECK(rest.empty());
}

TEST_CASE("faults of overrides name the option") {
    struct {
        const char* option;
        const char* line;
    } const rows[] = {
        {"seed", "--set seed: not an override, \"seed\", allowed: key.path=value"},
        {"=1", "--set =1: not an override, \"=1\", allowed: key.path=value"},
        {"a..b=1", "--set a..b=1: not an override, \"a..b=1\", allowed: key.path=value"},
        {"camera.fov_deg=[1",
         "--set camera.fov_deg=[1: not a value, \"[1\", allowed: a TOML "
         "value, or a printable text without quotes"},
        {"medium.2.albedo=0.5",
         "--set medium.2.albedo=0.5: medium.2: no such element, 2, "
         "allowed: 0 to 1"},
        {"medium.x.albedo=0.5",
         "--set medium.x.albedo=0.5: medium.x: no such element, x, "
         "allowed: 0 to 1"},
        {"camera.up.3=1", "--set camera.up.3=1: camera.up.3: no such element, 3, allowed: 0 to 2"},
        {"medium.0.density.size=[1,1,1]",
         "--set medium.0.density.size=[1,1,1]: medium.0.density: holds a single value, "
         "\"uniform:box\", allowed: a table or list"},
        {"camera.fov_deg=1\nseed = 3",
         "--set camera.fov_deg=1\\x0aseed = 3: not a value, "
         "\"1\\x0aseed = 3\", allowed: a TOML value, or a "
         "printable text without quotes"},
        // The text that a picture stores would be no TOML with this behind its "# --set".
        {"output.report=a\x7f.json",
         "--set output.report=a\\x7f.json: not a value, \"a\\x7f.json\", allowed: a TOML value, or "
         "a "
         "printable text without quotes"},
    };
    const std::string text = kCamera + "up = [0, 0, 1]\n" + kMedium;
    for (const auto& row : rows) {
        CAPTURE(row.option);
        const Status status = read(text, {row.option});
        CHECK(status.code == Code::kBadInput);
        CHECK(status.message == row.line);
    }
}

}  // namespace
