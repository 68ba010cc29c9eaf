// SPDX-License-Identifier: Apache-2.0
// Which generations a frame is lit by, and how a session shoots more.
// in: a run, its method's way to shoot one generation -> out: generations shot.
// docs/methods.md 3, "Generations and error".
#pragma once
#include <functional>

#include "src/photons/photon_run.h"

namespace pileus {

/// Shoots one generation of the run.
using ShootPhotons = std::function<Status()>;

/// Up to `count` generations, fewer where the time of the budget is up or the user wants an end.
/// `aim` does what the next one asks for first.
Status shoot_generations(const Context& context, PhotonRun& run, std::uint64_t count,
                         const std::function<void()>& aim, const ShootPhotons& shoot);

/// `all`, or fewer where the budget says so.
std::uint64_t wanted_generations(const PhotonRun& run, std::uint64_t all);

/// Shoots what a frame of a run with a ring, or a still, needs: frame f has the generations
/// f .. f + p - 1, whatever frames were asked for, so that a part of an animation repeats the
/// whole's bits. kCheckFailed: interrupted before there was anything to show.
Status light_photon_frame(const FrameStep& step, const Context& context, PhotonRun& run,
                          const ShootPhotons& shoot);

/// The fault of an end before `what`.
Status interrupted_before(const char* what);

/// LiveMethod::advance, ::units and ::full_work.
Status advance_photons(std::uint64_t units, const Context& context, PhotonRun& run,
                       const ShootPhotons& shoot, std::uint64_t& done);
LightUnits photon_units(const PhotonRun& run);
FrameWork photon_full_work(const MethodRun& run);

/// Recipe::budget_used: generations, of as many photons in all.
void photon_budget_used(int frame, const MethodRun& run, const Report& report, Budget& used);

/// LiveMethod::most_units where the picture is marched.
Status photon_most_units(const FrameWork& work, const PhotonRun& run, FrameUnits& out);

}  // namespace pileus
