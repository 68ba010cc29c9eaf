// SPDX-License-Identifier: Apache-2.0
// pileus.h: how far one picture is from another.
#include "lab/compare/flip.h"
#include "lab/compare/metrics.h"
#include "src/api/c_types.h"
#include "src/io/images/image_file.h"
#include "src/scene/number_keys.h"

namespace pileus::api {
namespace {

/// A caller's pixels as planes.
Status take_picture(const pileus_picture* given, const char* name, Image& image) {
    pileus_picture p;
    if (!take(given, p)) return no_struct(name);
    const std::string where = std::string(name) + ".";
    for (const std::uint32_t n : {p.width, p.height})
        PILEUS_TRY(check_number(where.c_str(), "size", n, {1, kMaxImageSide}));
    if (p.channels != 3 && p.channels != 4)
        return Status::bad_input(where + "channels: " + std::to_string(p.channels) +
                                 ", allowed: 3 (R G B), 4 (R G B A)");
    if (p.values == nullptr) return Status::bad_input(where + "values: null, allowed: pixels");
    Rows rows;
    // Read only: rows are shared with those that are written.
    rows.first = reinterpret_cast<unsigned char*>(const_cast<float*>(p.values));
    const std::size_t width = p.width, channels = p.channels;
    PILEUS_TRY(take_stride(name, p.stride, std::int64_t(width * channels * sizeof(float)), p.height,
                           rows));
    image.width = int(p.width);
    image.height = int(p.height);
    image.channels.resize(channels);
    for (std::size_t c = 0; c < channels; ++c) {
        image.channels[c].name = std::string(1, "RGBA"[c]);
        Buffer<float>& plane = image.channels[c].pixels;
        PILEUS_TRY(plane.resize(width * p.height, name));
        for (std::size_t y = 0; y < p.height; ++y) {
            const unsigned char* row = rows.row(int(y), image.height);
            for (std::size_t x = 0; x < width; ++x)
                std::memcpy(&plane[y * width + x], row + (x * channels + c) * sizeof(float),
                            sizeof(float));
        }
    }
    return Status::ok();
}

pileus_figures figures_of(const Metrics& m) {
    pileus_figures out{};
    out.identical = m.identical ? 1 : 0;
    out.pixels = m.pixels;
    out.cloud_pixels = m.cloud_pixels;
    out.not_finite = m.not_finite;
    out.mean = m.mean_a;
    out.mean_reference = m.mean_reference;
    out.rmse = m.rmse;
    out.relmse = m.relmse;
    out.relmse_trimmed = m.relmse_trimmed;
    out.bias = m.bias;
    out.largest = m.largest;
    out.largest_at[0] = std::uint32_t(m.largest_x);
    out.largest_at[1] = std::uint32_t(m.largest_y);
    out.percentile_999 = m.percentile_999;
    out.relative_percentile_999 = m.relative_percentile_999;
    out.flip = out.flip_percentile_99 = out.flip_largest = kNotKnown;
    return out;
}

}  // namespace
}  // namespace pileus::api

using namespace pileus;
using namespace pileus::api;

extern "C" {

pileus_code pileus_compare(const pileus_picture* a, const pileus_picture* reference,
                           double alpha_least, int32_t with_flip, const pileus_host* host,
                           pileus_figures* figures, pileus_error* error) {
    return call_with(host, error, [&](const auto&, const RenderOptions& options) -> Status {
        if (!(alpha_least <= 1))
            return Status::bad_input("alpha_least: " + std::to_string(alpha_least) +
                                     ", allowed: at most 1; below 0: all pixels");
        Image images[2];
        PILEUS_TRY(take_picture(a, "a", images[0]));
        PILEUS_TRY(take_picture(reference, "reference", images[1]));
        PILEUS_TRY(check_same_size("a", images[0], images[1]));
        MetricOptions how;
        how.alpha_least = alpha_least;
        Metrics metrics;
        PILEUS_TRY(compare_images(images[0], images[1], how, metrics));
        pileus_figures out = figures_of(metrics);
        if (with_flip != 0) {
            FlipOptions seen;
            seen.threads = options.threads;
            FlipResult result;
            PILEUS_TRY(flip(images[0], images[1], seen, result));
            out.flip = result.mean;
            out.flip_percentile_99 = result.percentile_99;
            out.flip_largest = result.largest;
        }
        return give(out, figures, "figures");
    });
}

}  // extern "C"
