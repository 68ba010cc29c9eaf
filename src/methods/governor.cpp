// SPDX-License-Identifier: Apache-2.0
// See governor.h.
#include "src/methods/governor.h"

#include <algorithm>

namespace pileus {
namespace {

/// Fewest steps of a ray that still show a cloud.
constexpr int kFewestSteps = 16;
/// Frames with time to spare before more is tried.
constexpr std::uint32_t kPatience = 16;
/// Share of the target below which there is time to spare, and that more may take.
constexpr double kSpare = 0.8, kFits = 0.9;
/// What is left of the memory of a level that was too slow, each time that it would be tried.
constexpr double kForget = 0.95;
/// Weight of the newest frame in a level's cost.
constexpr double kNewest = 0.25;

double median(double a, double b, double c) {
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

void go_to(std::size_t level, Governor& g) {
    g.level = std::uint32_t(level);
    g.frames = g.spare = 0;
}

void note_frame(double frame_s, Governor& g) {
    double& cost = g.cost_s[g.level];
    const bool first = g.frames == 2;
    const double middle = g.frames > 3 ? median(frame_s, g.recent_s[0], g.recent_s[1]) : frame_s;
    g.recent_s[1] = g.recent_s[0];
    g.recent_s[0] = frame_s;
    const double before = cost;
    cost = first ? middle : cost + kNewest * (middle - cost);
    // Another load, or another view, makes all levels dearer or cheaper alike.
    for (std::size_t i = 0; i < kMaxWorkLevels && !first; ++i)
        if (i != g.level) g.cost_s[i] *= cost / before;
}

}  // namespace

std::vector<FrameWork> work_ladder(const FrameWork& whole) {
    std::vector<FrameWork> out{whole};
    const auto add = [&](const FrameWork& next) {
        if (out.size() < kMaxWorkLevels && !(next == out.back())) out.push_back(next);
    };
    FrameWork next = whole;
    if (whole.temporal > 0) {
        next.temporal = 4;
        add(next);
    } else if (whole.scale > 0) {
        while (next.scale < 4) {
            next.scale *= 2;
            add(next);
        }
    }
    for (int part = 2; part <= 16 && whole.photons > 0; part *= 2) {
        next.photons = std::max<std::int64_t>(whole.photons / part, 1);
        add(next);
    }
    for (int quarters = 3; quarters >= 1 && whole.steps > kFewestSteps; --quarters) {
        next.steps = std::max(whole.steps * quarters / 4, kFewestSteps);
        add(next);
    }
    return out;
}

FrameWork govern(const std::vector<FrameWork>& ladder, double frame_s, Governor& g) {
    const std::size_t last = std::min(ladder.size(), kMaxWorkLevels) - 1;
    if (g.level > last) go_to(last, g);
    if (!(frame_s > 0)) return ladder[g.level];
    // The first frame of a level makes what the level needs; it is no measure of it.
    if (++g.frames == 1) return ladder[g.level];
    note_frame(frame_s, g);
    const double cost = g.cost_s[g.level];
    if (cost > g.target_s && g.level < last && g.frames > 3) {
        const std::size_t down = cost > 2 * g.target_s ? 2 : 1;
        go_to(std::min<std::size_t>(g.level + down, last), g);
    } else if (g.level > 0 && cost <= kSpare * g.target_s) {
        if (++g.spare < kPatience) return ladder[g.level];
        g.spare = 0;
        double& above = g.cost_s[g.level - 1];
        if (above <= kFits * g.target_s)
            go_to(g.level - 1, g);
        else
            above *= kForget;
    } else {
        g.spare = 0;
    }
    return ladder[g.level];
}

}  // namespace pileus
