// SPDX-License-Identifier: Apache-2.0
// A sky from an image: radiance per texel, and the tables from which photons are drawn.
// in: a latitude-longitude picture, the medium's box -> out: SkyMapView, power, light on the
// ground. docs/methods.md 3 "Sky map"; docs/scene.md "Sky map" has the directions.
#pragma once
#include <array>

#include "kernels_cpu/light/sky_map.h"
#include "src/base/buffer.h"
#include "src/io/images/image.h"
#include "src/scene/scene.h"

namespace pileus {

constexpr std::uint64_t kMaxSkyTexels = std::uint64_t{1} << 26;
constexpr double kMaxSkyRadiance = 1e30;   ///< what is larger is refused
constexpr double kMinSkyRadiance = 1e-30;  ///< what is smaller counts as 0

/// `view` points into the buffers and stays valid while they live, also when the whole is moved.
struct SkyMap {
    std::array<int, 2> size{0, 0};  ///< columns, rows; 0: no map
    double rotation_deg = 0;
    Buffer<float> radiance;  ///< [plane][row][column], scaled; only rows that shine
    Buffer<std::int32_t> row_cdf, column_cdf;
    Buffer<float> row_bound, column_bound;
    SkyMapView view{};
    double power_m2 = 0;  ///< flux into the box, each texel counted by its brightest channel, W
    Double3 ground_irradiance{};  ///< on a level plane without media

    bool present() const { return size[0] > 0; }
    std::uint64_t bytes() const {
        return radiance.bytes() + row_cdf.bytes() + column_cdf.bytes() + row_bound.bytes() +
               column_bound.bytes();
    }
};

/// Reads the picture of the scene's sky.map. Errors: as load_sky_map's.
Status read_sky_image(const Scene& scene, Image& image);

/// Reads the scene's sky.map, if it has one. `map` is left without a size where it has none.
/// Missing or malformed file, a value below 0, above 1e30 or not finite: kBadInput, with the pixel;
/// more than 2^26 pixels or than memory: kLimit; failed half way: kIo.
Status load_sky_map(const Scene& scene, SkyMap& map);

/// The same from a picture in memory; `name` opens the messages. With a ground only the rows above
/// the horizon are kept.
Status make_sky_map(const std::string& name, const Image& image, const Sky& sky, bool ground,
                    SkyMap& map);

/// Fills `ground_irradiance`, as make_sky_map has it: of the upper half, so with a ground of the
/// rows that are kept.
void light_ground(SkyMap& map);

/// Fills the tables and powers for a box with edges `extent_m`, or for the top and bottom of a
/// periodic one alone. Out of memory: kLimit.
Status aim_sky_map(const double (&extent_m)[3], bool periodic, SkyMap& map);

/// Cumulative powers in units of 2^-31 of their sum: no texel, however many, is off by more than
/// one unit. Returns the sum. Entries behind the last one with power cannot be drawn.
double fill_cdf(const double* power, int count, std::int32_t* cdf);

}  // namespace pileus
