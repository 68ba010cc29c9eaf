// SPDX-License-Identifier: Apache-2.0
// What frames take at the most: told before, never exceeded, and fitted to a budget.
// in: scenes, settings of marches, cameras everywhere -> out: counts of pictures.
// docs/realtime.md, "Maximum cost of a frame"
#include <filesystem>

#include "src/scene/read_scene.h"
#include "src/session/session.h"
#include "tests/embed/host_harness.h"

using namespace host_test;
using render_test::kSmallCumulus;

namespace {

std::uint64_t executed(const pileus::Session& session, const char* name) {
    for (const auto& [key, value] : session.told().executed)
        if (key == name) return value;
    return 0;
}

std::uint64_t samples_of(const pileus::Session& session) {
    return executed(session, "ray_samples") + executed(session, "light_samples");
}

/// Draws from far, near, within and below the medium, across it and along its axes; what was
/// counted is never above what was told. Returns the largest share of the samples told.
double fly(pileus::Session& session, const pileus::Scene& scene) {
    const pileus::Camera start = session.camera();
    const glm::dvec3 middle = start.target_m;
    const glm::dvec3 arm = start.position_m - middle;
    const glm::dvec3 places[] = {arm,           0.4 * arm,          0.05 * arm,   {0, 0, 6000},
                                 {-3000, 0, 0}, {2000, 2000, 2000}, {30, 40, 700}};
    std::vector<float> pixels(4 * std::size_t(start.resolution[0]) * start.resolution[1]);
    double share = 0;
    int frame = 0;
    for (const glm::dvec3& place : places) {
        pileus::Camera camera = start;
        camera.position_m = middle + place;
        if (!scene.camera.orthographic) camera.fov_deg = 1 + 25.0 * frame;
        if (place.x == 0 && place.y == 0) camera.up = {0, 1, 0};
        REQUIRE(session.set_frame(frame++));
        const pileus::Status moved = session.set_camera(camera);
        if (!moved) continue;  // underground
        pileus::FrameUnits most;
        REQUIRE(session.most_units({}, most));
        const std::uint64_t rays = executed(session, "marched_pixels");
        const std::uint64_t samples = samples_of(session), photons = session.told().photons.traced;
        std::uint64_t units = 0, hash = 0;
        REQUIRE(session.step(1, units));
        pileus::FrameTarget target;
        target.hash = &hash;
        REQUIRE(session.render(target));
        const std::uint64_t own_rays = executed(session, "marched_pixels") - rays;
        const std::uint64_t own = samples_of(session) - samples;
        CAPTURE(frame);
        CHECK(own_rays <= most.rays);
        CHECK(own <= most.samples);
        // Those of method path are paths; a ring forgets its oldest.
        if (scene.method != "path") CHECK(session.told().photons.traced <= photons + most.photons);
        CHECK(most.rays <= most.pixels);
        if (most.samples > 0) share = std::max(share, double(own) / double(most.samples));
    }
    return share;
}

/// 0 where the scene cannot be drawn so, or what it takes depends on the view.
double fly_scene(const pileus::Scene& scene) {
    pileus::Session session;
    const pileus::Status opened = session.open(scene, {}, true, {});
    if (!opened) return 0;
    pileus::FrameUnits most;
    const pileus::Status told = session.most_units({}, most);
    if (!told) {
        CHECK(told.message.find("units: ") == 0);
        CHECK(told.message.find(", allowed: ") != std::string::npos);
        return 0;
    }
    return fly(session, scene);
}

const Overrides kMarches[] = {
    {"raymarch.steps=1"},
    {"raymarch.steps=40", "raymarch.light=march", "raymarch.light_steps=6"},
    {"raymarch.steps=20", "raymarch.light=march"},
    {"raymarch.steps=33", "raymarch.integrator=simpson"},
    {"raymarch.steps=33", "raymarch.integrator=simpson38", "raymarch.jitter=hash"},
    {"raymarch.steps=7", "raymarch.integrator=trapezoid", "raymarch.jitter=blue-noise"},
    {"raymarch.spacing=voxel"},
    {"raymarch.steps=24", "raymarch.spacing=optimal"},
    {"raymarch.steps=24", "raymarch.spacing=geometric"},
    {"raymarch.steps=24", "raymarch.occlusion=stretch", "raymarch.jitter=hash"},
    {"raymarch.steps=24", "raymarch.grid_lock_m=50"},
    {"raymarch.steps=24", "raymarch.light_path=cone", "raymarch.light=march",
     "raymarch.light_steps=5"},
    {"raymarch.steps=24", "raymarch.scale=4"},
    {"raymarch.steps=24", "raymarch.temporal=2"},
    {"raymarch.steps=24", "raymarch.temporal=4", "camera.resolution=[23,13]"},
    {"method.name=optical-depth"},
    {"method.name=optical-depth", "optical_depth.steps=12"},
};
/// Media that a march looks up the most: nothing that ends a ray early, and cells that are flat.
const Overrides kMedia[] = {
    {},
    {"medium.0.density=uniform:box", "medium.0.extinction_per_m=0.00001"},
    {"medium.0.density=uniform:box", "medium.0.resolution=[3,3,90]"},
    {"medium.0.density=uniform:box", "medium.0.interpolation=constant"},
    {"medium.0.extinction_per_m=50"},
};

pileus_costs unit_costs() {
    auto costs = cleared<pileus_costs>();
    costs.fixed = 1e6, costs.pixel = 400, costs.ray = 5000, costs.sample = 1300;
    costs.photon = 3000;
    return costs;
}

double cost(const pileus_units& u, const pileus_costs& c) {
    return c.fixed + double(u.pixels) * c.pixel + double(u.rays) * c.ray +
           double(u.samples) * c.sample + double(u.photons) * c.photon;
}

}  // namespace

TEST_CASE("units: no marched picture takes more rays or samples than was told") {
    double most = 0;
    for (const Overrides& medium : kMedia) {
        for (const Overrides& march : kMarches) {
            Overrides all{"method.name=raymarch"};
            all.insert(all.end(), medium.begin(), medium.end());
            all.insert(all.end(), march.begin(), march.end());
            std::string named;
            for (const std::string& key : all) named += key + " ";
            CAPTURE(named);
            pileus::Scene scene;
            const pileus::Status read =
                pileus::read_scene_text(kSmallCumulus, "scene", "", all, scene);
            REQUIRE_MESSAGE(bool(read), read.message);
            const double share = fly_scene(scene);
            CHECK(share > 0);
            most = std::max(most, share);
        }
    }
    // The bound is near what a picture takes where all rays go all the way.
    CHECK(most > 0.75);
}

TEST_CASE("units: the scenes of golden pictures take no more than was told") {
    int flown = 0;
    for (const auto& entry : std::filesystem::directory_iterator("assets/scenes/golden")) {
        if (entry.path().extension() != ".toml") continue;
        CAPTURE(entry.path().string());
        pileus::Scene scene;
        REQUIRE(pileus::read_scene_file(entry.path().string(),
                                        {"camera.resolution=[16,12]", "collectors.photons=500",
                                         "photon_grid.photons=500", "path.samples_per_pixel=1"},
                                        scene));
        flown += fly_scene(scene) > 0;
    }
    CHECK(flown >= 8);
}

TEST_CASE("units: a thousand frames of more work than fits keep to the budget, each of them") {
    const Overrides rows[] = {{"method.name=raymarch", "raymarch.steps=64"},
                              {"method.name=raymarch", "raymarch.steps=64", "raymarch.temporal=2"},
                              {"method.name=collectors", "collectors.generations=4"},
                              {"method.name=photon-grid", "photon_grid.ring=true"}};
    for (const Overrides& row : rows) {
        CAPTURE(row);
        Hosted host(kSmallCumulus, row);
        REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
        const double position[3] = {16, -4000, 256}, target[3] = {0, 0, 1024};
        host.aim(position, target, 40, 24, 14);
        host.sun(120, 30);
        host.step(1);
        host.hash();
        const pileus_costs costs = unit_costs();
        auto most = cleared<pileus_units>();
        host.check(pileus_session_most_units(host.session.get(), nullptr, &most, &host.out.error));
        // What all of the work takes is three times what a frame may.
        const double budget = cost(most, costs) / 3;
        const int frames = row[0] == "method.name=raymarch" ? 1000 : 60;
        for (int frame = 0; frame < frames; ++frame) {
            double at[3];
            pileus_orbit(position, target, 3.0 * frame, at);
            host.aim(at, target, 5 + frame % 80, 24, 14);
            auto work = cleared<pileus_work>();
            host.check(
                pileus_session_fit(host.session.get(), &costs, budget, &work, &host.out.error));
            host.check(pileus_session_set_work(host.session.get(), &work, &host.out.error));
            auto own = cleared<pileus_units>();
            host.check(
                pileus_session_most_units(host.session.get(), nullptr, &own, &host.out.error));
            REQUIRE(cost(own, costs) <= budget);
            host.step(1);
            host.hash();
        }
        // The finest work that fits: the next level up does not.
        auto all = cleared<pileus_work>();
        host.check(pileus_session_fit(host.session.get(), &costs, 1e29, &all, &host.out.error));
        auto whole = cleared<pileus_units>();
        host.check(pileus_session_most_units(host.session.get(), &all, &whole, &host.out.error));
        CHECK(cost(whole, costs) > budget);
        // Nothing fits into nothing: the least work, and a line.
        auto least = cleared<pileus_work>();
        CHECK(pileus_session_fit(host.session.get(), &costs, 0, &least, &host.out.error) ==
              PILEUS_ERROR_LIMIT);
        CHECK(host.out.line().find("work: the least takes up to ") == 0);
        CHECK(least.struct_size == marked(sizeof least));
    }
}

TEST_CASE("units: views decide what billboards and particles take, which is said in a line") {
    const Overrides rows[] = {
        {"method.name=collectors", "collectors.display=billboards"},
        {"method.name=raymarch", "medium.0.boundary=periodic", "raymarch.spacing=voxel"}};
    for (const Overrides& row : rows) {
        CAPTURE(row);
        Hosted host(kSmallCumulus, row);
        REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
        auto most = cleared<pileus_units>();
        CHECK(pileus_session_most_units(host.session.get(), nullptr, &most, &host.out.error) ==
              PILEUS_ERROR_INPUT);
        CHECK(host.out.line().find("units: ") == 0);
    }
    Hosted host(kSmallCumulus, {"method.name=raymarch"});
    auto costs = unit_costs();
    costs.ray = -1;
    auto work = cleared<pileus_work>();
    CHECK(pileus_session_fit(host.session.get(), &costs, 1, &work, &host.out.error) ==
          PILEUS_ERROR_INPUT);
    CHECK(pileus_session_fit(host.session.get(), nullptr, 1, &work, &host.out.error) ==
          PILEUS_ERROR_INPUT);
    CHECK(pileus_session_most_units(nullptr, nullptr, nullptr, &host.out.error) ==
          PILEUS_ERROR_INPUT);
}
