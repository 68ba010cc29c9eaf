// SPDX-License-Identifier: Apache-2.0
// Settings of method path, and of the filter of noisy pictures.
// in: keys of [method.path] and [method.filter] -> out: plain values. docs/scene.md
#pragma once
#include <cstdint>

namespace pileus {

/// Whether discrete ordinates split paths and end them: by what the scene gains, where they know
/// it, never.
enum class ImportanceUse { kAuto, kOn, kOff };

struct PathSettings {
    std::int64_t samples_per_pixel = 64;
    int max_depth = 0;        ///< scatterings after which light is not followed; 0: unlimited
    bool centre = false;      ///< pixel = "centre": rays through the middles of pixels only
    double target_error = 0;  ///< mean relative standard error to reach; 0: none
    std::int64_t max_samples_per_pixel = 65536;  ///< where an error or a time decides
    bool guide = true;  ///< a peaked phase function's light is also sought from near the sun
    ImportanceUse importance = ImportanceUse::kAuto;
};

enum class FilterKind { kNone, kRegression, kOidn };

/// What makes a noisy picture smooth.
struct FilterSettings {
    FilterKind kind = FilterKind::kNone;
    int radius_pixels = 0;  ///< of the windows; 0: by the noise
};

}  // namespace pileus
