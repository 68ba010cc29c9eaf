// SPDX-License-Identifier: Apache-2.0
// pileus.h: scenes, plans and worlds.
#include "src/api/c_types.h"
#include "src/scene/media/host_media.h"
#include "src/scene/number_keys.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/volume_format.h"

namespace pileus::api {
namespace {

Status take_overrides(const char* const* overrides, std::uint32_t count,
                      std::vector<std::string>& out) {
    if (count > 0 && overrides == nullptr)
        return Status::bad_input("overrides: null, allowed: as many texts as override_count says");
    for (std::uint32_t i = 0; i < count; ++i) {
        if (overrides[i] == nullptr)
            return Status::bad_input("overrides[" + std::to_string(i) + "]: null, allowed: a text");
        out.emplace_back(overrides[i]);
    }
    return Status::ok();
}

/// `read` fills the scene.
template <class Read>
pileus_code make_scene(const char* const* overrides, std::uint32_t count, pileus_scene** scene,
                       pileus_error* error, Read read) {
    return call(nullptr, error, [&]() -> Status {
        if (scene == nullptr) return Status::bad_input("scene: null, allowed: where to put it");
        auto made = std::make_unique<pileus_scene>();
        std::vector<std::string> texts;
        PILEUS_TRY(take_overrides(overrides, count, texts));
        PILEUS_TRY(read(texts, made->scene));
        *scene = made.release();
        return Status::ok();
    });
}

/// `host` must outlive the scene.
Status take_particles(const pileus_density& density, const std::string& where,
                      const MediumSettings& medium, MediumValues& taken, HostParticles& host) {
    pileus_particles given;
    if (!take(density.particles, given)) return no_struct("particles");
    if (!is_particle_format(medium.source.format))
        return Status::bad_input(where +
                                 "the scene's medium is no file of particles, allowed: "
                                 "density = \"host.ply\"");
    if (given.count > 0 && given.position == nullptr)
        return Status::bad_input(where + "position: null, allowed: x, y, z of each particle");
    host.count = given.count;
    host.position = given.position, host.position_stride = given.position_stride;
    host.radius = given.radius, host.radius_stride = given.radius_stride;
    host.density = given.density, host.density_stride = given.density_stride;
    host.id = given.id, host.id_stride = given.id_stride;
    host.velocity = given.velocity, host.velocity_stride = given.velocity_stride;
    host.colour = given.colour, host.colour_stride = given.colour_stride;
    host.emission = given.emission, host.emission_stride = given.emission_stride;
    const auto stride = [&](const char* name, bool used, std::size_t bytes, std::size_t least) {
        if (!used || given.count < 2) return Status::ok();
        if (bytes < least)
            return Status::bad_input(where + name + "_stride: " + std::to_string(bytes) +
                                     ", allowed: at least " + std::to_string(least));
        if (given.count > std::uint64_t(PTRDIFF_MAX) / bytes)
            return Status::bad_input(where + "count: " + std::to_string(given.count) + " of " +
                                     name + "_stride " + std::to_string(bytes) +
                                     ", allowed: up to " +
                                     std::to_string(std::uint64_t(PTRDIFF_MAX) / bytes));
        return Status::ok();
    };
    PILEUS_TRY(stride("position", true, host.position_stride, 3 * sizeof(float)));
    PILEUS_TRY(stride("radius", host.radius != nullptr, host.radius_stride, sizeof(float)));
    PILEUS_TRY(stride("density", host.density != nullptr, host.density_stride, sizeof(float)));
    PILEUS_TRY(stride("id", host.id != nullptr, host.id_stride, sizeof(std::uint64_t)));
    PILEUS_TRY(
        stride("velocity", host.velocity != nullptr, host.velocity_stride, 3 * sizeof(float)));
    PILEUS_TRY(stride("colour", host.colour != nullptr, host.colour_stride, 3 * sizeof(float)));
    PILEUS_TRY(
        stride("emission", host.emission != nullptr, host.emission_stride, 3 * sizeof(float)));
    taken.particles = &host;
    return Status::ok();
}

Status take_density(const pileus_density& given, std::uint32_t at, const Scene& scene,
                    HostParticles& host, HostMedia& media) {
    const std::string where = "densities[" + std::to_string(at) + "]: ";
    if (given.medium >= scene.media.size())
        return Status::bad_input(where + "no medium " + std::to_string(given.medium) +
                                 ", allowed: below " + std::to_string(scene.media.size()));
    const MediumSettings& medium = scene.media[given.medium];
    MediumValues& taken = media.media[given.medium];
    if (taken.cells != nullptr || taken.particles != nullptr)
        return Status::bad_input(where + "medium " + std::to_string(given.medium) +
                                 " a second time, allowed: once each");
    if (given.particles != nullptr) return take_particles(given, where, medium, taken, host);
    std::uint64_t cells = 1;
    for (const std::uint32_t n : given.size) {
        PILEUS_TRY(check_number(where.c_str(), "size", n, range_of(&MediumFile::raw_size),
                                " along each axis"));
        cells *= n;
    }
    if (given.values == nullptr) return Status::bad_input(where + "values: null, allowed: cells");
    if (medium.density.empty() || !medium.box.has_bounds)
        return Status::bad_input(where +
                                 "the scene's medium is a file or has no bounds_m, allowed: "
                                 "density = \"uniform:box\" and bounds_m");
    for (std::uint64_t i = 0; i < cells; ++i)
        if (!(given.values[i] >= 0 && given.values[i] <= 1e30f))
            return Status::bad_input(where + "cell " + std::to_string(i) + ": " +
                                     std::to_string(given.values[i]) +
                                     ", allowed: finite and not negative");
    taken.cells = given.values;
    for (std::size_t a = 0; a < 3; ++a) taken.size[a] = int(given.size[a]);
    return Status::ok();
}

}  // namespace

}  // namespace pileus::api

using namespace pileus;
using namespace pileus::api;

extern "C" {

pileus_code pileus_scene_read(const char* path, const char* const* overrides,
                              uint32_t override_count, pileus_scene** scene, pileus_error* error) {
    return make_scene(overrides, override_count, scene, error,
                      [&](const std::vector<std::string>& texts, Scene& out) {
                          if (path == nullptr)
                              return Status::bad_input("path: null, allowed: of a scene file");
                          return read_scene_file(path, texts, out);
                      });
}

pileus_code pileus_scene_parse(const char* text, const char* directory,
                               const char* const* overrides, uint32_t override_count,
                               pileus_scene** scene, pileus_error* error) {
    return make_scene(overrides, override_count, scene, error,
                      [&](const std::vector<std::string>& texts, Scene& out) {
                          if (text == nullptr)
                              return Status::bad_input("text: null, allowed: a scene");
                          return read_scene_text(text, "scene", directory ? directory : "", texts,
                                                 out);
                      });
}

void pileus_scene_free(pileus_scene* scene) { delete scene; }

pileus_code pileus_plan_scene(const pileus_scene* scene, const pileus_host* host, pileus_plan* plan,
                              pileus_error* error) {
    return call_with(host, error, [&](const auto&, const RenderOptions& options) -> Status {
        if (scene == nullptr) return no_handle("scene");
        Session session;
        PILEUS_TRY(session.open(scene->scene, options, false, nullptr));
        const Medium& medium = session.world().medium;
        pileus_plan out{};
        for (std::size_t a = 0; a < 3; ++a) {
            out.cells[a] = std::uint32_t(medium.grid.size[a]);
            out.low_m[a] = medium.low_m[a];
            out.high_m[a] = medium.low_m[a] + medium.extent_m[a];
        }
        out.peak_bytes = session.plan().memory.peak();
        for (const MemoryRow& row : session.plan().memory.rows())
            for (const char* name : {"density", "parts of the media", "phase functions",
                                     "triangles", "tree of solids", "noise"})
                if (std::string(row.item) == name) out.world_bytes += row.bytes;
        return give(out, plan, "plan");
    });
}

pileus_code pileus_world_create(const pileus_scene* scene, const pileus_host* host,
                                const pileus_density* densities, uint32_t density_count,
                                pileus_world** world, pileus_error* error) {
    return call_with(host, error, [&](const auto& parts, const RenderOptions& options) -> Status {
        if (scene == nullptr) return no_handle("scene");
        if (world == nullptr) return Status::bad_input("world: null, allowed: where to put it");
        if (density_count > 0 && densities == nullptr)
            return Status::bad_input("densities: null, allowed: as many as density_count says");
        const Scene& described = scene->scene;
        if (density_count > described.media.size())
            return Status::bad_input("density_count: " + std::to_string(density_count) +
                                     ", allowed: 0 to " + std::to_string(described.media.size()) +
                                     ", the scene's media");
        std::vector<HostParticles> hosts(density_count);
        HostMedia media;
        media.media.resize(described.media.size());
        for (std::uint32_t i = 0; i < density_count; ++i) {
            pileus_density given;
            if (!take_element(densities, i, given)) return no_element("densities", i);
            PILEUS_TRY(take_density(given, i, described, hosts[i], media));
        }
        const auto held = std::make_shared<HeldWorld>();
        held->host = parts;
        RenderOptions own = options;
        own.media = &media;
        PILEUS_TRY(make_world(described, own, held->world));
        auto made = std::make_unique<pileus_world>();
        made->host = parts;
        made->world = std::shared_ptr<const World>(held, held->world.get());
        *world = made.release();
        return Status::ok();
    });
}

void pileus_world_free(pileus_world* world) { delete world; }

}  // extern "C"
