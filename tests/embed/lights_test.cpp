// SPDX-License-Identifier: Apache-2.0
// Lights that a host sets and moves: the bits of a scene that has them.
// in: small scenes without lights -> out: hashes of pictures.
// docs/embedding.md, "What may change"; docs/lights.md
#include <cstddef>

#include "tests/embed/host_harness.h"

using namespace host_test;
using render_test::kSmallCumulus;

namespace {

const char* const kMethods[] = {
    "collectors", "photon-grid",         "raymarch", "path", "optical-depth",
    "particles",  "particles-billboards"};

Overrides with(const std::string& method) {
    const bool balls = method == "particles-billboards";
    Overrides all{"method.name=\"" + (balls ? "particles" : method) + "\"",
                  "path.samples_per_pixel=3", "collectors.generations=6", "raymarch.steps=40",
                  "output.layers=[\"radiance\",\"alpha\"]"};
    if (balls) all.push_back("particles.display=billboards");
    return all;
}

/// The small cumulus, or for method particles what it shows; and lights.
std::string scene_for(const std::string& method, const std::string& lights) {
    const std::string text = kSmallCumulus;
    if (method.find("particles") != 0) return text + lights;
    const std::size_t from = text.find("[[medium]]"), to = text.find("[photon_grid]");
    return text.substr(0, from) +
           "[[medium]]\ndensity = \"assets/scenes/golden/data/puff.csv\"\n"
           "phase = { type = \"isotropic\" }\n" +
           text.substr(to) + lights;
}

const char* const kText = R"(
[[light]]
type = "spot"
position_m = [-1500, -900, 2000]
direction = [1, 0.5, -0.5]
cone_deg = 60
penumbra_deg = 6
radius_m = 2
intensity = [100000, 300000, 200000]
[[light]]
type = "directional"
azimuth_deg = 120
elevation_deg = 35
irradiance = [0.25, 0.5, 0.75]
[[light]]
type = "point"
position_m = [100, -250, 1200]
intensity = [60000, 40000, 20000]
)";

std::vector<pileus_lamp> lights() {
    std::vector<pileus_lamp> all(3, cleared<pileus_lamp>());
    const double spot[3] = {-1500, -900, 2000}, way[3] = {1, 0.5, -0.5};
    const double point[3] = {100, -250, 1200};
    const float colours[3][3] = {
        {100000, 300000, 200000}, {0.25f, 0.5f, 0.75f}, {60000, 40000, 20000}};
    for (std::size_t i = 0; i < 3; ++i) std::memcpy(all[i].light, colours[i], sizeof colours[i]);
    all[0].type = PILEUS_LAMP_SPOT;
    std::memcpy(all[0].position_m, spot, sizeof spot);
    std::memcpy(all[0].direction, way, sizeof way);
    all[0].cone_deg = 60, all[0].penumbra_deg = 6, all[0].radius_m = 2;
    all[1].type = PILEUS_LAMP_DIRECTIONAL;
    all[1].azimuth_deg = 120, all[1].elevation_deg = 35;
    all[2].type = PILEUS_LAMP_POINT;
    std::memcpy(all[2].position_m, point, sizeof point);
    return all;
}

void set(Hosted& host, const std::vector<pileus_lamp>& all) {
    host.check(pileus_session_set_lamps(host.session.get(), all.data(), std::uint32_t(all.size()),
                                        &host.out.error));
}

}  // namespace

TEST_CASE("lights of a host: the picture of a scene that has them") {
    for (const char* method : kMethods) {
        CAPTURE(std::string(method));
        const auto lit = program_hashes(scene_for(method, kText), with(method))[0];
        const auto dark = program_hashes(scene_for(method, ""), with(method))[0];
        CHECK(lit != dark);
        Hosted host(scene_for(method, ""), with(method));
        REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
        // Photons are numbered on: lights that come later have others than the program's.
        if (std::string(method) != "collectors" && std::string(method) != "photon-grid") {
            host.step(host.whole());
            CHECK(host.hash() == dark);
        }
        set(host, lights());
        host.step(host.whole());
        CHECK(host.hash() == lit);
        // The same again costs nothing and changes nothing.
        set(host, lights());
        CHECK(host.hash() == lit);
        // Moved: another picture. Photons in the ring are still those of the first place.
        auto moved = lights();
        moved[2].position_m[2] = 1100;
        set(host, moved);
        host.step(host.whole());
        CHECK(host.hash() != lit);
        // But for the photons' sums, which have a place for each kind of light.
        CHECK(host.stats().prepared <= 2);
    }
}

TEST_CASE("lights of a host: moved back and taken away") {
    // Photons keep their shares and their ring.
    for (const char* method :
         {"raymarch", "path", "optical-depth", "particles", "particles-billboards"}) {
        CAPTURE(std::string(method));
        Hosted host(scene_for(method, kText), with(method));
        REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
        auto moved = lights();
        moved[0].position_m[0] = 0;
        set(host, moved);
        host.step(host.whole());
        (void)host.hash();
        set(host, lights());
        host.step(host.whole());
        CHECK(host.hash() == program_hashes(scene_for(method, kText), with(method))[0]);
        set(host, {});
        host.step(host.whole());
        CHECK(host.hash() == program_hashes(scene_for(method, ""), with(method))[0]);
    }
}

TEST_CASE("lights of a host: places on spheres") {
    const auto text = [](const char* samples) {
        std::string own = kText;
        const std::string radius = "radius_m = 2\n";
        return own.replace(own.find(radius), radius.size(),
                           std::string("radius_m = 300\n") + samples);
    };
    for (const char* method : {"raymarch", "path", "particles"}) {
        CAPTURE(std::string(method));
        Hosted host(scene_for(method, ""), with(method));
        REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
        std::string last;
        for (const int samples : {0, 1, 5}) {
            auto all = lights();
            all[0].radius_m = 300;
            all[0].shadow_samples = std::uint32_t(samples);
            set(host, all);
            host.step(host.whole());
            const std::string key =
                samples > 0 ? "shadow_samples = " + std::to_string(samples) + "\n" : "";
            CHECK(host.hash() ==
                  program_hashes(scene_for(method, text(key.c_str())), with(method))[0]);
            CHECK(host.hash() != last);
            last = host.hash();
        }
        auto all = lights();
        all[0].shadow_samples = 65;
        CHECK(pileus_session_set_lamps(host.session.get(), all.data(), 3, &host.out.error) ==
              PILEUS_ERROR_INPUT);
        CHECK(std::string(host.out.error.message)
                  .find("light.shadow_samples: 65, allowed: 0 to 64") != std::string::npos);
        // Programs that were built before the field have padding at its end.
        struct Shorter {
            alignas(8) unsigned char bytes[offsetof(pileus_lamp, shadow_samples)];
        };
        Shorter older[3];
        for (std::size_t i = 0; i < 3; ++i) {
            pileus_lamp light = lights()[i];
            light.struct_size = marked(sizeof(Shorter));
            light.reserved = 0xffffffffu;
            if (i == 0) light.radius_m = 300;
            std::memcpy(&older[i], &light, sizeof(Shorter));
        }
        host.check(pileus_session_set_lamps(
            host.session.get(), reinterpret_cast<const pileus_lamp*>(older), 3, &host.out.error));
        host.step(host.whole());
        CHECK(host.hash() == program_hashes(scene_for(method, text("")), with(method))[0]);
    }
}

TEST_CASE("lights of a host: they stay where they are while the media move") {
    // Media, camera and lights shifted as one: the picture stays. Powers of two, so that sums are
    // exact; the ground would not move along, so there is none.
    for (const char* method : {"raymarch", "path"}) {
        CAPTURE(std::string(method));
        Hosted host(scene_for(method, kText), with(method));
        REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
        host.aim({0, -4096, 256}, {0, 0, 1024}, 40, 24, 14);
        host.step(host.whole());
        const std::string before = host.hash();
        auto placement = cleared<pileus_placement>();
        placement.offset_m[0] = 512;
        host.check(pileus_session_set_placement(host.session.get(), &placement, &host.out.error));
        auto moved = lights();
        moved[0].position_m[0] += 512;
        moved[2].position_m[0] += 512;
        set(host, moved);
        host.aim({512, -4096, 256}, {512, 0, 1024}, 40, 24, 14);
        host.step(host.whole());
        CHECK(host.hash() == before);
    }
}
