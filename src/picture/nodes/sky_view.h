// SPDX-License-Identifier: Apache-2.0
// Skylight on nodes as a camera sees it: how much of each part of the sphere is scattered its way.
// in: phase functions, a camera, what nodes see of each part -> out: brightness per node and set.
// docs/raymarch.md, "Skylight".
#pragma once
#include <array>

#include "kernels_cpu/core/camera.h"
#include "kernels_cpu/isa/kernels.h"
#include "kernels_cpu/raymarch/raymarch_params.h"
#include "kernels_cpu/raymarch/sky_turn_params.h"
#include "src/base/span.h"
#include "src/world/medium/medium.h"

namespace pileus {

/// Unit vector within a part, at shares u and v of its height and width: its middle.
std::array<float, 3> sky_direction(int part, double u = 0.5, double v = 0.5);
using SkyDirections = std::array<std::array<float, 3>, kSkyParts>;
SkyDirections sky_directions();

/// To whom light of the sky is scattered: to a camera, or alike to all sides.
struct SkyView {
    bool turned = false;
    CameraParams camera{};  ///< in metres of the box
    float anisotropy = 0;   ///< of an octave over that of the one before
};

/// Numbers per node of what it sees: e^-tau of each part; then, for a camera and more than one
/// octave, of each part what later octaves let through and that times three mean cosines, and the
/// sum of both over all parts were nothing absorbed: a number and a vector.
constexpr int sky_seen_numbers(bool turned, int octaves) {
    return turned && octaves > 1 ? 3 * kSkyParts + 4 : kSkyParts;
}

/// Share of light that comes from a direction within a part of the sphere and is scattered by an
/// angle, the angle to the part's middle: by its cosine, from -1 to 1. Its mean over the sphere
/// is 1.
using SkyPhase = std::array<float, kSkyPhaseSteps + 1>;

/// Mean over all media, each over a disc as large as a part.
SkyPhase sky_phase(const Medium& medium);

struct SkyViewInput {
    NodeGrid grid{};
    const SkyView* view = nullptr;
    const SkyPhase* phase = nullptr;
    const SkyDirections* middles = nullptr;
    int sets = 0, octaves = 1;
    const double (*share)[kSkyParts] = nullptr;  ///< of each set from each part, at most its own
    Span<const float> seen;                      ///< [number][node]
};

/// What a launch of turn_sky takes.
SkyTurnParams sky_turn_params(const SkyViewInput& in);

/// Brightness of nodes [begin, end) in each set, [set][node]. `kernels`: a table of the host.
void turn_sky_nodes(const SkyViewInput& in, const KernelTable& kernels, std::uint32_t begin,
                    std::uint32_t end, float* light);

}  // namespace pileus
