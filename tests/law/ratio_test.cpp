// SPDX-License-Identifier: Apache-2.0
// Ratio tracking against optical depths in closed form, and against the photons of the tracer.
// in: small media, rays, fixed seeds -> out: rows of means with standard errors, passes or fails.
// docs/methods.md 2 "Ratio tracking"; tests/trace_harness.h (two-stage rule).
#include "kernels_cpu/ratio.h"

#include <limits>

#include "tests/quadrature.h"
#include "tests/trace_harness.h"
#include "tests/widths.h"

using namespace pileus;
using namespace trace_test;

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kDepth = 3;       // optical depth of most rows
constexpr double kRays = 1 << 16;  // of the first stage
constexpr double kDense = 1, kFaint = 1e-6;
constexpr int kEdge = 15, kHotAt = 7;  // voxels; the hot one, in the middle

TrackGrid grid_of(const Rig& rig) {
    return track_grid(rig.medium, rig.majorants.span(), rig.block, rig.max_events);
}

/// A ray in voxels; its direction is normalised where it is used.
struct Line {
    double p[3], d[3], metres;
};

template <int W>
TrackRay<W> ray_of(const Line& line) {
    const double n =
        std::sqrt(line.d[0] * line.d[0] + line.d[1] * line.d[1] + line.d[2] * line.d[2]);
    const auto spread = [](double v) { return all<F<W>>(float(v)); };
    return {{spread(line.p[0]), spread(line.p[1]), spread(line.p[2])},
            {spread(line.d[0] / n), spread(line.d[1] / n), spread(line.d[2] / n)},
            spread(line.metres)};
}

/// Mean of estimates along `line_of(ray number)`.
template <class LineOf>
Mean mean_transmittance(const TrackGrid& k, double rays, std::uint64_t seed, LineOf line_of) {
    constexpr int kWidth = 4;
    const Key key = make_key(seed, 77, 0);
    double sum = 0, squares = 0;
    for (std::uint32_t i = 0; i < std::uint32_t(rays); i += kWidth) {
        const U<kWidth> number = reinterpret<U<kWidth>>(iota<I<kWidth>>()) + i;
        U<kWidth> event{};
        const F<kWidth> t = ratio_transmittance<kWidth>(k, ray_of<kWidth>(line_of(i)), key, number,
                                                        event, I<kWidth>{} == 0);
        for (int l = 0; l < kWidth; ++l) {
            sum += double(t[l]);
            squares += double(t[l]) * double(t[l]);
        }
    }
    const double mean = sum / rays;
    return {mean, std::sqrt(std::max(squares / rays - mean * mean, 0.0) / (rays - 1))};
}

void check_line(const std::string& name, const Rig& rig, const Line& line, double tau,
                double model = 0) {
    const TrackGrid k = grid_of(rig);
    check_mean(
        name, std::exp(-tau),
        [&](int multiple, std::uint64_t seed) {
            return mean_transmittance(k, kRays * multiple, seed,
                                      [&](std::uint32_t) { return line; });
        },
        model);
}

template <class DensityOf>
void fill(Rig& rig, int block, DensityOf density_of) {
    const Grid& g = rig.medium.grid;
    for (int z = 0; z < g.size[2]; ++z)
        for (int y = 0; y < g.size[1]; ++y)
            for (int x = 0; x < g.size[0]; ++x)
                rig.medium.volume.density.data()[voxel_index(g, x, y, z)] = density_of(x, y, z);
    set_majorants(rig, block);
}

/// One voxel a million times denser than the rest; voxels of 2 m; `tau` along x through its centre.
Rig make_hot(double tau, int block) {
    Rig rig = make_rig({kEdge, kEdge, kEdge}, {2.0 * kEdge, 2.0 * kEdge, 2.0 * kEdge}, tau / 2);
    fill(rig, block, [](int x, int y, int z) {
        return x == kHotAt && y == kHotAt && z == kHotAt ? float(kDense) : float(kFaint);
    });
    return rig;
}

/// Optical depth along z at (x, y) voxels from the hot voxel's centre.
double hot_depth(double tau, double x, double y) {
    const double near = std::max(0.0, 1 - std::fabs(x)) * std::max(0.0, 1 - std::fabs(y));
    return tau * (kFaint * kEdge + (kDense - kFaint) * near);
}

}  // namespace

TEST_CASE("uniform medium: the mean is exp(-tau), whatever the bound's excess") {
    for (double tau : {0.1, 1.0, kDepth, 8.0})
        for (float excess : {1.0f, 3.0f}) {
            Rig rig = make_rig({6, 5, 4}, {12, 5, 4}, tau / 12);
            for (int block : {0, 2}) {
                set_majorants(rig, block);
                for (float& m : rig.majorants.span()) m *= excess;
                const std::string name = "uniform tau " + std::to_string(tau).substr(0, 3) +
                                         " bound " + std::to_string(int(excess)) + " block " +
                                         std::to_string(block);
                check_line(name, rig, {{0, 2.3, 1.7}, {1, 0, 0}, kFar}, tau);
            }
        }
}

TEST_CASE("uniform medium: a ray stops at its length") {
    Rig rig = make_rig({6, 5, 4}, {12, 5, 4}, 0.5);
    set_majorants(rig, 2);
    for (float& m : rig.majorants.span()) m *= 2;
    // 4 m of 0.5/m, oblique, from a block's border against two axes; the box ends at 5.0 m.
    check_line("uniform, 4 m of a longer way", rig, {{4, 4, 2}, {-2, -2, 1}, 4}, 2);
    check_line("uniform, no length", rig, {{4, 4, 2}, {-2, -2, 1}, 0}, 0);
}

TEST_CASE("linear ramp: trilinear density read by one voxel") {
    constexpr int n = 24;
    for (int block : {0, 1, 5}) {
        Rig rig = make_rig({n, 3, 3}, {n, 3, 3}, 2 * kDepth / n);
        fill(rig, block, [](int x, int, int) { return (float(x) + 0.5f) / n; });
        const std::string end = ", block " + std::to_string(block);
        check_line("ramp along x" + end, rig, {{0, 1.2, 1.9}, {1, 0, 0}, kFar}, kDepth);
        check_line("ramp against x" + end, rig, {{n, 1.2, 1.9}, {-1, 0, 0}, kFar}, kDepth);
        // 10 m downhill from x = 20: the mean density is that half way.
        const double way = 20 - 5 * 12 / std::sqrt(12 * 12 + 2.5 * 2.5);
        check_line("ramp oblique" + end, rig, {{20, 0.4, 1.5}, {-12, 2.5, 0}, 10},
                   10 * 2 * kDepth / n * way / n);
    }
}

TEST_CASE("periodic media: the depth of a ray is that of every period it passes") {
    constexpr int n = 12;
    for (int block : {0, 1, 5}) {
        Rig rig = make_rig({n, 3, 4}, {n, 3, 400}, 0.01);
        fill(rig, block, [](int x, int, int) { return (float(x) + 0.5f) / n; });
        rig.medium.grid.periodic = true;
        set_majorants(rig, block);
        // Mean density 1/2 in every period: 50 periods and more from the top to the bottom.
        const std::string end = ", block " + std::to_string(block);
        const double way = std::sqrt(600.0 * 600 + 30 * 30 + 400 * 400);
        check_line("periods of a ramp" + end, rig, {{0, 1.2, 4}, {600, 30, -400}, kFar},
                   0.005 * way);
        check_line("periods, against x" + end, rig, {{n, 2.9, 0}, {-600, -30, 400}, kFar},
                   0.005 * way);
        // A length ends it after ten periods, level.
        check_line("ten periods, level" + end, rig, {{3, 1.2, 2}, {1, 0, 0}, 10.0 * n},
                   0.005 * 10 * n, 1e-5);
    }
}

TEST_CASE("one voxel a million times denser than the rest") {
    constexpr double middle = kHotAt + 0.5;
    for (int block : {0, 1, 4}) {
        const Rig rig = make_hot(kDepth, block);
        const std::string end = ", block " + std::to_string(block);
        check_line("hot voxel, centre" + end, rig, {{middle, middle, 0}, {0, 0, 1}, kFar},
                   hot_depth(kDepth, 0, 0));
        check_line("hot voxel, beside" + end, rig,
                   {{middle + 0.25, middle - 0.6, kEdge}, {0, 0, -1}, kFar},
                   hot_depth(kDepth, 0.25, 0.6));
        // The diagonal of x and y sees the square of the tent: sqrt(2) * 2/3 voxels.
        const double thin = kDepth * kFaint * kEdge * std::sqrt(2.0);
        check_line("hot voxel, diagonal" + end, rig, {{0, 0, middle}, {1, 1, 0}, kFar},
                   thin + kDepth * (kDense - kFaint) * std::sqrt(2.0) * 2 / 3);
    }
}

TEST_CASE("thin air under the bound of a dense block: rounding does not add up") {
    // 45 collisions of a share of 1e-6 each; the estimate itself is rounded to half of 2^-24.
    const Rig rig = make_hot(kDepth, 0);
    check_line("hot voxel, missed", rig, {{kHotAt + 2, kHotAt + 0.5, 0}, {0, 0, 1}, kFar},
               hot_depth(kDepth, 1.5, 0), 0x1p-25);
    // 40 000 collisions of 1e-7: factors rounded one by one would be off by 8e-4.
    Rig thin = make_rig({4, 4, 4}, {4, 4, 4}, 1e4);
    fill(thin, 0, [](int, int, int) { return 1e-7f; });
    thin.majorants.data()[0] = 1;
    const TrackGrid k = grid_of(thin);
    check_mean(
        "40 000 collisions of 1e-7", std::exp(-0.004),
        [&](int multiple, std::uint64_t seed) {
            return mean_transmittance(k, 64 * multiple, seed, [](std::uint32_t) {
                return Line{{0, 2, 2}, {1, 0, 0}, kFar};
            });
        },
        0x1p-25);
}

TEST_CASE("light that the tracer lets straight through agrees with ratio tracking") {
    const Quadrature q = gauss_legendre(24);
    const double hot =
        4 * integrate(q, 0, 1, [&](double x) {
            return integrate(q, 0, 1, [&](double y) { return std::exp(-hot_depth(kDepth, x, y)); });
        });
    const double rest = (kEdge * kEdge - 4) * std::exp(-hot_depth(kDepth, 1, 1));
    const double expected = (hot + rest) / (kEdge * kEdge);
    for (int block : {0, 4}) {
        Rig rig = make_hot(kDepth, block);
        set_albedo(rig, {0, 0, 0});
        add_light(rig, beam_light(rig.medium, {0, 0, -1}));
        const std::string end = ", block " + std::to_string(block);
        check_mean("delta tracking" + end, expected, [&](int multiple, std::uint64_t seed) {
            const TraceTally t =
                shoot(rig, std::uint64_t(kRays) * 4 * std::uint64_t(multiple), seed);
            CHECK(t.majorant_violations == 0);
            CHECK(t.light.direct_bottom[0] == t.light.bottom[0]);
            return share_mean(t.light.direct_bottom[0], t);
        });
        const TrackGrid k = grid_of(rig);
        check_mean("ratio tracking" + end, expected, [&](int multiple, std::uint64_t seed) {
            return mean_transmittance(k, kRays * 4 * multiple, seed, [&](std::uint32_t i) {
                const Words<std::uint32_t> w = threefry(99u, 0u, i, std::uint32_t(seed));
                return Line{{kEdge * double(uniform(w.a)), kEdge * double(uniform(w.b)), kEdge},
                            {0, 0, -1},
                            kFar};
            });
        });
    }
}

TEST_CASE("empty space lets everything through, exactly and with one draw") {
    Rig rig = make_rig({8, 8, 8}, {8, 8, 8}, 1e6);
    fill(rig, 2, [](int x, int, int) { return x == 7 ? 1.0f : 0.0f; });
    const TrackGrid k = grid_of(rig);
    for (std::uint32_t i = 0; i < 64; ++i) {
        std::uint32_t event = 5;
        // Blocks ahead hold nothing.
        const TrackRay<1> clear = ray_of<1>({{3.9, 0.1 * i, 0}, {-0.3, 0.1, 1}, kFar});
        CHECK(ratio_transmittance<1>(k, clear, Key{1, 2}, i, event, true) == 1.0f);
        CHECK(event == 6);
        // Block of x = 4 and 5 is empty, that of 6 and 7 is bounded by 1 and empty up to x = 6.5.
        const TrackRay<1> beside = ray_of<1>({{6.2, 4, 0}, {0, 0, 1}, kFar});
        CHECK(ratio_transmittance<1>(k, beside, Key{1, 2}, i, event, true) == 1.0f);
        CHECK(event > 1000);
    }
}

TEST_CASE("a ray that needs too many draws is given up with the weight it has") {
    Rig rig = make_rig({4, 4, 4}, {4, 4, 4}, 1e7);
    fill(rig, 0, [](int, int, int) { return 1e-7f; });
    rig.majorants.data()[0] = 1;
    rig.max_events = 100;
    for (std::uint32_t start : {0u, ~0u - 50u}) {
        std::uint32_t event = start;
        const TrackRay<1> ray = ray_of<1>({{0, 2, 2}, {1, 0, 0}, kFar});
        const float t = ratio_transmittance<1>(grid_of(rig), ray, Key{3, 4}, 0u, event, true);
        CHECK(event - start == 100);
        // 99 collisions; the sum is rounded once to a multiple of 2^-24.
        CHECK(std::fabs(double(t) - std::pow(1 - 1e-7, 99)) <= 0x1p-25);
    }
}

namespace {

constexpr int kTried = 64;

/// Estimates and draws of 64 rays of every kind, `W` at a time; each fifth is not wanted.
template <int W>
std::vector<std::uint32_t> outcome(const TrackGrid& k) {
    std::vector<std::uint32_t> bits;
    for (std::uint32_t i = 0; i < kTried; i += W) {
        TrackRay<W> ray{};
        U<W> number{}, event{};
        M<W> wanted{};
        for (int l = 0; l < W; ++l) {
            const std::uint32_t n = i + std::uint32_t(l);
            const auto a = threefry(5u, 6u, n, 0u), b = threefry(5u, 6u, n, 1u);
            const float c = 2 * uniform(a.a) - 1, s = sqrt_(1 - c * c);
            const SinCos<float> phi = sincos_turns(uniform(a.b));
            set_lane(ray.d.x, l, s * phi.cosine), set_lane(ray.d.y, l, s * phi.sine);
            set_lane(ray.d.z, l, c);
            set_lane(ray.p.x, l, float(k.size[0]) * uniform(b.a));
            set_lane(ray.p.y, l, float(k.size[1]) * uniform(b.b));
            set_lane(ray.p.z, l, n % 2 ? 0.0f : float(k.size[2]));
            set_lane(ray.metres, l, n % 3 ? float(kFar) : 5.0f);
            set_lane(number, l, n);
            set_lane(event, l, 7 * n);
            set_lane(wanted, l, W == 1 ? (n % 5 ? 1 : 0) : (n % 5 ? -1 : 0));
        }
        const F<W> t = ratio_transmittance<W>(k, ray, Key{8, 9}, number, event, wanted);
        for (int l = 0; l < W; ++l) {
            bits.push_back(bits_of_float(lane(t, l)));
            bits.push_back(lane(event, l));
        }
    }
    return bits;
}

}  // namespace

TEST_CASE("every width gives the same bits and the same number of draws") {
    Rig rig = make_rig({13, 9, 11}, {20, 20, 30}, 0.2);
    fill(rig, 3, [](int x, int y, int z) {
        const auto w = threefry(1u, 2u, std::uint32_t(x + 100 * y), std::uint32_t(z));
        return (x + y + z) % 7 < 3 ? 0.0f : uniform(w.a);
    });
    const TrackGrid k = grid_of(rig);
    const std::vector<std::uint32_t> scalar = outcome<1>(k);
    CHECK(outcome<4>(k) == scalar);
    CHECK(outcome<8>(k) == scalar);
    CHECK(outcome<16>(k) == scalar);
    int fractions = 0;
    for (std::uint32_t n = 0; n < kTried; ++n) {
        const float t = float_of(scalar[2 * n]);
        if (n % 5 == 0) {
            CHECK(t == 1.0f);
            CHECK(scalar[2 * n + 1] == 7 * n);
        }
        CHECK((t >= 0 && t <= 1));
        fractions += t > 0 && t < 1 ? 1 : 0;
    }
    CHECK(fractions > kTried / 8);  // the comparison saw more than zeros and ones
}
