// SPDX-License-Identifier: Apache-2.0
// The built-in blender against OpenGL by OSMesa and by EGL: same profile, same order.
// in: made-up billboards near, far, cut by solids -> out: agreement, or a line that says why none.
// docs/collectors.md, "Display".
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "kernels_cpu/core/rng.h"
#include "kernels_cpu/isa/kernels.h"
#include "src/methods/collectors/billboards/gl_billboards.h"
#include "src/scene/read_scene.h"

using namespace pileus;

namespace {

struct Case {
    std::string name;
    bool orthographic, solid;
    int channels;
};

float number(std::uint32_t i, std::uint32_t draw, float low, float high) {
    return low + (high - low) * uniform(threefry(9u, 41u, i, draw).a);
}

/// Overlapping spheres around a place 60 m north, some of them around the camera.
struct Spheres {
    std::vector<float> x, y, z, radius, extinction, colour;

    Spheres(std::uint32_t count, int channels) : colour(count * std::uint32_t(channels)) {
        for (std::uint32_t i = 0; i < count; ++i) {
            x.push_back(number(i, 0, -60, 60)), y.push_back(number(i, 1, -5, 110));
            z.push_back(number(i, 2, -50, 50)), radius.push_back(number(i, 3, 0.5f, 12));
            extinction.push_back(number(i, 4, 0, 0.08f));
        }
        for (std::uint32_t i = 0; i < colour.size(); ++i) colour[i] = number(i, 5, 0, 1);
    }
    BillboardScene scene(int channels, const float* solid) const {
        BillboardScene s;
        s.x = x.data(), s.y = y.data(), s.z = z.data();
        s.radius = radius.data(), s.extinction = extinction.data(), s.colour = colour.data();
        s.count = std::uint32_t(x.size());
        s.channels = channels;
        s.opaque_depth = solid;
        s.half_depth = false;
        return s;
    }
};

/// Largest difference of two planes.
double worst(const Buffer<float>& a, const Buffer<float>& b) {
    REQUIRE(a.size() == b.size());
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::fmax(most, std::fabs(double(a[i]) - double(b[i])));
    return most;
}

void compare(GlBlender& blender, const Case& which) {
    CAPTURE(which.name);
    CameraParams camera{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1.75f, 1, 161, 92, 0};
    if (which.orthographic)
        camera.orthographic = 1, camera.half_width = 70, camera.half_height = 40;
    std::vector<float> solid(161 * 92);
    for (std::uint32_t i = 0; i < solid.size(); ++i)
        solid[i] = i % 3 == 0 ? std::numeric_limits<float>::infinity() : number(i, 8, 1, 150);
    const Spheres spheres(400, which.channels);
    const BillboardScene scene =
        spheres.scene(which.channels, which.solid ? solid.data() : nullptr);
    BillboardImage own, foreign;
    REQUIRE(bool(composite_billboards(scene, camera, 1, kernel_table(nullptr)->blend_tile, own)));
    REQUIRE(bool(blend_by_gl(blender, scene, camera, 1, foreign)));
    const double alpha = worst(own.transmittance, foreign.transmittance),
                 colour = worst(own.colour, foreign.colour);
    double covered = 0;
    for (float t : own.transmittance.span()) covered += t < 0.9f;
    MESSAGE(which.name, ": largest difference of alpha ", alpha, ", of colour ", colour);
    CHECK(covered > 0.2 * double(own.transmittance.size()));

    // The built-in blender stops at a transmittance of 1e-4, colours are at most 1: 1e-4. As much
    // again for a driver's roots and exponentials, some 2^-20 each over a few spheres, and for q,
    // whose 2^-22 count at rims only: sqrt(2^-22) of a half chord where a pixel meets one exactly.
    CHECK(alpha < 2e-4);
    CHECK(colour < 2e-4);
    double sum = 0;
    for (std::size_t i = 0; i < own.transmittance.size(); ++i)
        sum += std::fabs(double(own.transmittance[i]) - double(foreign.transmittance[i]));
    CHECK(sum / double(own.transmittance.size()) < 1e-5);
}

void compare_all(Compositor compositor, const char* name) {
    GlBlender blender;
    const Status opened = open_gl_blender(compositor, blender);
    if (!opened) {
        MESSAGE("skipped: ", name, ": ", opened.message);
        CHECK(opened.code == Code::kBadInput);
        return;
    }
    for (const Case& which :
         {Case{"perspective", false, false, 3}, Case{"solids", false, true, 3},
          Case{"orthographic", true, false, 3}, Case{"batches", false, true, 7}})
        compare(blender, which);

    // What it cannot do is refused, not left out.
    const Spheres spheres(4, 1);
    BillboardScene scene = spheres.scene(1, nullptr);
    scene.half_depth = true;
    BillboardImage out;
    const CameraParams camera{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1, 1, 8, 8, 0};
    CHECK(blend_by_gl(blender, scene, camera, 1, out).code == Code::kBadInput);
}

}  // namespace

TEST_CASE("compositor: OSMesa blends what the built-in blender blends") {
    compare_all(Compositor::kOsmesa, "OSMesa");
}

TEST_CASE("compositor: EGL without a surface blends what the built-in blender blends") {
    compare_all(Compositor::kEgl, "EGL");
}

TEST_CASE("compositor: refused where it cannot show what the scene asks for") {
    const std::string camera = "[camera]\nposition_m = [0, -9, 5]\ntarget_m = [0, 0, 5]\n";
    const auto read = [&](const std::string& text, Scene& scene) {
        return read_scene_text(camera + text, "s.toml", "", {}, scene);
    };
    Scene scene;
    CHECK(bool(read("[collectors]\ndisplay = \"billboards\"\ncompositor = \"egl\"\n", scene)));
    CHECK(scene.collectors.display.compositor == Compositor::kEgl);
    CHECK(
        read("[collectors]\ncompositor = \"osmesa\"\n", scene).message ==
        "s.toml:5:14: collectors.compositor: draws billboards only, \"osmesa\", allowed: builtin, "
        "or display = \"billboards\"");
    CHECK(read("[collectors]\ndisplay = \"billboards\"\ncompositor = \"egl\"\n"
               "[output]\nlayers = [\"radiance\", \"depth\"]\n",
               scene)
              .message ==
          "s.toml:6:14: collectors.compositor: knows no layer depth, \"egl\", "
          "allowed: builtin, or layers without depth");
}
