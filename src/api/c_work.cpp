// SPDX-License-Identifier: Apache-2.0
// pileus.h: what a frame of a session may cost, and the governor.
#include "src/api/c_types.h"

namespace pileus::api {
namespace {

static_assert(kMaxWorkLevels + 2 <= 16, "own_times has room for the governor's");

pileus_work give_work(const FrameWork& work) {
    pileus_work out{};
    out.scale = std::uint32_t(work.scale);
    out.temporal = std::uint32_t(work.temporal);
    out.steps = std::uint32_t(work.steps);
    out.light_refresh = std::uint32_t(work.light_refresh);
    out.photons = std::uint64_t(work.photons);
    return out;
}

Status take_work(const pileus_work& given, FrameWork& work) {
    for (const std::uint32_t n : {given.scale, given.temporal, given.steps, given.light_refresh})
        if (n > 1u << 30)
            return Status::bad_input("work: " + std::to_string(n) + ", allowed: up to 2^30");
    if (given.photons > std::uint64_t{1} << 62)
        return Status::bad_input("work.photons: " + std::to_string(given.photons) +
                                 ", allowed: up to 2^62");
    work = {int(given.scale), int(given.temporal), int(given.steps), int(given.light_refresh),
            std::int64_t(given.photons)};
    return Status::ok();
}

Status take_costs(const pileus_costs& given, UnitCosts& costs) {
    for (const double c : {given.fixed, given.pixel, given.ray, given.sample, given.photon})
        if (!(c >= 0 && c < 1e30))
            return Status::bad_input("costs: out of range, allowed: 0 to 1e30 each");
    costs = {given.fixed, given.pixel, given.ray, given.sample, given.photon};
    return Status::ok();
}

Governor take_governor(const pileus_governor& given) {
    Governor out;
    out.target_s = given.target_s;
    out.level = given.level;
    out.frames = given.own_counts[0];
    out.spare = given.own_counts[1];
    for (std::size_t i = 0; i < 2; ++i) out.recent_s[i] = given.own_times[i];
    for (std::size_t i = 0; i < kMaxWorkLevels; ++i) out.cost_s[i] = given.own_times[2 + i];
    return out;
}

void give_governor(const Governor& governor, pileus_governor& out) {
    out.level = governor.level;
    out.own_counts[0] = governor.frames;
    out.own_counts[1] = governor.spare;
    for (std::size_t i = 0; i < 2; ++i) out.own_times[i] = governor.recent_s[i];
    for (std::size_t i = 0; i < kMaxWorkLevels; ++i) out.own_times[2 + i] = governor.cost_s[i];
}

}  // namespace
}  // namespace pileus::api

using namespace pileus;
using namespace pileus::api;

extern "C" {

pileus_code pileus_session_set_work(pileus_session* session, const pileus_work* work,
                                    pileus_error* error) {
    if (session == nullptr) return no_session(error);
    return call(*session, error, [&]() -> Status {
        pileus_work own;
        if (!take(work, own)) return no_struct("work");
        FrameWork next;
        PILEUS_TRY(take_work(own, next));
        return session->session->set_work(next);
    });
}

pileus_code pileus_session_work(const pileus_session* session, pileus_work* work,
                                pileus_error* error) {
    if (session == nullptr) return no_session(error);
    return call(*session, error, [&]() -> Status {
        return give(give_work(session->session->work()), work, "work");
    });
}

pileus_code pileus_session_govern(const pileus_session* session, pileus_governor* governor,
                                  double frame_s, pileus_work* work, pileus_error* error) {
    if (session == nullptr) return no_session(error);
    return call(*session, error, [&]() -> Status {
        pileus_governor own;
        if (!take(governor, own) || marked_size(governor->struct_size) < sizeof(pileus_governor))
            return no_struct("governor");
        if (!(own.target_s > 0 && own.target_s < 1e6))
            return Status::bad_input("governor.target_s: out of range, allowed: above 0, to 1e6");
        for (const double s : own.own_times)
            if (!(s >= 0))
                return Status::bad_input(
                    "governor.own_times: out of range, allowed: as the last call left them; 0 at "
                    "first");
        if (!(frame_s >= 0 && frame_s < 1e9))
            return Status::bad_input("frame_s: out of range, allowed: 0 to 1e9");
        PILEUS_TRY(session->session->refuse_clouds_sky("work"));
        Governor state = take_governor(own);
        const FrameWork next = govern(session->session->work_levels(), frame_s, state);
        PILEUS_TRY(give(give_work(next), work, "work"));
        give_governor(state, *governor);
        return Status::ok();
    });
}

pileus_code pileus_session_most_units(pileus_session* session, const pileus_work* work,
                                      pileus_units* most, pileus_error* error) {
    if (session == nullptr) return no_session(error);
    return call(*session, error, [&]() -> Status {
        FrameWork given = session->session->work();
        if (work != nullptr) {
            pileus_work own;
            if (!take(work, own)) return no_struct("work");
            PILEUS_TRY(take_work(own, given));
        }
        FrameUnits units;
        PILEUS_TRY(session->session->most_units(given, units));
        pileus_units out{};
        out.pixels = units.pixels;
        out.rays = units.rays;
        out.samples = units.samples;
        out.photons = units.photons;
        return give(out, most, "most");
    });
}

pileus_code pileus_session_fit(pileus_session* session, const pileus_costs* costs, double most,
                               pileus_work* work, pileus_error* error) {
    if (session == nullptr) return no_session(error);
    return call(*session, error, [&]() -> Status {
        pileus_costs own;
        if (!take(costs, own)) return no_struct("costs");
        UnitCosts given;
        PILEUS_TRY(take_costs(own, given));
        if (!(most >= 0 && most < 1e30))
            return Status::bad_input("most: out of range, allowed: 0 to 1e30");
        FrameWork next;
        const Status fits = session->session->fit_work(given, most, next);
        if (!fits && fits.code != Code::kLimit) return fits;
        PILEUS_TRY(give(give_work(next), work, "work"));
        return fits;
    });
}

}  // extern "C"
