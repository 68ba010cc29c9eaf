// SPDX-License-Identifier: Apache-2.0
// Extreme lights and views: no photons, suns at the horizon, views along the sun, cameras inside.
// in: one small scene, bent by overrides -> out: pictures, compared with what must be left.
// docs/testing.md S13, S46-S48, S54, S65, S78, S81, S83.
#include "tests/stiff/stiff_scene.h"

using namespace stiff_test;

namespace {

Keys join(Keys a, const Keys& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

}  // namespace

TEST_CASE("S13, S65: without a medium to speak of the picture is the background") {
    for (const char* display : kDisplays)
        for (const char* sigma : {"0", "1e-40", "1e-300"}) {
            const Picture p = render_sound(bent_scene(
                {display_key(display), std::string("medium.0.extinction_per_m=") + sigma}));
            CHECK(largest_of(p, "A") == 0);
            for (int y = 0; y < p.image.height; ++y)
                for (int x = 0; x < p.image.width; ++x) {
                    CHECK(p.at("R", x, y) == 0.05f);
                    CHECK(p.at("B", x, y) == 0.11f);
                }
            CHECK(p.report.events.scatterings == 0);
            CHECK(p.report.events.tentative == 0);
        }
}

TEST_CASE("S54: 0, 1 and 2 photons, with and without the error layer") {
    for (const char* display : kDisplays)
        for (const char* variant : {"best", "paper"})
            for (const char* layers : {"[radiance,alpha]", "[radiance,alpha,depth,error]"})
                for (std::int64_t photons : {0, 1, 2, 3}) {
                    const Scene scene = bent_scene(
                        {display_key(display), std::string("collectors.variant=") + variant,
                         std::string(layers) == "[radiance,alpha]"
                             ? "output.layers=[\"radiance\",\"alpha\"]"
                             : "output.layers=[\"radiance\",\"alpha\",\"depth\",\"error\"]"});
                    RenderOptions options = one_thread();
                    options.budget.photons = photons;
                    const Picture p = render_sound(scene, options);
                    // Every light with power gets a photon of its own per generation.
                    if (photons == 0) CHECK(p.report.photons.traced == 0);
                    if (photons > 0) CHECK(p.report.photons.traced >= 1);
                    CHECK(p.report.photons.traced <=
                          3 * std::uint64_t(std::max<std::int64_t>(photons, 1)));
                    // Nothing is known about the error of fewer than two generations.
                    if (photons < 2) CHECK(p.image.find("error.R") == nullptr);
                }
}

TEST_CASE("S54: one photon's noise makes no pixel of the ground negative; what is cut is counted") {
    for (const char* display : kDisplays) {
        const Picture p = render_sound(
            bent_scene({display_key(display), "ground.altitude_m=590", "sky.radiance=0",
                        "sun.elevation_deg=10", "collectors.generations=1", "collectors.photons=20",
                        "collectors.peak_deg=0"}));
        const Picture calm = render_sound(
            bent_scene({display_key(display), "ground.altitude_m=590", "sky.radiance=0",
                        "sun.elevation_deg=10", "collectors.photons=0"}));
        // Marched ones may be negative by themselves; their sum along a ray is not.
        if (std::string(display) == "billboards") CHECK(p.counter("clamped_negative") > 0);
        CHECK(calm.counter("clamped_negative") == 0);
    }
}

TEST_CASE("S46: suns at the horizon and beside it") {
    for (const char* display : kDisplays) {
        for (const char* degrees : {"90", "1e-7", "0", "-1e-7", "-90"}) {
            const Keys sun{display_key(display), std::string("sun.elevation_deg=") + degrees};
            const Picture air = render_sound(bent_scene(sun));
            CHECK(mean_of(air, "G") > 0);
            const Picture above = render_sound(bent_scene(join(sun, {"ground.altitude_m=0"})));
            const bool up = std::string(degrees) == "90" || std::string(degrees) == "1e-7";
            CHECK(left_out(above, "sun") == !up);
            // The ground under a sun that grazes it is lit by the sky alone.
            if (std::string(degrees) != "90")
                CHECK(double(above.at("R", 0, above.image.height - 1)) < 0.3 * 0.05);
        }
    }
}

TEST_CASE("S46: in free air nothing jumps where the sun passes the horizon") {
    // Without photons the march shows light scattered once, which has no noise.
    const Keys calm{"collectors.photons=0", "sun.irradiance=100"};
    const Picture over = render_sound(bent_scene(join(calm, {"sun.elevation_deg=1e-7"})));
    const Picture under = render_sound(bent_scene(join(calm, {"sun.elevation_deg=-1e-7"})));
    const Picture level = render_sound(bent_scene(join(calm, {"sun.elevation_deg=0"})));
    std::printf("sun 1e-7 degrees above and below the horizon: worst %.2g, %.2g\n",
                worst_difference(over, under), worst_difference(over, level));
    CHECK(worst_difference(over, under) <= 1e-5);
    CHECK(worst_difference(over, level) <= 1e-5);
    CHECK(largest_of(over, "G") > 0.2);
}

TEST_CASE("S47: views along the sun and against it are finite and bounded by the phase function") {
    // Sunlight reaches the camera once scattered as at most irradiance * p(view) * albedo, and
    // several times scattered as at most irradiance * p_max.
    const double g = 0.85, peak = (1 - g * g) / (4 * 3.14159265358979 * std::pow(1 - g, 3));
    for (const char* display : kDisplays)
        for (const char* side : {"-3000", "3000"}) {
            const Picture p = render_sound(bent_scene(
                {display_key(display), std::string("camera.position_m=[0,") + side + ",1100]",
                 "sun.azimuth_deg=0", "sun.elevation_deg=0", "sky.radiance=0"}));
            const double most = largest_of(p, "G"), mean = mean_of(p, "G");
            std::printf("%s from y = %s m: largest %.4g, mean %.4g, peak %.4g\n", display, side,
                        most, mean, peak);
            CHECK(most <= peak);
            CHECK(mean > 0);
        }
}

TEST_CASE("S48: a camera in the densest voxel, on faces, edges and corners") {
    const char* const places[] = {"[0,0,1150]",      "[0,0,1149.999]",   "[-800,0,1150]",
                                  "[800,0,1150]",    "[0,0,600]",        "[0,0,1700]",
                                  "[-800,-800,600]", "[800,800,1700]",   "[-800,-800,1150]",
                                  "[0,-800,600]",    "[40,40,1178.5714]"};
    for (const char* display : kDisplays)
        for (const char* place : places)
            for (const char* target : {"[0,0,1150.5]", "[3000,0,1150]", "[17,3000,1151]"})
                for (const char* sigma : {"0.02", "1e6"}) {
                    const Keys view{display_key(display),
                                    "medium.0.density=uniform:box",
                                    std::string("camera.position_m=") + place,
                                    std::string("camera.target_m=") + target,
                                    "camera.up=[0,1,0.01]",
                                    "camera.fov_deg=90",
                                    "camera.resolution=[8,8]",
                                    std::string("medium.0.extinction_per_m=") + sigma};
                    // A furnace first: nothing but sky is seen, through any medium.
                    const Picture furnace = render_sound(bent_scene(join(
                        view, {"medium.0.albedo=1", "sky.radiance=0.25", "sun.irradiance=0"})));
                    double worst = 0;
                    for (float v : furnace.image.find("G")->pixels.span())
                        worst = std::max(worst, std::fabs(double(v) / 0.25 - 1));
                    const std::string where = std::string(display) + place + target + sigma;
                    CAPTURE(where);
                    CAPTURE(worst);
                    CHECK(worst <= 1e-3);
                }
}

TEST_CASE("S78, S83: lights without power cost nothing and change nothing") {
    for (const char* display : kDisplays) {
        const Picture dark =
            render_sound(bent_scene({display_key(display), "sun.irradiance=0", "sky.radiance=0"}));
        CHECK(dark.report.photons.traced == 0);
        CHECK(dark.report.events.tentative == 0);
        CHECK(largest_of(dark, "G") == 0);
        CHECK(largest_of(dark, "A") > 0.5);
        const Picture night = render_sound(bent_scene({display_key(display), "sun.irradiance=0"}));
        CHECK(left_out(night, "sun photons"));
        CHECK(night.report.photons.energy.size() == 1);
        const Picture lone = render_sound(bent_scene({display_key(display), "sky.radiance=0"}));
        CHECK(left_out(lone, "sky photons"));
        CHECK(lone.report.photons.energy.size() == 1);
        CHECK(lone.report.photons.energy[0].ground == 0);
    }
}

TEST_CASE("S81: starlight and sunlight in one picture") {
    for (const char* display : kDisplays)
        for (const char* sky : {"1e-12", "1e9"}) {
            const Picture p = render_sound(bent_scene(
                {display_key(display), std::string("sky.radiance=") + sky, "sun.irradiance=1e9"}));
            // The corner of the picture is bare sky.
            CHECK(p.at("A", 0, 0) == 0);
            CHECK(p.at("G", 0, 0) == float(std::atof(sky)));
            CHECK(largest_of(p, "G") > 1e7);
            // Sun 1e9 brighter is the picture 1e9 times brighter, to the rounding of floats.
            if (std::string(sky) == "1e9") {
                const Picture one = render_sound(
                    bent_scene({display_key(display), "sky.radiance=1", "sun.irradiance=1"}));
                CHECK(std::fabs(mean_of(p, "G") / mean_of(one, "G") / 1e9 - 1) <= 1e-6);
            }
        }
}
