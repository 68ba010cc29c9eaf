// SPDX-License-Identifier: Apache-2.0
// Checks every value of a sky map.
// in: a picture -> out: planes of radiance above the horizon.
// docs/formats.md "Sky maps in".
#include "src/world/light/sky_map.h"

#include "src/base/number_text.h"
#include "src/io/images/image_file.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {
namespace {

/// Copies the first `rows` rows of a channel, scaled; the first value that is no radiance is a
/// fault.
Status take_plane(const std::string& name, const Image& image, const Channel& from, int rows,
                  double scale, Span<float> to) {
    const std::size_t width = std::size_t(image.width);
    for (std::size_t i = 0; i < from.pixels.size(); ++i) {
        const float v = from.pixels[i];
        const double scaled = double(v) * scale;
        if (!(v >= 0) || !(scaled <= kMaxSkyRadiance))
            return Status::bad_input(name + ": pixel " + std::to_string(i % width) + ' ' +
                                     std::to_string(i / width) + ": " + from.name +
                                     ": no radiance, " + number_text(double(v)) +
                                     ", allowed: 0 to 1e30 after sky.map_scale");
        if (i / width < std::size_t(rows))
            to.at(i) = scaled < kMinSkyRadiance ? 0.0f : float(scaled);
    }
    return Status::ok();
}

std::int32_t highest_bit_below(std::int32_t count) {
    std::int32_t bit = 1;
    while (bit * 2 < count) bit *= 2;
    return count > 1 ? bit : 0;
}

}  // namespace

Status make_sky_map(const std::string& name, const Image& image, const Sky& sky, bool ground,
                    SkyMap& map) {
    const Channel* rgb[3];
    if (const Status found = color_channels(image, rgb); !found)
        return Status::bad_input(name + ": " + found.message);
    // A row that the horizon cuts is kept whole: only its upper half shines.
    const int rows = ground ? (image.height + 1) / 2 : image.height;
    const std::size_t plane = std::size_t(rows) * std::size_t(image.width);
    PILEUS_TRY(map.radiance.resize(3 * plane, "sky map"));
    for (std::size_t c = 0; c < 3; ++c)
        PILEUS_TRY(take_plane(name, image, *rgb[c], rows, sky.map_scale,
                              map.radiance.span().part(c * plane, plane)));
    // Three equal planes are one.
    float* first = map.radiance.data();
    const bool grey = std::memcmp(first, first + plane, plane * sizeof(float)) == 0 &&
                      std::memcmp(first, first + 2 * plane, plane * sizeof(float)) == 0;
    if (grey) {
        Buffer<float> one;
        PILEUS_TRY(one.resize(plane, "sky map"));
        std::memcpy(one.data(), first, plane * sizeof(float));
        map.radiance.swap(one);
    }
    map.size = {image.width, image.height};
    map.rotation_deg = sky.map_rotation_deg;
    SkyMapView& v = map.view;
    v.rows = rows;
    v.columns = image.width;
    v.planes = grey ? 1 : 3;
    v.row_bit = highest_bit_below(rows);
    v.column_bit = highest_bit_below(image.width);
    v.foot = ground ? 0.5f * float(image.height) : float(image.height);
    v.rows_per_turn = 2.0f * float(image.height);
    v.turn_of_first = float(sky.map_rotation_deg / 360.0 - 0.5);
    v.radiance = map.radiance.data();
    light_ground(map);
    return Status::ok();
}

}  // namespace pileus
