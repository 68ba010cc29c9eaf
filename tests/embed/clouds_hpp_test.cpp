// SPDX-License-Identifier: Apache-2.0
// pileus.hpp: the pictures of the C interface, an owner that moves, faults.
// in: small skies -> out: checks.
// docs/clouds.md
#include "tests/embed/clouds_harness.h"
#include "tests/embed/hpp_harness.h"

using namespace clouds_test;
using namespace hpp_test;

namespace {

hpp::Session session_of(const std::string& text, const Overrides& sets) {
    const hpp::Scene scene = take(hpp::Scene::parse(text, {}, sets));
    return take(hpp::Session::create(take(hpp::World::create(scene)), scene));
}

std::uint64_t hash_of(hpp::Clouds& clouds) {
    std::uint64_t hash = 0;
    hpp::Frame frame;
    frame.hash = &hash;
    must(clouds.render(frame));
    return hash;
}

}  // namespace

TEST_CASE("pileus.hpp: pictures and counts are those of the C interface") {
    CloudySky c({at(0, 0, 0), at(2500, 9000, 200, 90, 1.5)});
    c.detail(false, 16);

    hpp::Clouds clouds =
        take(hpp::Clouds::create(session_of(sky_text(), {"method.name=raymarch"})));
    {
        const hpp::Scene scene = take(hpp::Scene::parse(kSmallCumulus, {}, kMarch));
        CHECK(take(clouds.add_kind(take(hpp::World::create(scene)), scene)) == 0);
    }
    must(clouds.place({{0, {0, 0, 0}}, {0, {2500, 9000, 200}, 90, 1.5}}));
    hpp::CloudDetail detail;
    detail.near_px = 16;
    detail.near_scale = 1;
    must(clouds.set_detail(detail));
    for (int frame = 0; frame < 3; ++frame) {
        const double from[3] = {16, -4000.0 + 300 * frame, 256}, to[3] = {0, 0, 1024};
        c.sky.aim(from, to, 40, 48, 28);
        hpp::Camera camera;
        camera.size = {48, 28};
        camera.position_m = {from[0], from[1], from[2]};
        camera.target_m = {to[0], to[1], to[2]};
        must(clouds.sky().set_camera(camera));
        CHECK(hash_of(clouds) == c.draw().hash);
        // Moved between two pictures, they go on.
        hpp::Clouds moved = std::move(clouds);
        CHECK_FALSE(bool(clouds));
        clouds = std::move(moved);
    }
    const hpp::CloudStats mine = take(clouds.stats());
    const pileus_cloud_stats its = c.stats();
    CHECK(mine.clouds == 2);
    CHECK(mine.visible == its.visible);
    CHECK(mine.marched == its.marched);
    CHECK(mine.marched_pixels == its.marched_pixels);
    CHECK(mine.worst_px == its.worst_px);
    clouds = hpp::Clouds();
    CHECK_FALSE(bool(clouds.sky()));
}

TEST_CASE("pileus.hpp: faults are codes and lines") {
    hpp::Session cloud = session_of(kSmallCumulus, kMarch);
    const auto refused = hpp::Clouds::create(std::move(cloud));
    CHECK(refused.code() == hpp::Code::kBadInput);
    CHECK(refused.message().find("sky: 1 media") != std::string::npos);
    CHECK(bool(cloud));
    hpp::Clouds none;
    hpp::Frame frame;
    CHECK(none.render(frame).code() == hpp::Code::kBadInput);
    CHECK(none.place({}).code() == hpp::Code::kBadInput);
    CHECK(none.set_detail({}).code() == hpp::Code::kBadInput);
    CHECK(none.stats().code() == hpp::Code::kBadInput);
    CHECK(none.add_kind({}, {}).code() == hpp::Code::kBadInput);

    hpp::Clouds clouds =
        take(hpp::Clouds::create(session_of(sky_text(), {"method.name=raymarch"})));
    CHECK(clouds.place({{}}).message().find("places[0].kind") != std::string::npos);
    CHECK(clouds.add_kind({}, {}).code() == hpp::Code::kBadInput);
    hpp::CloudDetail detail;
    detail.near_scale = 3;
    CHECK(clouds.set_detail(detail).message().find("near_scale") != std::string::npos);
    must(clouds.place({}));
    CHECK(take(clouds.stats()).clouds == 0);
}
