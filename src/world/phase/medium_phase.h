// SPDX-License-Identifier: Apache-2.0
// The phase function of a medium, as its scene asks for it.
// in: settings, perhaps a file -> out: numbers for the kernels, and the memory of a table.
// docs/phase.md.
#pragma once
#include "src/scene/scene.h"
#include "src/world/phase/phase_table.h"

namespace pileus {

/// HG and Draine for water droplets of 5 to 50 um: Jendersie and d'Eon 2023, equations 4 to 7.
PhaseParams hg_draine(double droplet_diameter_um);

/// A water cloud at 0.55 um whose droplets have this effective radius, 4 to 20 um: the tables of
/// the two radii that enclose it, mixed so that the mixture has just this radius. kLimit.
Status make_cloud_phase(double effective_radius_um, PhaseStore& out);

/// Nodes of the same.
Status cloud_phase_nodes(double effective_radius_um, PhaseNodes& nodes);

/// Reads, makes or looks up what `settings` asks for; `store` stays empty where no table is needed,
/// otherwise `params` points into it. Errors: those of the readers.
Status load_phase(const std::string& directory, const PhaseSettings& settings, PhaseStore& store,
                  PhaseParams& params);

}  // namespace pileus
