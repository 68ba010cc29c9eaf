// SPDX-License-Identifier: Apache-2.0
// Fits directions about the sun to the peaks of the media's phase functions.
// in: phase functions -> out: what branches towards the sun are drawn by.
// docs/path.md, "Guide"
#pragma once
#include "kernels_cpu/path/path_params.h"
#include "src/world/medium/medium.h"

namespace pileus {

/// A phase function is peaked where it scatters more than this straight on, 1/sr. Those of
/// Henyey-Greenstein are from g = 0.913 on.
constexpr float kPeaked = 20;

/// A branch leaves each vertex that sends more than this towards the sun, 1/sr, and others with the
/// chance at which it brings about as much (measured: docs/path.md, "Guide").
constexpr float kGuideWorth = 0.5f;

/// The guide for these media; off where none of them is peaked. Within its cone the densest of the
/// phase functions is above kGuideFoot, and the guide's density follows it: its g is the one, of
/// 128, whose least density in units of the phase function is largest.
GuideParams fit_guide(const Medium& medium);

}  // namespace pileus
