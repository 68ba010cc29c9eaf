// SPDX-License-Identifier: Apache-2.0
// Hosts place media and the ground: media below it are refused, and all is as it was.
// in: sessions and skies of clouds -> out: one line with the place and what is allowed.
// docs/embedding.md, "What may change"; docs/clouds.md
#include "src/clouds/render_clouds.h"
#include "src/scene/read_scene.h"
#include "tests/embed/clouds_harness.h"
#include "tests/io/temp_folder.h"

using namespace clouds_test;

namespace {

/// The small cumulus stands from 512 m up.
struct Placed {
    Hosted host{kSmallCumulus, {"method.name=raymarch"}};

    pileus_code place(double x, double z, double yaw_deg = 0) {
        auto placement = cleared<pileus_placement>();
        placement.offset_m[0] = x, placement.offset_m[2] = z;
        placement.yaw_deg = yaw_deg;
        return pileus_session_set_placement(host.session.get(), &placement, &host.out.error);
    }
    pileus_code ground(double altitude_m, bool present = true) {
        auto own = cleared<pileus_ground>();
        own.present = present ? 1 : 0;
        own.altitude_m = altitude_m, own.albedo = 0.25;
        return pileus_session_set_ground(host.session.get(), &own, &host.out.error);
    }
};

}  // namespace

TEST_CASE("below the ground: a host's placement, and a ground that a host raises") {
    Placed p;
    const double from[3] = {16, -4000, 5000}, to[3] = {0, 0, 1024};
    p.host.aim(from, to, 40, 24, 14);
    const std::string before = p.host.hash();
    const auto refused = [&](pileus_code code, const char* line) {
        CHECK(code == PILEUS_ERROR_INPUT);
        CHECK(p.host.out.line() == line);
    };
    refused(p.place(0, -900),
            "placement.offset_m: the media are below the ground, lowest z -388, allowed: at least "
            "ground.altitude_m 0, moved up or down by at least -512");
    refused(p.place(100, -512.25, 30),
            "placement.offset_m: the media are below the ground, lowest z -0.25, allowed: at least "
            "ground.altitude_m 0, moved up or down by at least -512");
    refused(p.ground(513),
            "ground.altitude_m: the media are below the ground, lowest z 512, allowed: at least "
            "ground.altitude_m 513");
    CHECK(p.host.hash() == before);
    // Down to the ground, and with it.
    p.host.check(p.place(0, -512));
    refused(p.ground(1),
            "ground.altitude_m: the media are below the ground, lowest z 0, allowed: at least "
            "ground.altitude_m 1, moved up or down by at least -511");
    p.host.check(p.ground(-400));
    p.host.check(p.place(0, -912));
    p.host.check(p.ground(0, false));
    p.host.check(p.place(0, -5000));
    p.host.check(p.place(0, 0));
    p.host.check(p.ground(0));
    CHECK(p.host.hash() == before);

    // A density that follows comes to stand where the one before it does.
    Hosted next(kSmallCumulus, {"method.name=raymarch", "ground.altitude_m=100"});
    p.host.check(p.place(0, -500));
    Outcome out;
    CHECK(pileus_session_hand_over(p.host.session.get(), next.session.get(), 0, &out.error) ==
          PILEUS_ERROR_INPUT);
    CHECK_MESSAGE(out.line().find("placement.offset_m: the media are below the ground") == 0,
                  out.line());
    // A session may have another ground than the scene that its world was made of.
    const SceneHandle high =
        scene_of(kSmallCumulus,
                 {"method.name=raymarch", "medium.0.bounds_m=[[-768,-768,900],[768,768,1536]]",
                  "ground.altitude_m=600", "camera.position_m=[16,-4000,700]"});
    pileus_session* made = nullptr;
    CHECK(pileus_session_create(p.host.world.get(), high.get(), nullptr, &made, &out.error) ==
          PILEUS_ERROR_INPUT);
    CHECK_MESSAGE(out.line().find("below the ground, lowest z 512") != std::string::npos,
                  out.line());
}

TEST_CASE("below the ground: clouds of a sky, and the ground below them") {
    CloudySky sky({at(0, 0, 0)});
    const std::uint64_t before = sky.draw().hash;
    const auto refused = [&](const pileus_cloud& place, const char* line) {
        const pileus_cloud two[2] = {at(0, 0, 0), place};
        CHECK(pileus_clouds_place(sky.clouds.get(), two, 2, &sky.out.error) == PILEUS_ERROR_INPUT);
        CHECK(sky.out.line() == line);
    };
    refused(at(50000, 0, -600),
            "places[1].offset_m: the cloud is below the ground, lowest z -88, allowed: at least "
            "ground.altitude_m 0, moved up or down by at least -512");
    refused(at(0, 0, -300, 90, 0.5),
            "places[1].offset_m: the cloud is below the ground, lowest z -44, allowed: at least "
            "ground.altitude_m 0, moved up or down by at least -256");
    CHECK(sky.draw().hash == before);
    sky.place({at(0, 0, -512)});
    sky.place({at(0, 0, 0)});
    CHECK(sky.draw().hash == before);
    auto ground = cleared<pileus_ground>();
    ground.present = 1, ground.albedo = 0.25, ground.altitude_m = 600;
    auto camera = cleared<pileus_camera>();
    camera.position_m[0] = 16, camera.position_m[1] = -4000, camera.position_m[2] = 2000;
    camera.target_m[2] = 1024, camera.fov_deg = 40;
    sky.check(pileus_session_set_camera(sky.sky.session.get(), &camera, &sky.out.error));
    sky.check(pileus_session_set_ground(sky.sky.session.get(), &ground, &sky.out.error));
    std::vector<float> pixels(24 * 14 * 4);
    auto frame = cleared<pileus_frame>();
    frame.colour = pixels.data(), frame.format = PILEUS_FORMAT_RGBA32F;
    CHECK(pileus_clouds_render(sky.clouds.get(), &frame, &sky.out.error) == PILEUS_ERROR_INPUT);
    CHECK_MESSAGE(
        sky.out.line().find(
            "ground.altitude_m: cloud 0 is below the ground, lowest z 512, allowed: ") == 0,
        sky.out.line());
    sky.place({at(0, 0, 88)});
    CHECK(sky.draw().sum(3) > 0);

    const pileus::test::TempFolder folder;
    folder.put("kind.toml", kSmallCumulus);
    pileus::Scene scene;
    const pileus::Status read = pileus::read_scene_text(
        sky_text() + "[[clouds.kind]]\nname = \"c\"\nscene = \"" + folder.path("kind.toml") +
            "\"\nset = [\"method.name=raymarch\"]\n"
            "[[clouds.place]]\nkind = \"c\"\noffset_m = [0, 0, -600]\n",
        "sky.toml", "", {"output.layers=[depth]"}, scene);
    REQUIRE_MESSAGE(bool(read), read.message);
    const pileus::Status drawn =
        pileus::render_clouds(scene, {}, [](int, pileus::Image&, pileus::Report&) {
            FAIL("a picture of a cloud below the ground");
            return pileus::Status::ok();
        });
    CHECK_MESSAGE(drawn.message.find("clouds.place.0.offset_m: the cloud is below the ground, "
                                     "lowest z -88") != std::string::npos,
                  drawn.message);
}

TEST_CASE("clouds: what a sky of clouds has no use for is refused") {
    CloudySky sky({at(0, 0, 0)});
    const std::uint64_t before = sky.draw().hash;
    pileus_session* const s = sky.sky.session.get();
    const auto refused = [&](pileus_code code, const char* word) {
        CHECK(code == PILEUS_ERROR_INPUT);
        CHECK_MESSAGE(sky.out.line().find(word) == 0, sky.out.line());
    };
    auto light = cleared<pileus_lamp>();
    light.type = PILEUS_LAMP_POINT, light.position_m[2] = 3000;
    for (float& v : light.light) v = 1e6f;
    refused(pileus_session_set_lamps(s, &light, 1, &sky.out.error),
            "lights: not in a sky of clouds");
    auto work = cleared<pileus_work>();
    auto governor = cleared<pileus_governor>();
    governor.target_s = 1;
    refused(pileus_session_govern(s, &governor, 0, &work, &sky.out.error), "work: not in a sky");
    auto costs = cleared<pileus_costs>();
    refused(pileus_session_fit(s, &costs, 1, &work, &sky.out.error), "work: not in a sky");
    auto most = cleared<pileus_units>();
    refused(pileus_session_most_units(s, nullptr, &most, &sky.out.error), "work: not in a sky");
    work.scale = 2;
    refused(pileus_session_set_work(s, &work, &sky.out.error), "work: not in a sky");
    auto placement = cleared<pileus_placement>();
    placement.offset_m[0] = 100;
    refused(pileus_session_set_placement(s, &placement, &sky.out.error), "placement: no media");
    CHECK(sky.draw().hash == before);

    // What was set before the clouds came.
    for (const bool lit : {false, true}) {
        Hosted bare(sky_text(), {"method.name=raymarch"});
        if (lit)
            bare.check(pileus_session_set_lamps(bare.session.get(), &light, 1, &bare.out.error));
        else
            bare.check(pileus_session_set_work(bare.session.get(), &work, &bare.out.error));
        pileus_clouds* made = nullptr;
        refused(pileus_clouds_create(bare.session.get(), &made, &sky.out.error), "sky: ");
        CHECK(made == nullptr);
    }
    // Once they have gone, a session is as any other.
    sky.clouds.reset();
    sky.check(pileus_session_set_lamps(s, &light, 1, &sky.out.error));

    CloudySky others({at(0, 0, 0)});
    const Hosted towards(kSmallCumulus,
                         {"method.name=photon-grid", "photon_grid.closure=\"camera\""});
    CHECK(pileus_clouds_add_kind(others.clouds.get(), towards.world.get(), towards.scene.get(),
                                 nullptr, &sky.out.error) == PILEUS_ERROR_INPUT);
    CHECK(sky.out.line().find("kind: photon_grid.closure \"camera\"") == 0);
}
