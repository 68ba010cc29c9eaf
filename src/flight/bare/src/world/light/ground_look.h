// SPDX-License-Identifier: Apache-2.0
// In place of the header of the same path: the ground of a flight is grey land. docs/flight.md
#pragma once
#include "kernels_cpu/light/ground_params.h"
#include "src/run/context.h"
#include "src/scene/scene.h"

namespace pileus {

struct GroundLook {
    std::uint64_t reading = 0;
    std::uint64_t bytes() const { return 0; }
};

struct GroundAlbedo {
    double even = 0, sun = 0;
};

struct GroundStand {
    Double3 low_m{}, extent_m{};
    Placement placement;
    double top_m = 0;
};

inline Status make_ground_look(const Scene&, const Context&, GroundLook&) { return Status::ok(); }
inline GroundAlbedo ground_albedo(const GroundLook&, double albedo, const GroundStand&, double) {
    return {albedo, albedo};
}
inline GroundPaint make_paint(const GroundLook&, double, const GroundAlbedo&, const GroundStand&,
                              double) {
    return {};
}

}  // namespace pileus
