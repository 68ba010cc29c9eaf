// SPDX-License-Identifier: Apache-2.0
// See scene_clouds.h.
#include "src/clouds/scene_clouds.h"

#include "src/clouds/scatter.h"
#include "src/scene/read_scene.h"
#include "src/session/render.h"

namespace pileus {
namespace {

std::string key_of(const char* list, std::size_t index, const char* member) {
    return std::string("clouds.") + list + "." + std::to_string(index) + "." + member;
}

/// A kind or a layer: of a file, or of a text that a report made.
template <class Settings>
Status read_part(const Scene& scene, const char* list, std::size_t number, const Settings& settings,
                 Scene& part) {
    const bool made = !settings.text.empty();
    const std::string path = made ? "weather" : scene_path(scene.directory, settings.scene);
    Status status = made
                        ? read_scene_text(settings.text, path, scene.directory, settings.sets, part)
                        : read_scene_file(path, settings.sets, part);
    if (status && part.clouds.present())
        status = Status::bad_input(path +
                                   ": [clouds] of its own, allowed: a scene with "
                                   "[[medium]]");
    if (status && film_run(scene) > 0 && has_sequence(part))
        status = Status::bad_input(path +
                                   ": a sequence of files in a film of clouds, which would show "
                                   "the first, allowed: one file");
    return made ? status : at_key(scene, key_of(list, number, "scene"), status);
}

RenderOptions own_options(const Context& context, const RenderOptions& options) {
    RenderOptions own;
    own.threads = context.threads;
    own.kernels = context.kernels;
    own.limits = options.limits;
    return own;
}

Status add_layers(const Scene& scene, const RenderOptions& options, Session& sky, Clouds& clouds,
                  CloudCounts& told) {
    const Context& context = sky.context();
    const StageClock clock(context, "layers of the sky");
    const RenderOptions own = own_options(context, options);
    for (std::size_t i = 0; i < scene.clouds.layers.size(); ++i) {
        const CloudLayerSettings& settings = scene.clouds.layers[i];
        Scene layer;
        PILEUS_TRY(read_part(scene, "layer", i, settings, layer));
        const std::string key = key_of("layer", i, "scene");
        std::shared_ptr<const World> world;
        PILEUS_TRY(at_key(scene, key, make_world(layer, own, world)));
        PILEUS_TRY(at_key(scene, key, clouds.add_layer(layer, std::move(world))));
        const std::string name = settings.text.empty() ? settings.scene : "weather";
        told.layers.push_back({name, settings.scene, layer.method, 1});
    }
    return Status::ok();
}

Status add_kinds(const Scene& scene, const RenderOptions& options, Session& sky, Clouds& clouds,
                 CloudCounts& told) {
    const Context& context = sky.context();
    const std::size_t count = scene.clouds.kinds.size();
    std::vector<Scene> kinds(count);
    // What is wrong with a text shows before anything is prepared.
    for (std::size_t i = 0; i < count; ++i)
        PILEUS_TRY(read_part(scene, "kind", i, scene.clouds.kinds[i], kinds[i]));

    const StageClock clock(context, "kinds of clouds");
    const RenderOptions own = own_options(context, options);
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string key = key_of("kind", i, "scene");
        context.tell("kinds of clouds", double(i) / double(count));
        std::shared_ptr<const World> world;
        PILEUS_TRY(at_key(scene, key, make_world(kinds[i], own, world)));
        bytes += bytes_of_world(*world);
        PILEUS_TRY(check_limit(options.limits, LimitId::kMemory, bytes, scene.file));
        std::size_t number = 0;
        PILEUS_TRY(at_key(scene, key, clouds.add_kind(kinds[i], std::move(world), number)));
        const CloudKindSettings& settings = scene.clouds.kinds[i];
        told.kinds.push_back({settings.name, settings.scene, kinds[i].method, 0});
    }
    return Status::ok();
}

std::size_t number_of(const CloudsSettings& clouds, const std::string& name) {
    std::size_t number = 0;
    while (number + 1 < clouds.kinds.size() && clouds.kinds[number].name != name) ++number;
    return number;
}

/// Clouds that the file names, and then those by random numbers.
Status list_places(const Scene& scene, const Clouds& clouds, std::vector<CloudPlace>& places) {
    const CloudsSettings& settings = scene.clouds;
    for (std::size_t i = 0; i < settings.places.size(); ++i) {
        const CloudPlaceSettings& place = settings.places[i];
        places.push_back(
            {number_of(settings, place.kind), place.offset_m, place.yaw_deg, place.scale});
        PILEUS_TRY(at_key(scene, key_of("place", i, "offset_m"),
                          clouds.check_height("the cloud is ", scene.ground, places.back())));
    }
    std::vector<KindBox> boxes;
    for (std::size_t i = 0; i < settings.kinds.size(); ++i)
        boxes.push_back({clouds.kind(i).low_m, clouds.kind(i).high_m});
    for (std::size_t i = 0; i < settings.scatters.size(); ++i) {
        const CloudScatter& scatter = settings.scatters[i];
        std::vector<std::size_t> kinds;
        for (const std::string& name : scatter.kinds) kinds.push_back(number_of(settings, name));
        // Those of a report have places of their own.
        for (std::size_t k = 0; scatter.kinds.empty() && k < settings.kinds.size(); ++k)
            if (settings.kinds[k].text.empty()) kinds.push_back(k);
        const Double3& eye = scene.camera.position_m;
        const std::array<double, 2> center =
            scatter.has_center ? scatter.center_m : std::array<double, 2>{eye.x, eye.y};
        PILEUS_TRY(at_key(scene, key_of("scatter", i, "count"),
                          scatter_clouds(scatter, center, kinds, boxes, places)));
    }
    return Status::ok();
}

}  // namespace

Status open_sky(const Scene& scene, const RenderOptions& options, Session& sky) {
    Scene around = scene;
    around.clouds = CloudsSettings{};
    // Nothing in it is for the method, and this one has the least of its own.
    around.method = "raymarch";
    around.raymarch = RaymarchSettings{};
    around.filter = FilterSettings{};
    around.particles = ParticlesSettings{};
    return sky.open(around, options, true, nullptr);
}

Status open_scene_clouds(const Scene& scene, const RenderOptions& options, Session& sky,
                         Clouds& clouds, CloudCounts& told) {
    PILEUS_TRY(clouds.open(sky));
    return fill_scene_clouds(scene, options, sky, clouds, told);
}

Status fill_scene_clouds(const Scene& scene, const RenderOptions& options, Session& sky,
                         Clouds& clouds, CloudCounts& told) {
    PILEUS_TRY(at_key(scene, "clouds.detail", clouds.set_detail(scene.clouds.detail)));
    PILEUS_TRY(add_kinds(scene, options, sky, clouds, told));
    PILEUS_TRY(add_layers(scene, options, sky, clouds, told));
    std::vector<CloudPlace> places;
    PILEUS_TRY(list_places(scene, clouds, places));
    told.clouds = places.size();
    for (const CloudPlace& place : places) ++told.kinds[place.kind].clouds;
    return at_key(scene, "clouds", clouds.place(places));
}

}  // namespace pileus
