// SPDX-License-Identifier: Apache-2.0
// See layers.h.
#include "src/stages/layers.h"

namespace pileus {
namespace {

Status add_channel(Image& image, const char* name, Channel*& out) {
    image.channels.emplace_back();
    out = &image.channels.back();
    out->name = name;
    return out->pixels.resize(std::uint64_t(image.width) * std::uint64_t(image.height), name);
}

bool finite(float v) { return v - v == 0.0f; }

/// Standard error of the mean over the batches of one channel of one pixel.
float batch_error(const Planes& p, std::size_t pixels, std::size_t pixel, int channel,
                  int batches) {
    double mean = 0, square = 0;
    for (int b = 1; b <= batches; ++b)
        mean += double(p.colour[std::size_t(3 * b + channel) * pixels + pixel]);
    mean /= batches;
    for (int b = 1; b <= batches; ++b) {
        const double d = double(p.colour[std::size_t(3 * b + channel) * pixels + pixel]) - mean;
        square += d * d;
    }
    return float(__builtin_sqrt(square / (double(batches) * (batches - 1))));
}

/// Mean of error/radiance and root mean square error over the cloud's pixels, by green.
void summarise(const Image& image, const Planes& p, Report& report) {
    const Channel* error = image.find("error.G");
    if (error == nullptr) return;
    double relative = 0, square = 0, count = 0;
    const std::size_t pixels = error->pixels.size();
    for (std::size_t i = 0; i < pixels; ++i) {
        if (1.0f - p.transmittance[i] <= 0.02f) continue;
        const double e = double(error->pixels[i]), r = double(image.channels[1].pixels[i]);
        relative += r > 0 ? e / r : 0;
        square += e * e;
        count += 1;
    }
    if (count == 0) return;
    report.has_error = true;
    report.mean_relative = relative / count;
    report.rmse_estimate = __builtin_sqrt(square / count);
}

}  // namespace

Status allocate_planes(int width, int height, int channels, bool solid, bool depth,
                       Planes& planes) {
    const std::uint64_t pixels = std::uint64_t(width) * std::uint64_t(height);
    const auto fit = [](Buffer<float>& b, std::uint64_t n, const char* name) {
        return b.size() == n ? Status::ok() : b.resize(n, name);
    };
    PILEUS_TRY(fit(planes.transmittance, pixels, "transmittance"));
    PILEUS_TRY(fit(planes.half_depth, depth ? pixels : 0, "depth"));
    PILEUS_TRY(fit(planes.opaque_depth, solid ? pixels : 0, "opaque depth"));
    PILEUS_TRY(fit(planes.background, 3 * pixels, "background"));
    return fit(planes.colour, std::uint64_t(channels) * pixels, "radiance");
}

Status make_layers(const Planes& planes, int width, int height, int channels,
                   const OutputSettings& output, Image& image, Report& report,
                   std::uint64_t& clamped) {
    image.width = width;
    image.height = height;
    image.channels.clear();
    image.channels.reserve(16);
    const std::size_t pixels = std::size_t(width) * std::size_t(height);
    static const char* const kColour[3] = {"R", "G", "B"};
    static const char* const kCloud[3] = {"cloud.R", "cloud.G", "cloud.B"};
    static const char* const kError[3] = {"error.R", "error.G", "error.B"};
    std::uint64_t broken = 0;
    Channel* plane = nullptr;
    for (int c = 0; c < 3; ++c) {
        PILEUS_TRY(add_channel(image, kColour[c], plane));
        for (std::size_t i = 0; i < pixels; ++i) {
            const std::size_t at = std::size_t(c) * pixels + i;
            float& v = plane->pixels[i];
            v = planes.colour[at] + planes.transmittance[i] * planes.background[at];
            if (!finite(v)) ++broken;
            if (v < 0) v = 0, ++clamped;
        }
    }
    PILEUS_TRY(add_channel(image, "A", plane));
    for (std::size_t i = 0; i < pixels; ++i) plane->pixels[i] = 1.0f - planes.transmittance[i];
    if (output.layer_cloud)
        for (int c = 0; c < 3; ++c) {
            PILEUS_TRY(add_channel(image, kCloud[c], plane));
            std::memcpy(plane->pixels.data(), planes.colour.data() + std::size_t(c) * pixels,
                        pixels * sizeof(float));
        }
    if (output.layer_depth) {
        PILEUS_TRY(add_channel(image, "Z", plane));
        const bool solid = !planes.opaque_depth.empty();
        for (std::size_t i = 0; i < pixels; ++i)
            plane->pixels[i] = solid && planes.opaque_depth[i] < planes.half_depth[i]
                                   ? planes.opaque_depth[i]
                                   : planes.half_depth[i];
    }
    const int batches = channels / 3 - 1;
    if (output.layer_error && batches >= 2) {
        for (int c = 0; c < 3; ++c) {
            PILEUS_TRY(add_channel(image, kError[c], plane));
            for (std::size_t i = 0; i < pixels; ++i)
                plane->pixels[i] = batch_error(planes, pixels, i, c, batches);
        }
        summarise(image, planes, report);
    }
    report.counters.emplace_back("nan", broken);
    return Status::ok();
}

}  // namespace pileus
