// SPDX-License-Identifier: Apache-2.0
// See photon_frames.h.
// in: frames, budgets -> out: slots of sums, filled.
// docs/collectors.md
#include "src/photons/photon_frames.h"

#include <algorithm>

#include "platform/clock.h"
#include "src/photons/photon_report.h"

namespace pileus {
namespace {

/// The ring of an animation is whole, or as far as the time went.
Status ring_state(const PhotonRun& run) {
    return run.interrupted ? interrupted_before("the frame's ring of generations was whole")
                           : Status::ok();
}

/// Fills the ring of the first frame that is asked for. Frame f has generations f .. f + p - 1.
Status fill_ring(int frame, const Context& context, PhotonRun& run, const ShootPhotons& shoot) {
    run.next_generation = std::uint64_t(frame);
    const auto aim = [&] {
        // Generation g >= p was shot for frame g - p + 1; those before it under frame 0's sun.
        const std::uint64_t g = run.next_generation;
        const int shown = g < run.generations ? 0 : int(g - run.generations + 1);
        if (run.place_at) run.place_at(shown);
        set_photon_sun(run.sun_of(shown), run);
    };
    const Status shot =
        shoot_generations(context, run, wanted_generations(run, run.generations), aim, shoot);
    if (run.place_at) run.place_at(frame);
    PILEUS_TRY(shot);
    // Time cut it short: what there is begins at the first slot, so that no gap lies before it.
    std::vector<PhotonSlot>& slots = run.photons.slots;
    if (run.next_generation - std::uint64_t(frame) < slots.size()) {
        run.ring_first = std::uint64_t(frame);
        run.ring_sum.counted.clear();
        std::rotate(slots.begin(), slots.begin() + std::ptrdiff_t(run.ring_first % slots.size()),
                    slots.end());
        set_photon_sun(run.sun_of(frame), run);
    }
    return ring_state(run);
}

}  // namespace

std::uint64_t wanted_generations(const PhotonRun& run, std::uint64_t all) {
    const std::uint64_t most = std::uint64_t(run.budget.generations);
    return most > 0 && most < all ? most : all;
}

Status interrupted_before(const char* what) {
    return {Code::kCheckFailed, std::string("interrupted before ") + what + "; no file written"};
}

Status shoot_generations(const Context& context, PhotonRun& run, std::uint64_t count,
                         const std::function<void()>& aim, const ShootPhotons& shoot) {
    const StageClock clock(context, "photons");
    const double start = wall_seconds();
    context.hold(true);
    for (std::uint64_t g = 0; g < count; ++g) {
        run.interrupted = context.stop();
        if (run.interrupted) break;
        aim();
        PILEUS_TRY(shoot());
        if (run.interrupted) break;
        context.tell("photons", double(g + 1) / double(count));
        // Time only chooses a whole number of generations, which the report records.
        if (run.budget.seconds > 0 && wall_seconds() - start >= run.budget.seconds) break;
    }
    return Status::ok();
}

Status shoot_frame(const FrameStep& step, const Context& context, PhotonRun& run,
                   const ShootPhotons& shoot) {
    const Scene& scene = *run.scene;
    const auto nothing = [] {};
    if (!step.first) {
        set_photon_sun(run.sun_of(step.frame), run);
        PILEUS_TRY(shoot_generations(context, run, 1, nothing, shoot));
        return ring_state(run);
    }
    if (scene.animation.present) return fill_ring(step.frame, context, run, shoot);
    PILEUS_TRY(
        shoot_generations(context, run, wanted_generations(run, run.generations), nothing, shoot));
    return run.next_generation > 0 ? Status::ok() : interrupted_before("the first generation");
}

Status light_photon_frame(const FrameStep& step, const Context& context, PhotonRun& run,
                          const ShootPhotons& shoot) {
    PILEUS_TRY(shoot_frame(step, context, run, shoot));
    if (!kPlans || !context.digests) return Status::ok();
    const StageClock clock(context, "digests");
    digest_photons(context.threads, run.photons);
    return Status::ok();
}

Status advance_photons(std::uint64_t units, const Context& context, PhotonRun& run,
                       const ShootPhotons& shoot, std::uint64_t& done) {
    const StageClock clock(context, "photons");
    for (done = 0; done < units; ++done) {
        run.interrupted = context.stop();
        if (run.interrupted) return Status::ok();
        // The ledger is that of the last turn of the ring, so that its bounds hold for ever.
        if ((run.next_generation - run.ring_first) % run.generations == 0)
            run.photons.tallies.assign(run.lighting.lights.size(), TraceTally{});
        PILEUS_TRY(shoot());
        if (run.interrupted) return Status::ok();
        context.tell("photons", double(done + 1) / double(units));
    }
    return Status::ok();
}

LightUnits photon_units(const PhotonRun& run) {
    LightUnits out;
    out.unit = "generation";
    out.whole = run.generations;
    for (const Light& light : run.lighting.lights) out.unit_photons += light.photons;
    for (const PhotonSlot& slot : run.photons.slots) out.held += slot.generations;
    out.prepared = run.layouts;
    out.one_sum = !run.ring;
    return out;
}

FrameWork photon_full_work(const MethodRun& method_run) {
    const PhotonRun& run = static_cast<const PhotonRun&>(method_run);
    FrameWork out;
    if (run.thins) out = work_of(run.thin);
    out.light_refresh = run.light_refresh;
    out.photons = std::int64_t(photon_units(run).unit_photons);
    return out;
}

void photon_budget_used(int frame, const MethodRun& method_run, const Report& report,
                        Budget& used) {
    const PhotonRun& run = static_cast<const PhotonRun&>(method_run);
    if (report.photons.generations == 0) return;
    used.photons = run.budget_photons;
    // A film's ring counts on from frame to frame; its length is that of the first one.
    const bool ring = run.scene->animation.present && run.ring;
    used.generations = std::int64_t(report.photons.generations) - (ring ? frame : 0);
}

}  // namespace pileus
