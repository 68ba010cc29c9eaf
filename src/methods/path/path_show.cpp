// SPDX-License-Identifier: Apache-2.0
// The picture of a traced film, and what the report tells of it.
// in: PathRun after tracing -> out: Image, Report.
// docs/formats.md, "Pictures out"; docs/report.md
#include "kernels_cpu/core/profile.h"
#include "platform/threads.h"
#include "src/base/digest.h"
#include "src/methods/path/path.h"
#include "src/picture/finish_frame.h"

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
Status fill_planes(const Context& context, PathRun& run) {
    const StageClock clock(context, "layers");
    const OutputSettings& output = run.scene->output;
    Planes& p = run.planes;
    PILEUS_TRY(mean_planes(context, run.film, kPathTotal, p.colour));
    if (output.layer_cloud || output.layer_order)
        PILEUS_TRY(mean_planes(context, run.film, kPathCloud, p.cloud));
    if (kFilms && output.layer_light) PILEUS_TRY(mean_planes(context, run.film, kPathSun, p.sun));
    if (kFilms && output.layer_order)
        PILEUS_TRY(mean_planes(context, run.film, kPathSingle, p.single));
    // One sample has no scatter to tell an error from.
    if (kFilms && output.layer_error && run.film.samples >= 2 && !path_filters(run.filter))
        PILEUS_TRY(error_planes(run.film, p.error));
    return Status::ok();
}

std::string film_digest(const Film& film) {
    Digest d;
    for (const Buffer<double>* sums : {&film.sum, &film.square}) d.doubles(sums->span());
    return d.hex();
}

/// The report tells the error also where no layer shows it.
void report_error(const PathRun& run, const ErrorSum& sum, Report& report) {
    // The film's scatter is not what is left of it in a filtered picture.
    report.errors.known = run.film.samples >= 2 && sum.count > 0 && !path_filters(run.filter);
    if (!report.errors.known) return;
    report.errors.mean_relative = sum.mean_relative();
    report.errors.rmse_estimate = __builtin_sqrt(sum.square / sum.count);
}

}  // namespace

ErrorSum path_error(const PathRun& run) {
    ErrorSum sum;
    for (std::size_t i = 0; i < run.film.pixels(); ++i)
        sum.add(run.planes.transmittance[i], float(film_error(run.film, 1, i)),
                float(film_mean(run.film, 0, 1, i)));
    return sum;
}

Status path_planes(const Context& context, PathRun& run) {
    PILEUS_TRY(fill_planes(context, run));
    Buffer<float> straight;
    PILEUS_TRY(path_straight(context, run, straight));
    if (path_filters(run.filter)) PILEUS_TRY(path_filter(context, run));
    return path_air(context, run, straight);
}

Status path_show(const FrameStep&, const Context& context, MethodRun& method_run, Image& image) {
    PathRun& run = static_cast<PathRun&>(method_run);
    Report& report = *context.report;
    report.digests = run.digests;
    if (context.digests) report.digests.emplace_back("film", film_digest(run.film));
    PILEUS_TRY(path_planes(context, run));
    const ErrorSum error = path_error(run);
    FinishedParts parts;
    parts.film = run.film.parts;
    PILEUS_TRY(finish_frame(context, run.scene->output, *run.world, run.environment.depth,
                            run.camera, parts, run.planes, image, report));
    report_error(run, error, report);
    run.guides = FilterGuides{};
    run.film.sum = Buffer<double>();
    run.film.square = Buffer<double>();
    return Status::ok();
}

namespace {

PathTally tally_of(const PathRun& run) {
    PathTally all = run.tally;
    add_tally(run.film.tally, all);
    return all;
}

}  // namespace

void path_count(const MethodRun& method_run, Counts& counters) {
    const PathTally all = tally_of(static_cast<const PathRun&>(method_run));
    counters.emplace_back("majorant_violations", std::uint64_t(all.majorant_violations));
    counters.emplace_back("saturated", 0);  // sums are doubles
    counters.emplace_back("terminated", std::uint64_t(all.terminated));
    counters.emplace_back("nan_samples", std::uint64_t(all.nan));
}

void path_report(const MethodRun& method_run, Report& report) {
    const PathRun& run = static_cast<const PathRun&>(method_run);
    const PathTally all = tally_of(run);
    report.interrupted = run.interrupted;
    report.paths.samples_per_pixel = run.film.samples;
    report.paths.ahead_pixels = run.film.ahead;
    report.paths.ahead_samples = run.film.ahead > 0 ? run.film.ahead_samples : 0;
    report.paths.traced = std::uint64_t(all.paths);
    report.events.scatterings = std::uint64_t(all.scatterings);
    report.events.tentative = std::uint64_t(all.tentative);
    report.events.crossings = std::uint64_t(all.crossings);
    report.paths.shadow_rays = std::uint64_t(all.shadow_rays);
    report.paths.earlier = std::uint64_t(run.earlier.paths);
    report.paths.earlier_scatterings = std::uint64_t(run.earlier.scatterings);
    report.executed.emplace_back("ground_bounces", std::uint64_t(all.bounces));
    report.executed.emplace_back("shadow_rays", std::uint64_t(all.shadow_rays));
}

}  // namespace pileus
