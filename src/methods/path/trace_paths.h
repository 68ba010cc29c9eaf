// SPDX-License-Identifier: Apache-2.0
// Launches the path tracer: samples over threads, added up pixel by pixel in their order.
// in: medium, light, camera, majorants -> out: sums and sums of squares of independent samples.
// docs/path.md; a sample is a function of (seed, film size, pixel, number) alone.
#pragma once
#include <functional>
#include <vector>

#include "kernels_cpu/isa/kernels.h"
#include "src/methods/path/path_guide.h"
#include "src/methods/path/path_sky.h"
#include "src/plan/part_light.h"
#include "src/world/light/lights.h"
#include "src/world/majorant/majorant.h"

namespace pileus {

/// A step of a flight across a border is a few additions: smaller blocks than photons have pay.
constexpr TrackingCosts kPathCosts{1.0, 0.25, 0.25};

/// Mean free paths, where the medium is densest, within which light of a lamp is found between
/// vertices.
constexpr double kLampNear = 2;

/// Which ways light goes, and how they are sampled.
struct PathRules {
    int max_depth = 0;  ///< scatterings after which light is not followed; 0: unlimited
    std::uint32_t max_events = 1u << 24;  ///< draws per path before it is given up
    /// Shadow rays that bring less than this share of their light, 1/sr, play roulette; 0: all fly.
    float light_roulette = kLightRoulette;
    bool guide = true;          ///< branches towards the sun where a phase function is peaked
    double sun_radius_deg = 0;  ///< of the sun's disc, [0, 10]; 0: a point
    /// Expected light that particles are split by; null: paths go one by one.
    const ImportanceParams* importance = nullptr;
};

struct PathInput {
    const Medium* medium = nullptr;
    const Lighting* lighting = nullptr;  ///< of it sun, sky, map and ground; of lights none
    Span<const float> majorants;
    int block = 1;
    WorkPart part{};  ///< whose share of the film's pixels is traced
    CameraParams camera{};
    std::uint64_t seed = 0;
    int threads = 1;
    const KernelTable* kernels = nullptr;
    PathRules rules;
    bool jitter = true;             ///< rays spread over their pixels; false: through the middles
    bool parts = false;             ///< also the sun's, the singly scattered and the media's light
    bool brief = false;             ///< films keep of parts the media's alone, and no squares
    std::function<bool()> ended{};  ///< asked between pieces of work whether to end there
};

/// What samples have brought so far. Start with make_film; pixels are row by row from the top.
struct Film {
    int width = 0, height = 0;
    int parts = 1;              ///< groups of three channels: 1, kPathParts, or 2: total, cloud
    std::uint64_t samples = 0;  ///< per pixel
    /// Of a pass that was ended within: pixels [0, ahead) have `ahead_samples` more.
    std::uint64_t ahead = 0, ahead_samples = 0;
    Buffer<double> sum;     ///< [group * 3 + channel][pixel], radiance (flux camera: irradiance)
    Buffer<double> square;  ///< [channel][pixel], of the samples of the total; brief: none
    PathTally tally{};

    std::size_t pixels() const { return std::size_t(width) * std::size_t(height); }
    /// The part that a group is of, and the group of a part that is kept.
    int part_of(int group) const { return parts == 2 && group == 1 ? int(kPathCloud) : group; }
    int group_of(int part) const { return parts == 2 && part == kPathCloud ? 1 : part; }
    std::uint64_t samples_of(std::size_t pixel) const {
        return pixel < ahead ? samples + ahead_samples : samples;
    }
};

/// Memory of the tracer between calls: samples that are not added up yet, tallies per thread.
struct PathScratch {
    Buffer<float> radiance;
    Buffer<PathTally> tallies;
    PathSky sky;
    GuideParams guide{};
    Buffer<float> blocks;        ///< majorants, and leaps through empty ones
    std::uint64_t capacity = 0;  ///< samples
    bool ready = false;
};

/// An empty film for the input's camera. kLimit: out of memory.
Status make_film(const PathInput& in, Film& film);

namespace arrays {

/// Sums of every kept part's channels, and of the squares of the whole light's.
Array<double> film_sums(const PathInput& in);
Array<double> film_squares(const PathInput& in);
/// Samples of all threads that are not added up yet.
Array<float> path_samples(const PathInput& in);
/// Means of so many channels of the film, while they become an image.
inline Array<float> film_means(std::uint64_t channels, std::uint64_t pixels) {
    return {"means of the film", bytes_of(channels, pixels), Stage::kLayers, Stage::kLayers};
}

}  // namespace arrays

/// Allocates the scratch once, for any number of calls with the same input.
Status prepare_path(const PathInput& in, PathScratch& scratch);

/// Adds `samples` samples to every pixel, numbers film.samples and up: N and then M are, to the
/// bit, N + M at once, with any number of threads. A pass that was ended within is finished first,
/// and its samples count. Where `in.ended` ends it, film.ahead says how far the last pass came.
/// Errors: kLimit where memory is missing.
Status trace_paths(const PathInput& in, std::uint64_t samples, PathScratch& scratch, Film& film);

/// The light of one pixel, and the squares of its standard errors.
struct PixelLight {
    double mean[3] = {}, square_error[3] = {};
    double straight[3] = {};  ///< of the mean, what came straight through the media; with parts
};

/// Samples for each pixel that trace_pixels takes at most.
std::uint32_t most_pixel_samples(const PathInput& in);

/// Traces single pixels of the input's camera, `samples` (at least 2) for each, from a stream of
/// their own: independent of any film. Runs on the host. `ended`: `in.ended` ended it, `out` is not
/// whole. kLimit: out of memory.
Status trace_pixels(const PathInput& in, const std::vector<std::uint32_t>& pixels,
                    std::uint32_t samples, PathScratch& scratch, std::vector<PixelLight>& out,
                    bool& ended);

/// Mean of a part that is kept and a channel of a pixel; 0 without samples.
double film_mean(const Film& film, int part, int channel, std::size_t pixel);

/// Squared standard error of the total's mean, from the scatter of its samples; 0 below two samples
/// or without squares.
double film_variance(const Film& film, int channel, std::size_t pixel);
/// Its root.
double film_error(const Film& film, int channel, std::size_t pixel);

/// Adds `from` to `to`, field by field.
void add_tally(const PathTally& from, PathTally& to);

}  // namespace pileus
