// SPDX-License-Identifier: Apache-2.0
// See blue_noise.h.
// in: nothing -> out: ranks by void and cluster, in whole numbers alone.
// docs/raymarch.md, "Jitter".
#include "src/picture/blue_noise.h"

#include "kernels_cpu/core/math.h"
#include "kernels_cpu/core/rng.h"
#include "kernels_cpu/raymarch/raymarch_params.h"

namespace pileus {
namespace {

constexpr int kEdge = kNoiseTile, kPixels = kEdge * kEdge;
constexpr int kReach = 7;  // beyond it the weight rounds to nothing that matters

/// Pixels taken so far, and how crowded each place is.
class Pattern {
public:
    Pattern() {
        // A Gaussian of 1.5 pixels, Ulichney's best, in units of 2^-20.
        for (int d = 0; d <= 2 * kReach * kReach; ++d)
            weight_[d] = std::int32_t(exp_(-float(d) / 4.5f) * 0x1p20f);
    }
    bool taken(int pixel) const { return taken_[pixel]; }
    void set(int pixel, bool taken) {
        taken_[pixel] = taken;
        const int x = pixel % kEdge, y = pixel / kEdge;
        for (int dy = -kReach; dy <= kReach; ++dy)
            for (int dx = -kReach; dx <= kReach; ++dx) {
                const int at = ((y + dy) & (kEdge - 1)) * kEdge + ((x + dx) & (kEdge - 1));
                const std::int32_t w = weight_[dx * dx + dy * dy];
                crowd_[at] += taken ? w : -w;
            }
    }
    /// The most crowded taken pixel, or the least crowded free one; the first of equals.
    int extreme(bool of_taken) const {
        int best = -1;
        for (int i = 0; i < kPixels; ++i) {
            if (taken_[i] != of_taken) continue;
            if (best < 0 || (of_taken ? crowd_[i] > crowd_[best] : crowd_[i] < crowd_[best]))
                best = i;
        }
        return best;
    }

private:
    std::int32_t weight_[2 * kReach * kReach + 1];
    std::int32_t crowd_[kPixels] = {};
    bool taken_[kPixels] = {};
};

/// A tenth of the pixels at random, then moved from clusters into voids until nothing moves.
void first_pattern(Pattern& p, int count) {
    for (std::uint32_t draw = 0, n = 0; int(n) < count; ++draw) {
        const int pixel = int(threefry<std::uint32_t>(7, 7, draw, 0).a % std::uint32_t(kPixels));
        if (p.taken(pixel)) continue;
        p.set(pixel, true);
        ++n;
    }
    for (int turn = 0; turn < 16 * kPixels; ++turn) {
        const int from = p.extreme(true);
        p.set(from, false);
        const int to = p.extreme(false);
        p.set(to, true);
        if (to == from) return;
    }
}

}  // namespace

Status make_blue_noise(Buffer<float>& tile) {
    constexpr int kFirst = kPixels / 10;
    // Who finds a tile takes it for a whole one: it comes last of what may fail.
    Buffer<Pattern> patterns;
    PILEUS_TRY(patterns.resize(2, "patterns of noise"));
    PILEUS_TRY(allocate(arrays::blue_noise(Stage::kWrite), tile));
    Pattern &start = patterns[0], &p = patterns[1];
    start = Pattern{};
    first_pattern(start, kFirst);
    const auto rank = [&](int pixel, int r) { tile[std::size_t(pixel)] = float(r) / kPixels; };
    // Ranks below the first pattern's number: what is most crowded goes last.
    p = start;
    for (int r = kFirst - 1; r >= 0; --r) {
        const int pixel = p.extreme(true);
        p.set(pixel, false);
        rank(pixel, r);
    }
    p = start;
    for (int r = kFirst; r < kPixels; ++r) {
        const int pixel = p.extreme(false);
        p.set(pixel, true);
        rank(pixel, r);
    }
    return Status::ok();
}

}  // namespace pileus
