// SPDX-License-Identifier: Apache-2.0
// What a flight has in place of films: frames that nothing moves but the host, no layers of files,
// no time that is given to a picture, nobody who ends it.
// in: a scene -> out: what it is without an animation. docs/flight.md, "Build"
#include "src/methods/collectors/collectors_display.h"
#include "src/methods/march/march_budget.h"
#include "src/methods/photon_grid/photon_grid_state.h"
#include "src/photons/lit_march.h"
#include "src/scene/frames.h"
#include "src/session/session.h"

namespace pileus {

SunPlace sun_at(const Scene&, const Sun& rest, int) { return place_of(rest); }
double orbit_at(const Scene&, int) { return 0; }
Camera camera_at(const Animation&, const Camera& rest, int) { return rest; }
double hours_at(const Scene&, int) { return 0; }
double wind_at(const Scene&, int) { return 0; }
Placement placement_at(const Scene&, int) { return {}; }
void frame_state_at(const Scene&, const FrameState& rest, int, FrameState& out) { out = rest; }
bool moves_sun(const Scene&) { return false; }
bool moves_time(const Scene&) { return false; }
bool moves_wind(const Scene&) { return false; }
bool moves_media(const Scene&) { return false; }
const char* mover_of_view(const Scene&) { return nullptr; }
double highest_sun(const Scene&, const Sun& rest) { return rest.elevation_deg; }
void place_at_frame(const FrameState&, int, Scene&) {}
SunTurn turn_of_sun(const FrameView& view, int slices, std::int64_t turn) {
    return {slices, turn, view.lighting.to_sun, nullptr};
}
void Session::keep_opened() {}
Status Session::check_layers(const std::vector<LayerTarget>&) const { return Status::ok(); }
Status Session::show_layers(const FrameView&, const std::vector<LayerTarget>&, const Planes&) {
    return Status::ok();
}
// No host of a flight ends it.
Status Session::trace_passes(std::uint64_t, std::uint64_t, std::uint64_t&) { return Status::ok(); }

void settle_ring(PhotonState&) {}
void note_colours(const Context&, Span<const float>, PhotonState&) {}
Status add_ground_noise(const Context&, const FrameView&, PhotonState&, const LightInput&,
                        Planes&) {
    return Status::ok();
}
Status collectors_parts(const Context&, const FrameView&, CollectorsState&, const ReconstructInput&,
                        Planes&) {
    return Status::ok();
}
Status add_grid_layers(const Context&, const FrameView&, PhotonGridState&, const GridLightInput&,
                       Planes&) {
    return Status::ok();
}
Status choose_march_work(const Context&, const FrameView&, double, const UpsampleInput&,
                         MarchState&) {
    return Status::ok();
}
std::function<bool()> patient_stop(const Context&) { return {}; }

}  // namespace pileus
