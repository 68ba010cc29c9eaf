// SPDX-License-Identifier: Apache-2.0
// See foretell.h.
#include "tools/pileus/foretell.h"

#include <algorithm>
#include <map>

namespace pileus {
namespace {

/// Seconds by stage; what no stage has counts as one of its own, without a name.
using Seconds = std::map<std::string, double>;

/// What stages took from one moment to a later one.
struct Moment {
    Seconds staged;
    double total_s = 0;

    Moment() = default;
    explicit Moment(const Report& report) : total_s(report.clocks.total_s) {
        for (const StageTime& stage : report.clocks.stages) staged[stage.name] += stage.wall_s;
    }
    Seconds since(const Moment& before) const {
        Seconds out;
        double rest = total_s - before.total_s;
        for (const auto& [name, seconds] : staged) {
            const auto then = before.staged.find(name);
            out[name] = seconds - (then == before.staged.end() ? 0 : then->second);
            rest -= out[name];
        }
        out[""] = std::max(rest, 0.0);
        return out;
    }
};

/// A first frame and a further one.
struct Trial {
    Seconds first, next;
};

/// With a share 1 / edge^2 of the pixels and photons.
Status try_small(const Scene& scene, const RenderOptions& options, int edge, Trial& trial) {
    Scene small = scene;
    if (small.crop[2] > 0)
        small.camera.resolution = {small.crop[2] - small.crop[0], small.crop[3] - small.crop[1]};
    small.crop = {};
    for (int& pixels : small.camera.resolution) pixels = std::max(pixels / edge, 1);
    const auto fewer = [edge](std::int64_t& photons) {
        if (photons > 0) photons = std::max(photons / (edge * edge), std::int64_t(1));
    };
    fewer(small.collectors.photons);
    fewer(small.photon_grid.photons);
    // Of depth images there are none of this size.
    small.view_files.depth.clear();
    RenderOptions some = options;
    fewer(some.budget.photons);
    some.digests = false;
    some.verify = 0;
    some.budget.state.clear();
    some.last_frame = std::min(options.last_frame, options.first_frame + 1);
    Moment before;
    return render(small, some, [&](int frame, Image&, Report& report) {
        const Moment now(report);
        // Clocks of stages begin anew where a frame has a session of its own.
        if (frame > some.first_frame && frames_stand_alone(scene)) before.staged.clear();
        (frame == some.first_frame ? trial.first : trial.next) = now.since(before);
        before = now;
        return Status::ok();
    });
}

/// Stages of light and of pixels, which parts of a picture divide.
bool is_divided(const std::string& stage) {
    for (const char* name : {"photons", "paths", "march", "blend", "background"})
        if (stage == name) return true;
    return false;
}

double grown(const Seconds& small, const Seconds& large, bool divided_alone) {
    constexpr double kMore = (1 - 1.0 / 16) / (1.0 / 16 - 1.0 / 64);
    double seconds = 0;
    for (const auto& [name, s] : large) {
        if (divided_alone && !is_divided(name)) continue;
        const auto before = small.find(name);
        seconds += s + kMore * std::max(before == small.end() ? s : s - before->second, 0.0);
    }
    return seconds;
}

}  // namespace

Status foretell_time(const Scene& scene, const RenderOptions& options, ForetoldTime& out) {
    if (options.budget.seconds > 0 || options.budget.error > 0)
        return Status::bad_input(
            "--time: a budget of seconds or of an error is no amount of work, "
            "allowed: another, or none");
    Trial small, large;
    PILEUS_TRY(try_small(scene, options, 8, small));
    PILEUS_TRY(try_small(scene, options, 4, large));
    out.first_s = grown(small.first, large.first, false);
    out.divided_s = grown(small.first, large.first, true);
    out.next_s = grown(small.next, large.next, false);
    out.total_s = out.first_s + (options.last_frame - options.first_frame) * out.next_s;
    return Status::ok();
}

}  // namespace pileus
