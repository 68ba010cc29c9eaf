// SPDX-License-Identifier: Apache-2.0
// The C++17 interface of pileus: owners and GLM types over the functions of pileus.h.
//
// Headers alone, so that it suits any compiler and any build of the library. Nothing throws, and
// neither exceptions nor RTTI are needed; what a host lends must not throw either. What may fail
// returns a Status or a Result, which holds pileus.h's code and message.
//
// - Lengths are metres, angles degrees, radiances linear R G B. x points east, y north, z up; an
//   azimuth counts from north (+y) towards east (+x).
// - Owners move and are not copied; an empty one answers every call with kBadInput. One thread uses
//   a session at a time; scenes and worlds are read only and may be shared.
// - The namespace is pileus::embed, as the library keeps its own Scene, World and Session in pileus
//   and its kernels in pileus::host: one program, such as a test, may include both.
//
// docs/embedding.md shows how to use all of this; tests/embed/examples/frame_loop.cpp does.
#ifndef PILEUS_HPP
#define PILEUS_HPP

#include <pileus/pileus.h>

#include <glm/mat4x4.hpp>
#include <memory>
#include <pileus/pileus_host.hpp>
#include <pileus/pileus_types.hpp>
#include <string>
#include <vector>

namespace pileus::embed {

/// "major.minor.patch" of the library that is linked, which may differ from this header's.
inline const char* version() { return pileus_version(); }

/// A checked text (docs/scene.md). Its camera, lights and method are where a session begins.
class Scene {
public:
    Scene() = default;

    /// From a file. `overrides`: "key=value" as of the program's --set. Errors: kBadInput, a line
    /// for each fault; kIo.
    static Result<Scene> read(const std::string& path,
                              const std::vector<std::string>& overrides = {}) {
        return made(overrides, [&](const char* const* texts, std::uint32_t count,
                                   pileus_scene** scene, pileus_error* error) {
            return pileus_scene_read(path.c_str(), texts, count, scene, error);
        });
    }

    /// From text; relative paths in it begin at `directory`, or at the current one.
    static Result<Scene> parse(const std::string& text, const std::string& directory = {},
                               const std::vector<std::string>& overrides = {}) {
        return made(overrides, [&](const char* const* texts, std::uint32_t count,
                                   pileus_scene** scene, pileus_error* error) {
            return pileus_scene_parse(text.c_str(), directory.empty() ? nullptr : directory.c_str(),
                                      texts, count, scene, error);
        });
    }

    /// From sizes of files alone: reads no values. Errors: kBadInput; kLimit where a limit forbids
    /// it.
    Result<Plan> plan(const Host& host = {}) const {
        const detail::Lent lent(host);
        auto c = detail::cleared<pileus_plan>();
        Status status = detail::status_of(
            [&](pileus_error* error) { return pileus_plan_scene(get(), &lent.given, &c, error); });
        if (!status) return status;
        Plan plan;
        plan.cells = {c.cells[0], c.cells[1], c.cells[2]};
        plan.peak_bytes = c.peak_bytes;
        plan.world_bytes = c.world_bytes;
        plan.low_m = {c.low_m[0], c.low_m[1], c.low_m[2]};
        plan.high_m = {c.high_m[0], c.high_m[1], c.high_m[2]};
        return plan;
    }

    explicit operator bool() const { return bool(handle_); }
    pileus_scene* get() const { return handle_.get(); }  ///< for pileus.h; stays owned

private:
    template <class Make>
    static Result<Scene> made(const std::vector<std::string>& overrides, Make make) {
        std::vector<const char*> texts;
        for (const std::string& text : overrides) texts.push_back(text.c_str());
        pileus_scene* handle = nullptr;
        Status status = detail::status_of([&](pileus_error* error) {
            return make(texts.data(), detail::count_of(texts.size()), &handle, error);
        });
        if (!status) return status;
        Scene scene;
        scene.handle_.reset(handle);
        return scene;
    }

    std::unique_ptr<pileus_scene, detail::FreeScene> handle_;
};

/// What of a scene depends on neither camera, light nor method: made once, then read only. Sessions
/// keep alive what they need of it.
class World {
public:
    World() = default;

    /// Loads or makes media and solids; the scene may go afterwards. Errors: kBadInput, kLimit,
    /// kIo.
    static Result<World> create(const Scene& scene, const Host& host = {},
                                const std::vector<Density>& densities = {}) {
        auto lent = std::make_shared<const detail::Lent>(host);
        std::vector<pileus_density> given;
        std::vector<pileus_particles> particles;
        particles.reserve(densities.size());
        for (const Density& density : densities) {
            given.push_back(detail::cleared<pileus_density>());
            given.back().medium = density.medium;
            detail::store(density.size, given.back().size);
            given.back().values = density.values;
            if (const Particles* p = density.particles) {
                particles.push_back(detail::cleared<pileus_particles>());
                pileus_particles& own = particles.back();
                own.count = p->count;
                own.position = p->position, own.position_stride = p->position_stride;
                own.radius = p->radius, own.radius_stride = p->radius_stride;
                own.density = p->density, own.density_stride = p->density_stride;
                own.id = p->id, own.id_stride = p->id_stride;
                own.velocity = p->velocity, own.velocity_stride = p->velocity_stride;
                own.colour = p->colour, own.colour_stride = p->colour_stride;
                own.emission = p->emission, own.emission_stride = p->emission_stride;
                given.back().particles = &own;
            }
        }
        pileus_world* handle = nullptr;
        Status status = detail::status_of([&](pileus_error* error) {
            return pileus_world_create(scene.get(), &lent->given, given.data(),
                                       detail::count_of(given.size()), &handle, error);
        });
        if (!status) return status;
        World world;
        world.handle_ = {handle, detail::FreeWorld{std::move(lent)}};
        return world;
    }

    explicit operator bool() const { return bool(handle_); }
    pileus_world* get() const { return handle_.get(); }  ///< for pileus.h; stays owned

private:
    friend class Session;
    std::unique_ptr<pileus_world, detail::FreeWorld> handle_;
};

namespace detail {

inline pileus_frame frame_of(const Frame& frame) {
    auto c = cleared<pileus_frame>();
    c.colour = frame.colour;
    c.colour_stride = frame.colour_stride;
    c.format = static_cast<std::uint32_t>(frame.format);
    c.blend = static_cast<std::uint32_t>(frame.blend);
    c.bottom_up = frame.bottom_up ? 1 : 0;
    c.exposure_stops = frame.exposure_stops;
    c.depth = frame.depth;
    c.depth_stride = frame.depth_stride;
    c.depth_kind = static_cast<std::uint32_t>(frame.depth_kind);
    c.hash = frame.hash;
    return c;
}

}  // namespace detail

/// One camera, one light and one method over a world. What is refused changes nothing.
class Session {
public:
    Session() = default;

    /// Prepares the scene's method over a world made from the same scene, or one with the same
    /// media. Errors: kBadInput, kLimit, kIo.
    static Result<Session> create(const World& world, const Scene& scene, const Host& host = {}) {
        auto lent = std::make_shared<const detail::Lent>(host);
        pileus_session* handle = nullptr;
        Status status = detail::status_of([&](pileus_error* error) {
            return pileus_session_create(world.get(), scene.get(), &lent->given, &handle, error);
        });
        if (!status) return status;
        Session session;
        session.handle_ = {handle, {lent, {lent, world.handle_.get_deleter().host}}};
        return session;
    }

    Status set_camera(const Camera& camera) {
        auto c = detail::cleared<pileus_camera>();
        c.width = camera.size.x;
        c.height = camera.size.y;
        detail::store(camera.position_m, c.position_m);
        detail::store(camera.target_m, c.target_m);
        detail::store(camera.up, c.up);
        c.fov_deg = camera.fov_deg;
        c.height_m = camera.height_m;
        c.near_m = camera.near_m;
        c.far_m = camera.far_m;
        return call(pileus_session_set_camera, &c);
    }

    /// By matrices of any precision, such as those of glm::lookAt and glm::perspective: world to
    /// view (turns and shifts alone; the view looks along -z, y up), and view to clip (perspective
    /// or orthographic, may be off-centre). `size`: pixels, 0: as before. Errors: kBadInput.
    template <class T, glm::qualifier Q>
    Status set_camera(const glm::mat<4, 4, T, Q>& view, const glm::mat<4, 4, T, Q>& projection,
                      Clip clip = Clip::kMinusOne, glm::uvec2 size = glm::uvec2(0)) {
        double v[16], p[16];
        detail::store(view, v);
        detail::store(projection, p);
        return detail::status_of([&](pileus_error* error) {
            return pileus_session_set_matrices(get(), v, p, static_cast<pileus_clip>(clip), size.x,
                                               size.y, error);
        });
    }

    Status set_sun(const Sun& sun) {
        auto c = detail::cleared<pileus_sun>();
        c.present = sun.present ? 1 : 0;
        c.azimuth_deg = sun.azimuth_deg;
        c.elevation_deg = sun.elevation_deg;
        detail::store(sun.irradiance, c.irradiance);
        return call(pileus_session_set_sun, &c);
    }

    Status set_sky(const Sky& sky) {
        auto c = detail::cleared<pileus_environment>();
        c.present = sky.present ? 1 : 0;
        detail::store(sky.radiance, c.radiance);
        c.map_size[0] = sky.map_size.x;
        c.map_size[1] = sky.map_size.y;
        c.map = sky.map;
        c.map_scale = sky.map_scale;
        c.map_rotation_deg = sky.map_rotation_deg;
        return call(pileus_session_set_environment, &c);
    }

    Status set_ground(const Ground& ground) {
        auto c = detail::cleared<pileus_ground>();
        c.present = ground.present ? 1 : 0;
        c.altitude_m = ground.altitude_m;
        c.albedo = ground.albedo;
        return call(pileus_session_set_ground, &c);
    }

    /// In place of all lights that the session had, the scene's included. kBadInput: more than 64,
    /// or what the scene's method has no lights for.
    Status set_lights(const std::vector<SceneLight>& lights) {
        std::vector<pileus_lamp> given;
        for (const SceneLight& light : lights) {
            given.push_back(detail::cleared<pileus_lamp>());
            pileus_lamp& c = given.back();
            c.type = static_cast<std::uint32_t>(light.type);
            detail::store(light.position_m, c.position_m);
            detail::store(light.direction, c.direction);
            c.cone_deg = light.cone_deg, c.penumbra_deg = light.penumbra_deg;
            c.radius_m = light.radius_m, c.shadow_samples = light.shadow_samples;
            c.azimuth_deg = light.azimuth_deg, c.elevation_deg = light.elevation_deg;
            detail::store(light.light, c.light);
        }
        return detail::status_of([&](pileus_error* error) {
            return pileus_session_set_lamps(get(), given.data(), detail::count_of(given.size()),
                                            error);
        });
    }

    /// Moves all media: turned about the z axis through the world's origin (counter-clockwise seen
    /// from above), then shifted. kBadInput in a world with solids.
    Status set_placement(const glm::dvec3& offset_m, double yaw_deg = 0) {
        auto c = detail::cleared<pileus_placement>();
        detail::store(offset_m, c.offset_m);
        c.yaw_deg = yaw_deg;
        return call(pileus_session_set_placement, &c);
    }

    /// Copies the depths for the camera as it is set now; they stay until they are set again.
    Status set_depth(const DepthImage& depth) {
        auto c = detail::cleared<pileus_depth_image>();
        c.kind = static_cast<std::uint32_t>(depth.kind);
        c.values = depth.values;
        c.stride = depth.stride;
        c.bottom_up = depth.bottom_up ? 1 : 0;
        return call(pileus_session_set_depth, &c);
    }

    /// Number of the picture, from 0 on, which jitter and the noise of paths go by.
    Status set_frame(std::int32_t number) {
        return detail::status_of(
            [&](pileus_error* error) { return pileus_session_set_frame(get(), number, error); });
    }

    /// For the steps and pictures from now on. kBadInput: what the session's method has not.
    Status set_work(const Work& work) {
        auto c = detail::cleared<pileus_work>();
        c.scale = work.scale, c.temporal = work.temporal, c.steps = work.steps;
        c.light_refresh = work.light_refresh, c.photons = work.photons;
        return call(pileus_session_set_work, &c);
    }

    /// The next frame's work by how long the last one took, 0 before the first; `governor` is
    /// cleared by PILEUS_INIT and has its target_s set. kBadInput: a time out of range.
    Result<Work> govern(pileus_governor& governor, double frame_s) const {
        auto c = detail::cleared<pileus_work>();
        Status status = detail::status_of([&](pileus_error* error) {
            return pileus_session_govern(get(), &governor, frame_s, &c, error);
        });
        if (!status) return status;
        return Work{c.scale, c.temporal, c.steps, c.light_refresh, c.photons};
    }

    Result<Light> light() const {
        auto c = detail::cleared<pileus_progress>();
        Status status = call(pileus_session_progress, &c);
        if (!status) return status;
        return Light{c.whole, c.unit_photons, c.units, c.unit};
    }

    /// Traces so many units of light for what is set now; never counts time. `done`, where not
    /// null: how many, fewer where Host::stop ended it, which is no fault.
    Status step(std::uint32_t units, std::uint32_t* done = nullptr) {
        return detail::status_of(
            [&](pileus_error* error) { return pileus_session_step(get(), units, done, error); });
    }

    /// Draws what the session holds now. Light is not traced: see step.
    Status render(const Frame& frame) {
        const pileus_frame c = detail::frame_of(frame);
        return call(pileus_session_render, &c);
    }

    /// Draws the world and the light of `next` from the next picture on, and lets the last one fade
    /// over `frames`; `next` has the state that this session had, to be used again or freed.
    /// Errors: kBadInput, kLimit; both are as they were.
    Status hand_over(Session& next, std::uint32_t frames) {
        Status status = detail::status_of([&](pileus_error* error) {
            return pileus_session_hand_over(get(), next.get(), frames, error);
        });
        if (!status) return status;
        detail::FreeSession &own = handle_.get_deleter(), &other = next.handle_.get_deleter();
        own.lenders.swap(other.lenders);
        own.lent_by(own.host);
        other.lent_by(other.host);
        return status;
    }

    Result<Stats> stats() const {
        auto c = detail::cleared<pileus_stats>();
        Status status = call(pileus_session_stats, &c);
        if (!status) return status;
        return Stats{c.prepared,  c.pictures, c.units,   c.shared_bytes,
                     c.own_bytes, c.render_s, c.stages_s};
    }

    /// As the program writes it (docs/report.md), JSON.
    Result<std::string> report() const {
        std::size_t needed = 0;
        Status status = report_into(nullptr, 0, needed);
        if (!status) return status;
        std::string text(needed, '\0');
        status = report_into(&text[0], needed, needed);
        if (!status) return status;
        text.pop_back();
        return text;
    }

    explicit operator bool() const { return bool(handle_); }
    pileus_session* get() const { return handle_.get(); }  ///< for pileus.h; stays owned

private:
    template <class Function, class Given>
    Status call(Function function, Given* given) const {
        return detail::status_of(
            [&](pileus_error* error) { return function(get(), given, error); });
    }
    Status report_into(char* text, std::size_t size, std::size_t& needed) const {
        return detail::status_of([&](pileus_error* error) {
            return pileus_session_report(get(), text, size, &needed, error);
        });
    }

    std::unique_ptr<pileus_session, detail::FreeSession> handle_;
};

/// `position_m` turned about the vertical axis through `target_m`, counter-clockwise seen from
/// above, by the bits of the program's animation.camera_orbit_deg.
inline glm::dvec3 orbit(const glm::dvec3& position_m, const glm::dvec3& target_m, double degrees) {
    double from[3], about[3], to[3];
    detail::store(position_m, from);
    detail::store(target_m, about);
    pileus_orbit(from, about, degrees, to);
    return {to[0], to[1], to[2]};
}

}  // namespace pileus::embed

#endif  // PILEUS_HPP
