// SPDX-License-Identifier: Apache-2.0
// The work of a live session's frames: what a host or the governor chose, checked and taken up.
// in: FrameWork -> out: limits of the session's method, or what is wrong.
// docs/realtime.md, "Work and the governor"
#include "platform/fp_mode.h"
#include "src/picture/upsample.h"
#include "src/scene/number_keys.h"
#include "src/scene/read_scene.h"
#include "src/session/session.h"

namespace pileus {
namespace {

Status refuse(const char* what, std::int64_t value, const std::string& allowed) {
    return Status::bad_input(std::string("work.") + what + ": " + std::to_string(value) +
                             ", allowed: " + allowed);
}

/// A member that the method does not have, or that is beyond the scene's.
Status check_work(const FrameWork& given, const FrameWork& whole, const std::string& method) {
    const std::string none = "0, as method " + method + " has none here";
    if (given.scale != 0 && (whole.scale == 0 || whole.temporal > 0))
        return refuse("scale", given.scale, whole.temporal > 0 ? "0, with temporal" : none);
    if (given.temporal != 0 && whole.temporal == 0)
        return refuse("temporal", given.temporal, "0 where the scene has none");
    if (given.steps < 0 || (given.steps != 0 && whole.steps == 0))
        return refuse("steps", given.steps, given.steps < 0 ? "0 and more" : none);
    if (given.light_refresh != 0 && whole.light_refresh == 0)
        return refuse("light_refresh", given.light_refresh, none);
    if (given.photons < 0 || given.photons > whole.photons)
        return refuse("photons", given.photons,
                      whole.photons > 0 ? "0 to " + std::to_string(whole.photons) : none);
    return Status::ok();
}

/// Null where all members are sound for sure.
const char* work_fault(const FrameWork& work, const FrameWork& whole) {
    const auto one_of = [](int v, int a, int b, int c) { return v == a || v == b || v == c; };
    if (whole.scale > 0 && !one_of(work.scale, 1, 2, 4)) return "work.scale";
    if (!one_of(work.temporal, 0, 2, 4) || (work.temporal > 0 && work.scale > 1))
        return "work.temporal";
    if (whole.steps > 0 && (work.steps < 1 || work.steps > whole.steps)) return "work.steps";
    const bool refreshed = holds(range_of(&RaymarchLightSettings::refresh), work.light_refresh);
    return whole.light_refresh > 0 && !refreshed ? "work.light_refresh" : nullptr;
}

template <class T>
T chosen(T given, T whole) {
    return given != 0 ? given : whole;
}

FrameWork filled(const FrameWork& given, const FrameWork& whole) {
    FrameWork work;
    work.scale = chosen(given.scale, whole.scale);
    work.temporal = chosen(given.temporal, whole.temporal);
    work.steps = chosen(given.steps, whole.steps);
    work.light_refresh = chosen(given.light_refresh, whole.light_refresh);
    work.photons = chosen(given.photons, whole.photons);
    return work;
}

}  // namespace

Status Session::set_work(const FrameWork& given) {
    const FpModeGuard guard;
    PILEUS_TRY(check_work(given, whole_work_, scene_.method));
    const FrameWork work = filled(given, whole_work_);
    if (!(given == FrameWork{})) PILEUS_TRY(refuse_clouds_sky("work"));
    if (work == work_) return Status::ok();
    if (const char* key = work_fault(work, whole_work_)) {
        const auto change = [&](Scene& changed) {
            made_.report->put_work(work, changed);
            changed.camera = host_.camera;
            changed.sun = host_.sun;
            changed.ground = host_.ground;
            changed.lights = host_.lights;
        };
        PILEUS_TRY(check_changed(key, scene_, change));
        Scene named;
        named.file = "session";
        UpsampleSettings thin;
        put_work(work, thin);
        PILEUS_TRY(check_upsampling(named, "work", thin));
    }
    // The method is the last to refuse.
    PILEUS_TRY(made_.method->set_limits(work));
    work_ = work;
    report_.frame_work = work_;
    report_.light_rule.clear();
    return Status::ok();
}

std::vector<FrameWork> Session::work_levels() const {
    FrameWork whole = whole_work_;
    if (light().one_sum) whole.photons = 0;
    std::vector<FrameWork> out = work_ladder(whole);
    for (FrameWork& work : out)
        if (whole.photons == 0) work.photons = whole_work_.photons;
    return out;
}

Status Session::most_units(const FrameWork& given, FrameUnits& units) {
    const FpModeGuard guard;
    PILEUS_TRY(refuse_clouds_sky("work"));
    PILEUS_TRY(check_work(given, whole_work_, scene_.method));
    const PoolGuard lent(*threads_);
    PILEUS_TRY(aim());
    units = {};
    return made_.method->worst_case(view(), filled(given, whole_work_), units);
}

Status Session::fit_work(const UnitCosts& costs, double most, FrameWork& work) {
    double least = 0;
    for (const FrameWork& level : work_levels()) {
        FrameUnits units;
        PILEUS_TRY(most_units(level, units));
        work = level;
        least = cost_of(units, costs);
        if (least <= most) return Status::ok();
    }
    const double percent = most > 0 ? 100 * least / most : 1e9;
    return {Code::kLimit, "work: the least takes up to " +
                              std::to_string(std::uint64_t(percent < 1e9 ? percent : 1e9)) +
                              " % of what a frame may, allowed: 100"};
}

}  // namespace pileus
