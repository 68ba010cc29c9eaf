// SPDX-License-Identifier: Apache-2.0
// The most that a generation of photons and a marched picture of their light take.
// in: the work of a frame, a run -> out: pixels, rays, samples, photons.
// docs/realtime.md, "What a frame takes at the most"
#include "src/methods/most_units.h"
#include "src/photons/photon_frames.h"

namespace pileus {

Status photon_most_units(const FrameWork& work, const PhotonRun& run, FrameUnits& out) {
    most_pixels(work, run, run.upsample, out);
    std::uint64_t samples = 0;
    PILEUS_TRY(most_grid_samples(run.world->medium, samples));
    out.samples = run.world->medium.sigma > 0 ? out.rays * samples : 0;
    // Each light has one photon or more.
    out.photons = std::uint64_t(work.photons) + run.lighting.lights.size();
    return add_lamp_samples(run, out);
}

}  // namespace pileus
