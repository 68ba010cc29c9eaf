// SPDX-License-Identifier: Apache-2.0
// Densities of extreme contrast: means stay true, work stays bounded, wrong bounds are noticed.
// in: single hot voxels, checkerboards -> out: rows of means and of work against their exact laws.
// A block of volume V, surface S and majorant M sees sigma M 4V and S events per unit of S_box.
#include "tests/support/trace_harness.h"

using namespace trace_test;

namespace {

constexpr int kEdge = 12;

/// One voxel of density 1 and optical depth `tau` in a cube of density 1/contrast.
Rig make_hot_voxel(double contrast, double tau) {
    Rig rig = make_rig({kEdge, kEdge, kEdge}, {kEdge, kEdge, kEdge}, tau);
    for (float& v : rig.medium.volume.density.span()) v = float(1 / contrast);
    rig.medium.volume.density[voxel_index(rig.medium.grid, 6, 6, 6)] = 1;
    rig.max_events = 1u << 28;
    add_light(rig, diffuse_light(rig.medium, 0));
    return rig;
}

/// Exact means per photon in diffuse light.
struct Work {
    double tentative = 0, crossings = 0, real = 0;
};
Work exact_work(const Rig& rig) {
    const Grid& g = rig.medium.grid;
    int n[3];
    block_counts(g, rig.block, n);
    const auto& e = rig.medium.extent_m;
    const double surface = 2 * (e[0] * e[1] + e[1] * e[2] + e[2] * e[0]);
    const double sigma = double(rig.medium.sigma);
    Work w;
    std::size_t b = 0;
    for (int z = 0; z < n[2]; ++z)
        for (int y = 0; y < n[1]; ++y)
            for (int x = 0; x < n[0]; ++x, ++b) {
                const int at[3] = {x, y, z};
                double edge[3];
                for (int a = 0; a < 3; ++a)
                    edge[a] =
                        std::min(rig.block, g.size[a] - at[a] * rig.block) * double(g.cell_m[a]);
                w.tentative += sigma * double(rig.majorants[b]) * edge[0] * edge[1] * edge[2] * 4;
                w.crossings += 2 * (edge[0] * edge[1] + edge[1] * edge[2] + edge[2] * edge[0]);
            }
    const double cell = double(g.cell_m[0]) * double(g.cell_m[1]) * double(g.cell_m[2]);
    for (float v : rig.medium.volume.density.span()) w.real += double(v) * cell * sigma * 4;
    return {w.tentative / surface, w.crossings / surface, w.real / surface};
}

void check_work(const std::string& name, Rig& rig, std::uint64_t photons) {
    const Work exact = exact_work(rig);
    const auto row = [&](const char* what, double reference, auto count) {
        check_mean(name + what, reference, [&](int multiple, std::uint64_t seed) {
            return batch_mean(rig, photons * std::uint64_t(multiple), seed,
                              [&](const TraceTally& t) {
                                  CHECK(t.majorant_violations == 0);
                                  CHECK(t.light.terminated[0] == 0);
                                  CHECK(balance(t.light, 0) == 0);
                                  return double(count(t)) / double(t.photons);
                              });
        });
    };
    row(": tentative", exact.tentative, [](const TraceTally& t) { return t.tentative; });
    row(": crossings", exact.crossings, [](const TraceTally& t) { return t.crossings; });
    row(": real", exact.real, [](const TraceTally& t) { return t.scatterings; });
}

}  // namespace

TEST_CASE("contrast: work and means around a single hot voxel") {
    for (double contrast : {1e3, 1e6, 1e9}) {
        Rig rig = make_hot_voxel(contrast, 100);
        set_majorants(rig, 1);
        char name[64];
        std::snprintf(name, sizeof name, "hot voxel 1:%g", contrast);
        check_work(name, rig, 400'000);
        // A bound covers a voxel and its 26 neighbours, so that with blocks of one voxel
        // tentative collisions are at most 27 times the real ones, at any contrast.
        const Work w = exact_work(rig);
        CHECK(w.tentative <= 27 * w.real);
        CHECK(w.crossings == doctest::Approx(double(kEdge)));  // sum of cells' over box's surface
    }
}

TEST_CASE("contrast: a million times fewer events than one bound for all would take") {
    Rig rig = make_hot_voxel(1e9, 1e4);
    const double global = exact_work(rig).tentative;
    set_majorants(rig, 1);
    const double local = exact_work(rig).tentative;
    std::printf("hot voxel of optical depth 1e4: %.4g tentative, one bound for all %.4g\n", local,
                global);
    CHECK(global == doctest::Approx(local * kEdge * kEdge * kEdge / 27).epsilon(1e-4));
}

TEST_CASE("contrast: checkerboards cost what the law says") {
    for (double contrast : {1e3, 1e6, 1e9})
        for (int block : {1, 2}) {
            Rig rig = make_rig({6, 6, 6}, {6, 6, 6}, 5);
            std::size_t v = 0;
            for (int z = 0; z < 6; ++z)
                for (int y = 0; y < 6; ++y)
                    for (int x = 0; x < 6; ++x, ++v)
                        if ((x + y + z) % 2 != 0)
                            rig.medium.volume.density[v] = float(1 / contrast);
            rig.max_events = 1u << 28;
            add_light(rig, diffuse_light(rig.medium, 0));
            set_majorants(rig, block);
            char name[64];
            std::snprintf(name, sizeof name, "checkerboard 1:%g block %d", contrast, block);
            check_work(name, rig, 100'000);
        }
}

TEST_CASE("contrast: one bound for all and local bounds give one mean") {
    // A beam through a lump; what leaves below is compared between the two.
    Rig rig = make_hot_voxel(20, 30);
    rig.lighting.lights.clear();
    add_light(rig, beam_light(rig.medium, {0.6, 0, -0.8}));
    rig.medium.optics[0].phase.g1 = 0.7f;
    set_majorants(rig, 0);
    const TraceTally global = shoot(rig, 1'000'000, 501);
    const Mean reference = share_mean(global.light.bottom[0], global);
    for (int block : {1, 2, 5}) {
        set_majorants(rig, block);
        check_mean("local bounds " + std::to_string(block) + ": bottom", reference.value,
                   [&](int multiple, std::uint64_t seed) {
                       const TraceTally t = shoot(rig, 400'000 * std::uint64_t(multiple), seed);
                       const Mean m = share_mean(t.light.bottom[0], t);
                       return Mean{m.value, std::hypot(m.error, reference.error)};
                   });
    }
}

TEST_CASE("contrast: a bound that is too small is noticed") {
    for (int block : {0, 1, 3}) {
        Rig rig = make_hot_voxel(10, 5);
        set_majorants(rig, block);
        for (float& v : rig.majorants.span()) v *= 0.5f;
        const TraceTally t = shoot(rig, 50'000, 21);
        CHECK(t.majorant_violations > 0);
        CHECK(balance(t.light, 0) == 0);
    }
}

TEST_CASE("contrast: empty and nearly empty boxes are crossed in one step per block") {
    Rig rig = make_hot_voxel(10, 5);
    for (float density : {0.0f, 1e-30f, 1e-40f}) {
        for (float& v : rig.medium.volume.density.span()) v = density;
        set_majorants(rig, 1);
        const TraceTally t = shoot(rig, 10'000, 22);
        CHECK(t.tentative == 0);
        CHECK(balance(t.light, 0) == 0);
        // A straight line crosses at most the planes of three axes.
        CHECK(t.crossings <= t.photons * 3 * kEdge);
        CHECK(t.light.top[0] + t.light.bottom[0] + t.light.sides[0] == t.light.emitted[0]);
    }
}
