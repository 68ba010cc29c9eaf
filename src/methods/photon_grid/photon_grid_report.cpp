// SPDX-License-Identifier: Apache-2.0
// What people are told of method `photon-grid`: what it needs, counts, digests, its budget.
// in: its state, outlined or prepared -> out: a plan, a report.
// docs/report.md, "Plan"; docs/photon-grid.md
#include "src/methods/photon_grid/photon_grid_method.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

constexpr Stage kUnused[] = {Stage::kPaths, Stage::kSamples, Stage::kTree, Stage::kCollectors,
                             Stage::kLeafGrid};

void explain_deposit(const FrameView& view, const PhotonGridState& state, Plan& plan) {
    explain_axis(why_no_grid_axis(view, state), state, plan);
    if (const char* why =
            why_no_peak(view, state.settings.peak_deg, state.lights.deposit.by_bands, state))
        plan.leave_out("the beam's peak", why);
    explain_split(state.lights.deposit.first_order != 0, state, plan);
}

}  // namespace

void PhotonGridReport::explain(const Context& context, const FrameView& view, Plan& plan) const {
    const PhotonGridState& state = of_.state();
    const Scene& scene = view.scene;
    explain_photon_lights(view, state, plan);
    explain_deposit(view, state, plan);
    plan.bias = {"photon-grid", "cells and the bands left out blur the light of many orders",
                 "docs/photon-grid.md"};
    plan.need("majorants, floored near medium");
    explain_photon_picture(view, state, "marched display", plan);
    note_media(view.world.media_plan, plan);
    for (Stage stage : kUnused) plan.skip(stage);
    note_limits(scene, view.world.medium.grid, context.limits,
                {LimitId::kVoxels, LimitId::kPhotons, LimitId::kPixels, LimitId::kFrames,
                 LimitId::kMemory, LimitId::kScatterings, LimitId::kWork},
                plan);
}

void PhotonGridReport::digest(const FrameView& view, Digests& digests) const {
    digests = {{"density", density_digest(view.world)}};
}

LightGoal PhotonGridReport::goal(const FrameView&) const {
    return photon_goal(of_.state(), of_.most_generations());
}

Status PhotonGridReport::error(const Context& context, const FrameView& view,
                               double& mean_relative) {
    return of_.error(context, view, mean_relative);
}

void PhotonGridReport::report(Report& report) const {
    const PhotonGridState& state = of_.state();
    report_photons(state, report);
    const DepositPlan& deposit = state.lights.deposit;
    const std::uint64_t numbers =
        std::uint64_t(deposit.channels) * std::uint64_t(deposit.coefficients);
    const std::size_t sums = state.lights.lighting.lights.size() * state.ring.photons.slots.size();
    report.executed.emplace_back("cells", state.cells.count());
    report.executed.emplace_back("cells_near_medium", state.near.marked);
    report.executed.emplace_back("coefficients", numbers * sums);
}

void PhotonGridReport::put_work(const FrameWork& work, MethodTables& tables) const {
    pileus::put_work(work, tables.photon_grid.thin);
    tables.photon_grid.light_refresh = work.light_refresh;
}

std::unique_ptr<MethodReport> photon_grid_report(PhotonGridMethod& method) {
    return std::make_unique<PhotonGridReport>(method);
}

}  // namespace pileus
