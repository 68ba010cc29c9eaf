// SPDX-License-Identifier: Apache-2.0
// Whole pictures of media at the ends of what the scene format allows.
// in: one small scene with extreme extinctions, albedos, phase functions -> out: sound pictures.
// docs/testing.md S20, S27, S36, S57, S65, S72: bounded work, finite numbers, balanced ledgers.
#include "src/io/images/image_file.h"
#include "tests/stiff/stiff_scene.h"

using namespace stiff_test;

TEST_CASE("S27, S57: an extinction of 1e12 per metre ends after a million events a photon") {
    // Free flights of 1e-12 m are shorter than a position can be told, so that a photon stays where
    // it is: in clear air beside the cloud for good. What has not left or been absorbed after 2^20
    // collisions is counted as terminated, and the ledger balances (render_one checks it).
    for (const char* display : kDisplays)
        for (const char* albedo : {"1", "0.99"})
            for (const char* tracking : {"local", "global"}) {
                const Picture p = render_sound(
                    bent_scene({display_key(display), "medium.0.extinction_per_m=1e12",
                                std::string("medium.0.albedo=") + albedo, "collectors.photons=4",
                                std::string("collectors.tracking=") + tracking, "sky.radiance=0"}));
                REQUIRE(p.report.photons.energy.size() == 1);
                const EnergyRow& e = p.report.photons.energy[0];
                std::printf("%s, albedo %s, %s: %llu events, terminated %.3g\n", display, albedo,
                            tracking, static_cast<unsigned long long>(p.report.events.tentative),
                            e.terminated);
                CHECK(p.report.events.tentative <= p.report.photons.traced << 20);
                CHECK(e.emitted == 1);
                CHECK(e.top + e.bottom + e.sides + e.absorbed + e.terminated ==
                      doctest::Approx(1).epsilon(1e-12));
                CHECK(largest_of(p, "A") == 1);
            }
}

TEST_CASE("S20: pictures of albedo 1 - 1e-7, 1e-7 and of one colour alone") {
    for (const char* display : kDisplays)
        for (const char* albedo : {"0.9999999", "0.99999999999", "1e-7", "1e-40", "0", "[1,0,0]",
                                   "[0,1e-30,1]", "[1,0.9999999,0.5]"}) {
            const Picture p = render_sound(
                bent_scene({display_key(display), std::string("medium.0.albedo=") + albedo}));
            // A black medium hides what it covers and adds nothing.
            if (std::string(albedo) == "0") CHECK(largest_of(p, "G") <= double(0.07f) * 1.0001);
        }
}

TEST_CASE("S20: an albedo next to 1 is next to the white picture") {
    const Keys quiet{"sky.radiance=0", "collectors.photons=4000"};
    Keys white = quiet, almost = quiet;
    white.push_back("medium.0.albedo=1");
    almost.push_back("medium.0.albedo=0.9999999");
    // No photon of this few is absorbed: the same paths, and 1e-7 of the light less.
    CHECK(worst_difference(render_sound(bent_scene(white)), render_sound(bent_scene(almost))) <=
          1e-5);
}

TEST_CASE("S1, S3, S4: pictures of every phase function's ends") {
    for (const char* display : kDisplays)
        for (const char* closure : {"sh", "lobe", "camera"})
            for (const char* g : {"1", "-1", "0", "0.9999999", "-0.9999999", "1e-8", "1e-40"}) {
                const Scene scene =
                    bent_scene({display_key(display), std::string("collectors.closure=") + closure,
                                std::string("medium.0.phase.g=") + g, "collectors.photons=2000"});
                const std::string name = std::string(display) + " " + closure + " g " + g;
                CAPTURE(name);
                // The camera's closure sums the phase function itself, whose peak no sum
                // holds here; at g = 1 it is a delta, which no direction but one can see.
                const double size = std::fabs(std::atof(g));
                if (std::string(closure) == "camera" && size > 0.9) {
                    const Status status = render(scene, one_thread(),
                                                 [](int, Image&, Report&) { return Status::ok(); });
                    CHECK(status.code == (size < 1 ? Code::kLimit : Code::kBadInput));
                    const char* said = size < 1 ? "overflow" : "a lobe of g = 1 or -1";
                    CHECK(status.message.find(said) != std::string::npos);
                    continue;
                }
                render_sound(scene);
            }
}

TEST_CASE("S36: voxels of 1:1000 and rods one voxel thick make sound pictures") {
    for (const char* display : kDisplays)
        for (const char* size : {"[1,1,1]", "[1,1,200]", "[200,1,1]", "[3,200,3]"})
            for (const char* box :
                 {"[[-800,-800,600],[800,800,1700]]", "[[-8e6,-8e6,1100],[8e6,8e6,1101]]",
                  "[[-0.5,-0.5,600],[0.5,0.5,17000]]"}) {
                const Picture p = render_sound(bent_scene(
                    {display_key(display), "medium.0.density=uniform:box",
                     std::string("medium.0.resolution=") + size,
                     std::string("medium.0.bounds_m=") + box, "collectors.photons=400"}));
                CHECK(p.report.prepared.collectors > 0);
            }
}

TEST_CASE("S72: the bytes of pictures that are black, equal, tiny or huge") {
    for (const char* light : {"0", "1e-30", "1e-12", "1e12"}) {
        const Picture p = render_sound(
            bent_scene({std::string("sun.irradiance=") + light,
                        std::string("sky.radiance=") + light, "collectors.photons=400"}));
        for (double stops : {-60.0, 0.0, 60.0}) {
            ToneSettings tone;
            tone.stops = float(stops);
            Buffer<std::uint8_t> rgb;
            REQUIRE(tone_map_8bit(p.image, tone, rgb));
            int most = 0;
            for (std::uint8_t v : rgb.span()) most = std::max(most, int(v));
            if (std::string(light) == "0") CHECK(most == 0);
            if (std::string(light) == "1e12" && stops >= 0) CHECK(most == 255);
            if (std::string(light) == "1e-30" && stops <= 0) CHECK(most == 0);
        }
    }
}
