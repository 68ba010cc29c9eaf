// SPDX-License-Identifier: Apache-2.0
// The filter of a path tracing's picture: what of its light is smooth, and what is left alone.
// in: planes of the film, guides -> out: the planes' colour with less noise.
// docs/filter.md
#include "platform/threads.h"
#include "src/methods/path/path_state.h"
#include "src/picture/background.h"
#include "src/picture/filter/filter_error.h"
#include "src/picture/filter/regression.h"

namespace pileus {
namespace {

bool has_sky(const Lighting& light) {
    return light.map.columns > 0 || light.sky[0] > 0 || light.sky[1] > 0 || light.sky[2] > 0;
}

/// Whether all that is solid is a ground under the sun and an even sky, or that of clear air. Then
/// its light is filtered, too, and media have the same light before it and before the sky.
bool has_plain_ground(const Lighting& light) {
    return light.ground.present && light.ground.paint.on == 0 && !has_surfaces(light) &&
           light.lamps.empty() && (light.map.columns == 0 || light.air);
}

bool is_solid(const Planes& p, std::size_t i) {
    return !p.opaque_depth.empty() && p.opaque_depth[i] < kNothingSolid;
}

/// Calls set(c, pixel) for all channels of all pixels.
template <class Set>
void for_light(const Context& context, const PathState& state, Set set) {
    const std::size_t width = std::size_t(state.film.width);
    parallel_for(context.threads, state.film.height, [&](std::int64_t row, int) {
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = std::size_t(row) * width; i < (std::size_t(row) + 1) * width; ++i)
                set(c, i);
    });
}

/// What the media turned last.
float turned(const PathState& state, std::size_t c, std::size_t i) {
    return float(film_mean(state.film, kPathCloud, int(c), i));
}

RegressionInput regression_input(const Context& context, const PathState& state, int fold,
                                 double* kept) {
    const Planes& p = state.planes;
    RegressionInput in;
    in.width = state.film.width;
    in.height = state.film.height;
    in.threads = context.threads;
    in.transmittance = p.transmittance.data();
    in.optical_depth = p.optical_depth.data();
    in.guides = state.guides.planes.data();
    in.opaque_depth = p.opaque_depth.data();
    in.radius_pixels = state.filter.radius_pixels;
    in.fold = fold;
    in.kept = kept;
    return in;
}

/// The share of the sun's light on the ground, the first of three planes.
Status light_ground(const Context& context, const FrameView& view, const PathState& state,
                    Buffer<float>& out) {
    PILEUS_TRY(allocate(arrays::film_means(3, state.film.pixels()), out));
    if (!view.lighting.sunlit) return Status::ok();
    BackgroundParams k = background_params(make_medium_view(view.world.medium, state.majorants),
                                           state.camera, view.lighting);
    for (int c = 0; c < 3; ++c) k.sky[c] = k.ground_diffuse[c] = k.ground_sun[c] = 0;
    k.ground_sun[0] = 1;
    return show_background(context, view.lighting, k, {nullptr, out.data(), nullptr});
}

/// What of a picture is known without its samples, made once for all of its filters.
struct Known {
    bool plain = false;      ///< a plain ground
    Buffer<float> sky;       ///< of path_sky_behind
    Buffer<float> sun;       ///< of light_ground; with a plain ground alone
    double* kept = nullptr;  ///< RegressionInput::kept
};

Status find_known(const Context& context, const FrameView& view, const PathState& state,
                  Known& known) {
    known.plain = has_plain_ground(view.lighting);
    PILEUS_TRY(path_sky_behind(context, view, state, known.sky));
    return known.plain ? light_ground(context, view, state, known.sun) : Status::ok();
}

/// Puts what comes straight through the media from a plain ground and from the sky in place of the
/// samples of it: filtered, and as it is known.
Status filter_straight(const Context& context, PathState& state, const Known& known, int fold) {
    Planes& p = state.planes;
    const std::size_t pixels = state.film.pixels();
    const Buffer<float>& sky = known.sky;
    Buffer<float> straight;
    PILEUS_TRY(allocate(arrays::film_means(3, pixels), straight));
    for_light(context, state, [&](std::size_t c, std::size_t i) {
        const std::size_t at = c * pixels + i;
        if (is_solid(p, i))
            straight[at] = p.colour[at] - turned(state, c, i);
        else
            straight[at] = sky.empty() ? 0.0f : p.transmittance[i] * sky[at];
    });
    RegressionInput in = regression_input(context, state, fold, known.kept);
    in.sun_on_ground = known.sun.data();
    PILEUS_TRY(filter_ground(in, straight.data()));
    for_light(context, state, [&](std::size_t c, std::size_t i) {
        const float s = straight[c * pixels + i];
        p.colour[c * pixels + i] = (s > 0 ? s : 0.0f) + turned(state, c, i);
    });
    return Status::ok();
}

/// Light that the filter takes. Before the sky that is all that has not come straight through;
/// before something solid, whose light has edges of its own, and where it is at hand anyway, what
/// the media turned last.
Status take_light(const Context& context, PathState& state, const Known& known, int fold,
                  Buffer<float>& out) {
    Planes& p = state.planes;
    const std::size_t pixels = state.film.pixels();
    const Buffer<float>& sky = known.sky;
    if (known.plain) PILEUS_TRY(filter_straight(context, state, known, fold));
    PILEUS_TRY(allocate(arrays::film_means(3, pixels), out));
    for_light(context, state, [&](std::size_t c, std::size_t i) {
        const std::size_t at = c * pixels + i;
        const float straight = sky.empty() ? 0.0f : p.transmittance[i] * sky[at];
        out[at] = known.plain || is_solid(p, i) ? turned(state, c, i) : p.colour[at] - straight;
    });
    return Status::ok();
}

Status regress(const Context& context, PathState& state, const Known& known, int fold) {
    Planes& p = state.planes;
    Buffer<float> light, before;
    PILEUS_TRY(take_light(context, state, known, fold, light));
    PILEUS_TRY(allocate(arrays::film_means(light.size(), 1), before));
    std::memcpy(before.data(), light.data(), light.size() * sizeof(float));
    RegressionInput in = regression_input(context, state, fold, known.kept);
    if (known.plain) in.opaque_depth = nullptr;
    PILEUS_TRY(filter_light(in, light.data()));
    const std::size_t pixels = state.film.pixels();
    for_light(context, state, [&](std::size_t c, std::size_t i) {
        // A fit may end below zero; no light does.
        const std::size_t at = c * pixels + i;
        if (light[at] == before[at]) return;
        const float old = p.colour[at], v = old + (light[at] - before[at]);
        p.colour[at] = v > 0 ? v : 0;
        // What is not filtered comes straight through: the media have turned all the rest.
        if (fold < 0 && !p.cloud.empty()) p.cloud[at] = p.colour[at] - (old - before[at]);
    });
    return Status::ok();
}

/// Whether the filter changes a pixel.
bool is_filtered(const PathState& state, const Known& known, std::size_t i) {
    const Planes& p = state.planes;
    return p.transmittance[i] < 1.0f || (known.plain && is_solid(p, i));
}

/// The planes' squares as errors, smooth, of which each is noise itself. Dark pixels have less of
/// it than bright ones around, but not in proportion: the unit is their light and the mean light.
Status steady_squares(const Context& context, PathState& state, const Known& known) {
    Planes& p = state.planes;
    const std::size_t pixels = state.film.pixels();
    double sum[3] = {}, count = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (!is_filtered(state, known, i)) continue;
        count += 1;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += double(p.colour[c * pixels + i]);
    }
    const auto unit = [&](std::size_t c, std::size_t i) {
        return p.colour[c * pixels + i] + float(sum[c] / count);
    };
    for_light(context, state, [&](std::size_t c, std::size_t i) {
        if (!is_filtered(state, known, i)) return;
        const float u = unit(c, i);
        p.error[c * pixels + i] *= u > 0 ? 1 / (u * u) : 0;
    });
    const PixelGroups groups = groups_of(p, state.film.width, state.film.height);
    PILEUS_TRY(smooth_error(context.threads, groups, p.error));
    for_light(context, state, [&](std::size_t c, std::size_t i) {
        if (is_filtered(state, known, i)) p.error[c * pixels + i] *= unit(c, i);
    });
    return Status::ok();
}

/// A third, and a quarter of that more: how much windows keep of their fits is noise, too, and the
/// same in all parts. docs/filter.md has what was measured.
constexpr float kOfFolds = 1.25f / 3.0f;

/// Four parts of the picture, each filtered by itself, against the whole, of which each is a
/// quarter: a difference of the two has three times the square of the whole's own error. Windows
/// keep as much of their fits as with all pixels.
Status regress_with_error(const Context& context, PathState& state, Known& known) {
    Planes& p = state.planes;
    const std::size_t pixels = state.film.pixels();
    Buffer<double> kept;
    PILEUS_TRY(allocate(arrays::filter_kept(state.film.width, state.film.height), kept));
    known.kept = kept.data();
    const auto copy = [&](const Buffer<float>& from, Buffer<float>& to) {
        std::memcpy(to.data(), from.data(), from.bytes());
    };
    Buffer<float> samples, whole;
    for (Buffer<float>* b : {&samples, &whole, &p.error})
        PILEUS_TRY(allocate(arrays::film_means(3, pixels), *b));
    copy(p.colour, samples);
    PILEUS_TRY(regress(context, state, known, -1));
    copy(p.colour, whole);
    for (int fold = 0; fold < 4; ++fold) {
        copy(samples, p.colour);
        PILEUS_TRY(regress(context, state, known, fold));
        for_light(context, state, [&](std::size_t c, std::size_t i) {
            const int width = state.film.width;
            if (filter_fold(int(i % std::size_t(width)), int(i / std::size_t(width))) != fold)
                return;
            const float d = p.colour[c * pixels + i] - whole[c * pixels + i];
            p.error[c * pixels + i] =
                is_filtered(state, known, i) ? d * d * kOfFolds : kNotFiltered;
        });
    }
    copy(whole, p.colour);
    PILEUS_TRY(steady_squares(context, state, known));
    // What is not filtered has the error of its samples.
    for (std::size_t c = 0; c < 3; ++c)
        film_errors(context.threads, state, int(c), samples.data() + c * pixels, nullptr);
    for_light(context, state, [&](std::size_t c, std::size_t i) {
        if (!is_filtered(state, known, i)) p.error[c * pixels + i] = samples[c * pixels + i];
    });
    return Status::ok();
}

}  // namespace

Status path_sky_behind(const Context& context, const FrameView& view, const PathState& state,
                       Buffer<float>& out) {
    if (!has_sky(view.lighting)) return Status::ok();
    const std::size_t pixels = state.film.pixels();
    PILEUS_TRY(allocate(arrays::film_means(3, pixels), out));
    Lighting sky;
    sky.sky = view.lighting.sky;
    sky.map = view.lighting.map;
    const BackgroundParams k =
        background_params(make_medium_view(view.world.medium, state.majorants), state.camera, sky);
    return show_background(context, sky, k, {nullptr, out.data(), nullptr});
}

Status path_filter_with_error(const Context& context, const FrameView& view, PathState& state) {
    const StageClock clock(context, "filter");
    Known known;
    PILEUS_TRY(find_known(context, view, state, known));
    return regress_with_error(context, state, known);
}

Status path_filter(const Context& context, const FrameView& view, PathState& state) {
    if (path_regresses(state.filter) && view.scene.output.layer_error)
        return path_filter_with_error(context, view, state);
    const StageClock clock(context, "filter");
    if (!path_regresses(state.filter)) return denoise_film(context, view, state);
    Known known;
    PILEUS_TRY(find_known(context, view, state, known));
    return regress(context, state, known, -1);
}

}  // namespace pileus
