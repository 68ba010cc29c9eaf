// SPDX-License-Identifier: Apache-2.0
// What a collision in the medium stores for collectors, and the proof that the sums hold it.
// in: scene, world, lights -> out: choices in CollectorsState.
// docs/collectors.md; docs/methods.md 3, "Shoot"
#include "src/methods/collectors/collectors_state.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

/// First-order coefficients are 1; P_l exceeds 1 by its rounding alone; |y| stays below 1.1 for 8
/// bands; else the phase function's peak.
double largest_deposit(const FrameView& view, const DepositPlan& deposit) {
    const double peak = double(phase_peak(view.world.medium));
    if (deposit.mode == kDepositCamera && peak > 1) return peak;
    return deposit.bands > 6 ? 1.1 : deposit.axis_degrees > 0 ? 1.01 : 1;
}

/// Every photon of the ring may end only with its last event.
double most_deposits(const CollectorsState& state) {
    double photons = 0;
    for (const Light& l : state.lights.lighting.lights) photons += double(l.photons);
    return photons * double(state.ring.generations) * double(state.lights.max_events);
}

Status plan_deposit(const FrameView& view, CollectorsState& state) {
    const CollectorSettings& c = state.settings;
    DepositPlan& d = state.lights.deposit;
    d.bands = c.closure.lobe ? 2 : c.closure.bands;
    d.mode = c.paper ? kDepositOutgoing : kDepositIncident;
    if (state.camera_cells > 0) d.mode = kDepositCamera;
    PILEUS_TRY(check_camera_closure("collectors.closure", view, state));
    d.first_order = !splits_first_order(state) ? 0 : (is_marched(state) ? 2 : 1);
    choose_peak(view, c.peak_deg,
                is_marched(state) && d.mode == kDepositIncident && !c.closure.lobe, state);
    d.axis_degrees =
        why_no_collectors_axis(view, state) != nullptr
            ? 0
            : useful_axis_degrees(view.world.medium, c.closure.bands, c.closure.axis_degrees);
    choose_axes(view, state);
    d.coefficients = d.mode == kDepositCamera
                         ? 1
                         : d.bands * d.bands + axis_numbers(d) + (d.first_order == 1 ? 1 : 0);
    d.places = fixed_point_places(most_deposits(state), largest_deposit(view, d));
    return d.places < 0 ? sums_overflow("collectors.photons", view, state) : Status::ok();
}

}  // namespace

const char* why_no_collectors_axis(const FrameView& view, const CollectorsState& state) {
    const CollectorSettings& c = state.settings;
    if (state.camera_cells > 0) return "closure \"camera\" has all bands";
    if (c.paper) return "variant \"paper\"";
    if (c.closure.lobe) return "closure \"lobe\"";
    if (!has_axes(state.lights.lighting)) return "no sun";
    if (view.world.medium.grid.periodic && shows_harmonics(view, state))
        return "nodes of a periodic medium hold bands alone";
    if (c.closure.window) return "the window damps the higher bands";
    return c.closure.axis_degrees == 0 ? "switched off" : nullptr;
}

bool splits_first_order(const CollectorsState& state) {
    return (state.settings.first_order_split || state.camera_cells > 0) &&
           state.lights.lighting.sunlit;
}

SumBound collectors_bound(const FrameView& view, const CollectorsState& state) {
    const DepositPlan& deposit = state.lights.deposit;
    return deposit_bound("light in a collector", most_deposits(state),
                         largest_deposit(view, deposit), deposit.places);
}

Status choose_collectors_light(const FrameView& view, CollectorsState& state) {
    PILEUS_TRY(choose_photon_lights(view, std::uint64_t(state.settings.generations), state));
    aim_deposit(view, state);
    return plan_deposit(view, state);
}

}  // namespace pileus
