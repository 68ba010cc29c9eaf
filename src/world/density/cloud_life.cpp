// SPDX-License-Identifier: Apache-2.0
// See cloud.h. A cloud by its age in seconds: turrets rise one after the other, grow soft and are
// mixed away.
// in: resolved settings -> out: balls where they are by then, age and water.
// docs/generators.md, "Life"; Cotton, Bryan, van den Heever 2011, "Storm and cloud dynamics",
// ch. 7.
#include <algorithm>

#include "kernels_cpu/core/rng.h"
#include "src/base/random_streams.h"
#include "src/scene/media/cloud_types.h"
#include "src/world/density/cloud.h"

namespace pileus {
namespace {

// Shares of a life.
constexpr double kLastBirth = 0.35;           // turrets rise from 0 to here
constexpr double kRise = 0.28;                // and take so long
constexpr double kSoft = 0.3, kSoften = 0.3;  // after which they grow soft, and for how long
constexpr double kAges = 0.4;                 // the cloud as a whole falls apart from here on
constexpr double kFades = 0.62;               // and its water goes from here on
constexpr double kRainFrom = 0.25, kRainTo = 0.5, kRainEnds = 0.7, kRainOver = 0.95;
constexpr double kAnvilFrom = 0.25, kAnvilTo = 0.6;
constexpr double kLift = 0.8;  // heights that lumps rise in a life
// Farther within than blending and lumps reach.
constexpr float kAnvilSunk = 0.35f;  // over the height
constexpr double kAnvilLeast = 0.3;  // of its radius, while it comes
constexpr double kComesOut = 0.4;    // share of a turret's rise in which balls come out of it
constexpr float kBallSunk = 0.5f;    // of the first octave's cell
constexpr double kMixedIn = 1.2;     // dry air at the edge in the end

double smooth(double t) {
    const double c = std::min(std::max(t, 0.0), 1.0);
    return c * c * (3 - 2 * c);
}

}  // namespace

CloudLife cloud_life(const CloudSettings& s) {
    CloudLife out;
    if (!s.lives()) return out;
    out.share = std::min(std::max(s.age_s / s.lifetime_s, 0.0), 1.0);
    out.lift = float(kLift * out.share);
    out.water = float(1 - smooth((out.share - kFades) / (1 - kFades)));
    out.anvil = smooth((out.share - kAnvilFrom) / (kAnvilTo - kAnvilFrom));
    out.anvil_sunk = kAnvilSunk * float((1 - out.anvil) * (1 - out.anvil));
    out.rain = smooth((out.share - kRainFrom) / (kRainTo - kRainFrom)) *
               (1 - smooth((out.share - kRainEnds) / (kRainOver - kRainEnds)));
    out.rained_s = (out.share - kRainFrom) * s.lifetime_s;
    return out;
}

CloudSettings cloud_at_age(const CloudSettings& s) {
    CloudSettings out = s;
    if (!s.lives()) return out;
    const CloudLife life = cloud_life(s);
    const double share = life.share;
    const double old = smooth((share - kAges) / (1 - kAges));
    out.age = s.age + (1 - s.age) * old;
    out.dilution = s.dilution + kMixedIn * old;
    out.anvil = life.anvil > 0 ? s.anvil * (kAnvilLeast + (1 - kAnvilLeast) * life.anvil) : 0;
    return out;
}

void rise_turrets(const CloudSettings& s, const std::uint8_t* turret, const CloudFoot* feet,
                  std::size_t turrets, CloudHeap& heap) {
    const double share = s.age_s / s.lifetime_s;
    if (!(share > 0 && share < 1)) {
        heap.count = 0;
        return;
    }
    // How far each has risen, and how fresh it is.
    const float cell = s.anvil > 0 ? 0.11f : float(cloud_type(s.type).lump);
    float grown[kMaxTurrets], fresh[kMaxTurrets], outside[kMaxTurrets];
    for (std::size_t i = 0; i < turrets; ++i) {
        const std::uint32_t key = make_key(std::uint64_t(s.seed), kCloudLifeStream, i).k0;
        const double chance = double(key >> 8) * 0x1p-24;
        const double birth =
            i == 0 ? 0 : kLastBirth * (0.7 * double(i) / double(turrets) + 0.3 * chance);
        grown[i] = float(smooth((share - birth) / kRise));
        outside[i] = float(smooth((share - birth) / (kRise * kComesOut)));
        fresh[i] = float(1 - smooth((share - birth - kSoft) / kSoften));
    }
    std::size_t kept = 0;
    for (std::size_t n = 0; n < heap.count; ++n) {
        const std::size_t i = turret[n];
        if (!(outside[i] > 0)) continue;
        CloudBall b = heap.balls[n];
        const float up = grown[i], aside = 0.45f + 0.55f * up;
        b.x = feet[i].x + (b.x - feet[i].x) * aside;
        b.y = feet[i].y + (b.y - feet[i].y) * aside;
        b.z *= up;
        b.r *= up * (1 / 3.0f) + aside * (2 / 3.0f);
        b.spare = b.r;
        // Lumps of the first octave are large from the beginning: they come out with the ball.
        b.r = b.r * outside[i] - kBallSunk * cell * (1 - outside[i]);
        b.vigour *= fresh[i];
        heap.balls[kept++] = b;
    }
    heap.count = kept;
}

}  // namespace pileus
