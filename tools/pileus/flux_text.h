// SPDX-License-Identifier: Apache-2.0
// What pileus flux prints: lines for people, JSON for programs, and volumes as bare numbers.
// in: FluxResult -> out: text and bytes.
// docs/flux.md
#pragma once
#include "src/session/flux/flux.h"

namespace pileus {

/// What absorbed power does to air of a constant density and heat capacity.
struct AirHeating {
    double density_kg_m3 = 0, heat_capacity_j_kg_k = 0;  ///< 0: not asked for

    bool wanted() const { return density_kg_m3 > 0; }
    /// K/day per W/m3.
    double kelvin_per_day() const { return 86400 / (density_kg_m3 * heat_capacity_j_kg_k); }
};

std::string flux_lines(const FluxSettings& settings, const FluxResult& flux,
                       const AirHeating& heating);
std::string flux_json(const FluxSettings& settings, const FluxResult& flux,
                      const AirHeating& heating, const Report& report);

/// Planes of float32, little-endian: power, then its errors; one of each where all channels are
/// the same. `head` describes them. kLimit: out of memory.
Status absorbed_file(const AbsorbedPower& power, const AirHeating& heating, const std::string& path,
                     Buffer<char>& bytes, std::string& head);

}  // namespace pileus
