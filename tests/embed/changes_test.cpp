// SPDX-License-Identifier: Apache-2.0
// Values of a session one at a time: what is the same keeps the light, what differs does not.
// in: a path tracing, single members changed; work of every method out of range -> out: samples
// held; lines. docs/embedding.md, "What may change"; docs/realtime.md, "Work and the governor"
#include <functional>

#include "tests/embed/host_harness.h"

using namespace host_test;
using render_test::kSmallCumulus;

namespace {

const Overrides kPath = {"method.name=path", "path.samples_per_pixel=1", "camera.resolution=[8,5]",
                         "medium.0.resolution=[6,6,4]", "output.layers=[\"radiance\"]"};

std::uint32_t held(Hosted& host) {
    // What was set is taken up by the next step, though it be none.
    host.check(pileus_session_step(host.session.get(), 0, nullptr, &host.out.error));
    auto light = cleared<pileus_progress>();
    host.check(pileus_session_progress(host.session.get(), &light, &host.out.error));
    return std::uint32_t(light.units);
}

/// Sets `first`, draws a sample, sets it again, then with each change: samples that are left.
template <class Given, class Set>
void one_at_a_time(const Given& first, const std::vector<std::function<void(Given&)>>& changes,
                   Set set) {
    Hosted host(kSmallCumulus, kPath);
    REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
    const auto give = [&](const Given& given) {
        host.check(set(host.session.get(), given, &host.out.error));
    };
    for (std::size_t i = 0; i < changes.size(); ++i) {
        CAPTURE(i);
        give(first);
        host.step(1);
        CHECK(held(host) == 1);
        give(first);
        CHECK(held(host) == 1);
        Given other = first;
        changes[i](other);
        give(other);
        CHECK(held(host) == 0);
    }
}

}  // namespace

TEST_CASE("changes: each number of a camera by itself") {
    auto first = cleared<pileus_camera>();
    first.position_m[0] = 16, first.position_m[1] = -4000, first.position_m[2] = 256;
    first.target_m[2] = 1024;
    first.fov_deg = 40;
    first.width = 8, first.height = 5;
    using Change = std::function<void(pileus_camera&)>;
    std::vector<Change> changes = {
        [](pileus_camera& c) { c.fov_deg = 41; },        [](pileus_camera& c) { c.height_m = 900; },
        [](pileus_camera& c) { c.width = 9; },           [](pileus_camera& c) { c.height = 6; },
        [](pileus_camera& c) { c.up[0] = c.up[2] = 1; },
    };
    for (int a = 0; a < 3; ++a) {
        changes.push_back([a](pileus_camera& c) { c.position_m[a] += 1; });
        changes.push_back([a](pileus_camera& c) { c.target_m[a] += 1; });
    }
    const auto set = [](pileus_session* s, const pileus_camera& c, pileus_error* e) {
        return pileus_session_set_camera(s, &c, e);
    };
    one_at_a_time<pileus_camera>(first, changes, set);
    // From one parallel projection to another.
    first.height_m = 900;
    one_at_a_time<pileus_camera>(first, {[](pileus_camera& c) { c.height_m = 901; }}, set);
}

TEST_CASE("changes: each number of matrices by itself") {
    struct Given {
        double view[16], clip[16];
    };
    const Given first = {{1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, -16, -1024, -4000, 1},
                         {1, 0, 0, 0, 0, 1.6, 0, 0, 0, 0, -1.001, -1, 0, 0, -2, 0}};
    one_at_a_time<Given>(first,
                         {[](Given& g) { g.clip[0] = 1.1; }, [](Given& g) { g.clip[5] = 1.5; },
                          [](Given& g) { g.clip[8] = 0.1; }, [](Given& g) { g.clip[9] = 0.1; },
                          [](Given& g) { g.view[12] = -17; }},
                         [](pileus_session* s, const Given& g, pileus_error* e) {
                             return pileus_session_set_matrices(s, g.view, g.clip,
                                                                PILEUS_CLIP_MINUS_ONE, 0, 0, e);
                         });
}

TEST_CASE("changes: each number of a sun, a ground and a place by itself") {
    auto sun = cleared<pileus_sun>();
    sun.present = 1;
    sun.azimuth_deg = 120, sun.elevation_deg = 35;
    for (float& c : sun.irradiance) c = 1;
    std::vector<std::function<void(pileus_sun&)>> suns = {
        [](pileus_sun& s) { s.azimuth_deg += 1; }, [](pileus_sun& s) { s.elevation_deg += 1; },
        [](pileus_sun& s) { s.present = 0; }};
    for (int c = 0; c < 3; ++c) suns.push_back([c](pileus_sun& s) { s.irradiance[c] = 0.5f; });
    one_at_a_time<pileus_sun>(sun, suns,
                              [](pileus_session* s, const pileus_sun& v, pileus_error* e) {
                                  return pileus_session_set_sun(s, &v, e);
                              });
    auto ground = cleared<pileus_ground>();
    ground.present = 1;
    ground.albedo = 0.25;
    one_at_a_time<pileus_ground>(
        ground,
        {[](pileus_ground& g) { g.present = 0; }, [](pileus_ground& g) { g.albedo = 0.5; },
         [](pileus_ground& g) { g.altitude_m = -1; }},
        [](pileus_session* s, const pileus_ground& v, pileus_error* e) {
            return pileus_session_set_ground(s, &v, e);
        });
    auto place = cleared<pileus_placement>();
    place.yaw_deg = 10;
    std::vector<std::function<void(pileus_placement&)>> places = {
        [](pileus_placement& p) { p.yaw_deg = 11; }};
    for (int a = 0; a < 3; ++a) places.push_back([a](pileus_placement& p) { p.offset_m[a] += 1; });
    one_at_a_time<pileus_placement>(
        place, places, [](pileus_session* s, const pileus_placement& v, pileus_error* e) {
            return pileus_session_set_placement(s, &v, e);
        });
}

TEST_CASE("changes: each number of a light by itself") {
    auto spot = cleared<pileus_lamp>();
    spot.type = PILEUS_LAMP_SPOT;
    spot.position_m[1] = -900, spot.position_m[2] = 900;
    spot.direction[1] = 1;
    spot.cone_deg = 50, spot.penumbra_deg = 5, spot.radius_m = 2, spot.shadow_samples = 2;
    for (float& c : spot.light) c = 1e5f;
    const auto set = [](pileus_session* s, const pileus_lamp& l, pileus_error* e) {
        return pileus_session_set_lamps(s, &l, 1, e);
    };
    std::vector<std::function<void(pileus_lamp&)>> changes = {
        [](pileus_lamp& l) { l.type = PILEUS_LAMP_POINT; }, [](pileus_lamp& l) { l.cone_deg = 51; },
        [](pileus_lamp& l) { l.penumbra_deg = 6; },         [](pileus_lamp& l) { l.radius_m = 3; },
        [](pileus_lamp& l) { l.shadow_samples = 3; },
    };
    for (int a = 0; a < 3; ++a) {
        changes.push_back([a](pileus_lamp& l) { l.position_m[a] += 1; });
        changes.push_back([a](pileus_lamp& l) { l.direction[a] += 0.5; });
        changes.push_back([a](pileus_lamp& l) { l.light[a] = 2e5f; });
    }
    one_at_a_time<pileus_lamp>(spot, changes, set);
    auto beam = cleared<pileus_lamp>();
    beam.type = PILEUS_LAMP_DIRECTIONAL;
    beam.azimuth_deg = 30, beam.elevation_deg = 40;
    for (float& c : beam.light) c = 1;
    one_at_a_time<pileus_lamp>(
        beam,
        {[](pileus_lamp& l) { l.azimuth_deg = 31; }, [](pileus_lamp& l) { l.elevation_deg = 41; },
         [](pileus_lamp& l) { l.light[1] = 2; }},
        set);
}

TEST_CASE("changes: places out of range, on every axis") {
    Hosted host(kSmallCumulus, kPath);
    const auto refused = [&](const pileus_placement& place, const char* key) {
        CHECK(pileus_session_set_placement(host.session.get(), &place, &host.out.error) ==
              PILEUS_ERROR_INPUT);
        CHECK(host.out.line().find(key) == 0);
    };
    for (const double far : {2e9, -2e9}) {
        for (int a = 0; a < 3; ++a) {
            auto place = cleared<pileus_placement>();
            place.offset_m[a] = far;
            refused(place, "placement.offset_m: out of range");
        }
        auto place = cleared<pileus_placement>();
        place.yaw_deg = far;
        refused(place, "placement.yaw_deg: out of range");
    }
    // Below a sky map, whose lights would have to turn.
    const std::vector<float> texels(8 * 4 * 3, 0.5f);
    auto sky = cleared<pileus_environment>();
    sky.present = 1;
    sky.map_size[0] = 8, sky.map_size[1] = 4;
    sky.map = texels.data();
    host.check(pileus_session_set_environment(host.session.get(), &sky, &host.out.error));
    auto place = cleared<pileus_placement>();
    place.yaw_deg = 1;
    refused(place, "placement.yaw_deg: not below a sky map");
    auto ground = cleared<pileus_ground>();
    CHECK(pileus_session_set_ground(host.session.get(), &ground, &host.out.error) ==
          PILEUS_ERROR_INPUT);
    CHECK(host.out.line().find("ground: the sky map was read with it") == 0);
    // The map is kept where no other is given, and goes with a sky without one.
    sky.map = nullptr;
    host.check(pileus_session_set_environment(host.session.get(), &sky, &host.out.error));
    refused(place, "placement.yaw_deg: not below a sky map");
    sky.map_size[0] = sky.map_size[1] = 0;
    host.check(pileus_session_set_environment(host.session.get(), &sky, &host.out.error));
    host.check(pileus_session_set_placement(host.session.get(), &place, &host.out.error));
    sky.map_size[0] = 20000, sky.map_size[1] = 4;
    sky.map = texels.data();
    CHECK(pileus_session_set_environment(host.session.get(), &sky, &host.out.error) ==
          PILEUS_ERROR_INPUT);
    CHECK(host.out.line().find("sky.map_size: ") == 0);
}

TEST_CASE("changes: work that a method does not have, or more than the scene's, is refused") {
    struct Row {
        Overrides scene;
        std::function<void(pileus_work&)> change;
        const char* line;
    };
    const auto scale = [](std::uint32_t v) { return [v](pileus_work& w) { w.scale = v; }; };
    const auto temporal = [](std::uint32_t v) { return [v](pileus_work& w) { w.temporal = v; }; };
    const auto steps = [](std::uint32_t v) { return [v](pileus_work& w) { w.steps = v; }; };
    const auto refresh = [](std::uint32_t v) {
        return [v](pileus_work& w) { w.light_refresh = v; };
    };
    const auto photons = [](std::uint64_t v) { return [v](pileus_work& w) { w.photons = v; }; };
    const std::string march = "method.name=raymarch", grid = "method.name=photon-grid",
                      path = "method.name=path", gather = "method.name=collectors",
                      simple = "method.name=optical-depth", thin = "raymarch.temporal=2";
    const Row rows[] = {
        {{path}, scale(2), "work.scale: 2, allowed: 0, as method path"},
        {{simple}, scale(2), "work.scale: 2, allowed: 0, as method optical-depth"},
        {{gather, "collectors.display=billboards"}, scale(2), "work.scale: 2, allowed: 0, as"},
        {{march, thin}, scale(2), "work.scale: 2, allowed: 0, with temporal"},
        {{march}, scale(3), "work.scale: "},
        {{march}, temporal(2), "work.temporal: 2, allowed: 0 where the scene has none"},
        {{march, thin}, temporal(3), "work.temporal: "},
        {{path}, steps(2), "work.steps: 2, allowed: 0, as method path"},
        {{march, "raymarch.steps=10"}, steps(70000), "raymarch.steps: out of range, 70000"},
        {{march, "raymarch.steps=10"}, steps(0xffffffffu), "work: 4294967295, allowed: up to 2^30"},
        {{simple}, refresh(2), "work.light_refresh: 2, allowed: 0, as method optical-depth"},
        {{march}, refresh(65), "raymarch.light_refresh: out of range, 65"},
        {{march}, photons(1), "work.photons: 1, allowed: 0, as method raymarch"},
        {{gather, "collectors.photons=100", "collectors.generations=2"},
         photons(51),
         "work.photons: 51, allowed: 0 to 50"},
        {{grid, "photon_grid.photons=100", "photon_grid.generations=2"},
         photons(~std::uint64_t{0}),
         "work.photons: "},
    };
    for (const Row& row : rows) {
        CAPTURE(std::string(row.line));
        Overrides all = {"camera.resolution=[8,5]", "medium.0.resolution=[6,6,4]",
                         "collectors.samples=50", "output.layers=[\"radiance\"]"};
        all.insert(all.end(), row.scene.begin(), row.scene.end());
        Hosted host(kSmallCumulus, all);
        REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
        auto before = cleared<pileus_work>(), after = cleared<pileus_work>();
        host.check(pileus_session_work(host.session.get(), &before, &host.out.error));
        auto work = cleared<pileus_work>();
        row.change(work);
        CHECK(pileus_session_set_work(host.session.get(), &work, &host.out.error) ==
              PILEUS_ERROR_INPUT);
        CHECK_MESSAGE(host.out.line().find(row.line) != std::string::npos, host.out.line());
        CHECK(host.out.line().find("allowed: ") != std::string::npos);
        host.check(pileus_session_work(host.session.get(), &after, &host.out.error));
        CHECK(std::memcmp(&before, &after, sizeof before) == 0);
    }
}

TEST_CASE("changes: calls without a session, and numbers out of range, have a line") {
    Hosted host(kSmallCumulus, {"method.name=raymarch", "medium.0.resolution=[6,6,4]"});
    pileus_session* const s = host.session.get();
    pileus_error* const e = &host.out.error;
    auto work = cleared<pileus_work>();
    auto units = cleared<pileus_units>();
    auto costs = cleared<pileus_costs>();
    auto governor = cleared<pileus_governor>();
    auto camera = cleared<pileus_camera>();
    const double view[16] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, -16, -1024, -4000, 1};
    std::uint32_t width = 0, height = 0;
    governor.target_s = 0.01;
    const auto refused = [&](pileus_code code, const char* line) {
        CHECK(code == PILEUS_ERROR_INPUT);
        CHECK_MESSAGE(host.out.line().find(line) == 0, host.out.line());
    };
    refused(pileus_session_set_work(nullptr, &work, e), "session: null");
    refused(pileus_session_work(nullptr, &work, e), "session: null");
    refused(pileus_session_govern(nullptr, &governor, 0, &work, e), "session: null");
    refused(pileus_session_most_units(nullptr, &work, &units, e), "session: null");
    refused(pileus_session_fit(nullptr, &costs, 1, &work, e), "session: null");
    refused(pileus_session_set_camera(nullptr, &camera, e), "session: null");
    refused(pileus_session_set_matrices(nullptr, view, view, PILEUS_CLIP_ZERO, 0, 0, e),
            "session: null");
    refused(pileus_session_size(nullptr, &width, &height, e), "session: null");
    refused(pileus_session_set_frame(nullptr, 1, e), "session: null");
    refused(pileus_session_set_lamps(nullptr, nullptr, 0, e), "session: null");
    refused(pileus_session_progress(nullptr, nullptr, e), "session: null");
    refused(pileus_session_step(nullptr, 1, nullptr, e), "session: null");
    refused(pileus_session_stats(nullptr, nullptr, e), "session: null");
    refused(pileus_session_set_work(s, nullptr, e), "work: null");
    refused(pileus_session_work(s, nullptr, e), "work: null");
    refused(pileus_session_govern(s, nullptr, 0, &work, e), "governor: null");
    refused(pileus_session_fit(s, nullptr, 1, &work, e), "costs: null");
    refused(pileus_session_set_matrices(s, nullptr, view, PILEUS_CLIP_ZERO, 0, 0, e), "view");
    refused(pileus_session_set_matrices(s, view, nullptr, PILEUS_CLIP_ZERO, 0, 0, e), "view");
    refused(pileus_session_set_matrices(s, view, view, PILEUS_CLIP_ZERO, 40000, 1, e),
            "camera.resolution: 40000, allowed: 1 to 32768");
    refused(pileus_session_size(s, nullptr, &height, e), "width");
    refused(pileus_session_size(s, &width, nullptr, e), "width");
    auto older = work;
    older.struct_size = 0;
    refused(pileus_session_most_units(s, &older, &units, e), "work: null or not initialised");
    work.steps = 0xffffffffu;
    refused(pileus_session_most_units(s, &work, &units, e), "work: 4294967295");
    work = cleared<pileus_work>();
    work.photons = ~std::uint64_t{0};
    refused(pileus_session_set_work(s, &work, e), "work.photons: ");
    work = cleared<pileus_work>();
    for (const double wrong : {-1.0, 2e30, double(__builtin_nanf(""))}) {
        for (double pileus_costs::*member :
             {&pileus_costs::fixed, &pileus_costs::pixel, &pileus_costs::ray, &pileus_costs::sample,
              &pileus_costs::photon}) {
            costs = cleared<pileus_costs>();
            costs.*member = wrong;
            refused(pileus_session_fit(s, &costs, 1, &work, e), "costs: out of range");
        }
        costs = cleared<pileus_costs>();
        refused(pileus_session_fit(s, &costs, wrong, &work, e), "most: out of range");
        refused(pileus_session_govern(s, &governor, wrong, &work, e), "frame_s: out of range");
        auto other = governor;
        other.target_s = wrong;
        refused(pileus_session_govern(s, &other, 0, &work, e), "governor.target_s: out of range");
    }
    host.check(pileus_session_size(s, &width, &height, e));
    CHECK(width == 24);
    CHECK(height == 14);
}
