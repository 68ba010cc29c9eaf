// SPDX-License-Identifier: Apache-2.0
// What of a scene only trace_paths_full knows: asked by whoever chooses a kernel, and by the
// kernel. in: parameters of a launch -> out: whether it has lamps, a sun to be sought, solids.
// docs/path.md
#pragma once
#include "kernels_cpu/core/meshes.h"
#include "kernels_cpu/core/profile.h"
#include "kernels_cpu/path/path_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Lamps, or media that emit.
PILEUS_FN bool has_lamps(const PathParams& k) {
    return kLights && (k.lamp_count > 0 || k.emits != 0);
}

/// Paths are guided to the sun, or it is a disc.
PILEUS_FN bool seeks_sun(const PathParams& k) { return k.guide.on != 0 || k.sun_disc > 0; }

/// Solids, or the camera's image of them.
PILEUS_FN bool ends_at_solids(const PathParams& k) {
    return has_meshes(k.solids) || k.camera_depth != nullptr;
}

/// Whether paths need trace_paths_full, not trace_paths.
PILEUS_FN bool needs_full(const PathParams& k) {
    return has_lamps(k) || seeks_sun(k) || ends_at_solids(k);
}

/// What a kernel has beside media, sun, sky and ground: bits of the template argument K. Of that
/// the parameters tell what the scene needs.
constexpr int kAmongSolids = 1;  ///< flights end at solids and at the camera's image of them
constexpr int kSeekingSun = 2;   ///< paths are guided to the sun, which may be a disc
constexpr int kLitByLamps = 4;   ///< there are point, spot or parallel lights
template <int K>
constexpr bool kSolid = (K & kAmongSolids) != 0;
template <int K>
constexpr bool kGuided = (K & kSeekingSun) != 0;
template <int K>
constexpr bool kLamps = (K & kLitByLamps) != 0;

template <int K>
PILEUS_FN bool minds_lamps(const PathParams& k) {
    return kLamps<K> && has_lamps(k);
}
/// Among lamps the guide's rules hold without a guide, too: a sun below the ground's horizon is
/// dark.
template <int K>
PILEUS_FN bool minds_sun(const PathParams& k) {
    return kGuided<K> && (seeks_sun(k) || has_lamps(k));
}
template <int K>
PILEUS_FN bool minds_solids(const PathParams& k) {
    return kSolid<K> && ends_at_solids(k);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
