// SPDX-License-Identifier: Apache-2.0
// Pictures in clear air: all methods through one air, sessions, extreme cameras and suns.
// in: a small cumulus -> out: means, hashes.
// docs/atmosphere.md
#include "tests/support/air_scene.h"

using namespace render_test;
using air_test::in_air;

namespace {

double mean_of(const Picture& p, const char* channel, bool cloud) {
    double sum = 0, count = 0;
    const Channel& c = *p.image.find(channel);
    const Channel& alpha = *p.image.find("A");
    for (std::size_t i = 0; i < c.pixels.size(); ++i) {
        if ((alpha.pixels[i] > 0.5f) != cloud) continue;
        sum += double(c.pixels[i]);
        count += 1;
    }
    REQUIRE(count > 9);
    return sum / count;
}

}  // namespace

TEST_CASE("air: all methods show the same air as paths") {
    const Picture paths = render_one(scene_from(in_air(), {"method.name=path"}));
    for (const char* method : {"collectors", "photon-grid", "raymarch"}) {
        const Picture p = render_one(
            scene_from(in_air(), {std::string("method.name=") + method,
                                  "collectors.photons=400_000", "photon_grid.photons=400_000"}));
        for (const char* channel : {"R", "G", "B"}) {
            INFO(method << ' ' << channel);
            // Octaves of raymarch differ by up to 10 % in the cloud; of its light here half is
            // air's.
            const bool rough = std::string(method) == "raymarch";
            CHECK(mean_of(p, channel, true) ==
                  doctest::Approx(mean_of(paths, channel, true)).epsilon(rough ? 0.1 : 0.03));
            // Behind is the same but for the ground's shadow, light of the cloud on it, and rims.
            CHECK(mean_of(p, channel, false) ==
                  doctest::Approx(mean_of(paths, channel, false)).epsilon(0.01));
        }
    }
}

TEST_CASE("air: it takes and adds more the farther off a cloud is") {
    double dark = -1;
    for (const int metres : {3000, 12000, 50000, 200000}) {
        const Picture p = render_one(
            scene_from(in_air(), {"method.name=raymarch", "medium.0.albedo=0", "ground.albedo=0",
                                  "camera.position_m=[16, " + std::to_string(-metres) + ", 256]",
                                  "camera.fov_deg=" + std::to_string(160000.0 / metres)}));
        // A black cloud shows the air in front of it alone, in the end as bright as the horizon.
        const double air = mean_of(p, "B", true);
        // Beyond some 25 km of such haze it is all that there is, but for how the ray rises.
        CHECK(air > (metres < 50000 ? dark : 0.9 * dark));
        dark = air;
        const double horizon = double(p.at("B", 0, 0));
        CHECK(air < 1.5 * horizon);
    }
}

TEST_CASE("air: a camera in orbit sees a round earth in black space") {
    std::string text = in_air();
    const std::string ground = "[ground]\naltitude_m = 0\nalbedo = 0.25";
    text.erase(text.find(ground), ground.size());
    const Scene round =
        scene_from(text, {"method.name=raymarch", "camera.fov_deg=120",
                          "camera.position_m=[0, -1000, 400000]", "camera.target_m=[0, 0, 0]"});
    const Picture p = render_one(round);
    for (const char* channel : {"R", "G", "B"})
        for (int x = 0; x < p.image.width; ++x)
            for (int y = 0; y < p.image.height; ++y) {
                CHECK(p.at(channel, x, y) >= 0);
                CHECK(p.at(channel, x, y) < 2);
            }
    // The earth is lit; space is black.
    CHECK(p.at("B", 12, 12) > 0.01f);
    Scene space = round;
    space.camera.target_m = {0, 0, 900000};
    space.camera.up = {0, 1, 0};
    const Picture dark = render_one(space);
    CHECK(dark.at("B", 3, 3) == 0);
}

TEST_CASE("air: a camera above the air over a level ground is refused in a line") {
    const Scene high =
        scene_from(in_air(), {"method.name=raymarch", "camera.position_m=[0, -1000, 100001]"});
    const Status status = render(high, {}, [](int, Image&, Report&) { return Status::ok(); });
    CHECK(status.code == Code::kBadInput);
    CHECK(status.message ==
          "--set camera.position_m=[0, -1000, 100001]: camera.position_m: above the air, over a "
          "ground that is level for ever, z 100001, allowed: up to 100 km above it, or no "
          "[ground]: the round earth shows");
}

TEST_CASE("air: any sun makes a picture") {
    for (const char* elevation : {"90", "0", "-0.5", "-6", "-18", "-90"})
        for (const char* method : {"raymarch", "photon-grid"}) {
            const Picture p =
                render_one(scene_from(in_air(), {std::string("sun.elevation_deg=") + elevation,
                                                 std::string("method.name=") + method}));
            CHECK(p.counter("nan") == 0);
        }
}

TEST_CASE("air: frames of a day are pictures of its times") {
    std::string text = in_air();
    const std::string sun = "[sun]\nazimuth_deg = 120\nelevation_deg = 35";
    text.erase(text.find(sun), sun.size());
    const std::vector<std::string> date = {"method.name=raymarch", "atmosphere.date=2026-06-21",
                                           "atmosphere.latitude_deg=47",
                                           "atmosphere.longitude_deg=8", "atmosphere.time=06:00"};
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all = date;
        all.insert(all.end(), more.begin(), more.end());
        return scene_from(text, all);
    };
    std::vector<std::string> film;
    RenderOptions whole;
    whole.last_frame = 2;
    const Status status = render(with({"animation.frames=3", "animation.hours=[0, 12]"}), whole,
                                 [&](int, Image&, Report& report) {
                                     film.push_back(report.hash);
                                     return Status::ok();
                                 });
    REQUIRE_MESSAGE(status, status.message);
    REQUIRE(film.size() == 3);
    // Raymarch has no noise, so that a frame's number changes nothing.
    CHECK(film[0] == render_one(with({})).report.hash);
    CHECK(film[1] == render_one(with({"atmosphere.time=12:00"})).report.hash);
    CHECK(film[2] == render_one(with({"atmosphere.time=18:00"})).report.hash);
}

TEST_CASE("air: what --verify traces is seen through the air, too") {
    RenderOptions options;
    options.verify = 40;
    const Picture p = render_one(
        scene_from(in_air(), {"method.name=photon-grid", "photon_grid.photons=400_000"}), options);
    REQUIRE(p.report.verify.pixels > 10);
    // Four standard errors, and 2 % that cells cost (docs/photon-grid.md).
    CHECK(std::abs(p.report.verify.bias) < 0.02 + 4 * p.report.verify.standard_error);
    CHECK(p.report.verify.standard_error < 0.05);
}
