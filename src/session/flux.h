// SPDX-License-Identifier: Apache-2.0
// What a scene's media send back, let through and keep of the sun's light, by paths.
// in: a scene with a sun, samples -> out: shares of the sun's flux with standard errors; maps.
// docs/flux.md
#pragma once
#include "src/session/render.h"

namespace pileus {

struct FluxSettings {
    std::array<int, 2> columns{0, 0};  ///< of the maps along x and y; 0: the medium's cells
};

/// Shares of the sun's irradiance on a level plane, R G B.
struct FluxShare {
    std::array<double, 3> mean{}, standard_error{};
};

struct FluxResult {
    FluxShare reflectance;           ///< up through the top of the media's box
    FluxShare transmittance;         ///< down through its bottom: direct and diffuse
    FluxShare transmittance_direct;  ///< its part that nothing has turned; no error, steps of rays
    FluxShare absorptance;           ///< net flux into the box; 0 exactly for albedo 1
    double mu0 = 0;                  ///< cosine of the sun's angle from the zenith
    std::array<float, 3> irradiance{};  ///< of the sun, on a plane that faces it
    std::array<int, 2> columns{0, 0};
    std::uint64_t samples = 0, paths = 0;  ///< per column; in all
};

/// Places flat detectors on the faces of the media's box and traces paths from them. `maps` holds a
/// pixel a column, north at the top, west at the left: R G B reflectance, error.R ... its standard
/// error, transmittance.R ..., direct.R ... . Errors: as render's; kBadInput for a scene without
/// media, with solids, or whose sun is not above the horizon; kCheckFailed: interrupted.
Status measure_flux(const Scene& scene, const RenderOptions& options, const FluxSettings& settings,
                    FluxResult& result, Image& maps, Report& report);

}  // namespace pileus
