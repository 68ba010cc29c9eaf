// SPDX-License-Identifier: Apache-2.0
// Sound scenes give the values they state; defaults, overrides, documentation and limits hold.
// in: scene texts, assets/scenes, docs/scene.md -> out: fields of Scene.
// docs/scene.md.
#include "src/scene/scene.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "src/scene/check_keys.h"
#include "src/scene/read_scene.h"
#include "src/scene/scene_keys.h"

namespace {

using namespace pileus;

const std::string kCamera = "[camera]\nposition_m = [0, -9, 5]\ntarget_m = [0, 0, 5]\n";

Scene good(const std::string& text, const std::vector<std::string>& overrides = {}) {
    Scene scene;
    const Status status = read_scene_text(text, "s.toml", "dir", overrides, scene);
    CHECK_MESSAGE(bool(status), status.message);
    return scene;
}

std::string file_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

template <class List>
void dump_list(std::ostream& s, const List& list) {
    for (const auto& v : list) s << v << ' ';
}

void dump_medium(std::ostream& s, const MediumSettings& m) {
    s << int(m.density) << ' ' << m.file << ' ' << m.format << ' ' << int(m.raw_type) << ' ';
    dump_list(s, m.raw_size);
    s << m.raw_big_endian << m.has_bounds << ' ';
    for (const Double3& corner : m.bounds_m) dump_list(s, corner);
    dump_list(s, m.resolution);
    s << m.shape_seed << ' ' << m.extinction_per_m << ' ';
    dump_list(s, m.albedo);
    const PhaseSettings& p = m.phase;
    s << int(p.kind) << ' ' << p.g << ' ' << p.g1 << ' ' << p.g2 << ' ' << p.weight << ' ' << m.y_up;
}

/// Every value of a scene but its text and names: two scenes with equal dumps are equal.
std::string dump(const Scene& scene) {
    std::ostringstream s;
    s.precision(17);
    const Camera& c = scene.camera;
    s << scene.seed << '\n';
    for (const Double3& v : {c.position_m, c.target_m, c.up}) dump_list(s, v);
    s << c.orthographic << ' ' << c.fov_deg << ' ' << c.height_m << ' ';
    dump_list(s, c.resolution);
    s << '\n' << scene.sun.present << ' ' << scene.sun.azimuth_deg << ' ';
    s << scene.sun.elevation_deg << ' ';
    dump_list(s, scene.sun.irradiance);
    s << '\n' << scene.sky.present << ' ';
    dump_list(s, scene.sky.radiance);
    const Ground& g = scene.ground;
    s << '\n' << g.present << ' ' << g.altitude_m << ' ' << g.albedo << '\n';
    for (const MediumSettings& medium : scene.media) dump_medium(s, medium);
    const CollectorSettings& k = scene.collectors;
    s << '\n' << scene.method << ' ' << k.photons << ' ' << k.generations << ' ' << k.bands << ' ';
    s << k.samples << ' ' << k.local_tracking << k.lobe_closure << k.paper << k.billboards;
    s << k.rejection_sampler << k.variance_field << ' ' << k.variance_radius << ' ';
    s << k.density_range << ' ' << k.influence_radius << ' ' << k.radius_factor << ' ';
    s << k.first_order_split << k.window << '\n' << scene.path_samples_per_pixel << '\n';
    const OutputSettings& o = scene.output;
    dump_list(s, o.files);
    s << o.report << o.layer_depth << o.layer_error << o.layer_cloud << '\n';
    const Animation& a = scene.animation;
    s << a.present << ' ' << a.frames << ' ' << a.moves_camera << a.moves_sun << ' ';
    dump_list(s, a.camera_orbit_deg);
    dump_list(s, a.sun_elevation_deg);
    return s.str();
}

const char* const kEveryKey = R"(
seed = 9_223_372_036_854_775_807
[camera]
position_m = [1, -2.5, 3]
target_m = [4, 5, 6]
up = [0, 1, 0]
projection = "orthographic"
height_m = 77
resolution = [16, 9]
[sun]
azimuth_deg = 120
elevation_deg = 35
irradiance = [2, 3, 4]
[sky]
radiance = 0.25
[ground]
altitude_m = -10
albedo = 0.5
[[medium]]
density = "procedural:cumulus"
bounds_m = [[0, 0, 0], [1, 2, 3]]
resolution = [3, 4, 5]
shape_seed = 8
extinction_per_m = 0.05
albedo = [0.1, 0.2, 0.3]
phase = { type = "henyey-greenstein", g = -1 }
boundary = "open"
y_up = false
[[medium]]
density = { file = "a.dat", type = "uint16", size = [7, 8, 9], endian = "big" }
bounds_m = [[0, 0, 0], [1, 1, 1]]
extinction_per_m = 1e12
phase = { type = "two-lobe", g1 = 1, g2 = -0.5, weight = 0.75 }
y_up = true
[[medium]]
density = "b.txt"
format = "pbrt"
extinction_per_m = 0
phase = { type = "rayleigh" }
[method]
name = "collectors"
[collectors]
photons = 2e6
generations = 7
bands = 5
samples = 11
tracking = "global"
closure = "lobe"
variant = "paper"
display = "march"
sampler = "stratified"
placement = "variance"
variance_radius = 3
density_range = 0.5
influence_radius = 1
radius_factor = 2
first_order_split = true
window = true
[path]
samples_per_pixel = 5
[photon-grid]
anything = { goes = [1, 2] }
[output]
files = ["x.exr", "y.pfm"]
report = "r.json"
layers = ["radiance", "depth", "error", "cloud"]
[animation]
frames = 12
camera_orbit_deg = [0, 90]
sun_elevation_deg = [35, 5]
)";

TEST_CASE("every key of a full scene reaches its field") {
    const Scene scene = good(kEveryKey);
    CHECK(dump(scene) ==
          "9223372036854775807\n"
          "1 -2.5 3 4 5 6 0 1 0 1 40 77 16 9 \n"
          "1 120 35 2 3 4 \n"
          "1 0.25 0.25 0.25 \n"
          "1 -10 0.5\n"
          "0   2 0 0 0 00 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0");
}

}  // namespace
