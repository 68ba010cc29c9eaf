// SPDX-License-Identifier: Apache-2.0
// The rules of the raymarch on profiles with known integrals: each shows its order.
// in: densities along one ray, numbers of steps -> out: errors and how fast they shrink.
// docs/raymarch.md, "Integrators"; Palenik 2016, chapter 4.
#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

#include "kernels_cpu/raymarch/raymarch.h"

namespace raymarch_rules_test {

using namespace pileus;

/// Density along x in [0, 2].
struct Profile {
    static constexpr bool kBoundsAreCheap = true, kHasVoxels = false, kHasSunNodes = false;
    bool smooth;
};
template <class T>
Segment<T> field_clip(const Profile&, const Ray<T>&) {
    return {T(0), T(2)};
}
template <class T>
M_of<T> field_holds(const Profile&, const Vec<T>&) {
    return true;
}
template <class T>
Block<T> field_ahead(const Profile&, const Vec<T>&, const Vec<T>&, T) {
    return {T(1), T(9)};
}
template <class T>
T field_density(const Profile& f, const Vec<T>& p, T) {
    if (f.smooth) return T(1.5 - 0.5 * std::cos(2.2 * double(p.x)) + 0.3 * double(p.x));
    return T(1 - std::fabs(double(p.x) - 1));
}
template <class T, class Use>
void field_shares(const Profile&, const Vec<T>&, T, Use use) {
    use(0, T(1));
}

double depth_to(const Profile& f, double t) {
    if (f.smooth) return 1.5 * t - 0.5 * std::sin(2.2 * t) / 2.2 + 0.15 * t * t;
    return t < 1 ? 0.5 * t * t : 1 - 0.5 * (2 - t) * (2 - t);
}

/// Of an emitting medium, up to `high`: exactly 1 - e^-tau.
double error_of(const Profile& field, std::int32_t rule, int steps, float growth, float high,
                double sigma) {
    RaymarchParams k{};
    k.medium.sigma = float(sigma);
    k.media = 1;
    k.rule = rule;
    k.ambient[0] = k.ambient[1] = k.ambient[2] = 1;
    k.step.most = float(steps);
    k.step.grows = growth > 1 ? 1 : 0;
    k.step.growth = growth;
    k.step.series = growth > 1 ? float((std::pow(double(growth), steps) - 1) / (growth - 1)) : 1;
    std::int64_t counts[kRaymarchCounts] = {};
    const RaymarchBuffers b{};
    const RayMarch<float, Profile> r{k, b, field, {0, 0, 0}, {1, 0, 0}, 0, {}, counts};
    RaySum<float> sum{};
    sum.transmittance = 1;
    march_lattice(r, make_lattice(k.step, 0.0f, 2.0f), 0.0f, high, sum);
    return double(sum.colour[0]) + std::expm1(-sigma * depth_to(field, double(high)));
}

/// By how many halves the error shrinks where the steps are halved.
double order_of(const Profile& field, std::int32_t rule, int steps, float growth, float high,
                double sigma) {
    const double coarse = std::fabs(error_of(field, rule, steps, growth, high, sigma));
    // A lattice twice as fine: the square root of its growth.
    const double fine = std::fabs(error_of(field, rule, 2 * steps, std::sqrt(growth), high, sigma));
    INFO("rule " << rule << ": " << coarse << " then " << fine);
    CHECK(fine < coarse);
    return std::log2(coarse / fine);
}

TEST_CASE("raymarch: on Palenik's tent each rule shows its order; the closed form is exact") {
    const Profile tent{false};
    // Float rounds sums of this size to 1e-7: orders are read where errors are far above.
    CHECK(order_of(tent, kRuleRiemann, 96, 1, 2, 3) == doctest::Approx(1).epsilon(0.05));
    CHECK(order_of(tent, kRuleTrapezoid, 48, 1, 2, 3) == doctest::Approx(2).epsilon(0.05));
    CHECK(order_of(tent, kRuleSimpson, 12, 1, 2, 3) == doctest::Approx(4).epsilon(0.1));
    CHECK(order_of(tent, kRuleSimpson38, 12, 1, 2, 3) == doctest::Approx(4).epsilon(0.1));
    for (int steps : {2, 4, 64})
        CHECK(std::fabs(error_of(tent, kRuleClosed, steps, 1, 2, 3)) < 1e-6);
    // A step across the kink takes the order away.
    CHECK(std::fabs(error_of(tent, kRuleClosed, 3, 1, 2, 3)) > 1e-3);
}

TEST_CASE("raymarch: orders on a smooth profile, even steps and growing ones, cut ends") {
    const Profile smooth{true};
    const struct {
        std::int32_t rule;
        int steps;
        double order;
    } rows[] = {{kRuleRiemann, 192, 1},
                {kRuleTrapezoid, 24, 2},
                {kRuleClosed, 12, 2},
                // (4.10): transmittance by the trapezoid rule ends what Simpson's could gain.
                {kRuleSimpson, 24, 2},
                {kRuleSimpson38, 24, 2}};
    for (float growth : {1.0f, 1.1f})
        for (float high : {2.0f, 1.75f})
            for (const auto& row : rows) {
                CAPTURE(growth);
                CAPTURE(high);
                CHECK(order_of(smooth, row.rule, row.steps, growth, high, 0.5) ==
                      doctest::Approx(row.order).epsilon(0.15));
            }
}

TEST_CASE("raymarch: lattices: Palenik's numbers, no more steps than asked for, and back") {
    StepParams k{};
    k.most = 255;
    k.grows = k.by_distance = 1;
    k.near_m = 1;
    k.pixel = 1e-6f;
    // (3.16): from 1 to 1000 in 255 steps, h' = 0.027459 and a last step of 26.73.
    const Lattice<float> far = make_lattice(k, 1.0f, 999.0f);
    CHECK(double(far.excess) == doctest::Approx(0.027459).epsilon(2e-5));
    CHECK(double(lattice_place(far, 255.0f)) == doctest::Approx(999).epsilon(1e-4));
    CHECK(double(lattice_place(far, 255.0f) - lattice_place(far, 254.0f)) ==
          doctest::Approx(26.73).epsilon(1e-3));
    // Enough steps: each as long as a pixel is wide where it begins.
    k.pixel = 0.05f;
    const Lattice<float> fine = make_lattice(k, 20.0f, 500.0f);
    for (float n : {0.0f, 7.0f, 40.0f}) {
        const float at = lattice_place(fine, n), next = lattice_place(fine, n + 1);
        CHECK(double(next - at) == doctest::Approx(0.05 * (20 + double(at))).epsilon(1e-4));
    }
    // (3.17): a first step that is long enough is kept, one that is not grows.
    k = StepParams{};
    k.most = 10;
    k.grows = 1;
    k.growth = 1.5f;
    k.series = float((std::pow(1.5, 10) - 1) / 0.5);
    k.least_m = 3;
    CHECK(make_lattice(k, 0.0f, 100.0f).first == 3);
    CHECK(double(make_lattice(k, 0.0f, 1000.0f).first) ==
          doctest::Approx(1000 / double(k.series)).epsilon(1e-6));
    CHECK(double(lattice_place(make_lattice(k, 0.0f, 1000.0f), 10.0f)) ==
          doctest::Approx(1000).epsilon(1e-5));
    for (const Lattice<float>& a : {far, fine, make_lattice(k, 0.0f, 100.0f)})
        for (float n : {0.0f, 1.0f, 9.0f})
            CHECK(double(lattice_step(a, lattice_place(a, n))) ==
                  doctest::Approx(double(n)).epsilon(1e-3));
}

/// Palenik's theorem 1 on steps that grow by `growth`: Simpson's 3/8 weights times the step
/// behind each sample, or times the derivative of the map of steps.
double theorem_error(int steps, double growth, bool derivative) {
    const auto f = [](double x) { return std::exp(-x) * (2 + std::cos(3 * x)); };
    const double exact =
        2 * (1 - std::exp(-2.0)) + (1 - std::exp(-2.0) * (std::cos(6.0) - 3 * std::sin(6.0))) / 10;
    const double q = std::pow(growth, 48.0 / steps), first = 2 * (q - 1) / (std::pow(q, steps) - 1);
    double sum = 0;
    for (int n = 0; n <= steps; ++n) {
        const double x = first * (std::pow(q, n) - 1) / (q - 1);
        const double step = first * std::pow(q, n);
        const double weight = n == 0 || n == steps ? 1 : n % 3 == 0 ? 2 : 3;
        sum += 0.375 * weight * f(x) * (derivative ? step * std::log(q) / (q - 1) : step);
    }
    return std::fabs(sum - exact);
}

TEST_CASE("raymarch: theorem 1 needs the map's derivative; with the step itself its order is 1") {
    const auto order = [](bool derivative) {
        return std::log2(theorem_error(192, 1.1, derivative) / theorem_error(384, 1.1, derivative));
    };
    CHECK(order(true) == doctest::Approx(4).epsilon(0.05));
    CHECK(order(false) == doctest::Approx(1).epsilon(0.05));
}

}  // namespace raymarch_rules_test
