// SPDX-License-Identifier: Apache-2.0
// A session by the C interface that prints what fails, and digests of what it draws.
// in: a scene, calls of setters -> out: lines; the session's report at the end of r.json
// tests/guard/sessions.cpp
#pragma once
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "include/pileus/pileus.h"

namespace guard {

template <class T>
T cleared() {
    T made;
    PILEUS_INIT(made);
    return made;
}

constexpr std::uint32_t kWidth = 24, kHeight = 14;
constexpr double kFar = std::numeric_limits<double>::infinity();

inline unsigned long long wide(std::uint64_t value) { return value; }

template <class T>
unsigned long long digest(const std::vector<T>& values) {
    unsigned long long sum = 14695981039346656037ull;
    const unsigned char* bytes = reinterpret_cast<const unsigned char*>(values.data());
    for (std::size_t i = 0; i < values.size() * sizeof(T); ++i)
        sum = (sum ^ bytes[i]) * 1099511628211ull;
    return sum;
}

/// A session, and what is said of it.
struct Guarded {
    pileus_scene* scene = nullptr;
    pileus_world* world = nullptr;
    pileus_session* session = nullptr;
    pileus_clouds* clouds = nullptr;
    pileus_error error = cleared<pileus_error>();

    Guarded(const char* path, const std::vector<const char*>& overrides) {
        auto host = cleared<pileus_host>();
        host.threads = 2;
        host.log = [](void*, const char* line) { std::printf("log: %s\n", line); };
        const bool open =
            said("read", pileus_scene_read(path, overrides.data(), std::uint32_t(overrides.size()),
                                           &scene, &error)) &&
            said("plan", plan(&host)) &&
            said("world", pileus_world_create(scene, &host, nullptr, 0, &world, &error)) &&
            said("open", pileus_session_create(world, scene, &host, &session, &error));
        if (!open) std::exit(0);
    }
    Guarded(const Guarded&) = delete;
    Guarded& operator=(const Guarded&) = delete;
    ~Guarded() {
        pileus_clouds_free(clouds);
        pileus_session_free(session);
        pileus_world_free(world);
        pileus_scene_free(scene);
    }

    bool said(const char* what, pileus_code code) const {
        if (code != PILEUS_OK) std::printf("%s: %d: %s\n", what, int(code), error.message);
        return code == PILEUS_OK;
    }
    pileus_code plan(const pileus_host* host) {
        auto plan = cleared<pileus_plan>();
        const pileus_code code = pileus_plan_scene(scene, host, &plan, &error);
        std::printf("plan: %u %u %u cells, %llu bytes, %llu of the world, %g %g %g to %g %g %g\n",
                    plan.cells[0], plan.cells[1], plan.cells[2], wide(plan.peak_bytes),
                    wide(plan.world_bytes), plan.low_m[0], plan.low_m[1], plan.low_m[2],
                    plan.high_m[0], plan.high_m[1], plan.high_m[2]);
        return code;
    }

    void camera(double x, double y, double z, double fov_deg = 40, double height_m = 0) {
        auto c = cleared<pileus_camera>();
        c.width = kWidth, c.height = kHeight;
        c.position_m[0] = x, c.position_m[1] = y, c.position_m[2] = z;
        c.target_m[2] = 1024;
        c.fov_deg = fov_deg, c.height_m = height_m;
        said("set_camera", pileus_session_set_camera(session, &c, &error));
    }
    void matrices(double shift, pileus_clip clip) {
        const double view[16] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, -16, -1024, -4000, 1};
        const double projection[16] = {1.6, 0, 0, 0, 0, 2.7, 0, 0, shift, 0.1, -1, -1, 0, 0, -1, 0};
        said("set_matrices",
             pileus_session_set_matrices(session, view, projection, clip, kWidth, kHeight, &error));
    }
    void sun(double azimuth_deg, double elevation_deg, float irradiance = 1, int present = 1) {
        auto s = cleared<pileus_sun>();
        s.present = present;
        s.azimuth_deg = azimuth_deg, s.elevation_deg = elevation_deg;
        for (float& c : s.irradiance) c = irradiance;
        said("set_sun", pileus_session_set_sun(session, &s, &error));
    }
    void sky(float radiance, const std::vector<float>* map = nullptr, bool keep = false) {
        auto s = cleared<pileus_environment>();
        s.present = radiance >= 0;
        for (float& c : s.radiance) c = radiance;
        if (map != nullptr || keep) s.map_size[0] = 16, s.map_size[1] = 8;
        if (map != nullptr) s.map = map->data();
        s.map_scale = 1.25, s.map_rotation_deg = 30;
        said("set_sky", pileus_session_set_environment(session, &s, &error));
    }
    void ground(int present, double altitude_m, double albedo) {
        auto g = cleared<pileus_ground>();
        g.present = present;
        g.altitude_m = altitude_m, g.albedo = albedo;
        said("set_ground", pileus_session_set_ground(session, &g, &error));
    }
    void lights(std::uint32_t count) {
        pileus_lamp lamps[3];
        for (std::uint32_t i = 0; i < 3; ++i) {
            PILEUS_INIT(lamps[i]);
            lamps[i].type = i;
            lamps[i].position_m[1] = -900, lamps[i].position_m[2] = 900;
            lamps[i].direction[1] = 1;
            lamps[i].cone_deg = 50, lamps[i].penumbra_deg = 5, lamps[i].radius_m = 2;
            lamps[i].azimuth_deg = 30, lamps[i].elevation_deg = 40;
            for (float& c : lamps[i].light) c = i == 2 ? 0.3f : 1e5f;
        }
        said("set_lights", pileus_session_set_lamps(session, lamps, count, &error));
    }
    void depth(pileus_depth kind, double value) {
        std::vector<float> values(std::size_t(kWidth) * kHeight, float(value));
        for (std::size_t i = 0; i < values.size() / 2; ++i)
            values[i] = float(kind == PILEUS_DEPTH_BUFFER ? 1 : kFar);
        auto d = cleared<pileus_depth_image>();
        d.kind = kind;
        d.values = value > 0 ? values.data() : nullptr;
        said("set_depth", pileus_session_set_depth(session, &d, &error));
    }
    void placement(double east_m, double up_m, double yaw_deg) {
        auto p = cleared<pileus_placement>();
        p.offset_m[0] = east_m, p.offset_m[2] = up_m;
        p.yaw_deg = yaw_deg;
        said("set_placement", pileus_session_set_placement(session, &p, &error));
    }
    pileus_work work() {
        auto w = cleared<pileus_work>();
        said("work", pileus_session_work(session, &w, &error));
        return w;
    }
    void set_work(const pileus_work& w) {
        said("set_work", pileus_session_set_work(session, &w, &error));
        print(work(), "work now");
    }
    static void print(const pileus_work& w, const char* what) {
        std::printf("%s: scale %u temporal %u steps %u light_refresh %u photons %llu\n", what,
                    w.scale, w.temporal, w.steps, w.light_refresh, wide(w.photons));
    }
    void frame(int number) { said("set_frame", pileus_session_set_frame(session, number, &error)); }

    /// So many bytes a pixel by `fill`, none by 0: a hash has all layers made, none lets rows come
    /// late.
    void draw(const char* what, pileus_format format, pileus_blend blend, bool hashed) {
        const std::size_t bytes = format == PILEUS_FORMAT_RGBA8_SRGB ? 4
                                  : format == PILEUS_FORMAT_RGBA16F  ? 8
                                                                     : 16;
        std::vector<unsigned char> colour(bytes * kWidth * kHeight, 7);
        std::vector<float> metres(std::size_t(kWidth) * kHeight, 7.0f);
        std::uint64_t hash = 0;
        auto f = cleared<pileus_frame>();
        f.colour = colour.data();
        f.format = format, f.blend = blend;
        f.exposure_stops = 0.5f;
        f.depth = hashed ? metres.data() : nullptr;
        f.hash = hashed ? &hash : nullptr;
        const pileus_code code = clouds != nullptr ? pileus_clouds_render(clouds, &f, &error)
                                                   : pileus_session_render(session, &f, &error);
        if (said(what, code))
            std::printf("%s: %016llx %016llx %016llx\n", what, wide(hash), digest(colour),
                        digest(metres));
    }
    /// A whole light, the picture three times.
    void picture(const char* what) {
        auto light = cleared<pileus_progress>();
        std::uint32_t done = 0;
        said("light", pileus_session_progress(session, &light, &error));
        said("step", pileus_session_step(session, light.whole, &done, &error));
        said("light", pileus_session_progress(session, &light, &error));
        std::printf("%s: %u of %u %s, %llu held, %llu photons\n", what, done, light.whole,
                    light.unit, wide(light.units), wide(light.unit_photons));
        draw(what, PILEUS_FORMAT_RGBA32F, PILEUS_BLEND_REPLACE, true);
        draw(what, PILEUS_FORMAT_RGBA8_SRGB, PILEUS_BLEND_REPLACE, false);
        draw(what, PILEUS_FORMAT_RGBA16F, PILEUS_BLEND_MEDIA, false);
    }
    void end() {
        auto s = cleared<pileus_stats>();
        said("stats", pileus_session_stats(session, &s, &error));
        std::printf("stats: prepared %u, %llu pictures, %llu units, %llu shared, %llu own\n",
                    s.prepared, wide(s.pictures), wide(s.units), wide(s.shared_bytes),
                    wide(s.own_bytes));
        std::size_t needed = 0;
        said("report", pileus_session_report(session, nullptr, 0, &needed, &error));
        std::vector<char> text(needed + 1);
        if (!said("report", pileus_session_report(session, text.data(), needed, &needed, &error)))
            return;
        if (std::FILE* file = std::fopen("r.json", "a")) {
            std::fputs(text.data(), file);
            std::fclose(file);
        }
    }
};

}  // namespace guard
