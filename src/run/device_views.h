// SPDX-License-Identifier: Apache-2.0
// What the structs of several launches have in common: views of arrays, copied to a device.
// in: a view with the host's pointers -> out: the same with those of the device.
// docs/crosscheck.md
#pragma once
#include "kernels_cpu/display/march_params.h"
#include "kernels_cpu/light/sky_sample.h"
#include "kernels_cpu/light/sun_heights_params.h"
#include "kernels_cpu/media/track_grid.h"
#include "kernels_cpu/procedural/sky_params.h"
#include "kernels_cpu/solids/solids_params.h"
#include "src/run/device_arrays.h"

namespace pileus {

using DeviceSize = std::uint64_t;

inline DeviceSize product(const std::int32_t (&n)[3]) {
    return DeviceSize(n[0]) * DeviceSize(n[1]) * DeviceSize(n[2]);
}
/// Numbers of scratch that a launch has at most, and the items that it then takes at once, each of
/// which has a share.
constexpr DeviceSize kMaxScratch = DeviceSize{1} << 26;
inline std::uint32_t items_at_once(std::uint32_t count, DeviceSize share) {
    const DeviceSize most = kMaxScratch / share;
    return most < 1 ? 1 : (most < count ? std::uint32_t(most) : count);
}

inline DeviceSize pixels_in(const CameraParams& c) {
    return DeviceSize(c.width) * DeviceSize(c.height);
}
inline DeviceSize pixels_in(const PixelLattice& g) {
    return DeviceSize(g.width) * DeviceSize(g.height);
}

/// Numbers of all media but the first, `voxels` each.
inline DeviceSize other_media(std::int32_t media, DeviceSize voxels) {
    return media > 1 ? DeviceSize(media - 1) * voxels : 0;
}

void add_grid(DeviceArrays& a, TrackGrid& grid);
/// With its detail, where it has any.
void add_medium(DeviceArrays& a, MediumView& medium);
/// For kernels that ask a medium for its box alone.
void add_box(MediumView& medium);
void add_sky(DeviceArrays& a, SkyMapView& map);
void add_heights(DeviceArrays& a, SunHeights& heights);
void add_solids(DeviceArrays& a, SolidsView& solids);
void add_paint(DeviceArrays& a, GroundPaint& paint);
void add_layer(DeviceArrays& a, SkyParams& sky);
void add_background(DeviceArrays& a, BackgroundParams& k, BackgroundBuffers& b);

}  // namespace pileus
