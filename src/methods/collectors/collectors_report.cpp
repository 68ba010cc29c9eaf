// SPDX-License-Identifier: Apache-2.0
// What people are told of method `collectors`: what it needs, energy, counters, digests.
// in: its state, outlined or prepared -> out: a plan, a report.
// docs/report.md.
#include "src/base/digest.h"
#include "src/methods/collectors/collectors_method.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

std::string leaf_digest(const CollectorsState& state) {
    Digest d;
    for (const Leaf& leaf : state.prepared.leaves.span()) {
        const std::int32_t faces[] = {leaf.lo[0], leaf.hi[0], leaf.lo[1],
                                      leaf.hi[1], leaf.lo[2], leaf.hi[2]};
        d.words({faces, 6});
    }
    return d.hex();
}

std::string collector_digest(const CollectorsState& state) {
    Digest d;
    for (const Collector& c : state.prepared.collectors.span()) {
        const float numbers[] = {c.centre[0], c.centre[1], c.centre[2], c.billboard_radius,
                                 c.extinction};
        d.floats({numbers, 5});
    }
    return d.hex();
}

/// Numbers that the photon map holds for each collector.
std::uint64_t coefficients_of(const CollectorsState& state) {
    const DepositPlan& deposit = state.lights.deposit;
    return std::uint64_t(deposit.channels) * std::uint64_t(deposit.coefficients) *
           state.lights.lighting.lights.size() * state.ring.photons.slots.size();
}

void explain_deposit(const FrameView& view, const CollectorsState& state, Plan& plan) {
    if (const char* why =
            why_no_peak(view, state.settings.peak_deg, state.lights.deposit.by_bands, state))
        plan.leave_out("the beam's peak", why);
    explain_axis(why_no_collectors_axis(view, state), state, plan);
    explain_split(splits_first_order(state), state, plan);
}

}  // namespace

void CollectorsReport::explain(const Context& context, const FrameView& view, Plan& plan) const {
    const CollectorsState& state = of_.state();
    explain_photon_lights(view, state, plan);
    plan.bias = collectors_bias(state.settings);
    explain_deposit(view, state, plan);
    plan.need("samples");
    plan.need("tree");
    plan.need("collectors");
    plan.need("majorants");
    explain_photon_picture(view, state, is_marched(state) ? "marched display" : "billboards", plan);
    if (!state.settings.display.billboards) plan.leave_out("billboards", "display = \"march\"");
    note_media(view.world.media_plan, plan);
    plan.skip(Stage::kPaths);
    note_collectors_limits(context, view, plan);
}

void note_collectors_limits(const Context& context, const FrameView& view, Plan& plan) {
    note_limits(view.scene, view.world.medium.grid, context.limits,
                {LimitId::kVoxels, LimitId::kSamples, LimitId::kPhotons, LimitId::kPixels,
                 LimitId::kFrames, LimitId::kMemory, LimitId::kScatterings, LimitId::kWork},
                plan);
}

void CollectorsReport::digest(const FrameView& view, Digests& digests) const {
    digests = {{"density", density_digest(view.world)},
               {"leaves", leaf_digest(of_.state())},
               {"collectors", collector_digest(of_.state())}};
}

LightGoal CollectorsReport::goal(const FrameView&) const {
    return photon_goal(of_.state(), of_.state().ring.generations);
}

void CollectorsReport::report(Report& report) const {
    const CollectorsState& state = of_.state();
    report.prepared.samples = state.prepared.samples;
    report.prepared.leaves = state.prepared.leaves.size();
    report.prepared.collectors = state.prepared.collectors.size();
    report_photons(state, report);
    report.executed.emplace_back("coefficients", coefficients_of(state));
}

void CollectorsReport::put_work(const FrameWork& work, MethodTables& tables) const {
    if (of_.state().picture.thins) pileus::put_work(work, tables.collectors.thin);
    tables.collectors.light_refresh = work.light_refresh;
}

std::unique_ptr<MethodReport> collectors_report(CollectorsMethod& method) {
    return std::make_unique<CollectorsReport>(method);
}

}  // namespace pileus
