// SPDX-License-Identifier: Apache-2.0
// Reflected and transmitted shares of slabs against published tables.
// in: slabs 10^5 times wider than thick -> out: a row per share.
// van de Hulst 1980, "Multiple light scattering"; Chandrasekhar 1960, "Radiative transfer".
#include "tests/support/trace_harness.h"

using namespace trace_test;

namespace {

struct Case {
    const char* name;
    double tau;
    float albedo, g;
    double mu0, reflected, transmitted;  // negative: no reference
    double half_unit;                    // of the reference's last digit
};

Light beam_at(const Medium& medium, double mu0) {
    return beam_light(medium, {std::sqrt(1 - mu0 * mu0), 0, -mu0});
}

void check_case(const Case& c, std::uint64_t photons) {
    Rig rig = make_slab(c.tau, c.albedo, c.g);
    add_light(rig, beam_at(rig.medium, c.mu0));
    const std::string name = c.name;
    const auto measure = [&](auto fate) {
        return [&, fate](int multiple, std::uint64_t seed) {
            const TraceTally t = shoot(rig, photons * std::uint64_t(multiple), seed);
            CHECK(share(t.light.sides[0], t) < 1e-4);  // the slab is as good as endless
            CHECK(t.majorant_violations == 0);
            return share_mean(fate(t.light), t);
        };
    };
    if (c.reflected >= 0) {
        const Mean r = check_mean(name + " R", c.reflected,
                                  measure([](const Fates& f) { return f.top[0]; }), c.half_unit);
        CHECK(r.error <= 3e-4);
    }
    if (c.transmitted >= 0) {
        const Mean t = check_mean(name + " T", c.transmitted,
                                  measure([](const Fates& f) { return f.bottom[0]; }), c.half_unit);
        CHECK(t.error <= 3e-4);
    }
    check_mean(name + " direct", std::exp(-c.tau / c.mu0),
               measure([](const Fates& f) { return f.direct_bottom[0]; }));
}

}  // namespace

TEST_CASE("slab: van de Hulst's reference points") {
    check_case({"tau 2 albedo 0.9 g 0.75 mu 1", 2, 0.9f, 0.75f, 1, 0.09739, 0.66096, 5e-6},
               4'200'000);
    check_case({"tau 1 albedo 0.99 isotropic mu 0.5", 1, 0.99f, 0, 0.5, 0.48652, 0.49163, 5e-6},
               4'200'000);
}

TEST_CASE("slab: isotropic half space against Chandrasekhar's H functions") {
    // R(1) = 1 - H(1) sqrt(1 - albedo); what is left at optical depth 64 is under 1e-5.
    check_case({"half space albedo 0.5", 64, 0.5f, 0, 1, 0.115226, -1, 5e-7}, 2'000'000);
    check_case({"half space albedo 0.9", 64, 0.9f, 0, 1, 0.414947, -1, 5e-7}, 3'000'000);
    check_case({"half space albedo 0.99", 64, 0.99f, 0, 1, 0.752721, -1, 5e-7}, 3'000'000);
}

TEST_CASE("slab: thick and white in diffuse light follows the diffusion law") {
    // T = (4/3) / ((1-g) tau + 1.4209), true to 0.3 % from (1-g) tau = 5 on.
    const double cases[][2] = {{0, 5}, {0, 20}, {0.85, 40}, {0.85, 130}, {-0.5, 8}};
    for (const auto& c : cases) {
        Rig rig = make_slab(c[1], 1, float(c[0]));
        add_light(rig, diffuse_light(rig.medium, -1));
        const double reference = 4.0 / 3.0 / ((1 - c[0]) * c[1] + 1.4209);
        char name[64];
        std::snprintf(name, sizeof name, "diffuse slab g %g tau %g T", c[0], c[1]);
        check_mean(
            name, reference,
            [&](int multiple, std::uint64_t seed) {
                const TraceTally t = shoot(rig, 200'000 * std::uint64_t(multiple), seed);
                CHECK(t.light.absorbed[0] == 0);
                return share_mean(t.light.bottom[0], t);
            },
            0.003 * reference);
    }
}

TEST_CASE("slab: the reflected share does not depend on how finely it is cut") {
    // Voxels and blocks are bookkeeping only: one, 7, and 5 x 3 x 11 of them give one mean.
    const std::array<int, 3> sizes[] = {{1, 1, 7}, {5, 3, 11}, {2, 2, 64}};
    for (const auto& size : sizes)
        for (int block : {0, 1, 3}) {
            Rig rig = make_rig(size, {kSlabWidth, kSlabWidth, 1}, 2);
            set_albedo(rig, {0.9f, 0.9f, 0.9f});
            rig.medium.optics[0].phase.g1 = 0.75f;
            set_majorants(rig, block);
            add_light(rig, beam_at(rig.medium, 1));
            char name[64];
            std::snprintf(name, sizeof name, "%dx%dx%d voxels, blocks of %d: R", size[0], size[1],
                          size[2], rig.block);
            check_mean(
                name, 0.09739,
                [&](int multiple, std::uint64_t seed) {
                    const TraceTally t = shoot(rig, 200'000 * std::uint64_t(multiple), seed);
                    return share_mean(t.light.top[0], t);
                },
                5e-6);
        }
}
