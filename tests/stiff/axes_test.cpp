// SPDX-License-Identifier: Apache-2.0
// Suns on the axes and views along them, rays in the faces of voxels: every method and boundary.
// in: one small cloud on uneven grids -> out: pictures without accidents, as beside the axis.
// docs/testing.md, "Stiff cases"
#include "src/session/warnings.h"
#include "tests/stiff/stiff_scene.h"

using namespace stiff_test;

namespace {

// Rows of 20 m: rays run in the faces between voxels of 20 m, none in the box's own.
constexpr const char* kAxes = R"(
seed = 5
[camera]
position_m = [-500, 0, 60]
target_m = [0, 0, 60]
projection = "orthographic"
height_m = 100
resolution = [5, 5]
[sun]
azimuth_deg = 0
elevation_deg = 90
[[medium]]
density = "uniform:ellipsoid"
bounds_m = [[-80, -80, 0], [80, 80, 120]]
resolution = [8, 6, 6]
extinction_per_m = 0.05
albedo = 1
phase = { type = "henyey-greenstein", g = 0.5 }
[path]
samples_per_pixel = 16
pixel = "centre"
[collectors]
photons = 2_000
generations = 4
samples = 200
[output]
layers = ["error"]
)";

constexpr const char* kGrids[] = {"[8,6,6]", "[12,1,9]", "[1,7,1]", "[1,1,1]"};
constexpr const char* kViews[] = {"[-500,0,60]", "[500,0,60]", "[0,-500,60]",
                                  "[0,500,60]",  "[0,0,560]",  "[0,0,-440]"};
constexpr const char* kRules[] = {"closed", "riemann", "trapezoid", "simpson", "simpson38"};
constexpr const char* kLightKeys[] = {"march", "buffer", "buffer-exact"};

std::string number(const char* key, double value) { return key + std::to_string(value); }

/// Mean of the green channel, and its error as the picture knows it; 0 without noise.
struct MeanLight {
    double mean = 0, error = 0;
};
MeanLight light_of(const Picture& p) {
    MeanLight light{mean_of(p, "G"), 0};
    if (p.image.find("error.G") == nullptr) return light;
    double square = 0, count = 0;
    for (float e : p.image.find("error.G")->pixels.span()) square += double(e) * double(e), ++count;
    light.error = std::sqrt(square) / count;
    return light;
}

Picture sound(Keys keys, double elevation) {
    keys.push_back(number("sun.elevation_deg=", elevation));
    Picture p = render_sound(scene_from(kAxes, keys), one_thread());
    for (const std::string& warning : p.report.warnings) FAIL_CHECK(warning);
    return p;
}

/// The picture with the sun on the axis is that with it 0.001 degrees beside, within 6 standard
/// errors of both; without noise within 0.5 per cent, as a path through the box grows by 2e-5 of
/// itself, or meets another node where it runs in a face. Returns the mean.
double check_axis(const Keys& keys, double elevation) {
    const double beside = elevation > 0 ? elevation - 0.001 : elevation + 0.001;
    const MeanLight on = light_of(sound(keys, elevation)), off = light_of(sound(keys, beside));
    CHECK(std::fabs(on.mean - off.mean) <=
          6 * std::hypot(on.error, off.error) + 0.005 * std::fabs(off.mean));
    return on.mean;
}

/// Calls use(keys, elevation) for suns on all axes over all grids; views, integrators and sorts of
/// light take turns.
template <class Use>
void for_suns(const char* boundary, bool marched, Use use) {
    int turn = 0;
    for (const char* grid : kGrids)
        for (double azimuth : {0., 90., 180., 270.})
            for (double elevation : {90., 0., -90.}) {
                // Steps of a march do not follow a layer that is seen edge-on, which has no end.
                const bool upright = marched && boundary[0] == 'p';
                const char* view = kViews[std::size_t(upright ? 4 + turn % 2 : turn % 6)];
                ++turn;
                Keys keys = {std::string("medium.0.resolution=") + grid,
                             std::string("medium.0.boundary=") + boundary,
                             number("sun.azimuth_deg=", azimuth),
                             std::string("camera.position_m=") + view};
                if (view[1] == '0' && view[3] == '0') keys.push_back("camera.up=[0,1,0]");
                const bool flat = grid[1] == '1';
                if (flat) keys.push_back("medium.0.density=uniform:box");
                const std::string where = std::string(boundary) + " " + grid + " from " + view;
                CAPTURE(where);
                CAPTURE(azimuth);
                CAPTURE(elevation);
                use(keys, elevation, turn);
            }
}

Keys with(Keys keys, const Keys& more) {
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
}

}  // namespace

TEST_CASE("suns on the axes: method path") {
    for (const char* boundary : {"open", "periodic"})
        for_suns(boundary, false, [&](const Keys& keys, double elevation, int) {
            const Keys own = with(keys, {"method.name=path"});
            // A layer gets nothing from a level sun.
            if (elevation == 0 && boundary[0] == 'p')
                sound(own, 0);
            else
                CHECK(check_axis(own, elevation) > 0);
        });
}

TEST_CASE("suns on the axes: method collectors, both displays") {
    for (const char* boundary : {"open", "periodic"})
        for (const char* display : kDisplays) {
            if (boundary[0] == 'p' && std::string(display) == "billboards") continue;
            for_suns(boundary, false, [&](const Keys& keys, double elevation, int) {
                const Keys own = with(keys, {display_key(display)});
                if (elevation == 0 && boundary[0] == 'p')
                    sound(own, 0);
                else
                    CHECK(check_axis(own, elevation) > 0);
            });
        }
}

TEST_CASE("suns on the axes: method raymarch, integrators and lights in turn") {
    for (const char* boundary : {"open", "periodic"})
        for_suns(boundary, true, [&](const Keys& keys, double elevation, int turn) {
            const std::string rule = kRules[std::size_t(turn) % 5];
            const std::string light = kLightKeys[std::size_t(turn) % 3];
            CAPTURE(rule);
            CAPTURE(light);
            const Keys own =
                with(keys, {"method.name=raymarch", "output.layers=[]", "raymarch.light=" + light});
            // Other rules read the box's face itself, which a sun beside the axis sees and the one
            // on it does not.
            sound(with(own, {"raymarch.integrator=" + rule}), elevation);
            if (elevation == 0 && boundary[0] == 'p')
                sound(own, 0);
            else
                CHECK(check_axis(own, elevation) > 0);
        });
}

TEST_CASE("one pixel, one cell, the sun overhead") {
    for (const char* method : {"path", "collectors", "photon-grid", "raymarch"})
        for (const char* boundary : {"open", "periodic"}) {
            Keys keys = {std::string("method.name=") + method, "medium.0.resolution=[1,1,1]",
                         std::string("medium.0.boundary=") + boundary, "camera.resolution=[1,1]",
                         "medium.0.density=uniform:box"};
            if (std::string(method) == "raymarch") keys.push_back("output.layers=[]");
            CAPTURE(method);
            CAPTURE(boundary);
            CHECK(check_axis(keys, 90) > 0);
        }
}

TEST_CASE("rays in the faces of the box end") {
    for (const char* method : {"path", "collectors", "photon-grid", "raymarch"})
        for (const char* boundary : {"open", "periodic"})
            for (const char* view : {"[-500,0,40]", "[0,0,540]"}) {
                Keys keys = {std::string("method.name=") + method,
                             "camera.target_m=[0,0,40]",
                             "camera.height_m=180",
                             "camera.resolution=[9,9]",
                             std::string("medium.0.boundary=") + boundary,
                             std::string("camera.position_m=") + view};
                if (view[1] == '0') keys.push_back("camera.up=[0,1,0]");
                if (std::string(method) == "raymarch") keys.push_back("output.layers=[]");
                CAPTURE(method);
                CAPTURE(boundary);
                CHECK(light_of(sound(keys, 90)).mean > 0);
            }
}
