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

Status error_planes(const Context& context, const PathState& state, Buffer<float>& out) {
    const std::size_t pixels = state.film.pixels();
    PILEUS_TRY(allocate(arrays::film_means(3, pixels), out));
    for (int c = 0; c < 3; ++c)
        film_errors(context.threads, state, c, out.data() + std::size_t(c) * pixels, nullptr);
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
        PILEUS_TRY(error_planes(context, state, p.error));
    return Status::ok();
}

}  // namespace

void film_errors(int threads, const PathState& state, int channel, float* out, ErrorSum* sum) {
    constexpr int kBand = 16;  // rows, whose sums are added in their order
    const Film& film = state.film;
    const PixelGroups groups = groups_of(state.planes, film.width, film.height);
    const std::int64_t bands = (film.height + kBand - 1) / kBand;
    std::vector<ErrorSum> sums(static_cast<std::size_t>(bands));
    parallel_for(threads, bands, [&](std::int64_t band, int) {
        const int first = int(band) * kBand;
        ErrorRows rows(groups, Scatter::kSamples, double(film.samples));
        rows.run(
            first, first + kBand < film.height ? first + kBand : film.height,
            [&](std::size_t i) { return film_variance(film, channel, i); },
            [&](std::size_t i) { return film_mean(film, 0, channel, i); },
            [&](std::size_t i, const PixelError& e) {
                if (out != nullptr) out[i] = e.error;
                sums[std::size_t(band)].add(groups.transmittance[i], e.error, e.light);
            });
    });
    for (std::size_t band = 0; sum != nullptr && band < sums.size(); ++band) sum->add(sums[band]);
}

ErrorSum path_error(const Context& context, const PathState& state) {
    ErrorSum sum;
    film_errors(context.threads, state, 1, nullptr, &sum);
    return sum;
}

Status path_filtered_error(const Context& context, const FrameView& view, PathState& state,
                           ErrorSum& sum) {
    Planes& p = state.planes;
    PILEUS_TRY(mean_planes(context, state.film, kPathTotal, p.colour));
    PILEUS_TRY(path_filter_with_error(context, view, state));
    const std::size_t pixels = state.film.pixels();
    sum = sum_errors(groups_of(p, state.film.width, state.film.height), p.error.data() + pixels,
                     p.colour.data() + pixels);
    // Pictures have it where a layer asks for it alone.
    p.error = Buffer<float>();
    return Status::ok();
}

Status show_film(const Context& context, const FrameView& view, PathState& state) {
    PILEUS_TRY(fill_planes(context, view, state));
    Buffer<float> straight;
    PILEUS_TRY(path_straight(context, view, state, straight));
    if (path_filters(state.filter)) PILEUS_TRY(path_filter(context, view, state));
    return path_air(context, view, state, straight);
}

}  // namespace pileus
