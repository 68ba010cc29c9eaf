// SPDX-License-Identifier: Apache-2.0
// The ground's surface ready for kernels: a map of its albedo with coarser levels, tables of a sea.
// in: [ground] of a scene -> out: GroundPaint; mean albedos that media are lit by. docs/ground.md
#pragma once
#include "kernels_cpu/light/ground_params.h"
#include "src/base/buffer.h"
#include "src/io/images/image.h"
#include "src/run/context.h"
#include "src/scene/scene.h"

namespace pileus {

constexpr std::uint64_t kMaxGroundTexels = std::uint64_t{1} << 26;

/// Made once for a scene, then read only; paints point into it.
struct GroundLook {
    GroundSurface surface;
    Buffer<float> albedo;       ///< [plane][level][row][column], rows from the south
    GroundMapView map{};        ///< but for to_column and to_row
    std::uint64_t reading = 0;  ///< bytes of the map's picture and file while they were read
    Buffer<SeaView> facets;     ///< one of a sea
    double even = 0;            ///< share of even light that a sea's facets reflect

    std::uint64_t bytes() const { return albedo.bytes() + facets.bytes(); }
};

/// Light on the ground that goes on, in all, of even light and of a sun.
struct GroundAlbedo {
    double even = 0, sun = 0;
};

/// Reads the map, if there is one, and makes the tables. kBadInput: a number below 0, above 1 or
/// none, with its pixel, and the readers' faults; kLimit.
Status make_ground_look(const Scene& scene, const Context& context, GroundLook& look);

/// The same of a map in memory; `name` opens the messages.
Status make_ground_map(const std::string& name, const Image& image, const GroundSurface& surface,
                       GroundLook& look);

/// Facets under a wind, m/s, by Cox and Munk (1954): the mean square slope of a clean surface.
SeaView make_sea(double wind_m_s);

/// Where media stand on the ground: box-local, their placement in the world, and how high they
/// reach above it.
struct GroundStand {
    Double3 low_m{}, extent_m{};
    Placement placement;
    double top_m = 0;
};

/// What the ground sends back where its own albedo is `own` and the sun's height has this sine: of
/// a map the mean below the media and as far around them as they are high.
GroundAlbedo ground_albedo(const GroundLook& look, double own, const GroundStand& stand,
                           double sine);

/// What kernels need beside the lights. `own`: Ground::albedo; `all`: what `ground_albedo` told;
/// `time_s`: that waves have run.
GroundPaint make_paint(const GroundLook& look, double own, const GroundAlbedo& all,
                       const GroundStand& stand, double time_s);

}  // namespace pileus
