// SPDX-License-Identifier: Apache-2.0
// Whether a scene is one that the method draws; in no flight, whose scenes were checked when they
// were packed. in: a scene, a budget -> out: one line. docs/particles.md
#include "src/methods/check_support.h"
#include "src/methods/particles/particles_method.h"

namespace pileus {

Status check_particles(const Scene& scene, const Budget& budget) {
    const bool bins = !scene.particles.billboards && budget.steps >= 0;
    if (bins && (budget.steps == 0 || budget.steps > kMaxParticleBins))
        return Status::bad_input("--budget steps: out of range, " + std::to_string(budget.steps) +
                                 ", allowed: 1 to " + std::to_string(kMaxParticleBins) +
                                 " for method particles");
    PILEUS_TRY(check_budget_kinds(scene, budget));
    if (!shows_particles(scene))
        return Status::bad_input(scene.file +
                                 ": medium: method particles shows one medium of particles, " +
                                 std::to_string(scene.media.size()) +
                                 " media, allowed: one [[medium]] whose density is a file of "
                                 "particles (.ply, .csv, .prt, .bgeo, .pdb, .pda) or "
                                 "procedural:plume, procedural:particle-cumulus");
    if (scene.media[0].box.periodic)
        return Status::bad_input(scene.file +
                                 ": medium.0.boundary: method particles shows each particle once, "
                                 "\"periodic\", allowed: left out");
    if (scene.particles.scattering == ParticleScattering::kByNodes && !scene.particles.sky_ambient)
        return Status::bad_input(scene.file +
                                 ": particles.sky_light: goes with no scattering = \"ordinates\", "
                                 "\"none\", allowed: ambient, or another scattering");
    return check_layer_kinds(scene);
}

}  // namespace pileus
