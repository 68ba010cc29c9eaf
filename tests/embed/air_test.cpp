// SPDX-License-Identifier: Apache-2.0
// Sessions in clear air: a host moves the sun, the camera and the ground.
// in: a small cumulus in air -> out: hashes, as scenes of those values have.
// docs/atmosphere.md; docs/embedding.md
#include "tests/embed/host_harness.h"
#include "tests/support/air_scene.h"

using namespace host_test;

namespace {

std::string scene_hash(const Overrides& overrides) {
    return render_test::render_one(render_test::scene_from(air_test::in_air(), overrides))
        .report.hash;
}

}  // namespace

TEST_CASE("air in sessions: another sun has another sky, as in a scene") {
    for (const char* method : {"raymarch", "photon-grid", "collectors"}) {
        const std::string name = std::string("method.name=") + method;
        Hosted host(air_test::in_air(), {name});
        host.step(host.whole());
        CHECK(host.hash() == scene_hash({name}));
        Hosted low(air_test::in_air(), {name});
        low.sun(120, 6);
        low.step(low.whole());
        CHECK(low.hash() == scene_hash({name, "sun.elevation_deg=6"}));
        // And back, where nothing is left of the other one.
        if (std::string(method) != "raymarch") continue;
        low.sun(120, 35);
        CHECK(low.hash() == scene_hash({name}));
    }
}

TEST_CASE("air in sessions: a camera that climbs sees as far as a scene's") {
    const std::string name = "method.name=raymarch";
    Hosted host(air_test::in_air(), {name});
    for (const double height : {256.0, 3000.0, 12000.0}) {
        const double from[3] = {16, -12000, height}, to[3] = {0, 0, 1024};
        host.aim(from, to, 14, 24, 14);
        CHECK(host.hash() == scene_hash({name, "camera.position_m=[16, -12000, " +
                                                   std::to_string(int(height)) + "]"}));
    }
}

TEST_CASE("air in sessions: a dated scene begins at its date's sun") {
    const Overrides date = {"method.name=raymarch", "atmosphere.date=2026-06-21",
                            "atmosphere.latitude_deg=47", "atmosphere.longitude_deg=8"};
    std::string text = air_test::in_air();
    const std::string sun = "[sun]\nazimuth_deg = 120\nelevation_deg = 35";
    text.erase(text.find(sun), sun.size());
    Hosted host(text, date);
    CHECK(host.hash() == render_test::render_one(render_test::scene_from(text, date)).report.hash);
}
