// SPDX-License-Identifier: Apache-2.0
// See animation.h.
#include "src/scene/animation.h"

#include <algorithm>

namespace pileus {
namespace {

const TrackRow& row_of(Track track) { return kTracks[std::size_t(track)]; }

/// The next key from `at` on that has the track, or before it; -1: none.
int key_from(const Animation& a, Track track, int at, int step) {
    for (; at >= 0 && at < int(a.keys.size()); at += step)
        if (a.keys[std::size_t(at)].given[std::size_t(track)]) return at;
    return -1;
}

/// Of one number over the keys `before`, `low`, `high`, `after`, of which the outer two may be -1.
struct Curve {
    const Animation& animation;
    Track track;
    std::size_t number;
    bool single;  ///< of a track of one number

    double value(int key) const { return animation.keys[std::size_t(key)].numbers[number]; }
    double frame(int key) const { return double(animation.keys[std::size_t(key)].frame); }
    double slope(int from, int to) const {
        return (value(to) - value(from)) / (frame(to) - frame(from));
    }
    /// At a key, from those beside it.
    double slope_at(int before, int key, int after) const {
        if (before < 0) return slope(key, after);
        if (after < 0) return slope(before, key);
        const double left = frame(key) - frame(before), right = frame(after) - frame(key);
        const double to = slope(before, key), from = slope(key, after);
        const double parabola = (to * right + from * left) / (left + right);
        if (!single) return parabola;
        // Rises and falls where its keys do (Fritsch and Carlson 1980).
        if (!(to * from > 0)) return 0;
        return to > 0 ? std::min(parabola, 3 * std::min(to, from))
                      : std::max(parabola, 3 * std::max(to, from));
    }
    double at(int low, int high, double f) const {
        const KeyWay way = animation.keys[std::size_t(low)].way;
        if (way == KeyWay::kStep) return value(low);
        const double length = frame(high) - frame(low), t = (f - frame(low)) / length;
        if (way == KeyWay::kLinear) return value(low) + (value(high) - value(low)) * t;
        const int before = key_from(animation, track, low - 1, -1);
        const int after = key_from(animation, track, high + 1, 1);
        const double m0 = slope_at(before, low, high), m1 = slope_at(low, high, after);
        const double u = 1 - t;
        return u * u * (1 + 2 * t) * value(low) + t * t * (1 + 2 * u) * value(high) +
               length * t * u * (u * m0 - t * m1);
    }
};

}  // namespace

bool has_track(const Animation& animation, Track track) {
    return key_from(animation, track, 0, 1) >= 0;
}

bool track_at(const Animation& animation, Track track, int frame, double* numbers) {
    int low = -1, high = -1;
    for (int k = key_from(animation, track, 0, 1); k >= 0;
         k = key_from(animation, track, k + 1, 1)) {
        high = k;
        if (animation.keys[std::size_t(k)].frame > frame) break;
        low = k;
    }
    if (high < 0) return false;
    const TrackRow& row = row_of(track);
    for (int i = 0; i < row.numbers; ++i) {
        const Curve curve{animation, track, std::size_t(row.first + i), row.numbers == 1};
        double v = curve.value(low < 0 ? high : low);
        if (low >= 0 && high != low) v = curve.at(low, high, double(frame));
        numbers[i] = v;
    }
    return true;
}

}  // namespace pileus
