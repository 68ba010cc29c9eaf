// SPDX-License-Identifier: Apache-2.0
// See develop.h.
// in: a picture -> out: codes.
// docs/exposure.md
#include "src/io/images/develop/develop.h"

#include "src/base/powers.h"
#include "src/io/images/develop/glare.h"
#include "src/io/images/develop/meter.h"
#include "src/io/images/develop/tones.h"
#include "src/io/images/develop/white_balance.h"
#include "src/io/images/image_file.h"
#include "src/io/images/srgb.h"

namespace pileus {
namespace {

/// Light before the exposure: the picture's own planes, or changed ones.
struct Light {
    const float* planes[3];
    std::size_t pixels = 0;
    Buffer<float> changed[3];

    Rgb<float> at(std::size_t i) const { return {planes[0][i], planes[1][i], planes[2][i]}; }
};

void balance(const ColorMatrix& m, Light& light) {
    for (std::size_t i = 0; i < light.pixels; ++i) {
        const Rgb<float> c = light.at(i);
        for (std::size_t k = 0; k < 3; ++k)
            light.changed[k][i] =
                float(m[k][0] * double(c.r) + m[k][1] * double(c.g) + m[k][2] * double(c.b));
    }
}

Status take_light(const Image& image, const ToneSettings& tone, Light& light) {
    const Channel* planes[3];
    PILEUS_TRY(color_channels(image, planes));
    light.pixels = planes[0]->pixels.size();
    const bool balanced = tone.white_k > 0, glared = tone.glare > 0;
    for (std::size_t k = 0; k < 3; ++k) {
        light.planes[k] = planes[k]->pixels.data();
        if (!balanced && !glared) continue;
        PILEUS_TRY(light.changed[k].resize(light.pixels, "developed picture"));
        for (std::size_t i = 0; i < light.pixels && !balanced; ++i)
            light.changed[k][i] = light.planes[k][i];
    }
    if (balanced) balance(white_matrix(tone.white_k), light);
    const double width = double(image.display.width > 0 ? image.display.width : image.width);
    const double height = double(image.display.width > 0 ? image.display.height : image.height);
    for (std::size_t k = 0; k < 3 && (balanced || glared); ++k) {
        light.planes[k] = light.changed[k].data();
        if (glared)
            PILEUS_TRY(add_glare(image.width, image.height, width > height ? width : height,
                                 tone.glare, light.changed[k].span()));
    }
    return Status::ok();
}

Status choose_gain(const Light& light, const ToneSettings& tone, float& gain) {
    gain = exposure_gain(tone.stops);
    if (!tone.automatic) return Status::ok();
    Meter meter;
    PILEUS_TRY(meter.prepare());
    for (std::size_t i = 0; i < light.pixels; ++i) meter.add(light.at(i));
    // Stops count from what was found.
    gain = meter.gain() * (gain / kDaylightGain);
    return Status::ok();
}

}  // namespace

Status tone_map_8bit(const Image& image, const ToneSettings& tone, Buffer<std::uint8_t>& rgb) {
    const bool shown = image.display_colours;
    Light light;
    PILEUS_TRY(take_light(image, shown ? ToneSettings() : tone, light));
    PILEUS_TRY(rgb.resize(std::uint64_t(light.pixels) * 3, "8-bit picture"));
    const SrgbCodes code;
    float gain = 1;
    if (!shown) PILEUS_TRY(choose_gain(light, tone, gain));
    for (std::size_t i = 0; i < light.pixels; ++i) {
        const Rgb<float> c = shown ? light.at(i) : apply_tone(tone.tone, light.at(i), gain);
        rgb[3 * i] = code(c.r);
        rgb[3 * i + 1] = code(c.g);
        rgb[3 * i + 2] = code(c.b);
    }
    return Status::ok();
}

Status measured_stops(const Image& image, const ToneSettings& tone, double& stops) {
    Light light;
    float gain = 0;
    PILEUS_TRY(take_light(image, tone, light));
    PILEUS_TRY(choose_gain(light, tone, gain));
    stops = log2_of(double(gain) / double(kDaylightGain));
    return Status::ok();
}

}  // namespace pileus
