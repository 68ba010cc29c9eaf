// SPDX-License-Identifier: Apache-2.0
// Sessions of every method under many settings, moved about: one thread and one lane at a time draw
// what three threads and the widest lanes draw, and refuse in the same words. in: rows of scenes,
// the same calls on two hosts -> out: equal bytes, depths, hashes and lines. docs/determinism.md;
// docs/embedding.md, "What may change"
#include "tests/embed/settings_rows.h"
#include "tests/support/long_tests.h"

using namespace host_test;
using namespace settings_test;

namespace {

/// Two sessions over a scene, to which the same is done.
class Pair {
public:
    Pair(const std::string& text, const Overrides& overrides) {
        for (int i = 0; i < 2; ++i) {
            auto host = cleared<pileus_host>();
            host.isa = i == 0 ? "scalar" : nullptr;
            host.threads = i == 0 ? 1 : 3;
            hosts_[i] = std::make_unique<Hosted>(text, overrides, &host);
            REQUIRE_MESSAGE(hosts_[i]->code == PILEUS_OK, hosts_[i]->out.line());
        }
    }

    /// call(session, error) of both; what the first one returned.
    template <class Call>
    pileus_code both(Call call) {
        pileus_code codes[2];
        for (int i = 0; i < 2; ++i)
            codes[i] = call(hosts_[i]->session.get(), &hosts_[i]->out.error);
        CHECK(codes[0] == codes[1]);
        if (codes[0] == PILEUS_OK) return codes[0];
        CHECK(hosts_[0]->out.line() == hosts_[1]->out.line());
        CHECK(hosts_[0]->out.line().find("allowed: ") != std::string::npos);
        return codes[0];
    }

    /// All light, and a picture in pixels of `format`; its hash, or 0 where both were refused.
    std::uint64_t draw(std::uint32_t format) {
        std::uint64_t hashes[2] = {};
        std::vector<float> colours[2], depths[2];
        int turn = 0;
        const pileus_code code = both([&](pileus_session* s, pileus_error* e) {
            const int i = turn++;
            auto light = cleared<pileus_progress>();
            pileus_code got = pileus_session_progress(s, &light, e);
            if (got == PILEUS_OK) got = pileus_session_step(s, light.whole, nullptr, e);
            if (got != PILEUS_OK) return got;
            const std::size_t pixels = std::size_t(width_) * height_;
            colours[i].assign(4 * pixels, 0.25f), depths[i].assign(pixels, 0);
            auto frame = cleared<pileus_frame>();
            frame.colour = colours[i].data();
            frame.format = format;
            frame.blend = format;
            // Without depth and hash first, as rows of bytes that are finished one by one.
            if (format == PILEUS_FORMAT_RGBA8_SRGB) got = pileus_session_render(s, &frame, e);
            if (got != PILEUS_OK) return got;
            frame.depth = flux_ ? nullptr : depths[i].data();
            frame.hash = &hashes[i];
            return pileus_session_render(s, &frame, e);
        });
        CHECK(hashes[0] == hashes[1]);
        CHECK(colours[0].size() == colours[1].size());
        CHECK(std::memcmp(colours[0].data(), colours[1].data(), colours[0].size() * 4) == 0);
        CHECK(std::memcmp(depths[0].data(), depths[1].data(), depths[0].size() * 4) == 0);
        return code == PILEUS_OK ? hashes[0] : 0;
    }

    void see(const pileus_camera& camera) {
        const pileus_code code = both([&](pileus_session* s, pileus_error* e) {
            return pileus_session_set_camera(s, &camera, e);
        });
        if (code == PILEUS_OK && camera.width > 0) width_ = camera.width, height_ = camera.height;
    }
    void size(std::uint32_t width, std::uint32_t height, bool flux) {
        width_ = width, height_ = height, flux_ = flux;
    }
    std::size_t pixels() const { return std::size_t(width_) * height_; }

private:
    std::unique_ptr<Hosted> hosts_[2];
    std::uint32_t width_ = 9, height_ = 6;
    bool flux_ = false;
};

/// The camera of a scene, for its session.
pileus_camera camera_of(const pileus::Scene& scene) {
    auto camera = cleared<pileus_camera>();
    for (int a = 0; a < 3; ++a) {
        camera.position_m[a] = scene.camera.position_m[a];
        camera.target_m[a] = scene.camera.target_m[a];
        camera.up[a] = scene.camera.up[a];
    }
    camera.fov_deg = scene.camera.fov_deg;
    if (scene.camera.orthographic || scene.camera.flux) camera.height_m = scene.camera.height_m;
    camera.width = std::uint32_t(scene.camera.resolution[0]);
    camera.height = std::uint32_t(scene.camera.resolution[1]);
    return camera;
}

/// Views from all sides, some of which not every scene allows.
void look_around(const pileus_camera& start, Pair& pair) {
    const auto from = [&](double x, double y, double z, double aim_z) {
        pileus_camera camera = start;
        const double position[3] = {x, y, z}, target[3] = {0, 0, aim_z};
        std::memcpy(camera.position_m, position, sizeof position);
        std::memcpy(camera.target_m, target, sizeof target);
        return camera;
    };
    pair.see(from(0, -100, 1000, 1024));  // within the media
    pair.draw(PILEUS_FORMAT_RGBA32F);
    pair.see(from(0, 0, 4000, 0));  // along its own up
    auto down = from(0, 0, 4000, 0);
    down.up[1] = 1, down.up[2] = 0;
    pair.see(down);
    pair.draw(PILEUS_FORMAT_RGBA16F);
    auto flat = from(1500, -3500, 1400, 1000);
    if (flat.height_m > 0)
        flat.height_m = 0;
    else
        flat.height_m = 1800;
    flat.width = 7, flat.height = 3;
    pair.see(flat);
    pair.draw(PILEUS_FORMAT_RGBA8_SRGB);
    pair.see(from(-3000, 200, 90, 2500));  // from below, the sky behind
    pair.draw(PILEUS_FORMAT_RGBA32F);
    pair.see(start);
}

void change_sun(Pair& pair) {
    auto sun = cleared<pileus_sun>();
    const auto set = [&] {
        pair.both(
            [&](pileus_session* s, pileus_error* e) { return pileus_session_set_sun(s, &sun, e); });
    };
    set();
    pair.draw(PILEUS_FORMAT_RGBA32F);
    sun.present = 1;
    sun.azimuth_deg = -30;
    for (const double elevation : {-5.0, 0.0, 90.0, 25.0}) {
        sun.elevation_deg = elevation;
        for (std::size_t c = 0; c < 3; ++c)
            sun.irradiance[c] = elevation > 80 ? 1.0f - 0.25f * float(c) : 1.0f;
        set();
        pair.draw(PILEUS_FORMAT_RGBA8_SRGB);
    }
}

void change_surroundings(Pair& pair) {
    auto sky = cleared<pileus_environment>();
    auto ground = cleared<pileus_ground>();
    const auto set_sky = [&] {
        pair.both([&](pileus_session* s, pileus_error* e) {
            return pileus_session_set_environment(s, &sky, e);
        });
    };
    const auto set_ground = [&] {
        pair.both([&](pileus_session* s, pileus_error* e) {
            return pileus_session_set_ground(s, &ground, e);
        });
    };
    set_ground();
    set_sky();
    pair.draw(PILEUS_FORMAT_RGBA16F);
    ground.present = 1, ground.albedo = 0.5, ground.altitude_m = -20;
    set_ground();
    pair.draw(PILEUS_FORMAT_RGBA32F);
    std::vector<float> texels(8 * 4 * 3, 0.5f);
    for (std::size_t i = 0; i < texels.size(); i += 7) texels[i] = 3;
    sky.present = 1;
    sky.map_size[0] = 8, sky.map_size[1] = 4;
    sky.map = texels.data();
    set_sky();
    pair.draw(PILEUS_FORMAT_RGBA32F);
    sky.map_size[0] = sky.map_size[1] = 0;
    sky.radiance[0] = 0.1f, sky.radiance[1] = 0.2f;
    set_sky();
    pair.draw(PILEUS_FORMAT_RGBA8_SRGB);
}

void change_more(Pair& pair) {
    pileus_lamp lights[3];
    for (pileus_lamp& light : lights) {
        light = cleared<pileus_lamp>();
        for (float& c : light.light) c = 2e5f;
        light.position_m[1] = -800, light.position_m[2] = 1300;
    }
    lights[0].radius_m = 90, lights[0].shadow_samples = 3;
    lights[1].type = PILEUS_LAMP_SPOT;
    lights[1].direction[1] = 1, lights[1].direction[2] = -0.25;
    lights[1].cone_deg = 50, lights[1].penumbra_deg = 10;
    lights[2].type = PILEUS_LAMP_DIRECTIONAL;
    for (std::size_t c = 0; c < 3; ++c) lights[2].light[c] = 0.3f * float(c);
    lights[2].elevation_deg = 70;
    pair.both([&](pileus_session* s, pileus_error* e) {
        return pileus_session_set_lamps(s, lights, 3, e);
    });
    pair.draw(PILEUS_FORMAT_RGBA32F);
    auto placement = cleared<pileus_placement>();
    placement.offset_m[0] = 300, placement.offset_m[2] = -64, placement.yaw_deg = 40;
    pair.both([&](pileus_session* s, pileus_error* e) {
        return pileus_session_set_placement(s, &placement, e);
    });
    pair.both([](pileus_session* s, pileus_error* e) { return pileus_session_set_frame(s, 3, e); });
    pair.draw(PILEUS_FORMAT_RGBA8_SRGB);
    // Something solid over half of the picture, with faults of a host among its depths.
    std::vector<float> metres(pair.pixels(), 3800.0f);
    for (std::size_t i = 0; i < metres.size() / 2; ++i) metres[i] = __builtin_inff();
    metres[0] = __builtin_nanf(""), metres[1] = -1;
    auto depth = cleared<pileus_depth_image>();
    depth.values = metres.data();
    pair.both(
        [&](pileus_session* s, pileus_error* e) { return pileus_session_set_depth(s, &depth, e); });
    pair.draw(PILEUS_FORMAT_RGBA16F);
    depth.values = nullptr;
    pair.both(
        [&](pileus_session* s, pileus_error* e) { return pileus_session_set_depth(s, &depth, e); });
    for (const double share : {0.5, 1.0}) {
        auto work = cleared<pileus_work>();
        pair.both([&](pileus_session* s, pileus_error* e) {
            const pileus_code got = pileus_session_work(s, &work, e);
            if (got != PILEUS_OK) return got;
            work.scale = share < 1 ? 2 : 0;
            if (work.steps > 1) work.steps = std::uint32_t(double(work.steps) * share);
            return pileus_session_set_work(s, &work, e);
        });
        pair.draw(PILEUS_FORMAT_RGBA32F);
    }
}

/// Every seventh row, or all in the long form, looks around; of the other moves each makes a third.
void move_about(const std::vector<Row>& rows) {
    const std::size_t stride = pileus::row_stride(7);
    for (std::size_t number = 0; number < rows.size(); number += stride) {
        const Row& row = rows[number];
        const std::size_t kind = number / stride % 3;
        std::string name;
        for (const std::string& override : row.overrides) name += override + " ";
        CAPTURE(name);
        CAPTURE(row.text.substr(0, 120));
        const bool whole = row.text.find("[camera]") != std::string::npos;
        Overrides all = {"camera.resolution=[9,6]",   "collectors.photons=200",
                         "collectors.generations=2",  "photon_grid.photons=200",
                         "photon_grid.generations=2", "path.samples_per_pixel=1",
                         "collectors.samples=100",    "raymarch.steps=10",
                         "optical_depth.steps=8",     "output.layers=[\"radiance\"]"};
        if (!whole) all.push_back("medium.0.resolution=[9,9,7]");
        all.insert(all.end(), row.overrides.begin(), row.overrides.end());
        std::string text = whole ? row.text : render_test::kSmallCumulus + row.text;
        const std::string fov = "fov_deg = 40\n";
        if (!whole && name.find("camera.projection") != std::string::npos)
            text.erase(text.find(fov), fov.size());
        pileus::Scene scene;
        const pileus::Status read = pileus::read_scene_text(text, "scene", "", all, scene);
        CHECK_MESSAGE(bool(read), read.message);
        if (!read) continue;
        Pair pair(text, all);
        pair.size(std::uint32_t(scene.camera.resolution[0]),
                  std::uint32_t(scene.camera.resolution[1]), scene.camera.flux);
        CHECK(pair.draw(PILEUS_FORMAT_RGBA32F) != 0);
        look_around(camera_of(scene), pair);
        // Each sun in the air, and each light of a sky in place, is made anew: tests of theirs move
        // it.
        if (row.text.find("[atmosphere]") != std::string::npos) continue;
        if (row.text.find("procedural:sky") != std::string::npos) continue;
        if (kind == 0) change_sun(pair);
        if (kind == 1) change_surroundings(pair);
        if (kind == 2) change_more(pair);
    }
}

}  // namespace

TEST_CASE("settings: collectors, moved about, on one lane and on many") {
    move_about(collector_rows());
}

TEST_CASE("settings: the photon grid, moved about, on one lane and on many") {
    move_about(grid_rows());
}

TEST_CASE("settings: marched pictures, moved about, on one lane and on many") {
    move_about(march_rows());
}

TEST_CASE("settings: paths and particles, moved about, on one lane and on many") {
    move_about(other_rows());
}
