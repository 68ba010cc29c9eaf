// SPDX-License-Identifier: Apache-2.0
// What a flight has in place of what people are told: reports, plans, why something was chosen.
// in: a method, what it does -> out: nothing. docs/flight.md, "Build"
#include "src/methods/collectors/collectors_memory.h"
#include "src/methods/collectors/collectors_method.h"
#include "src/methods/march/march_method.h"
#include "src/methods/particles/particles_method.h"
#include "src/methods/path/path_method.h"
#include "src/methods/photon_grid/photon_grid_method.h"
#include "src/session/run_context.h"
#include "src/session/session.h"

namespace pileus {

std::unique_ptr<MethodReport> collectors_report(CollectorsMethod&) { return nullptr; }
std::unique_ptr<MethodReport> march_report(MarchMethod&) { return nullptr; }
std::unique_ptr<MethodReport> particles_report(ParticlesMethod&) { return nullptr; }
std::unique_ptr<MethodReport> path_report(PathMethod&, const Budget&) { return nullptr; }
std::unique_ptr<MethodReport> photon_grid_report(PhotonGridMethod&) { return nullptr; }

void explain_march_light(double, double, MarchChoice&) {}
void Session::tell_plan(bool) {}
Status make_plan(const MadeMethod& made, const Context& context, Scenery& scenery, Plan& plan) {
    return made.method->plan(context, scenery.view(0), plan);
}
void note_head(const Scene&, const RenderOptions&, const Context&, Report&) {}

// Sums are chosen by what threads may take.
std::uint64_t collectors_peak(const CollectorsSizes&) { return 0; }
std::uint64_t photon_grid_peak(const Context&, const FrameView&, const PhotonGridState&) {
    return 0;
}
Status measure_memory(const Context&, const FrameView&, const CollectorsState&,
                      const CollectorsSizes&, Plan&) {
    return Status::ok();
}
Status measure_grid_memory(const Context&, const FrameView&, const PhotonGridState&, std::uint64_t,
                           Plan&) {
    return Status::ok();
}

}  // namespace pileus
