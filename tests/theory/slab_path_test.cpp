// SPDX-License-Identifier: Apache-2.0
// Slabs by path: thirty against adding and doubling, printed numbers, laws of thick layers.
// in: tests/theory/slab_list.h -> out: a row for each share; four slabs, all in the long form.
// docs/validation.md; van de Hulst 1980; Chandrasekhar 1960.
#include "tests/support/path_slab.h"
#include "tests/support/validation_rows.h"
#include "tests/theory/adding_doubling.h"
#include "tests/theory/slab_list.h"

using namespace path_slab;
using namespace validation;

namespace {

/// Sunlight on a slab of flux 1 through a level plane; the sky is black.
Rig make_sunlit(const slab_list::Case& c) {
    Rig rig = make_slab(c.tau, c.albedo, c.g);
    shine(rig, sun_at(c.mu0), 1 / c.mu0);
    return rig;
}

/// Uniform light of radiance 1 from above; black ground.
Rig make_skylit(const slab_list::Case& c) {
    Rig rig = make_slab(c.tau, c.albedo, c.g);
    set_sky(rig, 1);
    set_ground(rig, -1, 0);
    return rig;
}

/// R and T of a slab, T with what came straight through; negative: no reference.
struct Shares {
    double reflected, transmitted, half_unit;
};

/// Sun and flux camera: paths look for the sun at every collision. T holds the direct light.
Mean by_sun(const slab_list::Case& c, bool reflected, std::uint64_t count, std::uint64_t seed) {
    const Rig rig = make_sunlit(c);
    Mean m = flux(rig, reflected ? 1 : 0, reflected, count, seed);
    if (!reflected) m.value += std::exp(-double(float(c.tau)) / c.mu0);
    return m;
}

/// The same with camera and light exchanged: what uniform light sends towards the sun's place, or
/// through the slab along the sun's light, is by reciprocity the share of the sun's flux.
Mean by_sky(const slab_list::Case& c, bool reflected, std::uint64_t count, std::uint64_t seed) {
    const Rig rig = make_skylit(c);
    Double3 travel = travel_of(reflected ? c.mu0 : -c.mu0, 0);
    return radiance(rig, reflected ? 1.5 : -0.5, travel, count, seed);
}

void check_shares(const char* what, const slab_list::Case& c, const Shares& answer,
                  std::uint64_t count, Section& section) {
    const std::string numbers =
        text_of("%g | %g | %g | %g", c.tau, double(c.g), double(c.albedo), c.mu0);
    for (bool reflected : {true, false}) {
        const double reference = reflected ? answer.reflected : answer.transmitted;
        if (reference < 0) continue;
        for (bool sun : {true, false}) {
            // Peaked light of a low sun comes in a sample of a thousand: too few here to judge.
            if (sun && c.g > 0.9f && !long_tests()) continue;
            section.check(
                text_of("%s tau %g g %g albedo %g mu0 %g %s by %s", what, c.tau, double(c.g),
                        double(c.albedo), c.mu0, reflected ? "R" : "T", sun ? "sun" : "sky"),
                numbers + (reflected ? " | R | " : " | T | ") + (sun ? "sun" : "sky"), reference,
                answer.half_unit, [&](int multiple, std::uint64_t seed) {
                    return (sun ? by_sun : by_sky)(c, reflected, count * std::uint64_t(multiple),
                                                   seed);
                });
        }
    }
}

const char* const kHead =
    "| tau | g | albedo | mu0 | share | light | reference | path | standard error | z | "
    "detectable bias |\n|---|---|---|---|---|---|---|---|---|---|---|";

}  // namespace

TEST_CASE("validation: thirty slabs by path against adding and doubling") {
    Section section("slabs-path", kHead);
    const int count = long_tests() ? 30 : slab_list::kPlain;
    for (int i = 0; i < count; ++i) {
        const slab_list::Case& c = slab_list::kCases[i];
        const auto answer =
            adding_doubling::solve({c.tau, double(c.albedo), double(c.g)}, {c.mu0}, 64)[0];
        check_shares("path:", c, {answer.reflected, answer.transmitted, 1e-7},
                     samples(40'000, 500'000), section);
    }
}

TEST_CASE("validation: slabs and half spaces by path against printed numbers") {
    Section section("slabs-published", kHead);
    const struct {
        slab_list::Case c;
        Shares answer;
    } printed[] = {
        {{2, 0.75f, 0.9f, 1}, {0.09739, 0.66096, 5e-6}},
        {{1, 0, 0.99f, 0.5}, {0.48652, 0.49163, 5e-6}},
        // What comes back from below optical depth 64 is under 1e-5 of the light.
        {{64, 0, 0.5f, 1}, {0.115226, -1, 5e-7}},
        {{64, 0, 0.5f, 0.5}, {0.160144, -1, 5e-7}},
        {{64, 0, 0.9f, 1}, {0.414947, -1, 5e-7}},
        {{64, 0, 0.9f, 0.5}, {0.507939, -1, 5e-7}},
        {{64, 0, 0.99f, 1}, {0.752721, -1, 5e-7}},
        {{64, 0, 0.99f, 0.5}, {0.815140, -1, 5e-7}},
    };
    for (const auto& p : printed)
        check_shares("path, printed:", p.c, p.answer, samples(40'000, 1'000'000), section);
    // Light from everywhere: the spherical albedo.
    const double spherical[][2] = {{0.5, 0.146544}, {0.9, 0.478024}, {0.99, 0.794564}};
    for (const auto& s : spherical) {
        Rig rig = make_slab(64, float(s[0]), 0);
        set_sky(rig, 1 / std::acos(-1.0));
        set_ground(rig, -1, 0);
        section.check(text_of("path: spherical albedo of %g", s[0]),
                      text_of("64 | 0 | %g | all | R | sky", s[0]), s[1], 5e-7,
                      [&](int multiple, std::uint64_t seed) {
                          return flux(rig, 1, true,
                                      samples(40'000, 1'000'000) * std::uint64_t(multiple), seed);
                      });
    }
}
