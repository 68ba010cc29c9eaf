// SPDX-License-Identifier: Apache-2.0
// pileus.hpp: the whole sky has the bits of the C interface, its session and clouds stay its own
// wherever it moves, faults are codes and lines.
// in: small skies -> out: checks.
// docs/whole-sky.md
#include <cmath>
#include <limits>

#include "tests/embed/clouds_harness.h"
#include "tests/embed/hpp_harness.h"

using namespace clouds_test;
using namespace hpp_test;

namespace {

/// A refusal of one line that tells `what`.
bool refuses(const hpp::Status& status, const std::string& what) {
    CAPTURE(status.message());
    return status.code() == hpp::Code::kBadInput &&
           status.message().find(what) != std::string::npos &&
           status.message().find('\n') == std::string::npos;
}

hpp::Scene cumulus() { return take(hpp::Scene::parse(kSmallCumulus, {}, kMarch)); }

hpp::Sky sky_of(const Overrides& more = {}, bool air = false, const hpp::Host& host = {}) {
    return take(hpp::Sky::create(take(hpp::Scene::parse(sky_text(air), {}, more)), host));
}

/// Of a date, which places the sun.
std::string dated_text() {
    std::string text = sky_text(true);
    const std::string sun = "azimuth_deg = 120\nelevation_deg = 35\n";
    text.erase(text.find(sun), sun.size());
    return text;
}
const Overrides kDated{"atmosphere.date=\"2024-06-21\"", "atmosphere.time=\"12:00\"",
                       "atmosphere.latitude_deg=48", "atmosphere.longitude_deg=11"};

constexpr std::size_t kPixels = std::size_t{24} * 14;

hpp::Camera camera_of() {
    hpp::Camera camera;
    camera.size = {24, 14};
    camera.position_m = {16, -4000, 256};
    camera.target_m = {0, 0, 1024};
    return camera;
}

std::uint64_t hash_of(hpp::Sky& sky) {
    std::uint64_t hash = 0;
    hpp::Frame frame;
    frame.hash = &hash;
    must(sky.render(frame));
    return hash;
}

/// Adds the small cumulus as a kind; its world and scene go.
void add_cumulus(hpp::Sky& sky, const std::vector<hpp::Cloud>& places) {
    hpp::Clouds clouds = sky.clouds();
    const hpp::Scene scene = cumulus();
    CHECK(take(clouds.add_kind(take(hpp::World::create(scene)), scene)) == 0);
    must(clouds.place(places));
}

}  // namespace

TEST_CASE("pileus.hpp: a whole sky gives what the C interface gives") {
    Outcome out;
    const auto check = [&](pileus_code code) { REQUIRE_MESSAGE(code == PILEUS_OK, out.line()); };
    pileus_sky* c = nullptr;
    check(pileus_sky_create(scene_of(dated_text(), kDated).get(), nullptr, &c, &out.error));
    const auto free_sky = [](pileus_sky* p) { pileus_sky_free(p); };
    const std::unique_ptr<pileus_sky, decltype(free_sky)> kept(c, free_sky);
    const Hosted kind(kSmallCumulus, kMarch);
    check(pileus_clouds_add_kind(pileus_sky_clouds(c), kind.world.get(), kind.scene.get(), nullptr,
                                 &out.error));
    check(pileus_sky_add_layer(c, kind.world.get(), kind.scene.get(), &out.error));
    pileus_cloud place = at(500, 2000, 0, 90, 1.5);
    place.presence = 0.5;
    check(pileus_clouds_place(pileus_sky_clouds(c), &place, 1, &out.error));
    check(pileus_sky_set_time(c, -3, &out.error));
    const double wind[3] = {40, -20, 0};
    check(pileus_sky_move(c, wind, &out.error));

    hpp::Sky own = take(hpp::Sky::create(take(hpp::Scene::parse(dated_text(), {}, kDated))));
    add_cumulus(own, {{0, {500, 2000, 0}, 90, 1.5, 0.5}});
    {
        const hpp::Scene scene = cumulus();
        must(own.add_layer(take(hpp::World::create(scene)), scene));
    }
    must(own.set_time(-3));
    must(own.move({40, -20, 0}));

    // A host's picture with half of its pixels solid.
    std::vector<float> depth(kPixels, std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < kPixels; i += 2) depth[i] = 1500;
    std::vector<float> c_pixels(4 * kPixels, 0.5f), pixels = c_pixels;
    auto image = cleared<pileus_depth_image>();
    image.values = depth.data();
    auto c_frame = cleared<pileus_frame>();
    c_frame.colour = c_pixels.data();
    c_frame.format = PILEUS_FORMAT_RGBA32F;
    c_frame.blend = PILEUS_BLEND_OVER;
    check(pileus_sky_render(c, &image, &c_frame, &out.error));
    hpp::Frame frame;
    frame.colour = pixels.data();
    frame.format = hpp::Format::kRgba32F;
    frame.blend = hpp::Blend::kOver;
    must(own.render(frame, {depth.data()}));
    CHECK(pixels == c_pixels);
    // The depths stay as they were set.
    std::vector<float> again(4 * kPixels, 0.5f);
    frame.colour = again.data();
    must(own.render(frame));
    CHECK(again == pixels);

    // What the host's world gets back.
    pileus_sky_light light[2] = {cleared<pileus_sky_light>(), cleared<pileus_sky_light>()};
    light[1].position_m[1] = 2000, light[1].position_m[2] = 1500;
    check(pileus_sky_light_at(c, light, 2, &out.error));
    const auto lights = take(own.light_at({{0, 0, 0}, {0, 2000, 1500}}));
    REQUIRE(lights.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(lights[i].position_m == hpp::Vec3(0, 2000.0 * double(i), 1500.0 * double(i)));
        CHECK(lights[i].sun_share == light[i].sun_share);
        CHECK(lights[i].sun == hpp::Rgb(light[i].sun[0], light[i].sun[1], light[i].sun[2]));
        CHECK(lights[i].level == hpp::Rgb(light[i].level[0], light[i].level[1], light[i].level[2]));
        CHECK(lights[i].extinction_per_m == light[i].extinction_per_m);
        CHECK(std::memcmp(lights[i].around, light[i].around, sizeof light[i].around) == 0);
    }
    CHECK(lights[0].level.z > 0);
    CHECK(take(own.light_at({})).empty());

    std::vector<float> c_shares(10 * 6, -1), shares = c_shares;
    const std::vector<float> heights(c_shares.size(), 300);
    auto c_map = cleared<pileus_shadow_map>();
    c_map.width = 10, c_map.height = 6;
    c_map.format = PILEUS_SHADOW_R32F;
    c_map.low_m[0] = -3000, c_map.low_m[1] = -1000;
    c_map.size_m[0] = 5000, c_map.size_m[1] = 6000;
    c_map.heights = heights.data();
    c_map.texels = c_shares.data();
    c_map.bottom_up = 1;
    c_map.first_row = 1, c_map.rows = 4;
    check(pileus_sky_shadow(c, &c_map, &out.error));
    hpp::ShadowMap map;
    map.size = {10, 6};
    map.format = hpp::ShadowFormat::kR32F;
    map.low_m = {-3000, -1000};
    map.size_m = {5000, 6000};
    map.heights = heights.data();
    map.texels = shares.data();
    map.bottom_up = true;
    map.first_row = 1, map.rows = 4;
    must(own.shadow(map));
    CHECK(shares == c_shares);
    CHECK(shares[0] == -1);
    CHECK(shares[10] >= 0);
    map.heights = nullptr;
    map.altitude_m = 300;
    must(own.shadow(map));
    CHECK(shares == c_shares);

    const double ahead[3] = {0, 1000, 200};
    float left[3], added[3];
    check(pileus_sky_air(c, ahead, 15000, left, added, &out.error));
    const hpp::AirWay way = take(own.air({0, 1000, 200}, 15000));
    CHECK(way.left == hpp::Rgb(left[0], left[1], left[2]));
    CHECK(way.light == hpp::Rgb(added[0], added[1], added[2]));
    CHECK(take(own.air({0, 0, 1}, std::numeric_limits<double>::infinity())).left == hpp::Rgb(0));
}

TEST_CASE("pileus.hpp: session and clouds are a sky's own, wherever it moves") {
    hpp::Sky sky = sky_of();
    hpp::Session session = sky.session();
    CHECK(session.get() == pileus_sky_session(sky.get()));
    must(session.set_camera(camera_of()));
    add_cumulus(sky, {{0, {0, 0, 0}}});
    const std::uint64_t one = hash_of(sky);

    hpp::Sky moved = std::move(sky);
    CHECK_FALSE(bool(sky));
    CHECK(refuses(sky.move({}), "sky: null"));
    CHECK(hash_of(moved) == one);
    // What was asked for before goes on, and sets the sky that has moved.
    must(session.set_sun({200, 25}));
    const std::uint64_t other = hash_of(moved);
    CHECK(other != one);
    must(moved.session().set_sun({120, 35}));
    CHECK(hash_of(moved) != other);
    hpp::Clouds clouds = moved.clouds();
    CHECK(clouds.get() == pileus_sky_clouds(moved.get()));
    CHECK(clouds.sky().get() == session.get());
    CHECK(take(clouds.stats()).clouds == 1);

    // They keep what they belong to, whatever is assigned or goes first.
    moved = sky_of();
    must(clouds.place({{0, {300, 0, 0}}}));
    hpp::Frame frame;
    std::uint64_t hash = 0;
    frame.hash = &hash;
    must(clouds.render(frame));
    CHECK(take(clouds.stats()).visible == 1);
    clouds = moved.clouds();
    must(session.set_sun({200, 25}));
    must(session.render(frame));
    CHECK(hash != 0);
    session = moved.session();
    moved = hpp::Sky();
    must(clouds.place({}));
    clouds = hpp::Clouds();
    must(session.set_frame(1));
    session = hpp::Session();

    // Clouds of one's own over a sky's session keep it, too.
    hpp::Clouds over = take(hpp::Clouds::create(sky_of().session()));
    must(over.render(frame));
}

TEST_CASE("pileus.hpp: a sky keeps the hosts of what it was made of") {
    // Arrays go back to the host that lent them, after the last use of it.
    std::atomic<long> held{0};
    const auto token = std::make_shared<int>(0);
    hpp::Host host = counting_host(held, token);
    host.threads = 1;
    {
        hpp::Sky sky = sky_of();
        const hpp::Scene scene = cumulus();
        hpp::Clouds clouds = sky.clouds();
        (void)take(clouds.add_kind(take(hpp::World::create(scene, host)), scene));
        must(sky.add_layer(take(hpp::World::create(scene, host)), scene));
        must(clouds.place({{0, {0, 0, 0}}}));
        CHECK(held > 0);
        // The one here, the host's, and those that were kept of the kind's and the layer's.
        CHECK(token.use_count() == 4);
        (void)hash_of(sky);
        sky = hpp::Sky();
        CHECK(held > 0);
        clouds = hpp::Clouds();
        CHECK(held == 0);
        CHECK(token.use_count() == 2);
        sky = sky_of({}, false, host);
        host = {};
        must(sky.session().set_camera(camera_of()));
        (void)hash_of(sky);
    }
    CHECK(held == 0);
    CHECK(token.use_count() == 1);
}

TEST_CASE("pileus.hpp: a report of the weather makes the clouds") {
    hpp::Sky sky = sky_of(kMarch, true);
    hpp::Camera camera;
    camera.size = {32, 18};
    camera.position_m = {0, 0, 300};
    camera.target_m = {0, 1000, 700};
    camera.fov_deg = 60;
    must(sky.session().set_camera(camera));
    must(sky.set_weather("EGLL 271020Z 24015KT 9999 OVC030 12/08 Q1012", 1));
    (void)hash_of(sky);
    // How much an overcast lets through is the weather's own matter.
    CHECK(take(sky.light_at({{0, 0, 10}}))[0].sun_share < 1);
    CHECK(refuses(sky.set_weather(""), "metar"));
    CHECK(refuses(sky.set_weather("nothing of the kind"), "metar"));
    CHECK(refuses(sky.set_weather("EGLL 271020Z 24015KT CAVOK 12/08 Q1012", 0, NAN), "elevation"));
    must(sky.set_weather("EGLL 271020Z 24005KT CAVOK 12/08 Q1012"));
    (void)hash_of(sky);
    CHECK(take(sky.light_at({{0, 0, 10}}))[0].sun_share == 1);
}

TEST_CASE("pileus.hpp: faults of a sky are codes and lines") {
    CHECK(hpp::Sky::create({}).code() == hpp::Code::kBadInput);
    CHECK(refuses(hpp::Sky::create(cumulus()).status(), "medi"));
    hpp::Sky none;
    CHECK_FALSE(bool(none.session()));
    CHECK_FALSE(bool(none.clouds()));
    CHECK(none.session().set_frame(1).code() == hpp::Code::kBadInput);
    CHECK(none.clouds().place({}).code() == hpp::Code::kBadInput);
    for (const hpp::Status& status :
         {none.add_layer({}, {}), none.set_weather(""), none.set_time(0), none.move({}),
          none.render({}), none.render({}, hpp::DepthImage{}), none.light_at({{}}).status(),
          none.shadow({}), none.air({}, 1).status()})
        CHECK(refuses(status, "sky: null"));

    const double inf = std::numeric_limits<double>::infinity();
    hpp::Sky sky = sky_of();
    must(sky.session().set_camera(camera_of()));
    const std::uint64_t before = hash_of(sky);
    CHECK(refuses(sky.add_layer({}, cumulus()), "world: null"));
    CHECK(refuses(sky.set_time(1), "date"));
    CHECK(refuses(sky.set_time(NAN), "hours"));
    CHECK(refuses(sky.move({0, NAN, 0}), "nan"));
    CHECK(refuses(sky.light_at({{0, 0, 0}, {inf, 0, 0}}).status(), "places.position_m"));
    CHECK(refuses(sky.air({0, 0, 0}, 1).status(), "direction"));
    CHECK(refuses(sky.air({0, 0, 1}, -1).status(), "metres"));
    CHECK(refuses(sky.clouds().place({{1, {0, 0, 0}}}), "places[0].kind"));
    hpp::ShadowMap map;
    CHECK(refuses(sky.shadow(map), "shadow.width"));
    map.size = {4, 4};
    CHECK(refuses(sky.shadow(map), "shadow.size_m"));
    map.size_m = {100, 100};
    CHECK(refuses(sky.shadow(map), "shadow.texels: null"));
    std::vector<float> texels(16);
    map.texels = texels.data();
    map.rows = 5;
    CHECK(refuses(sky.shadow(map), "shadow.rows"));
    hpp::Frame frame;
    frame.layers.push_back({"R", texels.data()});
    CHECK(refuses(sky.render(frame), "frame.layers"));
    hpp::DepthImage image;
    image.kind = static_cast<hpp::Depth>(7);
    CHECK(refuses(sky.render({}, image), "depth"));
    CHECK(hash_of(sky) == before);
}
