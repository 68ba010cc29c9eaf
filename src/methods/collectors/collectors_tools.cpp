// SPDX-License-Identifier: Apache-2.0
// What programs ask of method `collectors` besides pictures.
// in: a scene -> out: settings of other qualities, what films depend on.
// docs/program.md, "Quality"
#include "src/methods/collectors/collectors_method.h"

namespace pileus {
namespace {

void collectors_draft(const Scene& scene, std::vector<std::string>& sets) {
    const CollectorSettings& s = scene.collectors;
    sets.push_back(at_most_text("collectors.photons", s.photons, kDraftPhotons));
    if (!s.display.billboards && !s.paper) sets.push_back("collectors.node_filter=\"guided\"");
}

void collectors_whole(const Scene& scene, std::vector<std::string>& sets) {
    if (scene.collectors.display.billboards) return;
    sets.push_back("collectors.scale=1");
    sets.push_back("collectors.temporal=0");
}

FilmMemory collectors_memory(const MethodTables& tables) {
    return {keeps_pictures(tables.collectors.thin, tables.collectors.light_refresh), true};
}

std::int64_t collectors_photons(const MethodTables& tables) { return tables.collectors.photons; }

}  // namespace

const MethodTools collectors_tools{collectors_draft, collectors_whole, collectors_memory,
                                   collectors_photons, false};

}  // namespace pileus
