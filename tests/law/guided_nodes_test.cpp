// SPDX-License-Identifier: Apache-2.0
// Laws of the filter of nodes: what follows the guides is kept, noise goes, sums stay linear.
// in: sums on small grids of nodes -> out: means compared. docs/collectors.md, "The filter of
// nodes".
#include <doctest/doctest.h>

#include <cmath>

#include "src/methods/collectors/photons/guided_grid.h"
#include "tests/support/hashed_number.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using pileus::test::number;

namespace {

/// Sums on a grid, to be filtered.
struct Rig {
    NodeGrid nodes;
    SplatOptions options;
    std::vector<float> depth, weight, value;
    int channels, threads = 1;

    Rig(int x, int y, int z, int numbers) : nodes{{x, y, z}, {1, 1, 1}}, channels(numbers) {
        const std::size_t n = std::size_t(node_count(nodes));
        depth.resize(n), weight.assign(n, 1), value.assign(n * std::size_t(channels), 0);
        for (std::size_t i = 0; i < n; ++i) depth[i] = 3 * number(i / 16, 7);
        options.guided = true;
        options.prior_mass = 1;
        options.sun_depth = depth.data();
        options.sun_fades = 0.5f;
    }
    float guide(std::size_t i) const { return std::exp(-0.5f * depth[i]); }

    /// Means by channel and node.
    std::vector<float> filter() const {
        const std::size_t n = std::size_t(node_count(nodes)), own = std::size_t(channels) + 1;
        Buffer<float> source;
        REQUIRE(
            allocate_once(arrays::source_grid(own, source_nodes(nodes), Stage::kDisplay), source));
        std::fill_n(source.data(), source.size(), 0.0f);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c + 1 < own; ++c)
                source[i * own + c] = weight[i] * value[c * n + i];
            source[i * own + own - 1] = weight[i];
        }
        const std::vector<NodeRange> all(std::size_t(nodes.size[1] * nodes.size[2]),
                                         NodeRange{0, nodes.size[0]});
        REQUIRE(guide_nodes(nodes, options, channels, all, all, threads, source));
        std::vector<float> means(n * (own - 1));
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t c = 0; c + 1 < own; ++c) means[c * n + i] = source[i * own + c];
        return means;
    }
};

}  // namespace

TEST_CASE("guided nodes: one colour everywhere stays that colour") {
    for (const int size : {1, 2, 7, 16})
        for (const int channels : {1, 3, 9})
            for (const bool wraps : {false, true}) {
                CAPTURE(size);
                CAPTURE(channels);
                Rig rig(size, size + 1, size, channels);
                rig.options.periodic = wraps;
                for (std::size_t i = 0; i < rig.weight.size(); ++i)
                    rig.weight[i] = number(i, 3) < 0.5f ? 0 : 40 * number(i, 4);
                rig.weight[0] = 1;
                std::fill(rig.value.begin(), rig.value.end(), 0.75f);
                for (const float v : rig.filter()) CHECK(double(v) == doctest::Approx(0.75));
            }
}

TEST_CASE("guided nodes: light that follows the sun's depth is kept where nothing was met") {
    Rig rig(32, 16, 16, 3);
    const std::size_t n = rig.depth.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (number(i, 9) < 0.75f) rig.weight[i] = 0;
        for (std::size_t c = 0; c < 3; ++c)
            rig.value[c * n + i] = 0.1f + float(c) * 0.2f * rig.guide(i);
    }
    const std::vector<float> means = rig.filter();
    // Slopes lean by a thousandth on none at the top, and nodes are met one time in four.
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            CHECK(std::fabs(means[c * n + i] - (0.1f + float(c) * 0.2f * rig.guide(i))) <= 0.004f);
    // The mean of the surroundings alone knows nothing of the depth.
    rig.options.sun_depth = nullptr;
    const std::vector<float> blind = rig.filter();
    double worst = 0;
    for (std::size_t i = 0; i < n; ++i)
        worst = std::max(worst, std::fabs(double(blind[2 * n + i] - means[2 * n + i])));
    CHECK(worst > 0.05);
}

TEST_CASE("guided nodes: noise falls, its mean stays, more photons are believed") {
    Rig rig(16, 16, 16, 1);
    const std::size_t n = rig.depth.size();
    for (std::size_t i = 0; i < n; ++i) rig.value[i] = number(i, 11) < 0.1f ? 10.0f : 0.0f;
    const auto spread = [&](const std::vector<float>& v, double& mean) {
        double sum = 0, square = 0;
        for (const float x : v) sum += double(x), square += double(x) * double(x);
        mean = sum / double(v.size());
        return square / double(v.size()) - mean * mean;
    };
    double before_mean, mean, trusted_mean;
    const double before = spread(rig.value, before_mean), after = spread(rig.filter(), mean);
    // Each node counts as one of 65, so that what is left is the noise of means over some fifty.
    CHECK(after < 0.03 * before);
    // Nodes weigh in fits by where they lie: the mean moves by less than its standard error, 0.047.
    CHECK(mean == doctest::Approx(before_mean).epsilon(0.047));
    rig.options.prior_mass = 1e-6f;
    CHECK(spread(rig.filter(), trusted_mean) == doctest::Approx(before).epsilon(1e-3));
    CHECK(trusted_mean == doctest::Approx(before_mean).epsilon(1e-4));
}

TEST_CASE("guided nodes: batches of photons may be filtered alike, by any number of threads") {
    Rig rig(19, 9, 11, 6);
    const std::size_t n = rig.depth.size();
    for (std::size_t i = 0; i < n; ++i) {
        rig.weight[i] = 5 * number(i, 2);
        for (std::size_t c = 0; c < 3; ++c) {
            rig.value[c * n + i] = 4 * number(c * n + i, 13);
            rig.value[(c + 3) * n + i] = rig.value[c * n + i] * (c == 1 ? -2.0f : 2.0f);
        }
    }
    const std::vector<float> means = rig.filter();
    for (std::size_t i = 0; i < 3 * n; ++i) {
        const double twice = i / n == 1 ? -2.0 : 2.0;
        CHECK(double(means[3 * n + i]) == doctest::Approx(twice * double(means[i])).epsilon(1e-4));
    }
    for (const int threads : {2, 3}) {
        rig.threads = threads;
        CHECK(rig.filter() == means);
    }
    rig.options.bounded = 3;
    rig.options.least[0] = rig.options.least[2] = -100;
    rig.options.least[1] = 100;
    const std::vector<float> bounded = rig.filter();
    for (std::size_t i = 0; i < bounded.size(); ++i) {
        const float wanted = i / n == 1 ? 100.0f : means[i];
        CHECK(bounded[i] == wanted);
    }
}

TEST_CASE("guided nodes: nothing met at all, or much too much, gives finite numbers") {
    Rig rig(8, 4, 4, 3);
    std::fill(rig.value.begin(), rig.value.end(), 1.0f);
    for (const float weight : {0.0f, 1e-30f, 1e15f}) {
        CAPTURE(weight);
        std::fill(rig.weight.begin(), rig.weight.end(), weight);
        for (const float v : rig.filter()) CHECK(std::isfinite(v));
        rig.options.prior_mass = 0;
        for (const float v : rig.filter()) CHECK(std::isfinite(v));
        rig.options.prior_mass = 1;
    }
}

TEST_CASE(
    "guided nodes: under a sky alone photons only take light away, and the filter lets them") {
    constexpr const char* kScene = R"(
seed = 5
[camera]
position_m = [0, -3000, 1000]
target_m = [0, 0, 500]
fov_deg = 24
resolution = [24, 24]
[sky]
radiance = [0.2, 0.2, 0.2]
[ground]
altitude_m = 0
albedo = 0.1
[collectors]
photons = 200_000
[[medium]]
density = "uniform:box"
bounds_m = [[-400, -400, 300], [400, 400, 900]]
resolution = [24, 24, 18]
extinction_per_m = 0.02
phase = { type = "henyey-greenstein", g = 0.8 }
)";
    const auto mean = [&](const std::vector<std::string>& more) {
        return render_test::sum_of(render_test::render_one(render_test::scene_from(kScene, more)),
                                   "G")
            .value;
    };
    const double around = mean({}), guided = mean({"collectors.node_filter=guided"});
    // Both are means of the same photons; the ground's shadow is dark and clamped light was 50 %
    // off.
    CHECK(std::fabs(guided / around - 1) < 0.02);
}
