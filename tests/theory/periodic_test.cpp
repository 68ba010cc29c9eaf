// SPDX-License-Identifier: Apache-2.0
// Periodic media: a small box that repeats is the slab without end.
// in: small periodic boxes -> out: shares against tables, against wide open slabs, shifted fields.
// docs/methods.md 2, "Periodic media"; van de Hulst 1980; tests/support/trace_harness.h (two-stage
// rule).
#include "tests/support/trace_harness.h"

using namespace trace_test;

namespace {

/// Makes the rig's box repeat, with bounds that know it.
void make_periodic(Rig& rig, int block) {
    rig.medium.grid.periodic = true;
    set_majorants(rig, block);
}

Light beam_at(const Medium& medium, double mu0, double azimuth = 0) {
    const double sine = std::sqrt(1 - mu0 * mu0);
    return beam_light(medium, {sine * std::cos(azimuth), sine * std::sin(azimuth), -mu0});
}

void set_optics(Rig& rig, float albedo, float g) {
    set_albedo(rig, {albedo, albedo, albedo});
    rig.medium.optics[0].phase.g1 = g;
}

/// A row for one fate of the first light; nothing may leave through the sides or be given up.
template <class Fate>
void check_fate(const std::string& name, Rig& rig, std::uint64_t photons, double reference,
                double model, Fate fate) {
    check_mean(
        name, reference,
        [&](int multiple, std::uint64_t seed) {
            const TraceTally t = shoot(rig, photons * std::uint64_t(multiple), seed);
            CHECK(t.light.sides[0] == 0);
            CHECK(t.light.sky[0] == 0);
            CHECK(t.light.terminated[0] == 0);
            CHECK(t.majorant_violations == 0);
            CHECK(balance(t.light, 0) == 0);
            return share_mean(fate(t.light), t);
        },
        model);
}

std::int64_t top_of(const Fates& f) { return f.top[0]; }
std::int64_t bottom_of(const Fates& f) { return f.bottom[0]; }

/// Sixteen columns of a wavy, broken layer, four voxels high; `shift` rolls it along x and y.
Rig make_waves(int shift) {
    constexpr int n = 16, high = 4;
    Rig rig = make_rig({n, n, high}, {160, 160, 80}, 0.1);
    for (int z = 0; z < high; ++z)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const int i = (x + shift) % n, j = (y + shift) % n;
                const int wave = (i * 5 + j * 3) % 11 - 4 + (i < 3 && j > 9 ? 6 : 0);
                rig.medium.volume.density.data()[voxel_index(rig.medium.grid, x, y, z)] =
                    wave > 0 ? float(wave) / 12 : 0.0f;
            }
    set_optics(rig, 0.95f, 0.7f);
    make_periodic(rig, 3);
    return rig;
}

}  // namespace

TEST_CASE("periodic slab of any box gives van de Hulst's shares") {
    const struct {
        std::array<int, 3> size;
        Double3 extent;
        int block;
    } boxes[] = {{{1, 1, 1}, {1, 1, 1}, 0},
                 {{7, 5, 6}, {1, 1, 1}, 2},
                 {{3, 4, 9}, {0.05, 0.02, 1}, 1},
                 {{4, 3, 2}, {30, 7, 1}, 3}};
    int number = 0;
    for (const auto& box : boxes) {
        Rig rig = make_rig(box.size, box.extent, 2);
        set_optics(rig, 0.9f, 0.75f);
        make_periodic(rig, box.block);
        add_light(rig, beam_at(rig.medium, 1));
        const std::string name = "periodic box " + std::to_string(number++);
        check_fate(name + " R", rig, 300'000, 0.09739, 5e-6, top_of);
        check_fate(name + " T", rig, 300'000, 0.66096, 5e-6, bottom_of);
    }
    Rig rig = make_rig({5, 5, 5}, {1, 1, 1}, 1);
    set_optics(rig, 0.99f, 0);
    make_periodic(rig, 2);
    add_light(rig, beam_at(rig.medium, 0.5, 2.0));
    check_fate("periodic, isotropic, mu 0.5 R", rig, 300'000, 0.48652, 5e-6, top_of);
    check_fate("periodic, isotropic, mu 0.5 T", rig, 300'000, 0.49163, 5e-6, bottom_of);
}

TEST_CASE("an open box of that size is another thing") {
    // Shows that the case above can fail: the sides of a cube let out a third of the light.
    Rig rig = make_rig({1, 1, 1}, {1, 1, 1}, 2);
    set_optics(rig, 0.9f, 0.75f);
    add_light(rig, beam_at(rig.medium, 1));
    const Mean r = share_mean(shoot(rig, 100'000, 5).light.top[0], shoot(rig, 100'000, 5));
    CHECK(std::fabs(r.value - 0.09739) > 20 * r.error);
}

TEST_CASE("diffuse light enters a periodic medium through its faces across z alone") {
    for (int hemisphere : {-1, 0, 1}) {
        Rig rig = make_rig({3, 4, 5}, {2, 3, 1}, 10);
        make_periodic(rig, 2);
        add_light(rig, diffuse_light(rig.medium, hemisphere));
        const double faces = hemisphere == 0 ? 2 : 1;
        CHECK(rig.lighting.lights[0].power_m2 == doctest::Approx(3.14159265358979 * 6 * faces));
        // Mean path of diffuse light, white: 4 V / S with the two faces alone, 2 heights.
        check_mean("periodic mean path, hemisphere " + std::to_string(hemisphere), 2,
                   [&](int multiple, std::uint64_t seed) {
                       return batch_mean(rig, 100'000 * std::uint64_t(multiple), seed,
                                         [&](const TraceTally& t) {
                                             CHECK(t.light.sides[0] == 0);
                                             CHECK(t.light.terminated[0] == 0);
                                             return mean_path(rig, t);
                                         });
                   });
    }
}

TEST_CASE("a field rolled by half its period gives the same shares") {
    // The reference is a run of its own, with an error of its own.
    constexpr std::uint64_t kPhotons = 400'000;
    for (double azimuth : {0.3, 4.0}) {
        Rig rig = make_waves(0), rolled = make_waves(8);
        add_light(rig, beam_at(rig.medium, 0.6, azimuth));
        add_light(rolled, beam_at(rolled.medium, 0.6, azimuth));
        const TraceTally many = shoot(rig, 4 * kPhotons, 1234);
        for (auto fate : {top_of, bottom_of}) {
            const Mean reference = share_mean(fate(many.light), many);
            check_mean("rolled field, azimuth " + std::to_string(azimuth).substr(0, 3) +
                           (fate == top_of ? " R" : " T"),
                       reference.value, [&](int multiple, std::uint64_t seed) {
                           const TraceTally t =
                               shoot(rolled, kPhotons * std::uint64_t(multiple), seed);
                           CHECK(t.majorant_violations == 0);
                           const Mean m = share_mean(fate(t.light), t);
                           return Mean{m.value, std::hypot(m.error, reference.error)};
                       });
        }
    }
}

TEST_CASE("light that grazes along a periodic medium ends") {
    constexpr std::int64_t kGrazing = 16;
    // Empty above, dense below: level light passes the empty layer for ever if nothing stops it.
    for (double mu : {0.0, 1e-30, 1e-7, 1e-3}) {
        Rig rig = make_rig({8, 8, 16}, {100, 100, 200}, 0.02);
        for (std::size_t v = 0; v < voxel_count(rig.medium.grid); ++v)
            if (v >= 8u * 8u * 4u) rig.medium.volume.density.data()[v] = 0;
        make_periodic(rig, 4);
        Light light = beam_at(rig.medium, mu > 0 ? mu : 1);
        // A light of no power, as one at the horizon is, must end all the same.
        if (!(mu > 0)) light.travel = {1, 0, 0};
        add_light(rig, light);
        const TraceTally t = shoot(rig, kGrazing, 3);
        CHECK(balance(t.light, 0) == 0);
        CHECK(t.light.sides[0] == 0);
        CHECK(t.light.terminated[0] == 0);
        // 150 m of empty height, 65536 times as long at the most, and two planes every 50 m.
        CHECK(t.crossings < kGrazing * 65536 * 150 / 50 * 2);
    }
}

TEST_CASE("a beam keeps its slope over thousands of periods") {
    // Empty columns of one voxel: the way through 100 m at slope mu is 100 m / mu, and each of its
    // steps climbs less than rounding of the height would keep.
    for (double mu : {0.02, 0.002, 2e-4}) {
        Rig rig = make_rig({1, 1, 4000}, {0.25, 0.5, 100}, 1);
        for (float& v : rig.medium.volume.density.span()) v = 0;
        make_periodic(rig, 4000);
        add_light(rig, beam_at(rig.medium, mu, 0.7));
        const TraceTally t = shoot(rig, 16, 3);
        CHECK(t.light.bottom[0] == t.light.emitted[0]);
        // Planes across x every 0.25 m and across y every 0.5 m count the metres it flew.
        const double sine = std::sqrt(1 - mu * mu);
        const double planes = 100 / mu * sine * (std::cos(0.7) / 0.25 + std::sin(0.7) / 0.5);
        CHECK(double(t.crossings) / double(t.photons) ==
              doctest::Approx(planes + 1).epsilon(3 / planes + 1e-6));
    }
}
