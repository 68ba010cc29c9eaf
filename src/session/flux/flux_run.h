// SPDX-License-Identifier: Apache-2.0
// The two ways to measure fluxes, behind one entry.
// in: a prepared run, settings -> out: FluxResult and maps.
// docs/flux.md
#pragma once
#include "src/methods/path/path_method.h"
#include "src/methods/scenery.h"
#include "src/session/flux/flux.h"

namespace pileus {

/// What a measurement of either way begins with.
struct FluxTask {
    const Scene& scene;
    const FluxSettings& settings;
    const Context& context;
    Scenery& scenery;             ///< prepared, with its lights
    PathMethod& path;             ///< over it
    double level[3] = {0, 0, 0};  ///< incident flux on a level plane
    bool last = true;  ///< whether there is no other measurement where this one is not good enough

    /// Part of the incident flux, 0 where there is none.
    double share(double light, std::size_t c) const { return level[c] > 0 ? light / level[c] : 0; }
};

/// Names of the maps' channels in their order, three of each.
Status make_flux_maps(const std::array<int, 2>& columns, Image& maps);

/// How far the standard errors are above what is aimed at; 1 or less: they are there. What is less
/// than a fiftieth of the incident flux is asked for as if it were so much; by paths absorption is
/// a difference of large fluxes, and asked for as a share of what comes in.
double flux_excess(const FluxTask& task, const FluxResult& result);

/// `samples` paths for each column and detector. Errors: those of measure_flux.
/// Sensors are read where no other measurement follows.
Status flux_by_paths(const FluxTask& task, std::uint64_t samples, FluxResult& out, Image& maps);

/// `photons` in all. kBadInput: columns or cells that do not divide the medium's; too few photons.
Status flux_by_photons(const FluxTask& task, std::int64_t photons, FluxResult& out, Image& maps,
                       Report& report);

}  // namespace pileus
