// SPDX-License-Identifier: Apache-2.0
// What a scene's media send back, let through and keep of light, by paths or by photons.
// in: a scene, what is asked -> out: shares of the incident flux with standard errors; maps;
// absorbed power per volume; sensors. docs/flux.md
#pragma once
#include "src/io/text/sensor_file.h"
#include "src/session/render.h"

namespace pileus {

enum class FluxMethod { kPath, kPhotons };

struct FluxSettings {
    FluxMethod method = FluxMethod::kPath;
    std::array<int, 2> columns{0, 0};  ///< of the maps along x and y; 0: the medium's cells
    /// Absorbed power in cells, by photons alone.
    bool absorbed = false;
    std::array<int, 3> cells{0, 0, 0};  ///< of it; 0: the medium's
    /// Instead of the scene's lights this radiance, R G B, from the whole lower half space.
    bool from_below = false;
    std::array<double, 3> below_radiance{};
    std::vector<Sensor> sensors;  ///< by paths alone
    std::string sensor_file;      ///< where they are from, for messages
};

/// Shares of the incident flux on a level plane, R G B.
struct FluxShare {
    std::array<double, 3> mean{}, standard_error{};
};

/// Power per volume, W/m3 where irradiance is in W/m2.
struct AbsorbedPower {
    std::array<int, 3> cells{0, 0, 0};  ///< 0: not asked for
    std::array<Double3, 2> bounds_m{};
    Buffer<float> mean[3], error[3];  ///< [channel], x fastest, from the south and the bottom
    FluxShare all;                    ///< over the box
    std::vector<FluxShare> layers;    ///< over each layer of cells, from the bottom
    std::array<double, 3> largest{};
};

/// What one sensor saw: radiance per steradian, or flux per area, in the unit of irradiance.
struct SensorReading {
    FluxShare radiance;              ///< of a place and a direction
    FluxShare up;                    ///< through a level
    FluxShare down;                  ///< likewise, or onto a small plane: direct and diffuse
    std::array<double, 3> direct{};  ///< part of `down`, without an error
    std::uint64_t samples = 0;
};

struct FluxResult {
    FluxShare reflectance;              ///< back through the face of the box that is lit
    FluxShare transmittance;            ///< through the other one: direct and diffuse
    FluxShare transmittance_direct;     ///< its part that nothing has turned
    FluxShare absorptance;              ///< net flux into the box; 0 exactly for albedo 1
    double mu0 = 0;                     ///< cosine of the sun's angle from the zenith
    std::array<float, 3> irradiance{};  ///< of the sun, on a plane that faces it; from below: pi L
    std::array<int, 2> columns{0, 0};
    std::uint64_t samples = 0, paths = 0;    ///< per column; in all
    std::uint64_t photons = 0, batches = 0;  ///< in all; groups of them that errors are from
    double terminated = 0;                   ///< share of photons that were given up
    AbsorbedPower absorbed;
    std::vector<SensorReading> sensors;  ///< as in the settings
};

/// By paths: places flat detectors on the faces of the media's box and traces paths from them. By
/// photons: shoots them and counts what leaves and what is absorbed. `maps` holds a
/// pixel a column, north at the top, west at the left: R G B reflectance, error.R ... its standard
/// error, transmittance.R ..., direct.R ... . Errors: as render's; kBadInput for a scene without
/// media, with solids, or whose sun is not above the horizon; kCheckFailed: interrupted.
Status measure_flux(const Scene& scene, const RenderOptions& options, const FluxSettings& settings,
                    FluxResult& result, Image& maps, Report& report);

}  // namespace pileus
