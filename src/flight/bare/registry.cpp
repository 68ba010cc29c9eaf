// SPDX-License-Identifier: Apache-2.0
// The methods of a flight library: those that it was configured with.
// in: PILEUS_FLIGHT_<METHOD>, PILEUS_WITHOUT_<PART> -> out: the row of a scene's method.
// docs/flight.md, "Build"
#include "src/methods/registry.h"

#include "kernels_cpu/core/profile.h"
#include "src/methods/collectors/collectors_method.h"
#include "src/methods/march/march_method.h"
#include "src/methods/particles/particles_method.h"
#include "src/methods/path/path_method.h"
#include "src/methods/photon_grid/photon_grid_method.h"

namespace pileus {

namespace {

Status without(const char* what, const char* option) {
    return Status::bad_input(std::string(what) +
                             " left out of this library, allowed: another scene, or a library "
                             "with other " +
                             option);
}

/// Scenes that need what was left out.
Status check_parts(const Scene& scene) {
    constexpr const char* kOption = "PILEUS_FLIGHT_LEFT_OUT";
    bool shines = !scene.lights.empty();
    for (const MediumSettings& medium : scene.media)
        for (const float emission : medium.optics.emission) shines |= emission > 0;
    if (!kLights && shines) return without("[[light]], emission: they were", kOption);
    if (!kAtmosphere && scene.atmosphere.present) return without("atmosphere: it was", kOption);
    return Status::ok();
}

}  // namespace

Status find_method(const Scene& scene, MethodRow& row) {
    PILEUS_TRY(check_parts(scene));
    const MethodRow known[] = {
#ifdef PILEUS_FLIGHT_COLLECTORS
        collectors_row(),
#endif
#ifdef PILEUS_FLIGHT_PATH
        path_row(),
#endif
#ifdef PILEUS_FLIGHT_RAYMARCH
        raymarch_row(),
#endif
#ifdef PILEUS_FLIGHT_OPTICAL_DEPTH
        optical_depth_row(),
#endif
#ifdef PILEUS_FLIGHT_PHOTON_GRID
        photon_grid_row(),
#endif
#ifdef PILEUS_FLIGHT_PARTICLES
        particles_row(),
#endif
    };
    for (const MethodRow& one : known) {
        row = one;
        if (scene.method == one.name) return Status::ok();
    }
    return without(("method.name: \"" + scene.method + "\" was").c_str(), "PILEUS_FLIGHT_METHODS");
}

}  // namespace pileus
