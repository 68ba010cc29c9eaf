// SPDX-License-Identifier: Apache-2.0
// The governor: less work where frames are too slow, more where there is time, no hunting.
// in: made-up costs of levels -> out: checks.
// docs/realtime.md, "Work and the governor"
#include "src/methods/governor.h"

#include <doctest/doctest.h>

using namespace pileus;

namespace {

const FrameWork kMarch{1, 0, 0, 8, 20000};

/// Flies `frames` frames whose cost is that of their level; the levels they had.
std::vector<std::uint32_t> fly(const std::vector<FrameWork>& ladder,
                               const std::vector<double>& cost_s, int frames, Governor& g) {
    std::vector<std::uint32_t> out;
    double last = 0;
    for (int f = 0; f < frames; ++f) {
        const FrameWork work = govern(ladder, last, g);
        CHECK(work == ladder[g.level]);
        out.push_back(g.level);
        last = cost_s[g.level];
    }
    return out;
}

int changes(const std::vector<std::uint32_t>& levels, std::size_t from) {
    int n = 0;
    for (std::size_t i = from + 1; i < levels.size(); ++i) n += levels[i] != levels[i - 1];
    return n;
}

}  // namespace

TEST_CASE("governor: the ladder falls from the scene's work, each step less than the one before") {
    const auto march = work_ladder(kMarch);
    REQUIRE(march.size() == 7);
    CHECK(march[0] == kMarch);
    CHECK(march[1].scale == 2);
    CHECK(march[2].scale == 4);
    CHECK(march[2].photons == 20000);
    CHECK(march[6].photons == 1250);
    const auto rays = work_ladder({0, 2, 96, 1, 0});
    REQUIRE(rays.size() == 5);
    CHECK(rays[1].temporal == 4);
    CHECK(rays[2].steps == 72);
    CHECK(rays[4].steps == 24);
    // One step, one photon, nothing to choose.
    CHECK(work_ladder({4, 0, 1, 1, 0}).size() == 1);
    CHECK(work_ladder({0, 0, 0, 1, 1}).size() == 1);
    CHECK(work_ladder({}).size() == 1);
}

TEST_CASE("governor: it ends at the finest level that is fast enough, and stays") {
    const auto ladder = work_ladder(kMarch);
    const std::vector<double> cost{0.050, 0.030, 0.015, 0.012, 0.011, 0.010, 0.010};
    Governor g;
    g.target_s = 0.0167;
    const auto levels = fly(ladder, cost, 400, g);
    CHECK(levels[0] == 0);
    CHECK(levels[30] == 2);
    CHECK(levels.back() == 2);
    // Level 2 takes nine tenths of the time: nothing finer is tried.
    CHECK(changes(levels, 30) == 0);
}

TEST_CASE("governor: what is known to be too slow is seldom tried again") {
    const auto ladder = work_ladder(kMarch);
    const std::vector<double> cost{0.050, 0.018, 0.008, 0.007, 0.006, 0.005, 0.005};
    Governor g;
    g.target_s = 0.0167;
    const auto levels = fly(ladder, cost, 2000, g);
    int slow = 0;
    for (std::size_t i = 100; i < levels.size(); ++i) slow += levels[i] < 2;
    CHECK(slow > 0);  // it would notice if level 1 had become fast
    CHECK(slow < 100);
}

TEST_CASE("governor: one frame that was held up changes nothing, ten do") {
    const auto ladder = work_ladder(kMarch);
    Governor g;
    g.target_s = 0.020;
    fly(ladder, std::vector<double>(7, 0.017), 20, g);
    REQUIRE(g.level == 0);
    govern(ladder, 0.5, g);
    for (int i = 0; i < 5; ++i) govern(ladder, 0.017, g);
    CHECK(g.level == 0);
    for (int i = 0; i < 10; ++i) govern(ladder, 0.5, g);
    CHECK(g.level > 1);
    // And back up when the load is gone.
    fly(ladder, std::vector<double>(7, 0.010), 4000, g);
    CHECK(g.level == 0);
}

TEST_CASE("governor: the last level is kept however slow, and the same seconds choose the same") {
    const auto ladder = work_ladder(kMarch);
    Governor a, b;
    a.target_s = b.target_s = 0.001;
    const std::vector<double> slow(7, 1.0);
    CHECK(fly(ladder, slow, 100, a) == fly(ladder, slow, 100, b));
    CHECK(a.level == ladder.size() - 1);
    // A ladder that has become shorter.
    CHECK(govern({kMarch}, 0.5, a) == kMarch);
}

TEST_CASE("governor: work three times the budget for a thousand frames, and what is late of them") {
    const auto ladder = work_ladder(kMarch);
    const std::vector<double> cost{0.0140, 0.0080, 0.0040, 0.0034, 0.0030, 0.0028, 0.0027};
    std::vector<double> heavy = cost;
    for (double& c : heavy) c *= 3;
    Governor g;
    g.target_s = 0.015;
    fly(ladder, cost, 200, g);
    REQUIRE(g.level == 0);
    const auto levels = fly(ladder, heavy, 1000, g);
    // Seven frames until it is noticed; then one in fifty at most, that tries whether the load is
    // gone.
    int late = 0;
    for (std::size_t i = 8; i < levels.size(); ++i) {
        CHECK(levels[i] >= 1);
        late += heavy[levels[i]] > g.target_s;
    }
    CHECK(late > 0);
    CHECK(late <= 20);
    // And all of the work when the load is gone, without a late frame.
    for (const std::uint32_t level : fly(ladder, cost, 4000, g)) CHECK(cost[level] <= g.target_s);
    CHECK(g.level == 0);
}
