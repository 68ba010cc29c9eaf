// SPDX-License-Identifier: Apache-2.0
// How often a photon will scatter, foretold from the medium's size and optics alone.
// in: extinction, mean density, box, albedo, g -> out: expected scatterings, without tracing.
// docs/report.md, "Work".
#pragma once

namespace pileus {

struct WorkInput {
    double extinction_per_m = 0;  ///< at density 1
    double mean_density = -1;     ///< over the box; below 0: not known yet
    double extent_m[3] = {1, 1, 1};
    double albedo = 1;       ///< the largest of the channels, [0, 1]
    double mean_cosine = 0;  ///< of the phase function, [-1, 1]
    double max_events = 1;   ///< collisions after which a photon is given up
    double photons = 0;
};

struct WorkEstimate {
    bool known = false;
    double photons = 0, scatterings_per_photon = 0, scatterings = 0;
    const char* law = "";  ///< which of the three bounds below is the least
};

/// The least of three means per photon that enters the box:
/// - mean path 4V/S of diffuse light in any white medium, times the mean extinction (Blanco and
///   Fournier 2003);
/// - a half space that absorbs: absorbed share over 1 - albedo, with the absorbed share
///   2.31 sqrt((1 - a) / (1 - g a)) of thick media, at most 1 (van de Hulst 1980);
/// - a white half space cut at max_events: the chance to live on falls as n^-1/2, by the same law,
///   so that the mean is 2.6 sqrt(max_events / (1 - g)).
WorkEstimate estimate_work(const WorkInput& in);

}  // namespace pileus
