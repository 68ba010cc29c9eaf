// SPDX-License-Identifier: Apache-2.0
// pileus.hpp: the pictures of the C interface, owners that move, hosts that are lambdas, faults.
// in: small scenes -> out: checks. Includes the library's own headers as well, whose names are the
// same in another namespace. docs/embedding.md
#include <atomic>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "tests/embed/host_harness.h"
#include "tests/embed/hpp_harness.h"

using render_test::kSmallCumulus;
using namespace hpp_test;

namespace {

using Texts = std::vector<std::string>;

Texts with(const std::string& method) {
    return {"method.name=\"" + method + "\"", "path.samples_per_pixel=3",
            "collectors.generations=3", "collectors.photons=600", "raymarch.steps=40"};
}

const auto& check = must;

hpp::Session session_of(const std::string& method, const hpp::Host& host = {}) {
    const hpp::Scene scene = take(hpp::Scene::parse(kSmallCumulus, {}, with(method)));
    const hpp::World world = take(hpp::World::create(scene, host));
    return take(hpp::Session::create(world, scene, host));  // keeps the world's parts
}

std::string hash_of(hpp::Session& session) {
    std::uint64_t hash = 0;
    hpp::Frame frame;
    frame.hash = &hash;
    check(session.render(frame));
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

}  // namespace

TEST_CASE("pileus.hpp: pictures, lights and counts are those of the C interface") {
    for (const char* method : {"collectors", "raymarch", "path"}) {
        CAPTURE(method);
        host_test::Hosted c(kSmallCumulus, with(method));
        hpp::Session own = session_of(method);
        const hpp::Progress light = take(own.progress());
        CHECK(light.whole == c.whole());
        c.step(c.whole());
        check(own.step(light.whole));
        CHECK(hash_of(own) == c.hash());

        const double position[3] = {900, -3000, 800}, target[3] = {0, 50, 1000};
        c.aim(position, target, 35, 31, 17);
        c.sun(200, 25, 2);
        c.step(c.whole());
        hpp::Camera camera;
        camera.size = {31, 17};
        camera.position_m = {900, -3000, 800};
        camera.target_m = {0, 50, 1000};
        camera.fov_deg = 35;
        check(own.set_camera(camera));
        check(own.set_sun({200, 25, glm::vec3(2)}));
        std::uint32_t done = 0;
        check(own.step(light.whole, &done));
        CHECK(done == light.whole);
        CHECK(hash_of(own) == c.hash());

        const hpp::Stats stats = take(own.stats());
        CHECK(stats.pictures == 2);
        CHECK(stats.prepared == c.stats().prepared);
        CHECK(stats.shared_bytes == c.stats().shared_bytes);
        const std::string report = take(own.report());
        CHECK(report.front() == '{');
        CHECK(report.find('\0') == std::string::npos);
    }
    CHECK(std::string(hpp::version()) == pileus_version());
}

TEST_CASE("pileus.hpp: GLM's matrices are the camera, whatever their precision") {
    hpp::Session own = session_of("raymarch");
    const glm::dvec3 eye(16, -4000, 256), target(0, 0, 1024);
    const glm::dmat4 view = glm::lookAt(eye, target, glm::dvec3(0, 0, 1));
    const glm::dmat4 projection = glm::perspectiveZO(glm::radians(40.0), 1.5, 10.0, 90000.0);
    const auto picture = [&] {
        std::vector<float> pixels(4 * 30 * 20);
        hpp::Frame frame;
        frame.colour = pixels.data();
        frame.format = hpp::Format::kRgba32F;
        check(own.render(frame));
        return pixels;
    };
    hpp::Camera camera;
    camera.size = {30, 20};
    camera.position_m = eye;
    camera.target_m = target;
    check(own.set_camera(camera));
    const std::vector<float> looked = picture();
    check(own.set_camera(view, projection, hpp::Clip::kZero));
    const std::vector<float> by_doubles = picture();
    check(own.set_camera(glm::mat4(view), glm::mat4(projection), hpp::Clip::kZero, {30, 20}));
    const std::vector<float> by_floats = picture();
    double doubles = 0, floats = 0;
    for (std::size_t i = 0; i < looked.size(); ++i) {
        doubles += std::abs(double(looked[i]) - double(by_doubles[i]));
        floats += std::abs(double(looked[i]) - double(by_floats[i]));
    }
    CHECK(doubles / double(looked.size()) < 1e-5);
    CHECK(floats / double(looked.size()) < 1e-3);

    // A depth buffer and metres along the view's axis are the same things in the picture.
    std::vector<float> buffer(30 * 20), metres(30 * 20, 3500);
    const glm::dvec4 clip = projection * glm::dvec4(0, 0, -3500, 1);
    for (float& value : buffer) value = float(clip.z / clip.w);
    check(own.set_camera(view, projection, hpp::Clip::kZero));
    check(own.set_depth({metres.data(), hpp::Depth::kViewZ}));
    const std::vector<float> hidden = picture();
    CHECK(hidden != by_doubles);
    check(own.set_depth({buffer.data(), hpp::Depth::kBuffer}));
    const std::vector<float> by_buffer = picture();
    double apart = 0;
    for (std::size_t i = 0; i < hidden.size(); ++i)
        apart += std::abs(double(hidden[i]) - double(by_buffer[i]));
    CHECK(apart / double(hidden.size()) < 1e-3);
    check(own.set_depth({}));
    CHECK(picture() == by_doubles);
}

TEST_CASE("pileus.hpp: a host of lambdas, kept as long as what it made") {
    std::atomic<long> held{0}, bodies{0}, stages{0};
    auto token = std::make_shared<int>(0);
    {
        hpp::Host host = counting_host(held, token);
        host.threads = 2;
        host.run = [&bodies](std::uint32_t count, hpp::Body body) {
            bodies += count;
            for (std::uint32_t i = count; i > 0; --i) body(i - 1);
        };
        host.progress = [&stages](const char*, double) { ++stages; };
        hpp::Session first = session_of("collectors", host), plain = session_of("collectors");
        host = {};
        check(first.step(3));
        check(plain.step(3));
        CHECK(hash_of(first) == hash_of(plain));
        CHECK(held > 0);
        CHECK(bodies > 0);

        // Moves: the older handle goes to the host that it came from.
        hpp::Session second = std::move(first);
        CHECK_FALSE(bool(first));
        CHECK(first.set_frame(1).code() == hpp::Code::kBadInput);
        CHECK(hash_of(second) == hash_of(plain));
        second = std::move(plain);
        CHECK(held == 0);
        CHECK(token.use_count() == 1);
        CHECK(bool(second));
    }
    CHECK(token.use_count() == 1);
}

TEST_CASE("pileus.hpp: faults are codes and lines; what stops says how far it came") {
    const auto bad = hpp::Scene::parse("seed = \"x\"\n[cloud]\n");
    CHECK_FALSE(bool(bad));
    CHECK(bad.code() == hpp::Code::kBadInput);
    CHECK(bad.message().find("seed") != std::string::npos);
    CHECK_FALSE(bool(*bad));
    CHECK(hpp::Scene::read("no/such/file.toml").code() == hpp::Code::kBadInput);
    const hpp::Scene none;
    CHECK(hpp::World::create(none).code() == hpp::Code::kBadInput);
    CHECK(none.plan().code() == hpp::Code::kBadInput);
    const hpp::Scene scene = take(hpp::Scene::parse(kSmallCumulus, {}, with("path")));
    CHECK(hpp::Session::create({}, scene).code() == hpp::Code::kBadInput);
    hpp::Host small;
    small.memory_limit = 1000;
    CHECK(hpp::World::create(scene, small).code() == hpp::Code::kLimit);
    hpp::Host half;
    half.release = [](void*) {};
    CHECK(hpp::World::create(scene, half).code() == hpp::Code::kBadInput);
    CHECK(take(scene.plan()).cells == glm::uvec3(24, 24, 16));
    CHECK(take(scene.plan()).high_m == glm::dvec3(768, 768, 1536));

    hpp::Host host;
    host.stop = [] { return true; };
    hpp::Session session = session_of("path", host);
    std::uint32_t done = 9;
    CHECK(bool(session.step(5, &done)));
    CHECK(done < 5);
    CHECK(session.set_sun({0, 91}).message().find("elevation") != std::string::npos);
    CHECK(session.set_camera(glm::dmat4(2), glm::dmat4(1)).code() == hpp::Code::kBadInput);
    CHECK(session.set_ground({100, 2}).code() == hpp::Code::kBadInput);
    hpp::Lamp light;
    light.type = hpp::Lamp::Type::kSpot;
    CHECK(session.set_lamps({light, light}));
    CHECK(session.set_lamps({}));
    light.cone_deg = 0;
    CHECK(session.set_lamps({light}).code() == hpp::Code::kBadInput);
    CHECK(session.set_frame(-1).code() == hpp::Code::kBadInput);
    CHECK(bool(session.set_placement({100, 0, 50}, 30)));
    CHECK(bool(session.set_environment({glm::vec3(1)})));
}

TEST_CASE("pileus.hpp: densities of the caller are the medium") {
    const std::string text = std::string(kSmallCumulus);
    const hpp::Scene scene = take(hpp::Scene::parse(text, {}, with("raymarch")));
    const std::vector<float> cells(4 * 5 * 6, 0.5f), none(4 * 5 * 6, 0.0f);
    const auto drawn = [&](const std::vector<float>& values) {
        const hpp::World world =
            take(hpp::World::create(scene, {}, {{0, {4, 5, 6}, values.data()}}));
        hpp::Session session = take(hpp::Session::create(world, scene));
        std::vector<float> pixels(4 * 24 * 14);
        hpp::Frame frame;
        frame.colour = pixels.data();
        frame.format = hpp::Format::kRgba32F;
        check(session.render(frame));
        return pixels;
    };
    CHECK(drawn(cells) != drawn(none));
    const std::vector<float> clear = drawn(none);
    for (std::size_t i = 3; i < clear.size(); i += 4) CHECK(clear[i] == 0);
    const std::vector<float> wrong(4 * 5 * 6, -1.0f);
    CHECK(hpp::World::create(scene, {}, {{0, {4, 5, 6}, wrong.data()}}).code() ==
          hpp::Code::kBadInput);
}

TEST_CASE("pileus.hpp: work and the governor are those of the C interface") {
    hpp::Session session = session_of("raymarch");
    const std::string whole = hash_of(session);
    pileus_governor governor;
    PILEUS_INIT(governor);
    governor.target_s = 0.01;
    CHECK(take(session.govern(governor, 0)).scale == 1);
    hpp::Work work;
    for (int i = 0; i < 8; ++i) work = take(session.govern(governor, 1.0));
    CHECK(governor.level > 0);
    CHECK(work.scale > 1);
    check(session.set_work(work));
    CHECK(hash_of(session) != whole);
    check(session.set_work({}));
    CHECK(hash_of(session) == whole);
    work.photons = 1;
    CHECK(session.set_work(work).code() == hpp::Code::kBadInput);
    CHECK_FALSE(session.govern(governor, -1));
}

TEST_CASE("pileus.hpp: any vector and any matrix will do") {
    struct Place {
        double x, y, z;
    };
    hpp::Session a = session_of("raymarch"), b = session_of("raymarch");
    hpp::Camera camera;
    camera.size = {24, 14};
    camera.position_m = Place{16, -3500, 600};
    camera.target_m = glm::vec3(0, 0, 1024);
    const Place back = camera.position_m;
    CHECK(back.y == -3500);
    check(a.set_camera(camera));
    const glm::dmat4 view = glm::lookAt(glm::dvec3(camera.position_m), glm::dvec3(camera.target_m),
                                        glm::dvec3(0, 0, 1));
    const glm::dmat4 projection = glm::perspective(glm::radians(40.0), 24.0 / 14, 1.0, 90000.0);
    double v[4][4], p[4][4];
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) v[i][j] = view[i][j], p[i][j] = projection[i][j];
    check(a.set_camera(v, p));
    check(b.set_camera(view, projection));
    CHECK(hash_of(a) == hash_of(b));
}

TEST_CASE("pileus.hpp: scenes are changed key by key, and calls are cancelled") {
    hpp::Scene scene = take(hpp::Scene::parse(kSmallCumulus, {}, with("path")));
    check(scene.set("medium.0.albedo", "0.9"));
    check(scene.set("sun.elevation_deg", 20));
    check(scene.set("camera.position_m", glm::dvec3(16, -3500, 700)));
    CHECK(scene.set("medium.0.albedo", 2).code() == hpp::Code::kBadInput);
    const std::string text = take(scene.dump());
    CHECK(text.find("albedo = 0.9\n") != std::string::npos);
    CHECK(text.find("position_m = [16, -3500, 700]\n") != std::string::npos);
    hpp::Scene none;
    CHECK(none.set("seed", 1).code() == hpp::Code::kBadInput);
    CHECK(none.dump().code() == hpp::Code::kBadInput);
    const hpp::World world = take(hpp::World::create(scene));
    hpp::Session session = take(hpp::Session::create(world, scene));
    std::uint32_t done = 9;
    session.cancel();
    check(session.step(3, &done));
    CHECK(done == 0);
    check(session.step(3, &done));
    CHECK(done == 3);
    hpp::Session empty;
    empty.cancel();
}
