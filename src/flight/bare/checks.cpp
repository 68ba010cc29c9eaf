// SPDX-License-Identifier: Apache-2.0
// What a flight has in place of checks of scenes: they were made when a scene was packed.
// in: a scene -> out: nothing wrong. docs/flight.md, "Packed scenes"
#include "src/methods/collectors/collectors_method.h"
#include "src/methods/march/march_method.h"
#include "src/methods/particles/particles_method.h"
#include "src/methods/path/path_method.h"
#include "src/methods/photon_grid/photon_grid_method.h"
#include "src/session/session.h"

namespace pileus {

Status check_collectors(const Scene&, const Budget&) { return Status::ok(); }
Status check_path(const Scene&, const Budget&) { return Status::ok(); }
Status check_raymarch(const Scene&, const Budget&) { return Status::ok(); }
Status check_optical_depth(const Scene&, const Budget&) { return Status::ok(); }
Status check_photon_grid(const Scene&, const Budget&) { return Status::ok(); }
Status check_particles(const Scene&, const Budget&) { return Status::ok(); }

Status check_all_frames(const Scenery&) { return Status::ok(); }
Status check_placed_media(const Scenery&, const Ground&, int) { return Status::ok(); }
Status Session::check_method(bool, const World*) { return Status::ok(); }
Status Session::refuse_clouds_sky(const char*) const { return Status::ok(); }
Status CollectorsMethod::check(const Context&, const FrameView&) { return Status::ok(); }
Status PhotonGridMethod::check(const Context&, const FrameView&) { return Status::ok(); }

}  // namespace pileus
