// SPDX-License-Identifier: Apache-2.0
// Leaves tile the grid and collectors keep its optical cross-section, on ordinary and odd fields.
// in: small density fields -> out: passes or fails.
// Elek 2011, sections 5.3-5.5; docs/methods.md 3, prepare 3-5.
#include <doctest/doctest.h>

#include "src/base/powers.h"
#include "src/methods/collectors/prepare/leaves.h"
#include "src/methods/collectors/prepare/place_collectors.h"
#include "src/methods/collectors/prepare/samples.h"
#include "src/methods/collectors/prepare/tree.h"
#include "src/world/grid/grid.h"
#include "tests/law/prepare_fields.h"

using namespace pileus;
using namespace prepare_test;

namespace {

struct Prepared {
    Buffer<Sample> samples;
    Buffer<Leaf> leaves;
    Buffer<Collector> collectors;
    std::vector<std::int32_t> leaf_of_voxel;
    std::vector<double> masses;
};

Prepared prepare_samples(const Field& f, Span<const Sample> samples, const TreeOptions& tree,
                         const CollectorOptions& options, int threads = 1) {
    Prepared p;
    REQUIRE(bool(build_tree(samples, f.span(), f.grid, tree, threads, p.leaves)));
    p.masses.resize(f.rho.size());
    p.leaf_of_voxel.assign(f.rho.size(), -7);
    const Span<double> m{p.masses.data(), p.masses.size()};
    voxel_masses(f.span(), f.grid, threads, m);
    Buffer<LeafMoments> moments;
    REQUIRE(bool(moments.resize(p.leaves.size(), "moments")));
    REQUIRE(bool(measure_leaves(f.span(), f.grid, threads, p.leaves.span(), moments.span())));
    const Span<std::int32_t> grid{p.leaf_of_voxel.data(), p.leaf_of_voxel.size()};
    fill_leaf_grid(p.leaves.span(), f.grid, threads, LeafLabel::kLeaf, grid);
    REQUIRE(bool(place_collectors(options, moments.span(), f.grid, samples, grid, threads,
                                  p.leaves.span(), p.collectors)));
    return p;
}

Prepared prepare(const Field& f, std::uint32_t count, const TreeOptions& tree,
                 const CollectorOptions& options = {}, int threads = 1) {
    std::vector<float> w(f.rho.size());
    FieldStats stats;
    REQUIRE(bool(gradient_magnitude(f.span(), f.grid, threads, {w.data(), w.size()}, stats)));
    SampleSet set;
    SampleOptions o;
    o.count = count;
    REQUIRE(
        bool(sample_stratified({w.data(), w.size()}, stats, f.span(), f.grid, o, threads, set)));
    Prepared p = prepare_samples(f, set.samples.span(), tree, options, threads);
    p.samples.swap(set.samples);
    return p;
}

/// What every voxel's density contributes over all voxels is its own cell, also at the rim.
double total_mass(const Field& f) {
    double sum = 0;
    for (float rho : f.rho) sum += double(rho);
    return sum * double(f.grid.cell_m[0]) * double(f.grid.cell_m[1]) * double(f.grid.cell_m[2]);
}

/// Checks every promise of prepared.h on one result.
void check_all(const Field& f, const Prepared& p) {
    // Each voxel lies in exactly one leaf, and the leaf grid says which.
    std::vector<int> covered(f.rho.size(), 0);
    double mass = 0, section = 0, collected = 0;
    std::size_t wrong_index = 0, wrong_majorant = 0, wrong_filled = 0, with_mass = 0;
    for (std::size_t l = 0; l < p.leaves.size(); ++l) {
        const Leaf& leaf = p.leaves[l];
        float largest = 0;
        int filled = 0, voxels = 0;
        for (int k = leaf.lo[2] - 1; k <= leaf.hi[2]; ++k)
            for (int j = leaf.lo[1] - 1; j <= leaf.hi[1]; ++j)
                for (int i = leaf.lo[0] - 1; i <= leaf.hi[0]; ++i) {
                    const int at[3] = {i, j, k};
                    bool in_box = true, in_leaf = true;
                    for (int a = 0; a < 3; ++a) {
                        in_box = in_box && at[a] >= 0 && at[a] < f.grid.size[a];
                        in_leaf = in_leaf && at[a] >= leaf.lo[a] && at[a] < leaf.hi[a];
                    }
                    REQUIRE((in_box || !in_leaf));
                    if (!in_box) continue;
                    const std::size_t v = voxel_index(f.grid, i, j, k);
                    largest = std::max(largest, f.rho[v]);
                    if (!in_leaf) continue;
                    ++voxels;
                    ++covered[v];
                    filled += f.rho[v] > 0;
                    wrong_index += p.leaf_of_voxel[v] != std::int32_t(l);
                }
        REQUIRE(voxels > 0);
        wrong_majorant += leaf.majorant != largest;
        wrong_filled += leaf.filled != float(double(filled) / voxels);
        mass += leaf.mass;
        CHECK((leaf.mass > 0) == (leaf.collector >= 0));
        CHECK((leaf.mass > 0) == (leaf.majorant > 0));
        with_mass += leaf.mass > 0;
    }
    CHECK(std::count(covered.begin(), covered.end(), 1) == std::ptrdiff_t(covered.size()));
    CHECK(wrong_index == 0);
    CHECK(wrong_majorant == 0);
    CHECK(wrong_filled == 0);
    // Two orders of a double sum of at most 1e5 positive terms.
    const double total = total_mass(f);
    CHECK(std::fabs(mass - total) <= 1e-12 * total);

    CHECK(p.collectors.size() == with_mass);
    for (std::size_t c = 0; c < p.collectors.size(); ++c) {
        const Collector& collector = p.collectors[c];
        const Leaf& leaf = p.leaves[std::size_t(collector.leaf)];
        REQUIRE(leaf.collector == std::int32_t(c));
        CHECK(collector.mass == leaf.mass);
        const double R = double(collector.billboard_radius);
        section += double(collector.extinction) * 4.0 / 3.0 * 3.14159265358979323846 * R * R * R;
        collected += collector.mass;
        for (int a = 0; a < 3; ++a) {
            const float cell = f.grid.cell_m[a];
            // A centroid lies inside its leaf; one float rounding may put it on the face.
            CHECK(collector.centre[a] >= float(leaf.lo[a]) * cell);
            CHECK(collector.centre[a] <= float(leaf.hi[a]) * cell);
        }
        CHECK((collector.radius > 0 && collector.billboard_radius >= collector.radius));
    }
    // Every extinction is rounded to float once: half an ulp, 6e-8.
    CHECK(std::fabs(section - total) <= 1e-7 * total);
    CHECK(std::fabs(collected - total) <= 1e-12 * total);
}

TreeOptions finished(const Field& f, float range, float influence_m, double share) {
    TreeOptions o;
    o.density_range = range;
    o.influence_m = influence_m;
    if (share > 0) leaf_limit(f.grid, share, 1e-9, o.max_leaf_voxels);
    return o;
}

}  // namespace

TEST_CASE("law: leaves tile the grid, majorants bound it, mass and cross-section are kept") {
    for (const Field& f : {balls(32, 24, 28, 1), speckle(15, 9, 11, 3), balls(40, 6, 33, 2)})
        for (bool paper : {false, true})
            for (float influence : {0.0f, 20.0f})
                for (double share : {0.0, 0.1}) {
                    CollectorOptions c;
                    c.paper = paper;
                    check_all(f, prepare(f, 700, finished(f, 0.1f, influence, share), c));
                }
}

TEST_CASE("law: no trilinear value rises above the majorant of its leaf") {
    const Field f = speckle(12, 10, 14, 6);
    const Prepared p = prepare(f, 400, finished(f, 0.2f, 1.0f, 0.0));
    int above = 0, reached = 0;
    for (std::uint32_t s = 0; s < 60000; ++s) {
        const float x[3] = {noise(1, s) * 12, noise(2, s) * 10, noise(3, s) * 14};
        const std::size_t v = voxel_index(f.grid, int(x[0]), int(x[1]), int(x[2]));
        const float majorant = p.leaves[std::size_t(p.leaf_of_voxel[v])].majorant;
        const float rho = density_at(f.span(), f.grid, x);
        // Three float interpolations may each pass their larger end by an ulp.
        above += rho > majorant * (1 + 3.6e-7f);
        reached += rho > 0.8f * majorant;
    }
    CHECK(above == 0);
    CHECK(reached > 100);
}

TEST_CASE("law: none, one and two samples, and samples on one spot") {
    const Field f = balls(16, 16, 16, 9);
    const Sample a{{4.25f, 4.25f, 4.25f}, 0.0f}, b{{11.75f, 4.25f, 4.25f}, 1.0f};
    const TreeOptions plain = finished(f, 0.1f, 0, 0);
    for (bool paper : {false, true}) {
        CollectorOptions c;
        c.paper = paper;
        const Sample two[2] = {a, b};
        const Prepared none = prepare_samples(f, {two, 0}, plain, c);
        const Prepared one = prepare_samples(f, {two, 1}, plain, c);
        const Prepared pair = prepare_samples(f, {two, 2}, plain, c);
        check_all(f, none), check_all(f, one), check_all(f, pair);
        CHECK(none.leaves.size() == 1);
        CHECK(one.leaves.size() == 1);
        // The plane stands midway between the two.
        REQUIRE(pair.leaves.size() == 2);
        CHECK(pair.leaves[0].hi[0] == 8);
        // Same place, same density: no plane can help, none is drawn.
        std::vector<Sample> same(50, a);
        const Prepared spot = prepare_samples(f, {same.data(), 50}, plain, c);
        CHECK(spot.leaves.size() == 1);
        // Same place, different densities: splitting must end at single voxels.
        for (std::size_t s = 0; s < same.size(); ++s) same[s].density = float(s % 2);
        const Prepared split = prepare_samples(f, {same.data(), 50}, plain, c);
        check_all(f, split);
        const Leaf& home =
            split.leaves[std::size_t(split.leaf_of_voxel[voxel_index(f.grid, 4, 4, 4)])];
        for (int axis = 0; axis < 3; ++axis) CHECK(home.hi[axis] - home.lo[axis] == 1);
    }
}

TEST_CASE("law: the plane stands at the median of the axis that separates the densities") {
    // Densities change along y only; samples spread evenly over a plane of voxels.
    Field f = zeros(16, 16, 16);
    std::fill(f.rho.begin(), f.rho.end(), 1.0f);
    std::vector<Sample> samples;
    for (int j = 0; j < 16; ++j)
        for (int i = 0; i < 16; ++i)
            samples.push_back(
                {{float(i) + 0.5f, float(j) + 0.5f, float(i) + 0.25f}, j < 8 ? 0.0f : 1.0f});
    const Prepared p = prepare_samples(f, {samples.data(), samples.size()}, finished(f, 0.5f, 0, 0),
                                       CollectorOptions{});
    REQUIRE(p.leaves.size() == 2);
    // The two middle samples lie at y = 7.5 and 8.5.
    CHECK(p.leaves[0].hi[1] == 8);
    CHECK(p.leaves[1].lo[1] == 8);
    // An odd count has one middle sample, at y = 5.5 here, which snaps upwards to face 6.
    const Sample three[3] = {
        {{3.5f, 2.5f, 8.5f}, 0}, {{3.5f, 5.5f, 8.5f}, 0}, {{3.5f, 12.5f, 8.5f}, 1}};
    const Prepared q = prepare_samples(f, {three, 3}, finished(f, 0.5f, 0, 0), CollectorOptions{});
    CHECK(q.leaf_of_voxel[voxel_index(f.grid, 3, 2, 8)] == 0);
    CHECK(q.leaves[0].hi[1] == 6);
}

TEST_CASE("law: finalisation leaves the radius of influence around samples, and no more") {
    Field f = zeros(64, 48, 32, 2.0f, 1.0f, 0.5f);
    std::fill(f.rho.begin(), f.rho.end(), 1.0f);
    const Sample s{{30.5f, 20.5f, 16.5f}, 1.0f};
    const TreeOptions o = finished(f, 0.1f, 5.0f, 0);
    const Prepared p = prepare_samples(f, {&s, 1}, o, CollectorOptions{});
    check_all(f, p);
    // The core and one slab per side.
    CHECK(p.leaves.size() == 7);
    const Leaf& home = p.leaves[std::size_t(p.leaf_of_voxel[voxel_index(f.grid, 30, 20, 16)])];
    for (int a = 0; a < 3; ++a) {
        const float cell = f.grid.cell_m[a];
        const float low = (s.x[a] - float(home.lo[a])) * cell,
                    high = (float(home.hi[a]) - s.x[a]) * cell;
        CHECK((low >= 5.0f && low < 5.0f + cell));
        CHECK((high >= 5.0f && high < 5.0f + cell));
    }
    // The widest gap goes first, over the whole cross-section: 64 - 30.5 voxels of 2 m on x.
    CHECK(p.leaves[0].hi[0] == 64);
    CHECK(p.leaves[0].lo[0] == home.hi[0]);
    CHECK(p.leaves[0].hi[1] - p.leaves[0].lo[1] == 48);
}

TEST_CASE("law: a limit on leaves halves those with medium and no others") {
    Field f = zeros(40, 40, 40);
    for (int k = 0; k < 20; ++k)
        for (int j = 0; j < 40; ++j)
            for (int i = 0; i < 40; ++i) f.at(i, j, k) = 0.5f;
    TreeOptions o;
    o.max_leaf_voxels[0] = 10, o.max_leaf_voxels[1] = 7, o.max_leaf_voxels[2] = 40;
    const Prepared p = prepare_samples(f, {}, o, CollectorOptions{});
    check_all(f, p);
    for (const Leaf& leaf : p.leaves.span()) {
        CHECK(leaf.hi[0] - leaf.lo[0] <= 10);
        CHECK(leaf.hi[1] - leaf.lo[1] <= 7);
    }
    CHECK(p.leaves.size() == 4 * 8);
    for (float& rho : f.rho) rho = 0;
    CHECK(prepare_samples(f, {}, o, CollectorOptions{}).leaves.size() == 1);
    int limit[3];
    const Grid g{{30, 40, 1}, {1.0f, 1.0f, 5.0f}};
    // Without an optical depth to speak of the diagonal alone counts.
    leaf_limit(g, 0.1, 1e-9, limit);
    // The diagonal is sqrt(900 + 1600 + 25) = 50.25 m.
    CHECK((limit[0] == 5 && limit[1] == 5 && limit[2] == 1));
    // Two optical depths are 4 m: longer than twelfths of 30 m and 40 m.
    leaf_limit(g, 0.1, 0.5, limit);
    CHECK((limit[0] == 4 && limit[1] == 4 && limit[2] == 1));
    // A layer of 600 x 600 x 12 voxels: the diagonal's tenth is 85 m, a twelfth of its height 1 m.
    const Grid layer{{600, 600, 12}, {1.0f, 1.0f, 1.0f}};
    leaf_limit(layer, 0.1, 100, limit);
    CHECK((limit[0] == 50 && limit[1] == 50 && limit[2] == 1));
    leaf_limit(layer, 0.1, 0.5, limit);
    CHECK((limit[0] == 50 && limit[1] == 50 && limit[2] == 4));
}

TEST_CASE("law: centre and radius of both variants, known answers") {
    Field f = zeros(8, 8, 8, 2.0f, 2.0f, 2.0f);
    f.at(5, 2, 3) = 1.0f;
    const Sample samples[2] = {{{1.5f, 2.5f, 3.5f}, 0.0f}, {{2.5f, 4.5f, 6.5f}, 0.0f}};
    CollectorOptions c;
    c.paper = true;
    const Prepared paper = prepare_samples(f, {samples, 2}, TreeOptions{}, c);
    REQUIRE(paper.collectors.size() == 1);
    const Collector& a = paper.collectors[0];
    CHECK((a.centre[0] == 4.0f && a.centre[1] == 7.0f && a.centre[2] == 10.0f));
    // r^3 = 3 * 16^3 / (4 pi); float rounding 6e-8, libm's cube root as the judge.
    CHECK(std::fabs(double(a.radius) / std::cbrt(3 * 4096.0 / (4 * 3.14159265358979)) - 1) < 1e-7);
    CHECK(a.billboard_radius == 2 * a.radius);
    // The paper's factor 8: the leaf's mean density over eight.
    CHECK(std::fabs(double(a.extinction) / (a.mass / 4096 / 8) - 1) < 4e-7);
    const Prepared best = prepare_samples(f, {samples, 2}, TreeOptions{}, CollectorOptions{});
    const Collector& b = best.collectors[0];
    // The hot voxel reaches half a voxel into its neighbours: cropped to 3^3 voxels around it.
    CHECK((b.centre[0] == 11.0f && b.centre[1] == 5.0f && b.centre[2] == 7.0f));
    CHECK(std::fabs(double(b.radius) / std::cbrt(3 * 216.0 / (4 * 3.14159265358979)) - 1) < 1e-7);
    CHECK(std::fabs(b.billboard_radius / b.radius - 1.35f) < 3e-7f);
    CHECK(b.mass == 8.0);
    for (double x : {1e-300, 1e-9, 0.3, 1.0, 2.0, 7.99, 8.0, 27.0, 1e12, 1e300})
        CHECK(std::fabs(cube_root(x) / std::cbrt(x) - 1) < 7e-16);
    CHECK(cube_root(0.0) == 0.0);
}

TEST_CASE("law: odd grids: one voxel, a row, a column, one hot voxel, nothing at all") {
    for (int which = 0; which < 6; ++which) {
        CAPTURE(which);
        Field f = which == 0   ? zeros(1, 1, 1)
                  : which == 1 ? speckle(1, 1, 37, 1)
                  : which == 2 ? speckle(53, 1, 1, 2)
                  : which == 3 ? zeros(20, 20, 20)
                  : which == 4 ? zeros(6, 7, 8)
                               : speckle(2, 2, 2, 4);
        if (which == 0) f.rho[0] = 0.7f;
        if (which == 3) f.at(19, 0, 7) = 1.0f;
        for (bool paper : {false, true}) {
            CollectorOptions c;
            c.paper = paper;
            const Prepared p = prepare(f, 60, finished(f, 0.05f, 1.0f, 0.2), c);
            check_all(f, p);
            if (which == 0) CHECK((p.samples.size() == 0 && p.collectors.size() == 1));
            if (which == 4) CHECK((p.leaves.size() == 1 && p.collectors.size() == 0));
        }
    }
}

TEST_CASE("law: leaves and collectors do not depend on the number of threads") {
    const Field f = balls(48, 40, 36, 12);
    for (bool paper : {false, true}) {
        std::uint64_t digests[3];
        for (int run = 0; run < 3; ++run) {
            CollectorOptions c;
            c.paper = paper;
            const Prepared p = prepare(f, 3000, finished(f, 0.1f, 30.0f, 0.04), c, 1 + run * 2);
            Digest d;
            for (const Leaf& l : p.leaves.span()) {
                for (int a = 0; a < 3; ++a)
                    d.u32(std::uint32_t(l.lo[a])), d.u32(std::uint32_t(l.hi[a]));
                d.f32(l.majorant), d.f32(l.filled), d.u32(std::uint32_t(l.collector));
            }
            for (const Collector& s : p.collectors.span()) {
                for (float x : s.centre) d.f32(x);
                d.f32(s.radius), d.f32(s.billboard_radius), d.f32(s.extinction);
                d.u32(std::uint32_t(s.leaf));
            }
            digests[run] = d.value();
        }
        CHECK(digests[0] == digests[1]);
        CHECK(digests[0] == digests[2]);
    }
}
