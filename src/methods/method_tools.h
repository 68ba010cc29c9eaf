// SPDX-License-Identifier: Apache-2.0
// What programs ask of a method besides pictures; a flight has none of it.
// in: a scene -> out: settings of other qualities, what films depend on.
// docs/program.md, "Quality" and "A picture made again"
#pragma once
#include <string>
#include <vector>

#include "src/scene/scene.h"

namespace pileus {

/// What a film's frame has of those before it.
struct FilmMemory {
    bool pictures = false;  ///< pixels of the last one, or light of an earlier sun
    bool ring = false;      ///< generations, which a budget may cut short
};

/// Members are null where a method has nothing of the kind.
struct MethodTools {
    /// Texts for `--set` of `--quality draft`, and of `final` but for the filter.
    void (*draft)(const Scene&, std::vector<std::string>& sets);
    void (*whole)(const Scene&, std::vector<std::string>& sets);
    FilmMemory (*film_memory)(const MethodTables&);
    /// That `pileus info` tells of.
    std::int64_t (*photons)(const MethodTables&);
    bool hides_pixels = false;  ///< a time may choose fewer of them than any key can say
};

constexpr std::int64_t kDraftPhotons = 100'000;

/// "KEY=n", n the least of both.
inline std::string at_most_text(const char* key, std::int64_t n, std::int64_t most) {
    return std::string(key) + "=" + std::to_string(n < most ? n : most);
}

/// Thinned pictures have no layers of noise, of single lights and orders.
inline bool may_thin(const Scene& scene, const UpsampleSettings& thin) {
    const OutputSettings& layers = scene.output;
    return !layers.layer_error && !layers.layer_light && !layers.layer_order && thin.temporal == 0;
}

inline bool keeps_pictures(const UpsampleSettings& thin, int light_refresh) {
    return thin.temporal > 0 || light_refresh > 1;
}

}  // namespace pileus
