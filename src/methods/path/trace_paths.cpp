// SPDX-License-Identifier: Apache-2.0
// See trace_paths.h.
#include "src/methods/path/trace_paths.h"

#include "kernels_cpu/path/path_needs.h"
#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/base/random_streams.h"
#include "src/base/single.h"
#include "src/methods/path/path_blocks.h"
#include "src/run/context.h"
#include "src/run/device_launch.h"
#include "src/run/on_device.h"
#include "src/run/work_share.h"
#include "src/world/majorant/majorants.h"
#include "src/world/solids/camera_depth.h"
#include "src/world/solids/solids.h"

namespace pileus {
namespace {

constexpr std::uint64_t kPiece = 16384;  // samples per piece of work
constexpr std::uint64_t kPiecesPerThread = 8;

std::uint64_t smaller(std::uint64_t a, std::uint64_t b) { return a < b ? a : b; }

int parts_of(const PathInput& in) { return in.parts ? kPathParts : 1; }
int kept_parts(const PathInput& in) { return in.brief && in.parts ? 2 : parts_of(in); }

std::uint64_t film_pixels(const PathInput& in) {
    return std::uint64_t(in.camera.width) * std::uint64_t(in.camera.height);
}

/// By which samples are counted: those of the whole picture, whose samples a window's are.
std::uint64_t counted_pixels(const PathInput& in) {
    return std::uint64_t(whole_width(in.camera)) * std::uint64_t(whole_height(in.camera));
}

std::uint64_t scratch_samples(const PathInput& in) {
    return std::uint64_t(in.threads) * kPiecesPerThread * kPiece;
}

/// Sample numbers whose product with the pixels fits 32 bits share a key.
std::uint64_t samples_per_key(const PathInput& in) {
    const std::uint64_t pixels = counted_pixels(in);
    return pixels > 0 ? (std::uint64_t{1} << 32) / pixels : 1;
}

void set_medium(const PathInput& in, Span<const float> blocks, PathParams& k) {
    const Medium& m = *in.medium;
    k.grid = track_grid(m, blocks, in.block, in.rules.max_events);
    for (int a = 0; a < 3; ++a) k.extent[a] = float(m.grid.size[a]) * m.grid.cell_m[a];
    k.channels = m.channels;
    k.media = m.count;
    for (std::size_t i = 0; i < m.optics.size(); ++i) k.optics[i] = m.optics[i];
    k.parts = m.parts.data();
}

void set_light(const PathInput& in, const SkySampler& sampler, PathParams& k) {
    const Lighting& light = *in.lighting;
    k.sunlit = light.sunlit ? 1 : 0;
    k.sun_heights = light.sun_heights;
    bool sky_lit = false;
    for (std::size_t c = 0; c < 3; ++c) {
        k.to_sun[c] = light.to_sun[c];
        k.sun[c] = float(light.sun_irradiance[c]);
        k.sky[c] = float(light.sky[c]);
        sky_lit |= k.sky[c] > 0;
    }
    // A black map has no directions to draw and counts as a black sky.
    if (light.map.columns > 0 && sampler.weight != nullptr) {
        k.map = light.map;
        k.sampler = sampler;
        sky_lit = true;
    }
    k.sky_lit = sky_lit ? 1 : 0;
    if (light.solids != nullptr) {
        k.solids = light.solids->view();
        if (light.solids->coloured()) k.channels = 3;
    }
    if (light.depth != nullptr) k.camera_depth = light.depth->metres.data();
    k.ground = light.ground.present ? 1 : 0;
    k.ground_z = float(light.ground.z);
    k.ground_albedo = float(light.ground.albedo);
    k.paint = light.ground.paint;
    if (has_coloured_ground(light)) k.channels = 3;
}

void set_lamps(const PathInput& in, PathParams& k) {
    const Medium& m = *in.medium;
    k.lamps = in.lighting->lamps.data();
    k.lamp_count = std::int32_t(in.lighting->lamps.size());
    const double densest = max_extinction(m);
    k.lamp_near = densest > 1e-9 ? float(kLampNear / densest) : 1e9f;
    for (const LampParams& lamp : in.lighting->lamps)
        if (lamp.radius > 0) k.lamp_spheres = 1;
    k.emits = emits(m) ? 1 : 0;
}

/// The sun's disc shines alike all over; its irradiance stays that of the point.
void set_disc(double radius_deg, PathParams& k) {
    const double half = sincos_deg(0.5 * radius_deg).sine;
    k.sun_disc = float(single_or_0(2 * half * half));
    for (float& light : k.sun) light = float(double(light) / (1 - half * half));
    for (float& light : k.sun_heights.above) light = float(double(light) / (1 - half * half));
}

PathParams path_params(const PathInput& in, const PathScratch& scratch) {
    PathParams k{};
    set_medium(in, scratch.blocks.span(), k);
    set_light(in, scratch.sky.view, k);
    k.camera = in.camera;
    k.jitter = in.jitter ? 1 : 0;
    k.max_depth = in.rules.max_depth > 0 ? in.rules.max_depth : 0x7fffffff;
    k.pixels = std::uint32_t(counted_pixels(in));
    k.parts_wanted = in.parts ? 1 : 0;
    k.light_roulette = in.rules.light_roulette;
    set_lamps(in, k);
    k.importance = in.rules.importance;
    if (k.sunlit == 0) return k;
    // Light that a sea reflects into the guide's cone is no density of its turns.
    if (in.rules.guide && k.paint.sea == nullptr) k.guide = scratch.guide;
    if (in.rules.sun_radius_deg > 0) set_disc(in.rules.sun_radius_deg, k);
    return k;
}

/// The kernel of the table that these paths need.
auto kernel_for(const PathInput& in, const PathParams& k) {
    if (k.importance != nullptr) return host_kernels(in.kernels).trace_paths_importance;
    return needs_full(k) ? in.kernels->trace_paths_full : in.kernels->trace_paths;
}

/// Traces the samples of a launch, which fit the scratch. `ended`: not all of them, because `in`
/// said so.
Status run_launch(const PathInput& in, const PathParams& k, std::uint64_t count,
                  const std::function<bool()>& ask, PathScratch& scratch, bool& ended) {
    ended = false;
    if (on_device(in.kernels->device) && k.importance == nullptr)
        return launch_on_device(*in.kernels->device, k,
                                {scratch.radiance.data(), scratch.capacity, &scratch.tallies[0]},
                                std::uint32_t(count));
    const std::uint64_t pieces = (count + kPiece - 1) / kPiece;
    ended = !run_until(in.threads, std::int64_t(pieces), ask, [&](std::int64_t piece, int thread) {
        const std::uint64_t begin = std::uint64_t(piece) * kPiece;
        const PathBuffers b{scratch.radiance.data(), scratch.capacity,
                            &scratch.tallies[std::size_t(thread) * 2]};
        kernel_for(in, k)(k, b, std::uint32_t(begin),
                          std::uint32_t(smaller(begin + kPiece, count)));
    });
    return Status::ok();
}

/// Adds the samples of a launch to the film, each pixel's one after the other.
void add_samples(const PathInput& in, const PathParams& k, std::uint64_t count,
                 const PathScratch& scratch, Film& film) {
    constexpr std::uint64_t kRun = 1024;
    const std::uint64_t pixels = count / k.per_pixel;
    parallel_for(in.threads, std::int64_t((pixels + kRun - 1) / kRun), [&](std::int64_t run, int) {
        const std::uint64_t first = std::uint64_t(run) * kRun;
        const std::uint64_t end = smaller(first + kRun, pixels);
        for (std::size_t c = 0; c < std::size_t(film.parts) * 3; ++c) {
            const std::size_t channel = std::size_t(film.part_of(int(c / 3))) * 3 + c % 3;
            const float* const samples = scratch.radiance.data() + channel * scratch.capacity;
            for (std::uint64_t p = first; p < end; ++p) {
                const float* from = samples + p * k.per_pixel;
                const std::size_t pixel = std::size_t(k.first_pixel + p);
                double& sum = film.sum[c * film.pixels() + pixel];
                for (std::uint32_t i = 0; i < k.per_pixel; ++i) sum += double(from[i]);
                if (c >= 3 || film.square.empty()) continue;
                double& square = film.square[c * film.pixels() + pixel];
                for (std::uint32_t i = 0; i < k.per_pixel; ++i)
                    square += double(from[i]) * double(from[i]);
            }
        }
    });
}

/// Moves the threads' tallies into the film's, or forgets them.
void take_tallies(const PathInput& in, bool count, PathScratch& scratch, Film& film) {
    for (int t = 0; t < in.threads; ++t) {
        PathTally& own = scratch.tallies[std::size_t(t) * 2];
        if (count) add_tally(own, film.tally);
        own = PathTally{};
    }
}

/// The pass that the film is in, from pixel film.ahead on: film.ahead_samples samples of every
/// pixel, from number k.first_sample on; they share a key. film.ahead is where it came to.
Status trace_run(const PathInput& in, PathParams& k, PathScratch& scratch, Film& film) {
    // As many samples of as few pixels as the scratch holds: neighbours in a lane meet one memory.
    const std::uint64_t count = film.ahead_samples, pixels = film_pixels(in);
    const std::uint64_t number = k.first_sample, most = smaller(count, scratch.capacity);
    const std::uint64_t band = scratch.capacity / most;
    // Pixels whose samples take several launches are finished.
    const std::function<bool()> ask = most == count ? in.ended : std::function<bool()>{};
    const std::uint64_t width = std::uint64_t(film.width);
    for (PartRange own = owned_run(pixels, width, in.part, film.ahead); own.begin < own.end;
         own = owned_run(pixels, width, in.part, own.end)) {
        if (film.ahead < own.begin) film.ahead = own.begin;
        while (film.ahead < own.end) {
            k.first_pixel = std::uint32_t(film.ahead);
            const std::uint64_t here = smaller(band, own.end - film.ahead);
            for (std::uint64_t done = 0; done < count; done += most) {
                k.first_sample = std::uint32_t(number + done);
                k.per_pixel = std::uint32_t(smaller(most, count - done));
                bool ended = false;
                PILEUS_TRY(run_launch(in, k, here * k.per_pixel, ask, scratch, ended));
                take_tallies(in, !ended, scratch, film);
                if (ended) return Status::ok();
                add_samples(in, k, here * k.per_pixel, scratch, film);
            }
            film.ahead += here;
        }
    }
    film.ahead = pixels;
    return Status::ok();
}

}  // namespace

void add_tally(const PathTally& from, PathTally& to) {
    const auto* source = reinterpret_cast<const std::int64_t*>(&from);
    auto* target = reinterpret_cast<std::int64_t*>(&to);
    for (std::size_t i = 0; i < sizeof(PathTally) / sizeof(std::int64_t); ++i)
        target[i] += source[i];
}

Array<double> arrays::film_sums(const PathInput& in) {
    return {"film", film_pixels(in) * 3 * std::uint64_t(kept_parts(in)), Stage::kPaths,
            Stage::kLayers};
}

Array<double> arrays::film_squares(const PathInput& in) {
    return {"film", in.brief ? 0 : film_pixels(in) * 3, Stage::kPaths, Stage::kLayers};
}

Array<float> arrays::path_samples(const PathInput& in) {
    return {"path samples", scratch_samples(in) * 3 * std::uint64_t(parts_of(in)), Stage::kPaths,
            Stage::kPaths};
}

Status make_film(const PathInput& in, Film& film) {
    film.width = in.camera.width;
    film.height = in.camera.height;
    film.parts = kept_parts(in);
    film.samples = film.ahead = film.ahead_samples = 0;
    film.tally = PathTally{};
    PILEUS_TRY(allocate(arrays::film_sums(in), film.sum));
    return allocate(arrays::film_squares(in), film.square);
}

Status prepare_path(const PathInput& in, PathScratch& scratch) {
    scratch.capacity = scratch_samples(in);
    PILEUS_TRY(allocate(arrays::path_samples(in), scratch.radiance));
    PILEUS_TRY(scratch.tallies.resize(std::uint64_t(in.threads) * 2, "path tallies"));
    PILEUS_TRY(make_path_sky(in.lighting->map, scratch.sky));
    scratch.guide = fit_guide(*in.medium);
    std::int32_t counts[3];
    block_counts(in.medium->grid, in.block, counts);
    PILEUS_TRY(path_blocks(in.majorants, counts, in.threads, scratch.blocks));
    scratch.ready = true;
    return Status::ok();
}

Status trace_paths(const PathInput& in, std::uint64_t samples, PathScratch& scratch, Film& film) {
    if (!scratch.ready) PILEUS_TRY(prepare_path(in, scratch));
    PathParams k = path_params(in, scratch);
    const std::uint64_t shared = samples_per_key(in);
    while (samples > 0) {
        const std::uint64_t number = film.samples % shared;
        if (film.ahead == 0)
            film.ahead_samples = smaller(smaller(samples, shared - number), scratch.capacity);
        k.key = make_key(in.seed, kPathStream, std::uint32_t(film.samples / shared));
        k.first_sample = std::uint32_t(number);
        PILEUS_TRY(trace_run(in, k, scratch, film));
        if (film.ahead < film_pixels(in)) return Status::ok();
        samples -= smaller(samples, film.ahead_samples);
        film.samples += film.ahead_samples;
        film.ahead = film.ahead_samples = 0;
    }
    return Status::ok();
}

std::uint32_t most_pixel_samples(const PathInput& in) {
    return std::uint32_t(smaller(samples_per_key(in), kPiecesPerThread * kPiece));
}

Status trace_pixels(const PathInput& in, const std::vector<std::uint32_t>& pixels,
                    std::uint32_t samples, PathScratch& scratch, std::vector<PixelLight>& out,
                    bool& ended) {
    if (!scratch.ready) PILEUS_TRY(prepare_path(in, scratch));
    PathParams k = path_params(in, scratch);
    k.key = make_key(in.seed, kVerifyStream, 0);
    k.first_sample = 0;
    k.per_pixel = samples;
    const auto kernel = kernel_for(in, k);
    const std::uint64_t own = scratch.capacity / std::uint64_t(in.threads);
    out.assign(pixels.size(), PixelLight{});
    ended = !run_until(
        in.threads, std::int64_t(pixels.size()), in.ended, [&](std::int64_t i, int thread) {
            float* const radiance = scratch.radiance.data() + std::uint64_t(thread) * own;
            PathParams mine = k;
            mine.first_pixel = pixels[std::size_t(i)];
            kernel(mine, {radiance, scratch.capacity, &scratch.tallies[std::size_t(thread) * 2]}, 0,
                   samples);
            const double n = double(samples);
            for (std::size_t c = 0; c < 3; ++c) {
                const float* from = radiance + c * scratch.capacity;
                double sum = 0, square = 0, turned = 0;
                for (std::uint32_t s = 0; s < samples; ++s) sum += double(from[s]);
                const double mean = sum / n;
                for (std::uint32_t s = 0; s < samples; ++s)
                    square += (double(from[s]) - mean) * (double(from[s]) - mean);
                PixelLight& pixel = out[std::size_t(i)];
                pixel.mean[c] = mean;
                pixel.square_error[c] = square / (n * (n - 1));
                if (!in.parts) continue;
                const float* cloud = from + 3 * kPathCloud * scratch.capacity;
                for (std::uint32_t s = 0; s < samples; ++s) turned += double(cloud[s]);
                pixel.straight[c] = mean - turned / n;
            }
        });
    return Status::ok();
}

double film_mean(const Film& film, int part, int channel, std::size_t pixel) {
    const std::uint64_t samples = film.samples_of(pixel);
    if (samples == 0) return 0;
    const std::size_t plane = std::size_t(film.group_of(part)) * 3 + std::size_t(channel);
    return film.sum[plane * film.pixels() + pixel] / double(samples);
}

double film_variance(const Film& film, int channel, std::size_t pixel) {
    if (film.samples_of(pixel) < 2 || film.square.empty()) return 0;
    const double n = double(film.samples_of(pixel)), mean = film_mean(film, 0, channel, pixel);
    const double square = film.square[std::size_t(channel) * film.pixels() + pixel];
    const double variance = (square / n - mean * mean) / (n - 1);
    return variance > 0 ? variance : 0;
}

double film_error(const Film& film, int channel, std::size_t pixel) {
    return __builtin_sqrt(film_variance(film, channel, pixel));
}

}  // namespace pileus
