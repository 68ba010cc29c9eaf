// SPDX-License-Identifier: Apache-2.0
// The phase function cornette-shanks: Henyey-Greenstein's times 1 + cos^2, Rayleigh's at g = 0.
// in: g -> out: the kernels' numbers, or a table.
// docs/phase.md, "Cornette and Shanks"; Cornette and Shanks 1992.
#include "src/base/angles.h"
#include "src/scene/rows/phase_row.h"
#include "src/world/phase/phase_table.h"

namespace pileus {
namespace {

constexpr PhaseNumber kG{"medium.N.phase.g", from_to(-1, 1), "",
                         "of cornette-shanks the same of the lobe that 1 + cos^2 shapes, required "
                         "there"};
constexpr KeyRow kKeys[] = {phase_key<kG>};

// Where Draine's function, which is this one at alpha = 1, is drawn to 1e-6 (docs/phase.md).
constexpr float kMinDrawn = 0.2f, kMaxDrawn = 0.99f;

/// Times a constant. `half` is the sine of half the angle to the peak.
double density(double size, double half) {
    const double edge = 1 - size, cosine = 1 - 2 * half * half;
    const double square = edge * edge + 4 * size * half * half;
    return (1 + cosine * cosine) / (square * __builtin_sqrt(square));
}

/// Nodes in steps that grow in proportion to the angle from the peak, beyond the peak's own width:
/// lines between them are within 1e-5 of the function for |g| <= 0.9999, within 4e-5 for all.
Status make_nodes(double g, PhaseNodes& nodes) {
    constexpr std::size_t kCells = 4096;
    const double size = g < 0 ? -g : g, width = (1 - size) / 3;
    // After so many equal factors a step is 1 / width times the first.
    double factor = 1 + 1 / width;
    for (std::size_t cells = kCells; cells > 1; cells /= 2) factor = __builtin_sqrt(factor);
    PILEUS_TRY(nodes.angle_deg.resize(kCells + 1, "phase table"));
    PILEUS_TRY(nodes.value.resize(kCells + 1, "phase table"));
    double power = 1;
    for (std::size_t i = 0; i <= kCells; ++i, power *= factor) {
        const double angle = i == kCells ? 180 : 180 * width * (power - 1);
        const std::size_t node = g < 0 ? kCells - i : i;
        nodes.angle_deg[node] = g < 0 ? 180 - angle : angle;
        nodes.value[node] = density(size, sincos_deg(0.5 * angle).sine);
    }
    return Status::ok();
}

Status make(const std::string&, const PhaseSettings& settings, PhaseStore& store,
            PhaseParams& params) {
    const float g = float(number_in(settings, kG));
    // All light straight on or straight back is a case of Henyey-Greenstein's alone.
    if (g <= -1 || g >= 1) {
        params = {kPhaseHg, g, 0, 1};
    } else if (g >= kMinDrawn && g <= kMaxDrawn) {
        params = {kPhaseHgDraine, 0, g, 0, 1, nullptr};
    } else {
        PhaseNodes nodes;
        PILEUS_TRY(make_nodes(double(g), nodes));
        PILEUS_TRY(make_phase_table("cornette-shanks", nodes, store));
        params = store.params();
    }
    return Status::ok();
}

}  // namespace

extern const PhaseRow cornette_shanks_phase{keys_of(kKeys), make};

}  // namespace pileus
