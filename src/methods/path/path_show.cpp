// SPDX-License-Identifier: Apache-2.0
// The picture of a traced film, and its error.
// in: a film -> out: planes of the light that layers show.
// docs/formats.md, "Pictures out"
#include "platform/threads.h"
#include "src/methods/path/path_state.h"

namespace pileus {
namespace {

/// Means of one part of the film as floats, [channel][pixel].
Status mean_planes(const Context& context, const Film& film, int part, Buffer<float>& out) {
    const std::size_t pixels = film.pixels();
    PILEUS_TRY(allocate(arrays::film_means(3, pixels), out));
    parallel_for(context.threads, film.height, [&](std::int64_t row, int) {
        const std::size_t first = std::size_t(row) * std::size_t(film.width);
        for (int c = 0; c < 3; ++c)
            for (std::size_t i = first; i < first + std::size_t(film.width); ++i)
                out[std::size_t(c) * pixels + i] = float(film_mean(film, part, c, i));
    });
    return Status::ok();
}

Status error_planes(const Film& film, Buffer<float>& out) {
    const std::size_t pixels = film.pixels();
    PILEUS_TRY(allocate(arrays::film_means(3, pixels), out));
    for (int c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < pixels; ++i)
            out[std::size_t(c) * pixels + i] = float(film_error(film, c, i));
    return Status::ok();
}

/// The film as planes; only what a layer shows.
Status fill_planes(const Context& context, const FrameView& view, PathState& state) {
    const StageClock clock(context, "layers");
    const OutputSettings& output = view.scene.output;
    Planes& p = state.planes;
    PILEUS_TRY(mean_planes(context, state.film, kPathTotal, p.colour));
    if (output.layer_cloud || output.layer_order)
        PILEUS_TRY(mean_planes(context, state.film, kPathCloud, p.cloud));
    if (output.layer_light) PILEUS_TRY(mean_planes(context, state.film, kPathSun, p.sun));
    if (output.layer_order) PILEUS_TRY(mean_planes(context, state.film, kPathSingle, p.single));
    // One sample has no scatter to tell an error from.
    if (output.layer_error && state.film.samples >= 2 && !path_filters(state.filter))
        PILEUS_TRY(error_planes(state.film, p.error));
    return Status::ok();
}

}  // namespace

ErrorSum path_error(const PathState& state) {
    ErrorSum sum;
    for (std::size_t i = 0; i < state.film.pixels(); ++i)
        sum.add(state.planes.transmittance[i], float(film_error(state.film, 1, i)),
                float(film_mean(state.film, 0, 1, i)));
    return sum;
}

Status show_film(const Context& context, const FrameView& view, PathState& state) {
    PILEUS_TRY(fill_planes(context, view, state));
    Buffer<float> straight;
    PILEUS_TRY(path_straight(context, view, state, straight));
    if (path_filters(state.filter)) PILEUS_TRY(path_filter(context, view, state));
    return path_air(context, view, state, straight);
}

}  // namespace pileus
