// SPDX-License-Identifier: Apache-2.0
// See verify.h.
// in: a picture -> out: figures over stratified pixels of the media.
// docs/report.md, "Verify"
#include "src/session/verify.h"

#include "kernels_cpu/core/rng.h"
#include "src/base/random_streams.h"
#include "src/io/volumes/weather_file.h"
#include "src/picture/air_view.h"
#include "src/scene/read_scene.h"
#include "src/world/medium/detail.h"
#include "src/world/place_scene.h"

namespace pileus {
namespace {

/// For each pixel. Noise of 1000 paths is some per cent of a pixel: less than pixels differ by.
constexpr std::uint32_t kSamples = 1024;
constexpr float kMinAlpha = 0.02f;

/// One of each of `wanted` equal runs of the shown pixels that show media, row by row; all where
/// they are no more.
std::vector<std::uint32_t> choose_pixels(const Image& image, const Shown& shown,
                                         std::uint64_t wanted, std::uint64_t seed) {
    std::vector<std::uint32_t> seen, chosen;
    const Channel* alpha = image.find("A");
    if (alpha == nullptr) return chosen;
    for (std::size_t i = 0; i < alpha->pixels.size(); ++i) {
        const std::size_t width = std::size_t(image.width);
        if (alpha->pixels[i] > kMinAlpha && shown.holds(int(i % width), int(i / width)))
            seen.push_back(std::uint32_t(i));
    }
    if (seen.size() <= wanted) return seen;
    const Key key = make_key(seed, kVerifiedStream, 0);
    const std::uint64_t count = seen.size();
    for (std::uint64_t i = 0; i < wanted; ++i) {
        const std::uint64_t begin = i * count / wanted, end = (i + 1) * count / wanted;
        const std::uint32_t word = threefry(key.k0, key.k1, std::uint32_t(i), 0u).a;
        chosen.push_back(seen[std::size_t(begin + ((end - begin) * word >> 32))]);
    }
    return chosen;
}

/// What the layer of errors has to say of the differences: what of them is noise, and how many it
/// covers.
void judge_errors(const Image& image, const std::vector<std::uint32_t>& pixels,
                  const std::vector<PixelLight>& paths, double least, VerifyFigures& out) {
    const char* const names[3] = {"R", "G", "B"};
    const double numbers = 3 * double(pixels.size());
    for (std::size_t c = 0; c < 3; ++c) {
        const Channel* plane = image.find(names[c]);
        const Channel* error = image.find((std::string("error.") + names[c]).c_str());
        if (error == nullptr) return;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const double m = paths[i].mean[c], e = double(error->pixels[pixels[i]]);
            const double d = double(plane->pixels[pixels[i]]) - m;
            const double square = e * e + paths[i].square_error[c];
            out.noise += e * e / ((m * m + least) * numbers);
            out.within[0] += (d * d <= square ? 1 : 0) / numbers;
            out.within[1] += (d * d <= 4 * square ? 1 : 0) / numbers;
        }
    }
    out.has_errors = true;
    const double rest = out.relmse - out.noise;
    out.bias_rms = rest > 0 ? __builtin_sqrt(rest) : 0;
}

/// Differences of pixels, channels one by one.
VerifyFigures compare_pixels(const Image& image, const std::vector<std::uint32_t>& pixels,
                             const std::vector<PixelLight>& paths) {
    const char* const names[3] = {"R", "G", "B"};
    const Channel* planes[3];
    for (int c = 0; c < 3; ++c) planes[c] = image.find(names[c]);
    const double n = double(pixels.size());
    double reference = 0, sum = 0, square = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        // The channels of a pixel err together: a pixel counts as one.
        double d = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            d += (double(planes[c]->pixels[pixels[i]]) - paths[i].mean[c]) / 3;
            reference += paths[i].mean[c] / (3 * n);
        }
        sum += d;
        square += d * d;
    }
    VerifyFigures out;
    out.pixels = pixels.size();
    if (!(reference > 0)) return out;
    const double mean = sum / n, spread = square / n - mean * mean;
    out.bias = mean / reference;
    if (pixels.size() > 1 && spread > 0)
        out.standard_error = __builtin_sqrt(spread / (n - 1)) / reference;
    const double least = 1e-4 * reference * reference;
    for (std::size_t i = 0; i < pixels.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const double m = paths[i].mean[c], d = double(planes[c]->pixels[pixels[i]]) - m;
            out.relmse += (d * d - paths[i].square_error[c]) / ((m * m + least) * 3 * n);
        }
    judge_errors(image, pixels, paths, least, out);
    return out;
}

}  // namespace

Status Verifier::open(const Scene& scene, const FrameState& frame, std::uint64_t pixels,
                      const Context& context, std::shared_ptr<const World> world) {
    if (context.kernels->device != nullptr)
        return Status::bad_input("--verify: not on a device, allowed: an --isa of the host");
    if (world->direct_sky)
        return Status::bad_input(scene.file +
                                 ": --verify: paths need the sky on a grid, allowed: "
                                 "medium.0.sky.evaluate = \"grid\"");
    PILEUS_TRY(refuse_marched_detail(scene, "--verify"));
    pixels_ = pixels;
    scene_ = scene;
    static_cast<FrameState&>(scene_) = frame;
    scenery_.weather = make_weather_files();
    PILEUS_TRY(place_scene(scene_, scenery_.weather.get()));
    rest_ = scene_;
    place(frame.world.sequence_frame);
    const MethodRow row = path_row();
    own_paths_ = scene.method == row.name;
    scene_.method = row.name;
    scene_.output = OutputSettings{};
    if (!own_paths_) {
        // Other methods look through the middles of pixels, and aim at all orders of scattering.
        scene_.path = PathSettings{};
        scene_.path.centre = true;
    }
    // Paths one by one: none is below 0, which pictures would show as 0.
    scene_.path.importance = ImportanceUse::kOff;
    scenery_.show(scene_, rest_);
    // Paths know particles on a grid alone, one finer than shadows ask for.
    if (world->shows_particles) world = nullptr;
    // Of a film there is but what is behind its light.
    path_ = &make_path({scene_, {}, true}, made_);
    return open_method(row, made_, context, true, nullptr, std::move(world), scenery_, plan_);
}

/// Moves the scene to a frame, where keys do.
void Verifier::place(int frame) {
    if (!scene_.animation.keys.empty()) place_at_frame(rest_, frame, scene_);
}

/// Lights, camera and noise of a frame.
Status Verifier::set_view(int frame, const Context& context) {
    scenery_.light(frame);
    return path_->set_view(context, scenery_.view(frame), {});
}

/// As the picture's method has it: by where the media and what is solid are along each ray.
Status Verifier::see_through_air(int frame, const Context& context,
                                 const std::vector<std::uint32_t>& pixels,
                                 std::vector<PixelLight>& paths) {
    PILEUS_TRY(path_->begin(context, scenery_.view(frame)));
    Planes& planes = path_->planes();
    const std::size_t all = planes.transmittance.size();
    Buffer<float> light, straight, dimmed;
    for (Buffer<float>* b : {&light, &straight, &dimmed})
        PILEUS_TRY(b->resize(3 * all, "verified picture"));
    for (std::size_t i = 0; i < pixels.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            straight[c * all + pixels[i]] = float(paths[i].straight[c]);
            light[c * all + pixels[i]] = float(paths[i].mean[c] - paths[i].straight[c]);
        }
    PILEUS_TRY(run_air(context, scene_, scenery_.world->medium, scenery_.lighting,
                       path_->state().camera, scenery_.environment, planes,
                       {light.data(), straight.data(), dimmed.data(), true}));
    for (std::size_t i = 0; i < pixels.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t at = c * all + pixels[i];
            paths[i].mean[c] = double(light[at]) + double(straight[at]);
            paths[i].square_error[c] *= double(dimmed[at]) * double(dimmed[at]);
        }
    return Status::ok();
}

Status Verifier::check(int frame, const Context& context, const Image& image, const Shown& shown,
                       Report& report) {
    report.verify = {};
    place(frame);
    if (is_sequence(scene_.view_files.depth)) {
        rest_.world.sequence_frame = scene_.world.sequence_frame = frame;
        PILEUS_TRY(load_environment(scene_, context, scenery_.environment));
    }
    PILEUS_TRY(set_view(frame, context));
    PathInput in = path_->input(context, scenery_.view(frame));
    in.ended = context.interrupted;
    const std::vector<std::uint32_t> pixels = choose_pixels(image, shown, pixels_, in.seed);
    if (pixels.empty()) return Status::ok();
    const std::uint32_t most = most_pixel_samples(in);
    const std::uint32_t samples = kSamples < most ? kSamples : most < 2 ? 2 : most;
    std::vector<PixelLight> paths;
    bool ended = false;
    {
        const StageClock clock(context, "verify");
        PILEUS_TRY(trace_pixels(in, pixels, samples, path_->scratch(), paths, ended));
    }
    if (ended) return Status::ok();
    if (scenery_.lighting.air) PILEUS_TRY(see_through_air(frame, context, pixels, paths));
    report.verify = compare_pixels(image, pixels, paths);
    report.verify.samples = samples;
    return Status::ok();
}

}  // namespace pileus
