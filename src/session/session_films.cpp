// SPDX-License-Identifier: Apache-2.0
// See session.h: what of it no flight has. Checks, what reports tell of plans, passes that a host
// may end. in: a session -> out: one line; light, pass by pass. docs/architecture.md;
// docs/program.md, "Interrupts"
#include "platform/clock.h"
#include "src/methods/support.h"
#include "src/session/session.h"
#include "src/session/stop_rule.h"

namespace pileus {

Status Session::check_method(bool hosted, const World* world) {
    PILEUS_TRY(row_.check(scene_, options_.budget));
    if (options_.find_view != nullptr && !options_.show.empty())
        PILEUS_TRY(options_.find_view(scene_.method, options_.show, row_));
    const std::string method = scene_.file + ": method.name: \"" + scene_.method + "\" ";
    if (hosted && !options_.show.empty())
        return Status::bad_input(method + "is for no session, allowed: another");
    if (world == nullptr) return Status::ok();
    if (world->media != scene_.media.size())
        return Status::bad_input(scene_.file + ": medium: " + std::to_string(scene_.media.size()) +
                                 " media, allowed: " + std::to_string(world->media) +
                                 ", as the world was made of");
    if (world->direct_sky && row_.world != WorldUse::kSkyInPlace)
        return Status::bad_input(method + "needs the sky on a grid, allowed: a world made for it");
    if (world->shows_particles != (row_.world == WorldUse::kParticles))
        return Status::bad_input(
            method +
            (world->shows_particles ? "needs the particles on a grid" : "needs the particles") +
            ", allowed: a world made for it");
    return Status::ok();
}

void Session::tell_plan(bool exact) {
    if (exact && context_.digests) made_.report->digest(scenery_.view(0), digests_);
    report_.plan = plan_;
}

Status Session::trace_passes(std::uint64_t held, std::uint64_t units, std::uint64_t& done) {
    Method& method = *made_.method;
    LightGoal goal;
    goal.most = held + units;
    const StopRule rule(goal);
    LightPass last;
    while (done < units) {
        const double start = wall_seconds();
        last.units = rule.next(method.progress(), 0, last);
        std::uint64_t more = 0;
        const Status status = method.accumulate(context_, view(), last.units, more);
        done += more;
        if (!status || method.progress().interrupted) return status;
        last.seconds = wall_seconds() - start;
    }
    return Status::ok();
}

Status Session::refuse_clouds_sky(const char* what) const {
    if (clouds_.use_count() < 2) return Status::ok();
    const Support& no = support(Feature::kSetLights, MethodColumn::kCloudSkies);
    return Status::bad_input(std::string(what) + ": " + no.text + ", allowed: " + no.allowed);
}

}  // namespace pileus
