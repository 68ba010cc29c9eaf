// SPDX-License-Identifier: Apache-2.0
// See cloud.h. A cloud by its age in seconds: turrets rise one after the other, grow soft and are
// mixed away.
// in: resolved settings -> out: balls where they are by then, age and water.
// docs/generators.md, "Life"; Cotton, Bryan, van den Heever 2011, "Storm and cloud dynamics",
// ch. 7.
#include <algorithm>

#include "kernels_cpu/core/rng.h"
#include "src/base/random_streams.h"
#include "src/world/density/cloud.h"

namespace pileus {
namespace {

// Shares of a life.
constexpr double kLastBirth = 0.35;           // turrets rise from 0 to here
constexpr double kRise = 0.28;                // and take so long
constexpr double kSoft = 0.3, kSoften = 0.3;  // after which they grow soft, and for how long
constexpr double kAges = 0.4;                 // the cloud as a whole falls apart from here on
constexpr double kFades = 0.62;               // and its water goes from here on
constexpr double kAnvilFrom = 0.25, kAnvilTo = 0.6;
constexpr double kLift = 0.8;     // heights that lumps rise in a life
constexpr double kMixedIn = 1.2;  // dry air at the edge in the end

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
    return out;
}

CloudSettings cloud_at_age(const CloudSettings& s) {
    CloudSettings out = s;
    if (!s.lives()) return out;
    const double share = cloud_life(s).share;
    const double old = smooth((share - kAges) / (1 - kAges));
    out.age = s.age + (1 - s.age) * old;
    out.dilution = s.dilution + kMixedIn * old;
    out.anvil = s.anvil * smooth((share - kAnvilFrom) / (kAnvilTo - kAnvilFrom));
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
    float grown[kMaxTurrets], fresh[kMaxTurrets];
    for (std::size_t i = 0; i < turrets; ++i) {
        const std::uint32_t key = make_key(std::uint64_t(s.seed), kCloudLifeStream, i).k0;
        const double chance = double(key >> 8) * 0x1p-24;
        const double birth =
            i == 0 ? 0 : kLastBirth * (0.7 * double(i) / double(turrets) + 0.3 * chance);
        grown[i] = float(smooth((share - birth) / kRise));
        fresh[i] = float(1 - smooth((share - birth - kSoft) / kSoften));
    }
    std::size_t kept = 0;
    for (std::size_t n = 0; n < heap.count; ++n) {
        const std::size_t i = turret[n];
        if (!(grown[i] > 0.02f)) continue;
        CloudBall b = heap.balls[n];
        const float up = grown[i], aside = 0.45f + 0.55f * up;
        b.x = feet[i].x + (b.x - feet[i].x) * aside;
        b.y = feet[i].y + (b.y - feet[i].y) * aside;
        b.z *= up;
        b.r *= up * (1 / 3.0f) + aside * (2 / 3.0f);
        // A small turret stands on the condensation level.
        b.r = std::min(b.r, std::max(b.z, 0.0f) + up * b.r);
        b.vigour *= fresh[i];
        b.join = 0.05f * b.r, b.unjoin = 0.25f / b.join;
        heap.balls[kept++] = b;
    }
    heap.count = kept;
}

}  // namespace pileus
