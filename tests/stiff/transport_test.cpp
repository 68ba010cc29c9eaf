// SPDX-License-Identifier: Apache-2.0
// Photons at the ends of what a medium can be: thin, thick, black, almost white, flat, mirrored.
// in: slabs and boxes made by hand -> out: exact ledgers and rows of means.
// docs/testing.md S14, S20, S32-S36, S42, S46, S56, S60, S82.
#include "tests/support/long_tests.h"
#include "tests/support/trace_harness.h"

using namespace trace_test;

namespace {

bool same_tally(const TraceTally& a, const TraceTally& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

Light overhead(const Rig& rig) { return beam_light(rig.medium, {0, 0, -1}); }

/// The two-stage rule for a share of the emitted light, or a number near 1: a bias of half a per
/// cent of it must be found.
template <class Measure>
void check_fine(const std::string& name, double reference, Measure measure, double model = 0) {
    const Mean m = check_mean(name, reference, measure, model);
    CHECK(7.6 * m.error <= 0.005);
}

/// A box in which no two voxels are alike, thin towards one corner.
Rig make_lump(const std::array<int, 3>& size) {
    Rig rig = make_rig(size, {90, 60, 75}, 0.1);
    std::size_t v = 0;
    for (int z = 0; z < size[2]; ++z)
        for (int y = 0; y < size[1]; ++y)
            for (int x = 0; x < size[0]; ++x, ++v)
                rig.medium.volume.density[v] =
                    float((x + 1) * (y + 2) * (z + 3)) / float((size[0] + 2) * 60);
    rig.medium.optics[0].phase.g1 = 0.6f;
    set_albedo(rig, {0.95f, 0.95f, 0.95f});
    set_majorants(rig, 2);
    return rig;
}

/// The same field with one axis turned round.
void mirror(Rig& rig, int axis) {
    const Grid& g = rig.medium.grid;
    const std::vector<float> old(rig.medium.volume.density.span().begin(),
                                 rig.medium.volume.density.span().end());
    for (int z = 0; z < g.size[2]; ++z)
        for (int y = 0; y < g.size[1]; ++y)
            for (int x = 0; x < g.size[0]; ++x) {
                int at[3] = {x, y, z};
                at[axis] = g.size[axis] - 1 - at[axis];
                rig.medium.volume.density[voxel_index(g, x, y, z)] =
                    old[voxel_index(g, at[0], at[1], at[2])];
            }
    set_majorants(rig, 2);
}

}  // namespace

TEST_CASE("S14: nothing scattered, optical depths from 1e-6 to 40") {
    // So few photons collide, or pass, that their number is Poisson's: both bounds are missed with
    // a chance below 1e-9.
    struct Row {
        double tau;
        std::uint64_t photons;
        bool passing;
        int low, high;  // of the rarer fate
    };
    const Row rows[] = {{1e-6, 20'000'000, false, 2, 56},     // mean 20
                        {1e-5, 20'000'000, false, 120, 296},  // mean 200, 6.3 sigma each way
                        {15, 40'000'000, true, 1, 40},        // mean 12.2
                        {40, 1'000'000, true, 0, 0}};         // mean 4e-12
    for (const Row& row : rows) {
        Rig rig = make_slab(row.tau, 0, 0);
        add_light(rig, overhead(rig));
        const TraceTally t = shoot(rig, row.photons, 77);
        const std::int64_t rare =
            (row.passing ? t.light.bottom[0] : t.light.absorbed[0]) / kPhotonQuanta;
        std::printf(
            "tau %g: %lld of %llu photons %s, expected %.3g\n", row.tau,
            static_cast<long long>(rare), static_cast<unsigned long long>(row.photons),
            row.passing ? "pass" : "are absorbed",
            double(row.photons) * (row.passing ? std::exp(-row.tau) : -std::expm1(-row.tau)));
        CHECK(rare >= row.low);
        CHECK(rare <= row.high);
        CHECK(t.light.top[0] == 0);
        CHECK(balance(t.light, 0) == 0);
    }
}

TEST_CASE("S20, S56: albedos at both ends are one more fate, exactly") {
    // What survives a collision by roulette has the mean of what is absorbed continuously.
    for (float albedo : {1 - 1e-6f, 1 - 0x1p-24f, 0.5f, 1e-3f, 1e-7f, 0.0f}) {
        Rig rig = make_slab(0.05, albedo, 0.85f);
        add_light(rig, diffuse_light(rig.medium, 0));
        const TraceTally t = shoot(rig, 2'000'000, 31);
        CHECK(balance(t.light, 0) == 0);
        // A roulette turn absorbs each of n collisions with chance 1 - albedo: a binomial, whose
        // 10 standard deviations and 20 counts are exceeded with a chance below 1e-9.
        const double n = double(t.scatterings), p = 1 - double(albedo);
        const double lost = double(t.light.absorbed[0] / kPhotonQuanta);
        std::printf("albedo 1 - %.8g: %g of %g collisions absorb\n", p, lost, n);
        CHECK(std::fabs(lost - n * p) <= 10 * std::sqrt(n * p * (1 - p)) + 20);
        if (albedo == 0) CHECK(lost == n);
    }
}

TEST_CASE("S20: in diffuse light an almost white slab collides 2 tau times and absorbs its share") {
    const double tau = 0.5;
    for (float albedo : {1.0f, 1 - 1e-6f, 0.999f}) {
        Rig rig = make_slab(tau, albedo, 0.85f);
        add_light(rig, diffuse_light(rig.medium, 0));
        const double lost = 1 - double(albedo);
        char name[64];
        std::snprintf(name, sizeof name, "albedo 1 - %.2g: collisions", lost);
        // Each collision absorbs `lost`, after which up to ten more would have come; 2e-5 is what
        // the slab's sides see.
        check_fine(
            name, 2 * tau,
            [&](int multiple, std::uint64_t seed) {
                return batch_mean(rig, 5'000'000 * std::uint64_t(multiple), seed,
                                  [](const TraceTally& t) {
                                      CHECK(balance(t.light, 0) == 0);
                                      return double(t.scatterings) / double(t.photons);
                                  });
            },
            5 * lost * 2 * tau + 2e-5);
    }
}

TEST_CASE("S32: lights together are the lights one by one, in integers") {
    Rig rig = make_lump({6, 5, 4});
    rig.lighting.ground.present = true;
    rig.lighting.ground.z = -30;
    rig.lighting.ground.albedo = 0.5;
    add_light(rig, beam_light(rig.medium, {0.48, 0.36, -0.8}));
    add_light(rig, diffuse_light(rig.medium, -1));
    add_light(rig, diffuse_light(rig.medium, 1));
    const std::vector<Light> lights = rig.lighting.lights;
    std::vector<TraceTally> together(3);
    shoot_batches(rig, 1, 50'000, 8, [&](const std::vector<TraceTally>& t) { together = t; });
    for (std::size_t l = 0; l < lights.size(); ++l) {
        rig.lighting.lights = {lights[l]};
        CHECK(same_tally(shoot(rig, 50'000, 8), together[l]));
        CHECK(together[l].scatterings > 1000);
    }
}

TEST_CASE("S33: a mirrored or turned field under a mirrored or turned beam is the same") {
    const Double3 travel{0.48, 0.36, -0.8};
    Rig rig = make_lump({6, 5, 4});
    add_light(rig, beam_light(rig.medium, travel));
    const TraceTally t = shoot(rig, 4'000'000, 91);
    const Mean reference = share_mean(t.light.sides[0], t);
    const auto check = [&](const std::string& name, Rig& other) {
        check_fine(name + ": sides", reference.value, [&](int multiple, std::uint64_t seed) {
            const TraceTally u = shoot(other, 1'200'000 * std::uint64_t(multiple), seed);
            const Mean m = share_mean(u.light.sides[0], u);
            return Mean{m.value, std::hypot(m.error, reference.error)};
        });
    };
    for (int axis = 0; axis < 3; ++axis) {
        Rig other = make_lump({6, 5, 4});
        mirror(other, axis);
        Double3 d = travel;
        d[std::size_t(axis)] = -d[std::size_t(axis)];
        add_light(other, beam_light(other.medium, d));
        check(std::string("mirrored across ") + "xyz"[axis], other);
    }

    // A quarter turn about z: x -> y, y -> -x.
    Rig turned = make_rig({5, 6, 4}, {60, 90, 75}, 0.1);
    for (int z = 0; z < 4; ++z)
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < 5; ++x)
                turned.medium.volume.density[voxel_index(turned.medium.grid, x, y, z)] =
                    rig.medium.volume.density[voxel_index(rig.medium.grid, y, 4 - x, z)];
    turned.medium.optics[0] = rig.medium.optics[0];
    set_majorants(turned, 2);
    add_light(turned, beam_light(turned.medium, {-0.36, 0.48, -0.8}));
    check("turned by 90 degrees", turned);
}

TEST_CASE("S34: one box in grids of 1, 2, 7, 64 cubed and 37 x 53 x 11 passes exp(-tau)") {
    const std::array<int, 3> sizes[] = {
        {1, 1, 1}, {2, 2, 2}, {7, 7, 7}, {64, 64, 64}, {37, 53, 11}};
    for (const auto& size : sizes) {
        Rig rig = make_rig(size, {40, 30, 20}, 0.1);
        set_majorants(rig, 1);
        add_light(rig, overhead(rig));
        char name[64];
        std::snprintf(name, sizeof name, "box of %d x %d x %d voxels: straight", size[0], size[1],
                      size[2]);
        check_fine(name, std::exp(-2.0), [&](int multiple, std::uint64_t seed) {
            const TraceTally t = shoot(rig, 300'000 * std::uint64_t(multiple), seed);
            return share_mean(t.light.direct_bottom[0], t);
        });
    }
}

TEST_CASE("S35, S36: rods, plates and voxels of 1:1000 keep 4V/S and exp(-tau)") {
    struct Row {
        std::array<int, 3> size;
        Double3 extent;
    };
    const Row rows[] = {{{1, 1, 1}, {1, 1, 1}},    {{1, 1, 50}, {1, 1, 50}},
                        {{50, 1, 1}, {50, 1, 1}},  {{1, 1, 40}, {1000, 1000, 40}},
                        {{4, 4, 4}, {4, 4, 4000}}, {{3, 5, 2}, {3000, 5, 2}}};
    for (const Row& row : rows) {
        // A third of an optical depth along the mean chord: half of the rays collide or more.
        Rig rig = make_rig(row.size, row.extent, 1);
        rig.medium.sigma = float(1 / mean_chord(rig));
        std::size_t v = 0;
        double mass = 0;
        for (float& d : rig.medium.volume.density.span()) {
            d = float(1 + v++ % 3);
            mass += double(d) / double(voxel_count(rig.medium.grid));
        }
        rig.medium.density_max = 3;
        set_majorants(rig, 1);
        add_light(rig, diffuse_light(rig.medium, 0));
        char name[96];
        std::snprintf(name, sizeof name, "%d x %d x %d voxels, %g x %g x %g m: 4V/S", row.size[0],
                      row.size[1], row.size[2], row.extent[0], row.extent[1], row.extent[2]);
        check_fine(name, 1, [&](int multiple, std::uint64_t seed) {
            return batch_mean(rig, 2'400'000 * std::uint64_t(multiple), seed,
                              [&](const TraceTally& t) {
                                  CHECK(balance(t.light, 0) == 0);
                                  CHECK(t.light.terminated[0] == 0);
                                  return mean_path(rig, t) / mean_chord(rig);
                              });
        });

        // Along the one axis that has structure the beam passes exp(-sum sigma_i dz_i).
        if (row.size[0] > 1 || row.size[1] > 1) continue;
        rig.lighting.lights.clear();
        add_light(rig, overhead(rig));
        const double tau = mass * double(rig.medium.sigma) * row.extent[2];
        if (tau > 8) continue;
        std::snprintf(name, sizeof name, "1 x 1 x %d voxels: straight", row.size[2]);
        check_fine(name, std::exp(-tau), [&](int multiple, std::uint64_t seed) {
            const TraceTally t = shoot(rig, 600'000 * std::uint64_t(multiple), seed);
            return share_mean(t.light.direct_bottom[0], t);
        });
    }
}

TEST_CASE("S42: photons along diagonals, edges and faces leave exactly once") {
    // Blocks of one voxel: beams along lattice diagonals meet three planes at once.
    for (const Double3& way :
         {Double3{1, 1, -1}, Double3{-1, 1, 1}, Double3{1, 0, -1}, Double3{0, 1, 0},
          Double3{0, 0, 1}, Double3{-1, 0, 0}, Double3{1, 1e-7, 1e-7}, Double3{1e-20, 1, 1}}) {
        Rig rig = make_rig({16, 16, 16}, {16, 16, 16}, 1e-4);
        set_majorants(rig, 1);
        const double n = std::sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
        add_light(rig, beam_light(rig.medium, {way[0] / n, way[1] / n, way[2] / n}));
        const std::uint64_t photons = long_tests() ? 20'000'000 : 400'000;
        const TraceTally t = shoot(rig, photons, 6);
        CHECK(t.light.emitted[0] == std::int64_t(photons) * kPhotonQuanta);
        CHECK(t.light.top[0] + t.light.bottom[0] + t.light.sides[0] == t.light.emitted[0]);
        // A straight line crosses at most three sets of 16 planes; each turn starts another.
        CHECK(t.crossings <= 48 * (t.photons + t.scatterings));
        CHECK(double(t.path) > 0);
    }
}

TEST_CASE("S46: flux through the top falls with the sun's sine, without a jump or a pole") {
    const Rig rig = make_rig({1, 1, 1}, {200, 100, 50}, 1);
    for (double mu : {1.0, 0.5, 1e-3, 1e-7, 1e-30, 0.0, -1e-7, -1.0}) {
        const double side = std::sqrt(1 - mu * mu);
        const Light sun = beam_light(rig.medium, {-side, 0, -mu});
        const double top = mu > 0 ? mu * 200 * 100 : 0, bottom = mu < 0 ? -mu * 200 * 100 : 0;
        CHECK(sun.power_m2 == doctest::Approx(top + bottom + side * 100 * 50).epsilon(1e-12));
        CHECK(double(sun.face_cdf[5] - sun.face_cdf[4]) ==
              doctest::Approx(top / sun.power_m2).epsilon(1e-6).scale(1));
        CHECK(double(sun.face_cdf[4] - sun.face_cdf[3]) ==
              doctest::Approx(bottom / sun.power_m2).epsilon(1e-6).scale(1));
    }
    // A grazing beam enters through the side alone, every photon of it.
    Rig grazing = make_rig({4, 4, 4}, {200, 100, 50}, 1e-6);
    add_light(grazing, beam_light(grazing.medium, {-1, 0, -1e-12}));
    const TraceTally t = shoot(grazing, 100'000, 2);
    CHECK(t.light.top[0] <= t.scatterings * kPhotonQuanta);
    CHECK(t.light.direct_bottom[0] == 0);
    CHECK(balance(t.light, 0) == 0);
}

TEST_CASE("S60: ten million photons into one voxel, every quantum accounted for") {
    Rig rig = make_rig({1, 1, 1}, {1, 1, 1}, 0.1);
    REQUIRE(rig.collector_of_voxel.resize(1, "map"));
    rig.collectors = 1;
    rig.deposit.bands = 1;
    rig.deposit.coefficients = 1;
    rig.deposit.places = 30;
    rig.lighting.lights.clear();
    add_light(rig, overhead(rig));
    rig.lighting.lights[0].photons = 10'000'000;
    const TraceInput in = input_of(rig, 12);
    TraceScratch scratch;
    PhotonSlot slot;
    REQUIRE(prepare_trace(in, scratch));
    REQUIRE(slot.sums.resize(slot_stride(in), "sums"));
    std::vector<TraceTally> tallies(1);
    REQUIRE(trace_generation(in, 0, scratch, slot, tallies));
    // Every tentative collision in a uniform medium deposits y_00 whole.
    const std::int64_t one = std::int64_t(double(0.282094792f) * double(1 << 30) + 0.5);
    CHECK(slot.sums[0] == tallies[0].tentative * one);
    CHECK(tallies[0].tentative > 900'000);
    CHECK(slot.sums[0] > (std::int64_t{1} << 47));  // far past what 32 bits hold
}

TEST_CASE("S82: event budgets of 0, 1, one too few and just enough") {
    Rig rig = make_slab(3, 1, 0.85f);
    add_light(rig, diffuse_light(rig.medium, 0));
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        rig.max_events = 1u << 20;
        const TraceTally whole = shoot(rig, 1, seed);
        // A budget is looked at after a collision: the last one may use it up.
        const auto need = std::uint32_t(whole.tentative) + 1;
        rig.max_events = need;
        CHECK(same_tally(shoot(rig, 1, seed), whole));
        for (std::uint32_t budget : {0u, 1u, need - 1}) {
            rig.max_events = budget;
            const TraceTally cut = shoot(rig, 1, seed);
            CHECK(balance(cut.light, 0) == 0);
            CHECK(cut.tentative <= std::int64_t(std::max(budget, 1u)));
            if (whole.tentative > 0 && budget <= std::uint32_t(whole.tentative))
                CHECK(cut.light.terminated[0] == kPhotonQuanta);
            CHECK(same_tally(cut, shoot(rig, 1, seed)));
        }
    }
}
