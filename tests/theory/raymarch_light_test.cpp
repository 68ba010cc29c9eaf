// SPDX-License-Identifier: Apache-2.0
// Sunlight of the raymarch: forward scattering, its share, powder, the share of a cone.
// in: phase functions, cones, recurrences -> out: closed forms, limits, Palenik's example.
// docs/raymarch.md, "Light"; Palenik 2016, 3.2 and 3.3.
#include "kernels_cpu/raymarch/raymarch_light.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

#include "src/world/phase/forward_share.h"

namespace raymarch_light_test {

using namespace pileus;

/// The integral over the cone by the midpoint rule in the angle.
double share_by_sum(const PhaseParams& phase, double half_deg) {
    constexpr int kSteps = 200000;
    constexpr double kDegree = 0.017453292519943295769;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double angle = half_deg * kDegree * (i + 0.5) / kSteps;
        const double s = std::sin(0.5 * angle);
        sum += double(phase_density(phase, float(2 * s * s))) * std::sin(angle);
    }
    return 2 * 3.14159265358979323846 * sum * half_deg * kDegree / kSteps;
}

TEST_CASE("raymarch: share of a cone, against its sum") {
    const PhaseParams phases[] = {
        {kPhaseHg, 0, 0, 1},       {kPhaseHg, 0.85f, 0, 1},
        {kPhaseHg, -0.6f, 0, 1},   {kPhaseTwoLobe, 0.9f, -0.3f, 0.7f},
        {kPhaseRayleigh, 0, 0, 1}, {kPhaseHgDraine, 0.99f, 0.6f, 0.4f, 30}};
    for (const PhaseParams& phase : phases)
        for (double half : {1.0, 20.0, 90.0, 150.0}) {
            CAPTURE(phase.type);
            CAPTURE(half);
            // Densities are floats: the sum keeps about six digits.
            CHECK(forward_share(phase, half) ==
                  doctest::Approx(share_by_sum(phase, half)).epsilon(2e-5));
        }
    for (const PhaseParams& phase : phases) {
        CHECK(forward_share(phase, 0) == 0);
        CHECK(forward_share(phase, 180) == doctest::Approx(1).epsilon(1e-5));
    }
    // Palenik's cone of 40 degrees at the apex.
    CHECK(forward_share({kPhaseHg, 0.85f, 0, 1}, 20) == doctest::Approx(0.63).epsilon(0.005));
    CHECK(forward_share({kPhaseHg, 1, 0, 1}, 20) == 1);
    CHECK(forward_share({kPhaseHg, -1, 0, 1}, 20) == 0);
}

/// (3.12) along Palenik's tent in `steps` steps.
double recurrence(double sigma, double kept, int steps) {
    const auto eta = [&](int n) {
        const double t = 2.0 * n / steps;
        return sigma * (1 - std::fabs(t - 1)) * 2 / steps;
    };
    double light = 1;
    for (int n = 1; n <= steps; ++n) light *= std::exp(-eta(n)) * (1 + kept * eta(n - 1));
    return light;
}

TEST_CASE("raymarch: the recurrence of forward scattering has the limit that is computed") {
    // Palenik's example: sigma 3, kept 0.7, shading by 0.9.
    CHECK((1 - 0.7) * 3 == doctest::Approx(0.9));
    const double limit = std::exp(-0.9);
    const double coarse = std::fabs(recurrence(3, 0.7, 200) - limit);
    const double fine = std::fabs(recurrence(3, 0.7, 400) - limit);
    CHECK(coarse < 0.01);
    CHECK(std::log2(coarse / fine) == doctest::Approx(1).epsilon(0.1));
}

/// Density 1 in a column of height 4 above the place.
struct Column {
    static constexpr bool kBoundsAreCheap = true, kHasVoxels = false, kHasSunNodes = false;
};
template <class T>
Segment<T> field_clip(const Column&, const Ray<T>& ray) {
    return {T(0), T(4) - ray.origin.z};
}
template <class T>
bool field_holds(const Column&, const Vec<T>& p) {
    return p.z >= 0 && p.z <= 4;
}
template <class T>
Block<T> field_ahead(const Column&, const Vec<T>&, const Vec<T>&, T) {
    return {T(1), T(9)};
}
template <class T>
T field_density(const Column&, const Vec<T>&, T) {
    return T(1);
}
template <class T, class Use>
void field_shares(const Column&, const Vec<T>&, T, Use use) {
    use(0, T(1));
}

float light_of(const RaymarchLight& light, float turn = 0) {
    RaymarchParams k{};
    k.medium.sigma = 0.75f;
    k.media = 1;
    k.to_sun[2] = 1;
    k.light = light;
    std::int64_t counts[kRaymarchCounts] = {};
    float out[3] = {};
    sunlight_at(k, static_cast<const float*>(nullptr), Column{}, Vec<float>{0, 0, 0}, 1.0f, true,
                turn, counts, out);
    CHECK(counts[kCountLightSamples] == (light.steps > 0 ? light.steps : 4));
    return out[0];
}

TEST_CASE("raymarch: light through a column, with and without forward scattering and powder") {
    RaymarchLight light{};
    light.march = 1;
    light.channels = 1;
    light.first_m = 1;
    light.growth = light.series = 1;
    CHECK(light_of(light) == doctest::Approx(std::exp(-3)).epsilon(1e-6));
    light.steps = 3;
    CHECK(light_of(light) == doctest::Approx(std::exp(-2.25)).epsilon(1e-6));  // sees no farther
    light.first_m = 0;
    light.growth = 2;
    light.series = 7;
    CHECK(light_of(light) == doctest::Approx(std::exp(-3)).epsilon(1e-6));
    light.forward = 1;
    light.kept[0][0] = 0.7f;
    CHECK(light_of(light) == doctest::Approx(std::exp(-0.9)).epsilon(1e-6));
    light.powder_strength = 0.5f;
    const double powder = 1 - std::exp(-1.5);
    light.powder = kPowderAlone;
    CHECK(light_of(light) == doctest::Approx(powder).epsilon(1e-6));
    light.powder = kPowderBeer;
    CHECK(light_of(light) == doctest::Approx(std::exp(-0.9) * powder).epsilon(1e-6));
    light.powder = kPowderDirectional;
    // Against the sun nothing is taken off; along its light everything; from the side half.
    CHECK(light_of(light, 0) == doctest::Approx(std::exp(-0.9)).epsilon(1e-6));
    CHECK(light_of(light, 2) == doctest::Approx(std::exp(-0.9) * powder).epsilon(1e-6));
    CHECK(light_of(light, 1) ==
          doctest::Approx(std::exp(-0.9) * (1 - 0.5 * std::exp(-1.5))).epsilon(1e-6));
}

}  // namespace raymarch_light_test
