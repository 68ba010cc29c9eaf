// SPDX-License-Identifier: Apache-2.0
// Flat detectors across a medium's box and single lines of sight, by paths.
// in: a prepared run of method path -> out: means of light with squared standard errors.
// docs/flux.md
#pragma once
#include "src/methods/path/path_method.h"
#include "src/methods/scenery.h"
#include "src/session/flux/flux.h"

namespace pileus {

/// A plane across an axis of the box, as wide as the box, `at_m` from its low corner.
struct FluxPlane {
    int axis;  ///< 0..2
    double at_m;
};

/// Of the two faces across an axis.
inline FluxPlane box_face(const Medium& m, int axis, bool high) {
    return {axis, high ? m.extent_m[axis] : 0};
}

/// Light on one side of a plane, or along one line: the mean over all pixels.
struct MeteredLight {
    double mean[3] = {}, square_error[3] = {};
};

class FluxMeter {
public:
    FluxMeter(const Context& context, Scenery& scenery, PathMethod& path, std::uint64_t samples)
        : context_(context),
          scenery_(scenery),
          path_(path),
          in_(path.input(context, scenery.view(0))),
          samples_(samples) {
        in_.parts = false;
        if (context.sharing == nullptr) in_.ended = context.interrupted;
    }

    /// Also keeps apart what the media have turned last: call before any light is metered.
    void keep_parts() { in_.parts = true; }
    /// Of each pixel, from now on.
    void set_samples(std::uint64_t samples) { samples_ = samples; }

    /// Diffuse light that falls on a plane from the side that `towards` points to, +1 or -1 along
    /// the axis; the film keeps its pixels. kCheckFailed: interrupted.
    Status diffuse(const FluxPlane& plane, int towards, const std::array<int, 2>& pixels,
                   MeteredLight& light);
    /// Share of the sun's rays that reach points of a plane through the medium, [pixel], rows along
    /// the plane's first axis.
    Status direct(const FluxPlane& plane, const std::array<int, 2>& pixels,
                  std::vector<double>& share);
    /// Radiance at a place of the world along a unit direction of sight; the sun's own light is not
    /// in it. kCheckFailed: interrupted.
    Status radiance(const Double3& place_m, const Double3& direction, MeteredLight& light);

    /// Diffuse light on the front of a small plane. kCheckFailed: interrupted.
    Status irradiance(const Double3& place_m, const Double3& normal, MeteredLight& light);
    /// Share of the sun's light that reaches a place of the world straight.
    Status sunlight(const Double3& place_m, double& share);

    const Film& film() const { return film_; }
    std::uint64_t paths() const { return paths_; }
    const Medium& medium() const { return *in_.medium; }

private:
    Status trace(const CameraParams& camera, MeteredLight& light);

    const Context& context_;
    const Scenery& scenery_;
    PathMethod& path_;
    PathInput in_;
    std::uint64_t samples_, paths_ = 0, made_ = 0;
    Film film_;
};

/// Mean of the list; 0 of none.
double mean_of(const std::vector<double>& values);

/// Reads the sensors of the settings. kBadInput: a level outside of the media's box, a place below
/// the ground; kCheckFailed: interrupted.
Status read_flux_sensors(const FluxSettings& settings, const Scene& scene, const Scenery& scenery,
                         FluxMeter& meter, std::vector<SensorReading>& out);

}  // namespace pileus
