// SPDX-License-Identifier: Apache-2.0
// See whole_rays.h.
#include "src/picture/whole_rays.h"

#include <algorithm>

namespace pileus {
namespace {

/// What no alpha of a file is off by: where light ends that no eye misses.
constexpr double kMinAlpha = 1e-4;

bool shows_data(const OutputSettings& output) {
    return output.layer_optical_depth || output.layer_transmittance;
}

/// Of a thinned picture alpha is filled in as its colours are.
bool needs_alpha(const RayEnds& ends) { return !ends.thinned && ends.stop_below > kMinAlpha; }

/// Empty planes of the picture's size. Rays that need no second march are hidden at once.
Status allocate_rays(const Planes& of, const std::vector<char>& ended, Planes& out) {
    const std::size_t pixels = of.transmittance.size();
    const auto fit = [&](std::uint64_t numbers, Buffer<float>& b) {
        return allocate(arrays::picture_planes(numbers, pixels), b);
    };
    PILEUS_TRY(fit(1, out.transmittance));
    PILEUS_TRY(fit(3, out.colour));
    PILEUS_TRY(fit(of.half_depth.empty() ? 0 : 1, out.half_depth));
    PILEUS_TRY(fit(of.optical_depth.empty() ? 0 : 1, out.optical_depth));
    PILEUS_TRY(fit(1, out.opaque_depth));
    for (std::size_t i = 0; i < pixels; ++i) {
        const float solid = of.opaque_depth.empty() ? __builtin_inff() : of.opaque_depth[i];
        out.opaque_depth[i] = ended[i] != 0 ? solid : 0.0f;
    }
    return Status::ok();
}

}  // namespace

bool follows_rays(const OutputSettings& output, const RayEnds& ends) {
    if (shows_data(output)) return ends.thinned || ends.stop_below > 0;
    return needs_alpha(ends) || (output.layer_depth && ends.stop_below > 0.5);
}

std::uint64_t whole_ray_planes(const OutputSettings& output, const RayEnds& ends, bool depth) {
    if (!follows_rays(output, ends)) return 0;
    return 6 + (depth ? 1u : 0u) + (output.layer_optical_depth ? 1u : 0u);
}

Status follow_rays(const OutputSettings& output, const RayEnds& ends,
                   const std::function<Status(Planes&)>& march, Planes& planes) {
    planes.through.truncate(0);
    // Whatever layers there are.
    planes.whole_alpha = needs_alpha(ends);
    if (!follows_rays(output, ends)) return Status::ok();
    const std::size_t pixels = planes.transmittance.size();
    std::vector<char> ended(pixels, 1);
    if (!ends.thinned) {
        // In the kernel's own precision.
        const float stop = float(ends.stop_below);
        for (std::size_t i = 0; i < pixels; ++i) ended[i] = planes.transmittance[i] < stop ? 1 : 0;
        if (std::find(ended.begin(), ended.end(), 1) == ended.end()) return Status::ok();
    }
    Planes whole;
    PILEUS_TRY(allocate_rays(planes, ended, whole));
    PILEUS_TRY(march(whole));
    PILEUS_TRY(allocate(arrays::picture_planes(1, pixels), planes.through));
    for (std::size_t i = 0; i < pixels; ++i) {
        planes.through[i] = ended[i] != 0 ? whole.transmittance[i] : planes.transmittance[i];
        if (ended[i] == 0) continue;
        if (!planes.optical_depth.empty()) planes.optical_depth[i] = whole.optical_depth[i];
        // Else it was met before the ray ended.
        if (!planes.half_depth.empty() && ends.stop_below > 0.5)
            planes.half_depth[i] = whole.half_depth[i];
    }
    return Status::ok();
}

}  // namespace pileus
