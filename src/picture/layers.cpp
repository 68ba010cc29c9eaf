// SPDX-License-Identifier: Apache-2.0
// See layers.h.
#include "src/picture/layers.h"

#include "src/base/angles.h"

namespace pileus {
namespace {

constexpr const char* kRgb[3] = {"R", "G", "B"};

Status add_channel(Image& image, const std::string& name, Channel*& out) {
    image.channels.emplace_back();
    out = &image.channels.back();
    out->name = name;
    return out->pixels.resize(std::uint64_t(image.width) * std::uint64_t(image.height),
                              name.c_str());
}

Status add_plane(const std::string& name, Span<const float> from, Image& image) {
    Channel* plane = nullptr;
    PILEUS_TRY(add_channel(image, name, plane));
    std::memcpy(plane->pixels.data(), from.data, from.size * sizeof(float));
    return Status::ok();
}

/// Three planes [c][pixel] as R, G, B of a layer.
Status add_three(const char* layer, const float* from, Image& image) {
    const std::size_t pixels = image.channels[0].pixels.size();
    for (std::size_t c = 0; c < 3; ++c)
        PILEUS_TRY(add_plane(std::string(layer) + kRgb[c], {from + c * pixels, pixels}, image));
    return Status::ok();
}

/// Channel c of a layer: what `part` leaves of `whole`.
Status add_rest(const char* layer, std::size_t c, const float* whole, const Buffer<float>& part,
                Image& image) {
    Channel* plane = nullptr;
    PILEUS_TRY(add_channel(image, std::string(layer) + kRgb[c], plane));
    const std::size_t pixels = plane->pixels.size();
    for (std::size_t i = 0; i < pixels; ++i) plane->pixels[i] = whole[i] - part[c * pixels + i];
    return Status::ok();
}

/// sun.*, and what else is told apart: lamp0.*, emission.*; sky.* is what these leave of R G B.
Status add_lights(const Planes& planes, Image& image) {
    const std::size_t three = planes.sun.size();
    std::vector<const float*> parts{planes.sun.data()};
    PILEUS_TRY(add_three("sun.", planes.sun.data(), image));
    for (std::size_t at = 0; at < planes.lamps.size(); at += three) {
        parts.push_back(planes.lamps.data() + at);
        const std::string name = "lamp" + std::to_string(at / three) + ".";
        PILEUS_TRY(add_three(name.c_str(), parts.back(), image));
    }
    if (!planes.emission.empty()) {
        parts.push_back(planes.emission.data());
        PILEUS_TRY(add_three("emission.", parts.back(), image));
    }
    const std::size_t pixels = three / 3;
    for (std::size_t c = 0; c < 3; ++c) {
        Channel* sky = nullptr;
        PILEUS_TRY(add_channel(image, std::string("sky.") + kRgb[c], sky));
        const float* whole = image.channels[c].pixels.data();
        for (std::size_t i = 0; i < pixels; ++i) {
            float left = whole[i];
            for (const float* part : parts) left -= part[c * pixels + i];
            sky->pixels[i] = left;
        }
    }
    return Status::ok();
}

const float* cloud_light(const Planes& planes) {
    return planes.cloud.empty() ? planes.colour.data() : planes.cloud.data();
}

const Buffer<float>& left_of(const Planes& planes) {
    return planes.through.empty() ? planes.transmittance : planes.through;
}

bool finite(float v) { return v - v == 0.0f; }

/// Squared standard error of the mean over the batches of one channel of one pixel.
double batch_variance(const Planes& planes, std::size_t pixel, int channel) {
    const std::size_t pixels = planes.transmittance.size();
    const int batches = planes.batches;
    double mean = 0, square = 0;
    for (int b = 1; b <= batches; ++b)
        mean += double(planes.colour[std::size_t(3 * b + channel) * pixels + pixel]);
    mean /= batches;
    for (int b = 1; b <= batches; ++b) {
        const double d =
            double(planes.colour[std::size_t(3 * b + channel) * pixels + pixel]) - mean;
        square += d * d;
    }
    return square / (double(batches) * (batches - 1));
}

/// Mean of error/radiance and root mean square error over the cloud's pixels, by green.
void summarise(const Image& image, const Planes& p, Report& report) {
    const ErrorSum sum =
        sum_errors(groups_of(p, image.width, image.height), image.find("error.G")->pixels.data(),
                   image.channels[1].pixels.data());
    if (sum.count == 0) return;
    report.errors.known = true;
    report.errors.mean_relative = sum.mean_relative();
    report.errors.rmse_estimate = sum.rms();
}

Status add_radiance(const Planes& planes, Image& image, std::uint64_t& clamped,
                    std::uint64_t& broken) {
    const std::size_t pixels = planes.transmittance.size();
    Channel* plane = nullptr;
    for (std::size_t c = 0; c < 3; ++c) {
        PILEUS_TRY(add_channel(image, kRgb[c], plane));
        for (std::size_t i = 0; i < pixels; ++i) {
            const std::size_t at = c * pixels + i;
            float& v = plane->pixels[i];
            v = planes.colour[at];
            if (!planes.background.empty()) v += planes.transmittance[i] * planes.background[at];
            if (!finite(v)) ++broken;
            if (v < 0) v = 0, ++clamped;
        }
    }
    PILEUS_TRY(add_channel(image, "A", plane));
    const Buffer<float>& left = planes.whole_alpha ? left_of(planes) : planes.transmittance;
    for (std::size_t i = 0; i < pixels; ++i) plane->pixels[i] = 1.0f - left[i];
    return Status::ok();
}

/// Metres to half transmittance, or to something solid before it.
Status add_depth(const Planes& planes, Image& image) {
    Channel* plane = nullptr;
    PILEUS_TRY(add_channel(image, "Z", plane));
    const bool solid = !planes.opaque_depth.empty();
    for (std::size_t i = 0; i < plane->pixels.size(); ++i)
        plane->pixels[i] = solid && planes.opaque_depth[i] < planes.half_depth[i]
                               ? planes.opaque_depth[i]
                               : planes.half_depth[i];
    return Status::ok();
}

Status add_error(const Planes& planes, Image& image) {
    if (!planes.error.empty()) return add_three("error.", planes.error.data(), image);
    const PixelGroups groups = groups_of(planes, image.width, image.height);
    Channel* plane = nullptr;
    for (int c = 0; c < 3; ++c) {
        PILEUS_TRY(add_channel(image, std::string("error.") + kRgb[c], plane));
        const float* light = image.channels[std::size_t(c)].pixels.data();
        ErrorRows rows(groups, Scatter::kBatches, planes.batches);
        rows.run(
            0, image.height, [&](std::size_t i) { return batch_variance(planes, i, c); },
            [&](std::size_t i) { return light[i]; },
            [&](std::size_t i, const PixelError& e) { plane->pixels[i] = e.error; });
    }
    return Status::ok();
}

}  // namespace

PixelGroups groups_of(const Planes& planes, int width, int height) {
    return {width, height, planes.transmittance.data(),
            planes.opaque_depth.empty() ? nullptr : planes.opaque_depth.data()};
}

ErrorSum batch_error_sum(const Planes& planes, int width, int height) {
    ErrorSum sum;
    if (planes.batches < 2) return sum;
    const PixelGroups groups = groups_of(planes, width, height);
    const std::size_t pixels = planes.transmittance.size();
    ErrorRows rows(groups, Scatter::kBatches, planes.batches);
    rows.run(
        0, height, [&](std::size_t i) { return batch_variance(planes, i, 1); },
        [&](std::size_t i) {
            const float behind = planes.background.empty() ? 0.0f : planes.background[pixels + i];
            return planes.colour[pixels + i] + planes.transmittance[i] * behind;
        },
        [&](std::size_t i, const PixelError& e) {
            sum.add(planes.transmittance[i], e.error, e.light);
        });
    return sum;
}

Status allocate_planes(int width, int height, int channels, bool solid, bool depth,
                       Planes& planes) {
    planes.batches = channels > 0 ? channels / 3 - 1 : 0;
    planes.clamped = 0;
    const std::uint64_t pixels = std::uint64_t(width) * std::uint64_t(height);
    const auto fit = [&](std::uint64_t numbers, Buffer<float>& b) {
        return allocate_once(arrays::picture_planes(numbers, pixels), b);
    };
    PILEUS_TRY(fit(1, planes.transmittance));
    PILEUS_TRY(fit(depth ? 1 : 0, planes.half_depth));
    PILEUS_TRY(fit(solid ? 1 : 0, planes.opaque_depth));
    PILEUS_TRY(fit(channels > 0 ? 3 : 0, planes.background));
    return fit(std::uint64_t(channels), planes.colour);
}

Status reserve_depths(const std::array<int, 2>& resolution, bool solid, Planes& planes) {
    const Array<float> plane =
        arrays::picture_planes(1, std::uint64_t(resolution[0]) * std::uint64_t(resolution[1]));
    PILEUS_TRY(planes.half_depth.reserve(plane.count, plane.name));
    return planes.opaque_depth.reserve(solid ? plane.count : 0, plane.name);
}

std::uint64_t extra_layers(const OutputSettings& output, bool has_depth, bool has_error) {
    return (output.layer_cloud ? 3u : 0u) + (has_depth ? 1u : 0u) +
           (output.layer_optical_depth ? 1u : 0u) + (output.layer_transmittance ? 1u : 0u) +
           (output.layer_light ? 6u : 0u) + (output.layer_order ? 6u : 0u) +
           (output.layer_reflectance ? 3u : 0u) + (output.layer_shadow ? 2u : 0u) +
           (output.layer_occlusion ? 1u : 0u) + (has_error ? 3u : 0u);
}

Status add_reflectance(const Lighting& lighting, Image& image) {
    const char* const names[3] = {"reflectance.R", "reflectance.G", "reflectance.B"};
    const double mu0 = lighting.sunlit ? double(lighting.to_sun[2]) : 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const Buffer<float>& radiance = image.channels[c].pixels;
        Buffer<float> share;
        PILEUS_TRY(share.resize(radiance.size(), names[c]));
        const double level = mu0 * lighting.sun_irradiance[c];
        // Nothing is a share of a sun that does not shine.
        const double scale = level > 0 ? kPi64 / level : 0;
        for (std::size_t i = 0; i < share.size(); ++i)
            share[i] = float(scale * double(radiance[i]));
        image.channels.push_back({names[c], std::move(share)});
    }
    return Status::ok();
}

Status make_layers(const Planes& planes, int width, int height, const OutputSettings& output,
                   Image& image, Report& report, std::uint64_t& clamped) {
    image.width = width;
    image.height = height;
    image.channels.clear();
    report.errors = {};
    const bool has_error = output.layer_error && (!planes.error.empty() || planes.batches >= 2);
    const std::size_t lights =
        planes.sun.empty() ? 0
                           : (planes.lamps.size() + planes.emission.size()) * 3 / planes.sun.size();
    image.channels.reserve(4 + std::size_t(extra_layers(output, output.layer_depth, has_error)) +
                           lights);
    std::uint64_t broken = 0;
    PILEUS_TRY(add_radiance(planes, image, clamped, broken));
    if (output.layer_cloud) PILEUS_TRY(add_three("cloud.", cloud_light(planes), image));
    if (output.layer_depth) PILEUS_TRY(add_depth(planes, image));
    if (output.layer_optical_depth)
        PILEUS_TRY(add_plane("tau", planes.optical_depth.span(), image));
    if (output.layer_transmittance) PILEUS_TRY(add_plane("T", left_of(planes).span(), image));
    if (output.layer_light) PILEUS_TRY(add_lights(planes, image));
    if (output.layer_order) {
        const std::size_t pixels = planes.transmittance.size();
        PILEUS_TRY(add_three("single.", planes.single.data(), image));
        for (std::size_t c = 0; c < 3; ++c)
            PILEUS_TRY(
                add_rest("multiple.", c, cloud_light(planes) + c * pixels, planes.single, image));
    }
    if (has_error) {
        PILEUS_TRY(add_error(planes, image));
        summarise(image, planes, report);
    }
    if (!planes.occlusion.empty())
        PILEUS_TRY(add_plane("occlusion", planes.occlusion.span(), image));
    report.counters.emplace_back("nan", broken);
    return Status::ok();
}

}  // namespace pileus
