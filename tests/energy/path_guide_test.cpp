// SPDX-License-Identifier: Apache-2.0
// Guided paths and the sun's disc: the same light as without, and nothing brighter than it may be.
// in: peaked phase functions, suns all around -> out: means, largest samples, closed forms.
// docs/path.md, "Guide", "The sun's disc".
#include "kernels_cpu/media/phase.h"
#include "src/base/angles.h"
#include "src/world/phase/medium_phase.h"
#include "tests/support/path_harness.h"

namespace {

using namespace path_test;

PhaseParams hg(float g) {
    PhaseParams p;
    p.g1 = g;
    return p;
}

/// A medium of the phase function and nothing else.
GuideParams guide_of(const PhaseParams& phase) {
    Medium medium;
    medium.optics[0].phase = phase;
    return fit_guide(medium);
}

/// Integral of a density over the guide's cone.
template <class Density>
double over_cone(const GuideParams& guide, Density density) {
    // In the cube root of 1 - cos: peaks of any width are seen.
    constexpr int kParts = 40000;
    double sum = 0;
    for (int i = 0; i < kParts; ++i) {
        const double u = (i + 0.5) / kParts;
        sum += double(density(float(double(guide.cone) * u * u * u))) * 3 * u * u / kParts;
    }
    return 2 * kPi64 * double(guide.cone) * sum;
}

TEST_CASE("a guide for peaked phase functions alone, of density one, which follows them") {
    for (float g : {0.0f, 0.85f, 0.91f, -0.98f}) CHECK(guide_of(hg(g)).on == 0);
    CHECK(guide_of({kPhaseRayleigh}).on == 0);
    PhaseStore store;
    REQUIRE(make_cloud_phase(10, store));
    const PhaseParams cloud = store.params();
    for (const PhaseParams& phase : {hg(0.92f), hg(0.95f), hg(0.999f), hg(0.99999f), cloud}) {
        const GuideParams guide = guide_of(phase);
        REQUIRE(guide.on == 1);
        CHECK(guide.g > 0);
        CHECK(guide.cone > 0);
        CHECK(guide.cone <= 0.5f);
        const auto density = [&](float turn) { return hg_density(guide.g, turn) * guide.unit; };
        CHECK(over_cone(guide, density) == doctest::Approx(1).epsilon(2e-4));
        // What a branch brings is the phase function over this, and has to have a bound.
        double least = 1e30;
        for (float turn = guide.cone; turn > 1e-12f; turn *= 0.99f)
            least = std::min(least, double(density(turn) / phase_density(phase, turn)));
        INFO(guide.g, " ", guide.cone, " ", least);
        CHECK(least > 0.5);
    }
    // Two peaks: the denser one leads at each angle.
    Medium two;
    two.count = 2;
    two.optics[0].phase = hg(0.5f);
    two.optics[1].phase = hg(0.95f);
    CHECK(fit_guide(two).on == 1);
}

/// A ball of ten voxels across in a box of 100 m; of the densities a part, if any, is `other`'s.
Rig make_ball(double sigma) {
    Rig rig = make_rig({10, 10, 10}, {100, 100, 100}, sigma);
    std::size_t v = 0;
    for (int z = 0; z < 10; ++z)
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 10; ++x, ++v) {
                const double a = x - 4.5, b = y - 4.5, c = z - 4.5;
                rig.medium.volume.density[v] = a * a + b * b + c * c <= 25 ? 1.0f : 0.0f;
            }
    set_majorants(rig, 2);
    return rig;
}

/// Both films' means, and their difference in standard errors.
struct Pair {
    Film on, off;
    double z(int channel = 0) const {
        const Mean a = film_average(on, channel), b = film_average(off, channel);
        return (a.value - b.value) / std::sqrt(a.error * a.error + b.error * b.error);
    }
};

Pair trace_both(PathInput in, unsigned with, unsigned without) {
    Pair pair;
    in.rules.guide = true;
    pair.on = trace_film(in, with);
    in.rules.guide = false;
    in.seed += 1000;
    pair.off = trace_film(in, without);
    return pair;
}

/// Differences beyond 4.5 standard errors fail; rows tell what would have been found.
void check_pair(const char* name, const Pair& pair, int channel = 0) {
    const Mean on = film_average(pair.on, channel), off = film_average(pair.off, channel);
    std::printf("%-44s on %.5g se %.1g, off %.5g se %.1g, z %+.2f\n", name, on.value, on.error,
                off.value, off.error, pair.z(channel));
    CHECK(on.value > 0);
    CHECK_MESSAGE(std::fabs(pair.z(channel)) <= 4.5, name);
}

/// Parallel rays northwards through the ball.
CameraParams look_north() { return make_flat_view({50, -200, 50}, {0, 1, 0}, 90, 12, 12); }

std::array<float, 3> sun_at_angle(double from_north_deg) {
    const double a = from_north_deg * kPi64 / 180;
    return {0, float(std::cos(a)), float(std::sin(a))};
}

TEST_CASE("guided paths bring the light of unguided ones, whatever the angle") {
    for (double angle : {0.0, 3.0, 30.0, 145.0, 180.0}) {
        Rig rig = make_ball(0.06);
        rig.medium.optics[0].phase = hg(0.95f);
        shine(rig, sun_at_angle(angle));
        char name[64];
        std::snprintf(name, sizeof name, "ball, g 0.95, sun at %g", angle);
        check_pair(name, trace_both(path_input(rig, look_north(), 5), 500, 1000));
    }
}

TEST_CASE("guided paths of a water cloud over a bright ground, by a disc and a sky") {
    PhaseStore store;
    REQUIRE(make_cloud_phase(10, store));
    Rig rig = make_ball(0.06);
    rig.medium.optics[0].phase = store.params();
    rig.medium.optics[0].albedo[0] = rig.medium.optics[0].albedo[1] = 0.97f;
    rig.medium.optics[0].albedo[2] = rig.medium.optics[0].albedo_max = 0.97f;
    shine(rig, {0, 0.6f, 0.8f});
    set_sky(rig, 0.05);
    set_ground(rig, -30, 0.8);
    PathInput in = path_input(rig, look_north(), 6);
    in.rules.sun_radius_deg = 2;
    check_pair("cloud of 10 um, ground, disc, sky", trace_both(in, 500, 2000));
    // Orders apart: what is not weighed as it should be shows in the low ones.
    for (int depth : {1, 2, 3}) {
        in.rules.max_depth = depth;
        check_pair(("the same, depth " + std::to_string(depth)).c_str(), trace_both(in, 500, 2000));
    }
}

TEST_CASE("guided paths through two media, of which one is peaked, in colour") {
    Rig rig = make_ball(0.06);
    Medium& m = rig.medium;
    m.count = 2;
    REQUIRE(m.parts.resize(voxel_count(m.grid), "parts"));
    for (std::size_t v = 0; v < m.parts.size(); ++v)
        m.parts[v] = m.volume.density[v] * float(v % 5) / 4;
    m.optics[0] = {{0.99f, 0.9f, 0.6f}, 0.99f, hg(0.96f)};
    m.optics[1] = {{0.5f, 0.95f, 1}, 1, {kPhaseRayleigh}};
    m.channels = 3;
    shine(rig, {0.6f, 0, 0.8f});
    const Pair pair = trace_both(path_input(rig, look_north(), 7), 500, 2000);
    for (int c = 0; c < 3; ++c) check_pair("two media", pair, c);
}

TEST_CASE("no guided sample of a water cloud is a firefly") {
    PhaseStore store;
    REQUIRE(make_cloud_phase(10, store));
    Rig rig = make_ball(0.1);
    rig.medium.optics[0].phase = store.params();
    shine(rig, sun_at_angle(145));
    PathInput in = path_input(rig, look_north(), 8);
    const auto largest = [&](bool guide) {
        in.rules.guide = guide;
        double most = 0;
        for (int run = 0; run < 400; ++run) {
            in.seed = std::uint64_t(run);
            const Film film = trace_film(in, 1);
            for (std::size_t p = 0; p < film.pixels(); ++p) most = std::max(most, film.sum[p]);
        }
        return most;
    };
    const double without = largest(false), with = largest(true);
    std::printf("largest of 57,600 samples: guided %.3g, unguided %.3g\n", with, without);
    // Ways that lie midway between a peak about the path and one about the sun have some tens per
    // steradian in both; the peak itself has 2000.
    CHECK(with < 64);
    CHECK(without > 256);  // the test sees fireflies where there are some
}

TEST_CASE("guided paths in corners: suns, single voxels, black and dense media") {
    const auto traced = [](Rig& rig, std::array<float, 3> sun, double disc) {
        shine(rig, sun);
        PathInput in = path_input(rig, look_north(), 9);
        in.rules.sun_radius_deg = disc;
        return film_average(trace_film(in, 64)).value;
    };
    for (double disc : {0.0, 10.0}) {
        Rig ball = make_ball(0.06);
        ball.medium.optics[0].phase = hg(0.99f);
        CHECK(traced(ball, {0, 0, 1}, disc) > 0);
        CHECK(traced(ball, {0, 0, -1}, disc) > 0);
        CHECK(traced(ball, {1, 0, 0}, disc) > 0);
        // Ten thousand optical depths.
        ball.medium.sigma = 100;
        set_majorants(ball, 2);
        set_albedo(ball, {0.9f, 0.9f, 0.9f});
        CHECK(traced(ball, {0, -0.6f, 0.8f}, disc) > 0);
        ball.medium.sigma = 0;
        set_majorants(ball, 2);
        CHECK(traced(ball, {0, 0, 1}, disc) == 0);

        Rig voxel = make_rig({1, 1, 1}, {100, 100, 100}, 0.05);
        voxel.medium.optics[0].phase = hg(0.99f);
        CHECK(traced(voxel, {0, 0.6f, 0.8f}, disc) > 0);
        set_albedo(voxel, {0, 0, 0});
        CHECK(traced(voxel, {0, 0.6f, 0.8f}, disc) == 0);
    }
}

TEST_CASE("the sun's disc lights the ground with the irradiance of the point") {
    Rig rig = make_rig({2, 2, 2}, {2, 2, 2}, 0);
    set_majorants(rig, 1);
    shine(rig, {0.6f, 0, 0.8f}, 3);
    set_ground(rig, -1, 0.3);
    for (double radius : {0.2665, 10.0}) {
        char name[64];
        std::snprintf(name, sizeof name, "ground under a disc of %g degrees", radius);
        // The sum of all directions of the disc is its middle, whatever its size.
        check_mean(name, 0.3 * 3 * 0.8 / kPi64, [&](int more, std::uint64_t seed) {
            PathInput in = path_input(rig, make_view({1, 1, 9}, {0, 0, -1}, 8, 8), seed);
            in.rules.sun_radius_deg = radius;
            return film_average(trace_film(in, 4096u * unsigned(more)));
        });
    }
}

TEST_CASE("half of a disc on the horizon lights the ground, and none of what has set") {
    Rig rig = make_rig({2, 2, 2}, {2, 2, 2}, 0);
    set_majorants(rig, 1);
    shine(rig, {1, 0, 0});
    set_ground(rig, -1, 1);
    // Radiance 1/(pi sin^2 a) over half a disc: the integral of its height is
    // (2/3) sin^3 a, all over pi sin^2 a, to the order a^2.
    const double radius = 2, a = radius * kPi64 / 180;
    check_mean(
        "ground under half a disc", 2.0 / 3 * std::sin(a) / (kPi64 * kPi64),
        [&](int more, std::uint64_t seed) {
            PathInput in = path_input(rig, make_view({1, 1, 9}, {0, 0, -1}, 8, 8), seed);
            in.rules.sun_radius_deg = radius;
            return film_average(trace_film(in, 4096u * unsigned(more)));
        },
        2.0 / 3 * std::sin(a) / (kPi64 * kPi64) * a * a);
}

TEST_CASE("a disc widens the peak of a thin ball by the mean over its directions") {
    // Straight on through HG: the mean of p over a cone is its share over the cone's size.
    const double tau = 0.002, g = 0.98, radius = 8;
    Rig rig = make_rig({1, 1, 1}, {1, 1, 1}, tau);
    rig.medium.optics[0].phase = hg(float(g));
    shine(rig, {0, 1, 0});
    const double turn = 2 * std::pow(std::sin(radius * kPi64 / 360), 2), b = 1 - g;
    const double r = std::sqrt(b * b + 2 * g * turn);
    const double share = (1 - g * g) * turn / (b * r * (b + r));
    const double light = 1 / (1 - turn / 2);  // of all its directions, by the irradiance
    const double exact = tau * light * share / (2 * kPi64 * turn);
    check_mean(
        "thin box, the sun's disc behind it", exact,
        [&](int more, std::uint64_t seed) {
            PathInput in =
                path_input(rig, make_flat_view({0.5f, -5, 0.5f}, {0, 1, 0}, 0.5f, 8, 8), seed);
            in.rules.max_depth = 1;
            in.rules.sun_radius_deg = radius;
            return film_average(trace_film(in, 100000u * unsigned(more)));
        },
        exact * 2 * tau);
}

}  // namespace
