// SPDX-License-Identifier: Apache-2.0
// The methods of a flight library: those that it was configured with.
// in: PILEUS_FLIGHT_<METHOD> -> out: the recipe of a scene's method.
// docs/flight.md, "Build"
#include "src/methods/registry.h"

#include "src/methods/collectors/collectors.h"
#include "src/methods/optical_depth/optical_depth.h"
#include "src/methods/particles/particles_method.h"
#include "src/methods/path/path.h"
#include "src/methods/photon_grid/photon_grid.h"
#include "src/methods/raymarch/raymarch.h"

namespace pileus {

Status find_method(const Scene& scene, const Method*& method) {
    const Method* const known[] = {
#ifdef PILEUS_FLIGHT_COLLECTORS
        &collectors_method(),
#endif
#ifdef PILEUS_FLIGHT_PATH
        &path_method(),
#endif
#ifdef PILEUS_FLIGHT_RAYMARCH
        &raymarch_method(),
#endif
#ifdef PILEUS_FLIGHT_OPTICAL_DEPTH
        &optical_depth_method(),
#endif
#ifdef PILEUS_FLIGHT_PHOTON_GRID
        &photon_grid_method(),
#endif
#ifdef PILEUS_FLIGHT_PARTICLES
        &particles_method(),
#endif
    };
    for (const Method* one : known) {
        method = one;
        if (scene.method == one->name) return Status::ok();
    }
    return Status::bad_input("method.name: \"" + scene.method +
                             "\" was left out of this library, allowed: another scene, or a "
                             "library with PILEUS_FLIGHT_METHODS");
}

Status find_view(const std::string&, const std::string&, const Method*&) {
    return Status::bad_input("views are not in a flight library, allowed: none");
}

}  // namespace pileus
