// SPDX-License-Identifier: Apache-2.0
// Extreme places and sizes: far from the origin, tiny and huge boxes, wide and narrow views.
// in: one small scene, moved, scaled and looked at from odd places -> out: pictures, compared.
// docs/testing.md S33, S35, S36, S44, S45, S49: camera, bounds and ground are doubles, the rest is
// box-local.
#include "tests/stiff/stiff_scene.h"

using namespace stiff_test;

namespace {

constexpr double kEarth = 6.371e6;

void shift(Scene& scene, const Double3& by) {
    for (std::size_t a = 0; a < 3; ++a) {
        scene.camera.position_m[a] += by[a];
        scene.camera.target_m[a] += by[a];
        for (MediumSettings& m : scene.media)
            for (Double3& corner : m.box.bounds_m) corner[a] += by[a];
    }
    scene.ground.altitude_m += by[2];
}

void scale(Scene& scene, double by) {
    for (Double3* v : {&scene.camera.position_m, &scene.camera.target_m,
                       &scene.media[0].box.bounds_m[0], &scene.media[0].box.bounds_m[1]})
        *v *= by;
    scene.ground.altitude_m *= by;
    scene.media[0].optics.extinction_per_m /= by;
}

}  // namespace

TEST_CASE("S33, S45: a scene moved by the Earth's radius is the same picture") {
    for (const char* display : kDisplays)
        for (const char* ground : {"0", "-20.25"}) {
            const Scene scene = bent_scene(
                {display_key(display), std::string("ground.altitude_m=") + ground, "seed=9"});
            const Picture here = render_sound(scene);
            for (const Double3& by :
                 {Double3{kEarth, 0, 0}, Double3{0, -kEarth, 0}, Double3{0, 0, kEarth},
                  Double3{kEarth / 3, 2 * kEarth / 3, -2 * kEarth / 3}}) {
                Scene there = scene;
                shift(there, by);
                const double worst = worst_difference(here, render_sound(there));
                std::printf("%s, ground %s, moved by %g %g %g m: worst %.2g\n", display, ground,
                            by[0], by[1], by[2], worst);
                CHECK(worst <= 1e-5);
            }
        }
}

TEST_CASE("S44: boxes from a tenth of a millimetre to ten thousand kilometres") {
    for (const char* display : kDisplays) {
        const Scene scene = bent_scene({display_key(display), "ground.altitude_m=100"});
        const Picture plain = render_sound(scene);
        // Decimal factors round each length on its own: a photon at the border of two voxels may
        // go another way, so that means are compared, to one photon in a thousand.
        for (double by : {1e-7, 1e-3, 1e4}) {
            Scene scaled = scene;
            scale(scaled, by);
            const Picture p = render_sound(scaled);
            const double ratio = mean_of(p, "G") / mean_of(plain, "G");
            std::printf("%s, lengths times %g: mean %.6f of the plain one\n", display, by, ratio);
            CHECK(std::fabs(ratio - 1) <= 1e-3);
            CHECK(std::fabs(mean_of(p, "A") / mean_of(plain, "A") - 1) <= 1e-4);
        }
    }
}

TEST_CASE("S44: a camera far away sees the same cloud, or is refused") {
    // The field of view shrinks with the distance, so that the picture stays.
    for (const char* display : kDisplays) {
        Picture near;
        for (double far : {1.0, 1e2, 1e3, 1e4, 4.9e4, 1e5}) {
            char position[64], fov[64];
            std::snprintf(position, sizeof position, "camera.position_m=[0,%.17g,1100]",
                          -20000 * far);
            std::snprintf(fov, sizeof fov, "camera.fov_deg=%.17g", 6 / far);
            const Keys keys{display_key(display), position, fov, "collectors.photons=0"};
            if (20000 * far > 1e9) {
                Scene scene;
                const Status status = read_scene_text(kText, "s.toml", "", keys, scene);
                CHECK(status.code == Code::kBadInput);
                continue;
            }
            Picture p = render_sound(bent_scene(keys));
            if (far == 1) {
                near = std::move(p);
                continue;
            }
            // Nearer parts look 4 % larger from 20 km than from infinity: that is the allowance.
            const double ratio = mean_of(p, "A") / mean_of(near, "A");
            std::printf("%s from %g km: mean alpha %.6f of that from 20 km, worst %.2g\n", display,
                        20 * far, ratio, worst_difference(near, p));
            CHECK(std::fabs(ratio - 1) <= 0.02);
        }
    }
}

TEST_CASE("S49: fields of view from 1e-4 to 179.9 degrees, pictures of one pixel and of one row") {
    for (const char* display : kDisplays) {
        for (const char* fov : {"1e-4", "179.9", "179.9999"})
            render_sound(bent_scene({display_key(display), std::string("camera.fov_deg=") + fov}));
        for (const char* size : {"[1,1]", "[16384,1]", "[1,16384]", "[3,7]"}) {
            const Picture p = render_sound(
                bent_scene({display_key(display), std::string("camera.resolution=") + size,
                            "collectors.photons=1000"}));
            CHECK(p.image.find("R")->pixels.size() ==
                  std::size_t(p.image.width) * std::size_t(p.image.height));
        }
        // A camera that looks away from the cloud sees nothing but sky.
        const Picture away =
            render_sound(bent_scene({display_key(display), "camera.target_m=[0,-9000,1100]"}));
        CHECK(largest_of(away, "A") == 0);
        CHECK(away.at("R", 0, 0) == 0.05f);
    }
}

TEST_CASE("S35, S36: single voxels, rods and plates show exp(-sigma L)") {
    // One ray through the middle of the box, along each axis: A = 1 - exp(-sigma L) by the march.
    const char* const sizes[] = {"[1,1,1]", "[1,1,64]", "[64,1,1]", "[1,64,1]", "[7,1,1000]"};
    const char* const boxes[] = {"[[-1,-1,-1],[1,1,1]]", "[[-1,-1,-1000],[1,1,1000]]",
                                 "[[-1000,-2,-1],[1000,2,1]]"};
    const double lengths[][3] = {{2, 2, 2}, {2, 2, 2000}, {2000, 4, 2}};
    double worst = 0;
    // Up to 8192 steps multiply as many rounded factors near 1, half an ulp or 2^-25 each.
    constexpr double kRounding = 8192 * 0x1p-25;
    for (std::size_t b = 0; b < 3; ++b)
        for (const char* size : sizes)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double tau = 1.5, length = lengths[b][axis];
                char position[96], sigma[64];
                std::snprintf(position, sizeof position, "camera.position_m=[%g,%g,%g]",
                              axis == 0 ? -3000.0 : 0.0, axis == 1 ? -3000.0 : 0.0,
                              axis == 2 ? 3000.0 : 0.0);
                std::snprintf(sigma, sizeof sigma, "medium.0.extinction_per_m=%.17g", tau / length);
                const Picture p = render_sound(bent_scene(
                    {"medium.0.density=uniform:box", std::string("medium.0.resolution=") + size,
                     std::string("medium.0.bounds_m=") + boxes[b], sigma, position,
                     "camera.target_m=[0,0,0]", "camera.up=[0,1,0.5]", "camera.resolution=[1,1]",
                     "collectors.photons=0"}));
                worst = std::max(worst, std::fabs(double(p.at("A", 0, 0)) + std::expm1(-tau)));
            }
    std::printf("alpha of a ray along an axis: worst error %.2g\n", worst);
    CHECK(worst <= kRounding);
}
