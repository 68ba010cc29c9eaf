// SPDX-License-Identifier: Apache-2.0
// The filter of a path tracing's picture: what of its light is smooth, and what is left alone.
// in: planes of the film, guides -> out: the planes' colour with less noise.
// docs/filter.md
#include "platform/threads.h"
#include "src/methods/path/path.h"
#include "src/picture/background.h"
#include "src/picture/filter/oidn.h"
#include "src/picture/filter/regression.h"

namespace pileus {
namespace {

bool has_sky(const Lighting& light) {
    return light.map.columns > 0 || light.sky[0] > 0 || light.sky[1] > 0 || light.sky[2] > 0;
}

/// What the sky shows of itself straight through the media, [3][pixel]; where there is one.
Status show_sky(const Context& context, const PathRun& run, Buffer<float>& out) {
    if (!has_sky(run.lighting)) return Status::ok();
    const std::size_t pixels = run.film.pixels();
    PILEUS_TRY(allocate(arrays::film_means(3, pixels), out));
    Lighting sky;
    sky.sky = run.lighting.sky;
    sky.map = run.lighting.map;
    const BackgroundParams k =
        background_params(make_medium_view(run.world->medium, run.majorants), run.camera, sky);
    return show_background(context, sky, k, {nullptr, out.data(), nullptr});
}

/// Light that the filter takes: before the sky all that has not come straight through; before
/// something solid, whose light has edges of its own, what the media turned last.
Status take_light(const Context& context, const PathRun& run, Buffer<float>& out) {
    const Planes& p = run.planes;
    const std::size_t pixels = run.film.pixels();
    Buffer<float> sky;
    PILEUS_TRY(show_sky(context, run, sky));
    PILEUS_TRY(allocate(arrays::film_means(3, pixels), out));
    parallel_for(context.threads, run.film.height, [&](std::int64_t row, int) {
        const std::size_t first = std::size_t(row) * std::size_t(run.film.width);
        for (std::size_t i = first; i < first + std::size_t(run.film.width); ++i) {
            const bool solid = !p.opaque_depth.empty() && p.opaque_depth[i] < kNothingSolid;
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t at = c * pixels + i;
                const float straight = sky.empty() ? 0.0f : p.transmittance[i] * sky[at];
                out[at] = solid ? float(film_mean(run.film, kPathCloud, int(c), i))
                                : p.colour[at] - straight;
            }
        }
    });
    return Status::ok();
}

Status regress(const Context& context, PathRun& run) {
    Planes& p = run.planes;
    Buffer<float> light, before;
    PILEUS_TRY(take_light(context, run, light));
    PILEUS_TRY(allocate(arrays::film_means(light.size(), 1), before));
    std::memcpy(before.data(), light.data(), light.size() * sizeof(float));
    RegressionInput in;
    in.width = run.film.width;
    in.height = run.film.height;
    in.threads = context.threads;
    in.transmittance = p.transmittance.data();
    in.optical_depth = p.optical_depth.data();
    in.guides = run.guides.planes.data();
    in.opaque_depth = p.opaque_depth.data();
    in.radius_pixels = run.scene->filter.radius_pixels;
    PILEUS_TRY(filter_light(in, light.data()));
    parallel_for(context.threads, 3, [&](std::int64_t c, int) {
        const std::size_t pixels = run.film.pixels(), first = std::size_t(c) * pixels;
        for (std::size_t i = first; i < first + pixels; ++i) {
            // A fit may end below zero; no light does.
            const float v = p.colour[i] + (light[i] - before[i]);
            if (light[i] != before[i]) p.colour[i] = v > 0 ? v : 0;
        }
    });
    return Status::ok();
}

std::string key_of(const Scene& scene) { return scene.file + ": filter.kind: "; }

}  // namespace

Status check_path_filter(const Scene& scene) {
    if (!path_filters(scene)) return Status::ok();
    const std::string key = key_of(scene);
    const std::string value = std::string("\"") + path_filter_name(scene) + "\"";
    if (scene.camera.flux)
        return Status::bad_input(key +
                                 "a flat detector (camera.projection \"flux\") sees along no "
                                 "single ray, " +
                                 value + ", allowed: none");
    const OutputSettings& output = scene.output;
    const char* layer = output.layer_error ? "error" : output.layer_light ? "light" : nullptr;
    if (layer != nullptr)
        return Status::bad_input(key + "a filtered picture has no layer \"" + layer + "\", " +
                                 value + ", allowed: none, or other layers");
    return path_regresses(scene) ? Status::ok() : check_oidn(key);
}

Status path_filter(const Context& context, PathRun& run) {
    const StageClock clock(context, "filter");
    return path_regresses(*run.scene)
               ? regress(context, run)
               : denoise_by_oidn(key_of(*run.scene), run.film.width, run.film.height,
                                 context.threads, run.planes.colour.data());
}

}  // namespace pileus
