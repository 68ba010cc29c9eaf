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
    bool painted = false;  ///< false: grey land
    bool sea = false;
    Buffer<float> albedo;    ///< [plane][level][row][column], rows from the south
    GroundMapView map{};     ///< but for to_column and to_row
    Double3 mean{1, 1, 1};   ///< of the map; without one of the colour, over the ground's albedo
    Buffer<SeaView> facets;  ///< one of a sea
    double even = 0;         ///< share of even light that a sea's facets reflect

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

/// What the ground sends back where its own albedo is `albedo` and the sun's height has this sine.
GroundAlbedo ground_albedo(const GroundLook& look, double albedo, double sine);

/// What kernels need beside the lights. `own`: Ground::albedo; `all`: what `ground_albedo` told;
/// `low_m`, `placement`: of the media; `time_s`: that waves have run.
GroundPaint make_paint(const GroundLook& look, const GroundSurface& surface, double own,
                       const GroundAlbedo& all, const Double3& low_m, const Placement& placement,
                       double time_s);

}  // namespace pileus
