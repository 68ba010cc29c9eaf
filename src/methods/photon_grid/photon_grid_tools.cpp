// SPDX-License-Identifier: Apache-2.0
// What programs ask of method `photon-grid` besides pictures.
// in: a scene -> out: settings of other qualities, what films depend on.
// docs/program.md, "Quality"
#include "src/methods/photon_grid/photon_grid_method.h"

namespace pileus {
namespace {

void grid_draft(const Scene& scene, std::vector<std::string>& sets) {
    const PhotonGridSettings& s = scene.photon_grid;
    sets.push_back(at_most_text("photon_grid.photons", s.photons, kDraftPhotons));
    if (may_thin(scene, s.thin)) sets.push_back("photon_grid.scale=2");
}

void grid_whole(const Scene&, std::vector<std::string>& sets) {
    sets.push_back("photon_grid.scale=1");
    sets.push_back("photon_grid.temporal=0");
}

FilmMemory grid_memory(const MethodTables& tables) {
    const PhotonGridSettings& s = tables.photon_grid;
    return {keeps_pictures(s.thin, s.light_refresh), s.ring};
}

}  // namespace

const MethodTools photon_grid_tools{grid_draft, grid_whole, grid_memory, nullptr, false};

}  // namespace pileus
