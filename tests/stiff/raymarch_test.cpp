// SPDX-License-Identifier: Apache-2.0
// Extreme raymarches: no steps and one, steps longer than the cloud, cameras in the densest place,
// suns at the horizon, sizes and views at the ends of their ranges.
// in: one small scene, bent by overrides -> out: pictures, compared with what must be left.
// docs/testing.md S13, S38, S40-S42, S44-S49.
#include <algorithm>

#include "tests/stiff/stiff_scene.h"

using namespace stiff_test;

namespace {

const char* const kRules[] = {"closed", "riemann", "trapezoid", "simpson", "simpson38"};
const char* const kSpacings[] = {"uniform", "voxel", "optimal", "geometric"};

Scene marched(Keys overrides) {
    overrides.push_back("method.name=raymarch");
    return bent_scene(overrides);
}
std::string rule_key(const char* rule) { return std::string("raymarch.integrator=") + rule; }
std::string spacing_key(const char* spacing) { return std::string("raymarch.spacing=") + spacing; }

}  // namespace

TEST_CASE("S13, S38, S41: no medium, or no step, is the background") {
    for (const char* key :
         {"medium.0.extinction_per_m=0", "medium.0.extinction_per_m=1e-300", "raymarch.steps=0"})
        for (const char* spacing : kSpacings) {
            const Picture p = render_sound(marched({key, spacing_key(spacing)}));
            CHECK(largest_of(p, "A") == 0);
            for (float v : p.image.find("B")->pixels.span()) CHECK(v == 0.11f);
        }
}

TEST_CASE("S41: one step through the whole cloud, and 65536") {
    for (const char* rule : kRules)
        for (const char* spacing : kSpacings)
            for (const char* steps : {"1", "2", "65536"}) {
                if (std::string(steps) == "65536" && std::string(rule) != "closed") continue;
                const Picture p = render_sound(
                    marched({rule_key(rule), spacing_key(spacing), "camera.resolution=[6,4]",
                             std::string("raymarch.steps=") + steps, "raymarch.growth=2",
                             "raymarch.light=march", "raymarch.detail=true"}));
                CAPTURE(rule);
                CAPTURE(spacing);
                CHECK(largest_of(p, "A") > 0);
            }
}

TEST_CASE("S40: an opaque sheet of one voxel is seen at any angle, and halving steps converges") {
    for (const char* rule : {"closed", "trapezoid", "simpson"}) {
        const Keys sheet = {"medium.0.density=uniform:box",
                            "medium.0.resolution=[4,4,1]",
                            "medium.0.bounds_m=[[-800,-800,1000],[800,800,1001]]",
                            "medium.0.extinction_per_m=50",
                            "camera.position_m=[0,-3000,2000]",
                            "camera.target_m=[0,0,1000]",
                            "camera.resolution=[5,5]",
                            "camera.fov_deg=5",
                            "raymarch.spacing=uniform",
                            rule_key(rule)};
        const Picture p = render_sound(marched(sheet));
        CHECK(p.at("A", 2, 2) >= 0.9999f);  // stop_below ends the ray there
    }
}

TEST_CASE("S46: sun at, below and above the horizon") {
    for (const char* elevation : {"-90", "-1", "-1e-7", "0", "1e-7", "90"})
        for (const char* light : {"march", "buffer"}) {
            const Keys keys = {"ground.altitude_m=0", "sky.radiance=0",
                               std::string("sun.elevation_deg=") + elevation,
                               std::string("raymarch.light=") + light};
            const Picture p = render_sound(marched(keys));
            if (elevation[0] == '-' || elevation[0] == '0') {
                CHECK(largest_of(p, "G") == 0);
                CHECK(left_out(p, "sunlight"));
            } else {
                CHECK(largest_of(p, "G") > 0);
            }
        }
}

TEST_CASE("S47: view along the sun and against it is below the phase function's peak") {
    const double peak = 0.99 * (1 + 0.85) / (0.15 * 0.15) / (4 * 3.14159265358979);
    for (const char* azimuth : {"0", "180"})
        for (const char* rule : kRules) {
            const Picture p = render_sound(
                marched({std::string("sun.azimuth_deg=") + azimuth, "sun.elevation_deg=0",
                         "sky.radiance=0", rule_key(rule), "raymarch.steps=16"}));
            CHECK(double(largest_of(p, "G")) <= peak * 1.0002);
            CHECK(largest_of(p, "G") > 0);
        }
}

TEST_CASE("S48: camera in the densest voxel, on faces and corners, extinctions up to 10^6") {
    for (const char* place : {"[0.5,0.5,1100.5]", "[-800,0,1100]", "[-800,-800,600]"})
        for (const char* sigma : {"0.02", "1", "1e6"})
            for (const char* rule : kRules)
                for (const char* spacing : kSpacings) {
                    const Picture p = render_sound(marched(
                        {std::string("camera.position_m=") + place, "camera.target_m=[10,20,1130]",
                         std::string("medium.0.extinction_per_m=") + sigma, rule_key(rule),
                         spacing_key(spacing), "camera.resolution=[4,3]", "raymarch.steps=64",
                         "medium.0.density=uniform:box", "sky.radiance=0", "sun.irradiance=0",
                         "raymarch.ambient=0.25"}));
                    CAPTURE(rule);
                    CAPTURE(spacing);
                    CAPTURE(sigma);
                    // Emission alone: no rule shows more than an opaque medium would, and the
                    // closed form shows that in any opaque one.
                    CHECK(double(largest_of(p, "G")) <= 0.25 * 1.0002);
                    if (std::string(rule) == "closed" && std::string(sigma) == "1e6")
                        CHECK(mean_of(p, "G") == doctest::Approx(0.25).epsilon(1e-5));
                }
}

TEST_CASE("S44, S45: far away, moved by the Earth's radius, 10^7 times as far as near") {
    const Picture near = render_sound(marched({"sky.radiance=0"}));
    for (const char* spacing : kSpacings) {
        // A view of 0.13 millionths of the angle from 10^7 m shows the same cloud.
        const Picture far = render_sound(marched(
            {"camera.position_m=[0,-1e7,1100]", "camera.fov_deg=0.0125", spacing_key(spacing)}));
        CHECK(largest_of(far, "A") > 0.5);
        const Picture inside =
            render_sound(marched({"camera.position_m=[0,-799.99,1100]", spacing_key(spacing),
                                  "raymarch.first_step_m=0.001"}));
        CHECK(largest_of(inside, "A") > 0.5);
    }
    const Picture moved =
        render_sound(marched({"sky.radiance=0", "camera.position_m=[6371000,-3000,1100]",
                              "camera.target_m=[6371000,0,1100]",
                              "medium.0.bounds_m=[[6370200,-800,600],[6371800,800,1700]]"}));
    CHECK(worst_difference(near, moved) <= 1e-5);
}

TEST_CASE("S49: fields of view and pictures at the ends of their ranges") {
    for (const char* spacing : kSpacings)
        for (const char* view : {"1e-4", "179.9999"})
            for (const char* size : {"[1,1]", "[64,1]", "[1,64]"})
                render_sound(
                    marched({std::string("camera.fov_deg=") + view, spacing_key(spacing),
                             std::string("camera.resolution=") + size, "raymarch.detail=true"}));
}

TEST_CASE("S42: rays in the planes of faces and through corners") {
    for (const char* rule : kRules)
        for (const char* along : {"0,1150]", "-800,1150]", "800,1700]", "-800,600]"}) {
            const std::string to = along;
            const std::string x = to.substr(0, to.find(',')), z = to.substr(to.find(',') + 1);
            // The middle pixel's ray runs in a face, along an edge, or through the middle.
            const Picture p = render_sound(
                marched({"camera.position_m=[" + x + ",-3000," + z, "camera.resolution=[9,9]",
                         "camera.target_m=[" + x + ",0," + z, rule_key(rule),
                         "medium.0.density=uniform:box"}));
            CHECK(largest_of(p, "A") > 0);
        }
}
