// SPDX-License-Identifier: Apache-2.0
// What a collision in the photon grid stores, how many cells there are, what they are shown by.
// in: scene, world -> out: choices in PhotonGridState.
// docs/photon-grid.md.
#include <algorithm>

#include "src/methods/photon_grid/photon_grid_state.h"
#include "src/photons/scatter.h"
#include "src/picture/nodes/node_grid.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

/// |y| stays below 1.1 for 8 bands, P_l exceeds 1 by its rounding; else the phase function's peak.
double largest_deposit(const Medium& medium, const DepositPlan& deposit) {
    const double peak = double(phase_peak(medium));
    if (deposit.mode == kDepositCamera && peak > 1) return peak;
    return deposit.bands > 6 ? 1.1 : 1.01;
}

/// Of one generation.
double photons_of(const PhotonGridState& state) {
    double photons = 0;
    for (const Light& l : state.lights.lighting.lights) photons += double(l.photons);
    return photons;
}

/// Every photon may end only with its last event.
double most_deposits(const PhotonGridState& state) {
    return state.most_photons * double(state.lights.max_events);
}

void choose_numbers(const FrameView& view, PhotonGridState& state) {
    const PhotonGridSettings& s = state.settings;
    DepositPlan& d = state.lights.deposit;
    d.mode = kDepositIncident;
    d.bands = s.closure == GridClosure::kSh ? s.bands : 2;
    d.first_order = s.first_order_split && state.lights.lighting.sunlit ? 2 : 0;
    d.axis_degrees = why_no_grid_axis(view, state) != nullptr
                         ? 0
                         : useful_axis_degrees(view.world.medium, s.bands, s.axis_degrees);
    choose_axes(view, state);
    d.coefficients = d.bands * d.bands + axis_numbers(d);
    if (s.closure == GridClosure::kPublished) d.mode = kDepositCosine, d.coefficients = 2;
    if (s.closure == GridClosure::kCamera) d.mode = kDepositCamera, d.coefficients = 1;
    choose_peak(view, s.peak_deg, s.closure == GridClosure::kSh, state);
}

/// Decides what a collision stores, and proves that the sums hold it. What a budget may add counts
/// from the start, so that it changes no bit; a high peak leaves it less room.
Status plan_deposit(const FrameView& view, PhotonGridState& state) {
    choose_numbers(view, state);
    PILEUS_TRY(check_camera_closure("photon_grid.closure", view, state));
    DepositPlan& deposit = state.lights.deposit;
    const double largest = largest_deposit(view.world.medium, deposit);
    const double all = photons_of(state) * double(state.ring.generations);
    state.most_photons = all > kMinMaxPhotons ? all : kMinMaxPhotons;
    deposit.places = fixed_point_places(most_deposits(state), largest);
    while (deposit.places < 0 && state.most_photons > all) {
        state.most_photons = state.most_photons > 2 * all ? state.most_photons / 2 : all;
        deposit.places = fixed_point_places(most_deposits(state), largest);
    }
    if (deposit.places < 0) return sums_overflow("photon_grid.photons", view, state);
    return Status::ok();
}

/// Cell volume over the track length that a deposit of 1 stands for.
double unit_m2(const FrameView& view, const PhotonGridState& state) {
    const Medium& m = view.world.medium;
    double volume = 1;
    for (int a = 0; a < 3; ++a) volume *= m.extent_m[a] / state.cells.size[a];
    return volume * double(state.near.least_density) * double(m.sigma);
}

}  // namespace

const char* why_no_grid_axis(const FrameView& view, const PhotonGridState& state) {
    const PhotonGridSettings& s = state.settings;
    if (s.closure != GridClosure::kSh) return "closures other than \"sh\" have none";
    if (!has_axes(state.lights.lighting)) return "no sun";
    if (shows_harmonics(view, state)) return "cells of a periodic medium show bands alone";
    return s.axis_degrees == 0 ? "switched off" : nullptr;
}

SumBound grid_bound(const FrameView& view, const PhotonGridState& state) {
    const DepositPlan& deposit = state.lights.deposit;
    return deposit_bound("light in a cell", most_deposits(state),
                         largest_deposit(view.world.medium, deposit), deposit.places);
}

std::uint64_t most_grid_generations(const PhotonGridState& state) {
    const std::uint64_t whole = state.ring.generations;
    if (state.ring.on) return whole;
    const double photons = photons_of(state);
    const double room = photons > 0 ? state.most_photons / photons : 1;
    const std::uint64_t most = room < 1e9 ? std::uint64_t(room) : 1000000000;
    return most > whole ? most : whole;
}

std::uint64_t planned_generations(const PhotonGridState& state) {
    if (state.budget.generations == 0 || state.ring.on) return state.ring.generations;
    const std::uint64_t wanted = std::uint64_t(state.budget.generations);
    const std::uint64_t most = most_grid_generations(state);
    return wanted < most ? wanted : most;
}

CellGrid photon_cells(const PhotonGridSettings& settings, std::int64_t photons,
                      const Medium& medium) {
    constexpr double kPhotonsPerCell = 32, kFewest = 4096, kMax = 0x1p19;
    CellGrid cells;
    if (settings.cells[0] > 0) {
        for (std::size_t a = 0; a < 3; ++a) cells.size[a] = settings.cells[a];
        return cells;
    }
    double wanted = double(photons) / kPhotonsPerCell;
    wanted = wanted < kFewest ? kFewest : (wanted > kMax ? kMax : wanted);
    const auto& e = medium.extent_m;
    double spacing = 0, fewest[3];
    for (std::size_t a = 0; a < 3; ++a) {
        spacing = e[a] > spacing ? e[a] : spacing;
        // More than 12 move the mean of a flat deck by less than 3 %.
        fewest[a] = std::max(1.0, layers_of_depth(e[a] * max_extinction(medium), 12));
    }
    // Down from the longest edge in steps of 3 %: cubes, but for layers of a flat box.
    const auto cells_along = [&](std::size_t a, double edge) {
        const double cubes = e[a] / edge;
        return cubes > fewest[a] ? cubes : fewest[a];
    };
    const auto count = [&](double edge) {
        return cells_along(0, edge) * cells_along(1, edge) * cells_along(2, edge);
    };
    while (count(spacing * 0.97) <= wanted) spacing *= 0.97;
    for (std::size_t a = 0; a < 3; ++a) {
        const double n = cells_along(a, spacing) + 0.5;
        const int most = medium.grid.size[a];
        cells.size[a] = n > most ? most : int(n);
    }
    return cells;
}

GridLightInput grid_light_input(const Context& context, const FrameView& view,
                                const PhotonGridState& state) {
    GridLightInput in;
    in.medium = &view.world.medium;
    in.lighting = &state.lights.lighting;
    in.photons = &state.ring.photons;
    if (sums_ring(state) && state.ring.sum.sum.generations > 0) in.whole = &state.ring.sum.sum;
    in.camera = view.camera;
    in.deposit = state.lights.deposit;
    in.batches = photon_batches(state);
    in.threads = context.threads;
    in.cells = state.cells;
    in.marks = state.near.marks.span();
    in.shares = state.shares.span();
    in.closure = state.settings.closure;
    set_axes(in);
    if (in.closure == GridClosure::kSh) damp_rings(in);
    in.unit_m2 = unit_m2(view, state);
    return in;
}

Status choose_grid_light(const FrameView& view, PhotonGridState& state) {
    const PhotonGridSettings& settings = state.settings;
    const Medium& medium = view.world.medium;
    state.cells = photon_cells(settings, state.lights.budget_photons, medium);
    for (std::size_t a = 0; a < 3; ++a) {
        const double edge = medium.extent_m[a] / state.cells.size[a];
        state.cell_m = a == 0 || edge < state.cell_m ? edge : state.cell_m;
    }
    if (settings.closure == GridClosure::kCamera && medium.count > 1)
        return Status::bad_input(view.scene.file +
                                 ": photon_grid.closure: \"camera\" knows one medium, but the "
                                 "scene has several, allowed: sh, published, mean");
    PILEUS_TRY(choose_photon_lights(view, std::uint64_t(settings.generations), state));
    aim_deposit(view, state);
    return plan_deposit(view, state);
}

}  // namespace pileus
