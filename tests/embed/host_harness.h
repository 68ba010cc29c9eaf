// SPDX-License-Identifier: Apache-2.0
// Small worlds and sessions by the C interface alone, freed with their owners.
// in: TOML, overrides, a host -> out: hashes and pixels of pictures.
// docs/embedding.md
#pragma once
#include <doctest/doctest.h>

#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "include/pileus/pileus.h"
#include "tests/support/render_harness.h"

namespace host_test {

using Overrides = std::vector<std::string>;

struct Freed {
    void operator()(pileus_scene* p) const { pileus_scene_free(p); }
    void operator()(pileus_world* p) const { pileus_world_free(p); }
    void operator()(pileus_session* p) const { pileus_session_free(p); }
};
using SceneHandle = std::unique_ptr<pileus_scene, Freed>;
using WorldHandle = std::unique_ptr<pileus_world, Freed>;
using SessionHandle = std::unique_ptr<pileus_session, Freed>;

template <class T>
T cleared() {
    T made;
    PILEUS_INIT(made);
    return made;
}

/// What struct_size of a struct of so many bytes holds.
inline std::uint32_t marked(std::size_t bytes) {
    std::uint32_t least = 0;
    PILEUS_INIT(least);
    return (least & 0xffff0000u) | std::uint32_t(bytes);
}

/// A code and the line beside it.
struct Outcome {
    pileus_error error = cleared<pileus_error>();
    bool is(pileus_code code) const { return error.code == code; }
    std::string line() const { return error.message; }
};

inline SceneHandle scene_of(const std::string& text, const Overrides& overrides) {
    std::vector<const char*> texts;
    for (const std::string& o : overrides) texts.push_back(o.c_str());
    pileus_scene* scene = nullptr;
    Outcome out;
    const pileus_code code = pileus_scene_parse(text.c_str(), nullptr, texts.data(),
                                                std::uint32_t(texts.size()), &scene, &out.error);
    REQUIRE_MESSAGE(code == PILEUS_OK, out.line());
    return SceneHandle(scene);
}

inline pileus_camera camera_at(const double (&position)[3], const double (&target)[3],
                               double fov_deg, std::uint32_t width, std::uint32_t height) {
    auto camera = cleared<pileus_camera>();
    camera.width = width;
    camera.height = height;
    std::memcpy(camera.position_m, position, sizeof position);
    std::memcpy(camera.target_m, target, sizeof target);
    camera.fov_deg = fov_deg;
    return camera;
}

/// A scene, its world and a session of it.
struct Hosted {
    SceneHandle scene;
    WorldHandle world;
    SessionHandle session;
    pileus_code code = PILEUS_OK;
    Outcome out;

    Hosted(const std::string& text, const Overrides& overrides, const pileus_host* host = nullptr)
        : scene(scene_of(text, overrides)) {
        pileus_world* w = nullptr;
        code = pileus_world_create(scene.get(), host, nullptr, 0, &w, &out.error);
        world.reset(w);
        if (code == PILEUS_OK) open(host);
    }
    void open(const pileus_host* host) {
        pileus_session* s = nullptr;
        code = pileus_session_create(world.get(), scene.get(), host, &s, &out.error);
        session.reset(s);
    }
    void check(pileus_code got) {
        code = got;
        REQUIRE_MESSAGE(got == PILEUS_OK, out.line());
    }
    void aim(const double (&position)[3], const double (&target)[3], double fov_deg,
             std::uint32_t width, std::uint32_t height) {
        const pileus_camera camera = camera_at(position, target, fov_deg, width, height);
        check(pileus_session_set_camera(session.get(), &camera, &out.error));
    }
    void sun(double azimuth_deg, double elevation_deg, float irradiance = 1) {
        auto own = cleared<pileus_sun>();
        own.present = 1;
        own.azimuth_deg = azimuth_deg;
        own.elevation_deg = elevation_deg;
        for (float& c : own.irradiance) c = irradiance;
        check(pileus_session_set_sun(session.get(), &own, &out.error));
    }
    std::uint32_t step(std::uint32_t units) {
        std::uint32_t done = 0;
        check(pileus_session_step(session.get(), units, &done, &out.error));
        return done;
    }
    std::uint32_t whole() {
        auto light = cleared<pileus_progress>();
        check(pileus_session_progress(session.get(), &light, &out.error));
        return light.whole;
    }
    std::string hash() {
        auto frame = cleared<pileus_frame>();
        std::uint64_t hash = 0;
        frame.hash = &hash;
        check(pileus_session_render(session.get(), &frame, &out.error));
        char text[17];
        std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
        return text;
    }
    pileus_stats stats() {
        auto counted = cleared<pileus_stats>();
        check(pileus_session_stats(session.get(), &counted, &out.error));
        return counted;
    }
};

/// A scene's hash as the program's own way makes it, of each frame.
inline std::vector<std::string> program_hashes(const std::string& text, const Overrides& overrides,
                                               int frames = 1) {
    std::vector<std::string> hashes;
    pileus::RenderOptions options;
    options.last_frame = frames - 1;
    pileus::Scene scene;
    const pileus::Status read = pileus::read_scene_text(text, "scene", "", overrides, scene);
    REQUIRE_MESSAGE(bool(read), read.message);
    const pileus::Status status =
        pileus::render(scene, options, [&](int, pileus::Image&, pileus::Report& report) {
            hashes.push_back(report.hash);
            return pileus::Status::ok();
        });
    REQUIRE_MESSAGE(bool(status), status.message);
    return hashes;
}

}  // namespace host_test
