// SPDX-License-Identifier: Apache-2.0
// Media laid on one grid: the grid, the weights, what is conserved, the collectors' shares.
// in: boxes that are equal, nested, disjoint or askew -> out: masses, copies, integrals by
// sampling. docs/methods.md 2, "Several media".
#include "src/base/digest.h"
#include "src/methods/collectors/prepare/prepare.h"
#include "src/world/grid/grid.h"
#include "tests/support/media_harness.h"

using namespace trace_test;

namespace {

/// The trilinear read-out along one axis by its definition: weight of source cell s at `metres`.
double hat(const CellRow& source, int s, double metres) {
    const double u = (metres - source.low_m) / source.cell_m;
    if (u < 0 || u > source.count) return 0;
    const double c = std::min(std::max(u - 0.5, 0.0), double(source.count - 1));
    return std::max(0.0, 1 - std::fabs(c - s));
}

double weight_at(const RowWeights& w, int t, int s) {
    const std::size_t run = w.first[std::size_t(t) + 1] - w.first[std::size_t(t)];
    const int k = s - w.begin[std::size_t(t)];
    return k < 0 || std::size_t(k) >= run ? 0 : w.weight[w.first[std::size_t(t)] + std::size_t(k)];
}

Medium mixed(std::vector<Medium>& media, int threads = 1) {
    std::vector<MixBox> boxes;
    for (const Medium& m : media) boxes.push_back(box_of(m));
    Medium out;
    REQUIRE(mix_media(media, plan_mix(boxes), threads, out));
    return out;
}

}  // namespace

TEST_CASE("media: weights are the integrals of the trilinear read-out") {
    const CellRow target{0, 0.5, 40};
    const CellRow sources[] = {{0, 0.5, 40}, {1, 0.5, 7},     {0, 1, 20},       {2.13, 0.7, 9},
                               {3.3, 5, 3},  {0.2, 0.06, 90}, {7, 13, 1},       {19.1, 0.9, 1},
                               {0, 20, 1},   {1.25, 0.5, 11}, {4.0, 0.125, 33}, {5, 0.5 / 3, 27}};
    for (const CellRow& source : sources) {
        CAPTURE(source.low_m);
        CAPTURE(source.cell_m);
        const RowWeights w = row_weights(target, source);
        for (int s = 0; s < source.count; ++s) {
            double whole = 0;
            for (int t = 0; t < target.count; ++t) whole += weight_at(w, t, s) * target.cell_m;
            // Rounding of some dozen additions.
            CHECK(whole == doctest::Approx(source.cell_m).epsilon(1e-12));
        }
        if (!w.resampled) continue;
        constexpr int kPoints = 4000;
        for (int t = 0; t < target.count; ++t)
            for (int s = 0; s < source.count; ++s) {
                double mean = 0;
                for (int i = 0; i < kPoints; ++i)
                    mean += hat(source, s, (t + (i + 0.5) / kPoints) * target.cell_m) / kPoints;
                // At an outer face the read-out jumps by 1: one point of 4000 may be wrong there.
                CHECK(std::fabs(weight_at(w, t, s) - mean) < 3.0 / kPoints);
            }
    }
}

TEST_CASE("media: lattices that coincide are copied, and only they") {
    const CellRow target{-3, 0.1, 100};
    for (int shift : {0, 3, 70}) {
        const RowWeights w = row_weights(target, {-3 + 0.1 * shift, 0.1, 30});
        CHECK(!w.resampled);
        for (int t = 0; t < 100; ++t)
            for (int s = 0; s < 30; ++s) CHECK(weight_at(w, t, s) == (t == s + shift ? 1.0 : 0.0));
    }
    CHECK(row_weights(target, {-3 + 0.05, 0.1, 30}).resampled);
    CHECK(row_weights(target, {-3, 0.2, 30}).resampled);
    // One cell whose faces are faces of the target: a box of constant density stays what it is.
    CHECK(!row_weights(target, {-2, 1.7, 1}).resampled);
    CHECK(row_weights(target, {-2, 1.73, 1}).resampled);
}

TEST_CASE("media: the common grid has the finest edges and covers every box") {
    const MixBox cloud{{100, 100, 50}, {160, 160, 110}, {16, 16, 11}};
    const MixBox haze{{0, 0, 0}, {400, 320, 200}, {1, 1, 1}};
    const MixGrid nested = plan_mix({cloud, haze});
    CHECK(nested.box.low_m == Double3{0, 0, 0});
    CHECK(nested.box.extent_m == Double3{400, 320, 200});
    CHECK(nested.box.size == std::array<int, 3>{40, 32, 20});
    CHECK(!nested.coarsened);
    CHECK(resampled_media({cloud, haze}, nested) == std::vector<bool>{false, false});

    const MixGrid same = plan_mix({cloud, cloud});
    CHECK(same.box.size == cloud.size);
    CHECK(same.box.extent_m == cloud.extent_m);

    // Too many voxels: every axis grows by the same factor, and the limit is nearly used.
    const MixGrid few = plan_mix({cloud, haze}, 1000);
    std::uint64_t voxels = 1;
    for (int n : few.box.size) voxels *= std::uint64_t(n);
    CHECK(few.coarsened);
    CHECK(voxels <= 1000);
    CHECK(voxels > 700);
    CHECK(resampled_media({cloud, haze}, few) == std::vector<bool>{true, false});

    const MixGrid wide =
        plan_mix({{{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, {{9e5, 0, 0}, {1, 1, 1}, {4, 1, 1}}});
    CHECK(wide.box.size == std::array<int, 3>{4096, 1, 1});
    CHECK(wide.coarsened);
}

TEST_CASE("media: equal boxes add voxel by voxel, exactly") {
    std::vector<Medium> media;
    for (std::uint32_t i = 0; i < 3; ++i)
        media.push_back(make_box({1, 2, 3}, {7, 5, 3}, {14, 9, 5}, i == 1 ? 0.5 : 0.25, i));
    std::vector<float> a[3];
    for (std::size_t i = 0; i < 3; ++i)
        a[i].assign(media[i].volume.density.span().begin(), media[i].volume.density.span().end());
    const Medium m = mixed(media);
    CHECK(m.sigma == 0.5f);
    CHECK(m.count == 3);
    const std::size_t voxels = m.volume.density.size();
    for (std::size_t v = 0; v < voxels; ++v) {
        CHECK(m.parts[v] == a[1][v]);
        CHECK(m.parts[voxels + v] == 0.5f * a[2][v]);
        CHECK(m.volume.density[v] == (a[1][v] + 0.5f * a[2][v]) + 0.5f * a[0][v]);
    }
}

TEST_CASE("media: one medium is handed on to the bit") {
    std::vector<Medium> media;
    media.push_back(make_box({1, 2, 3}, {7, 5, 3}, {14, 9, 5}, 0.3, 1));
    Buffer<float> before;
    REQUIRE(before.resize(media[0].volume.density.size(), "copy"));
    std::copy(media[0].volume.density.span().begin(), media[0].volume.density.span().end(),
              before.data());
    const Medium m = mixed(media);
    CHECK(m.count == 1);
    CHECK(m.parts.empty());
    CHECK(m.sigma == 0.3f);
    CHECK(std::memcmp(m.volume.density.data(), before.data(), std::size_t(before.bytes())) == 0);
}

TEST_CASE("media: two halves of a medium are the whole, to the bit") {
    const Medium whole = make_box({10, 20, 30}, {70, 50, 30}, {14, 10, 6}, 0.3, 5);
    std::vector<Medium> halves;
    for (int h = 0; h < 2; ++h) {
        halves.push_back(make_box({10 + 35.0 * h, 20, 30}, {35, 50, 30}, {7, 10, 6}, 0.3, 0));
        Buffer<float>& part = halves.back().volume.density;
        for (std::size_t v = 0; v < part.size(); ++v)
            part[v] = whole.volume.density[v / 7 * 14 + v % 7 + std::size_t(7 * h)];
    }
    const Medium m = mixed(halves);
    CHECK(m.volume.size == whole.volume.size);
    CHECK(std::memcmp(m.volume.density.data(), whole.volume.density.data(),
                      std::size_t(whole.volume.density.bytes())) == 0);
}

TEST_CASE("media: what each holds is kept, wherever its box and whatever its voxels") {
    struct Pair {
        const char* name;
        Double3 low, extent;
        std::array<int, 3> size;
    };
    const Pair pairs[] = {
        {"nested, coarser", {-5, -7, -1}, {40, 39, 21}, {8, 5, 3}},
        {"nested, one voxel", {-5.3, -7.1, -1.7}, {40, 39, 21}, {1, 1, 1}},
        {"inside, finer", {2, 2.5, 1.25}, {3.7, 2.9, 1.3}, {17, 13, 11}},
        {"overlapping, askew", {3.3, 4.7, -2.2}, {11, 6, 5}, {10, 7, 6}},
        {"disjoint", {30, 20, 0}, {4, 4, 4}, {5, 6, 7}},
        {"the same box, other voxels", {0, 0, 0}, {12, 10, 8}, {7, 11, 3}},
    };
    for (const Pair& p : pairs) {
        CAPTURE(p.name);
        std::vector<Medium> media;
        media.push_back(make_box({0, 0, 0}, {12, 10, 8}, {12, 10, 8}, 0.2, 3));
        media.push_back(make_box(p.low, p.extent, p.size, 0.01, 4));
        const double held[2] = {cross_section(media[0].volume.density.span(), media[0]),
                                cross_section(media[1].volume.density.span(), media[1])};
        const Medium m = mixed(media);
        // Each voxel is rounded to a float: 6e-8 of itself, and medium 0 is a difference of sums.
        CHECK(cross_section_of(m, 1) == doctest::Approx(held[1]).epsilon(2e-7));
        CHECK(cross_section_of(m, 0) == doctest::Approx(held[0]).epsilon(1e-6));
        for (std::size_t v = 0; v < m.parts.size(); ++v)
            REQUIRE((m.parts[v] >= 0 && m.parts[v] <= m.volume.density[v]));
    }
}

TEST_CASE("media: the grid is the same for any number of threads") {
    std::string digests[2];
    for (int threads : {1, 5}) {
        std::vector<Medium> media;
        media.push_back(make_box({0, 0, 0}, {12, 10, 8}, {12, 10, 8}, 0.2, 3));
        media.push_back(make_box({3.3, 4.7, -2.2}, {11, 6, 5}, {10, 7, 6}, 0.1, 4));
        media.push_back(make_box({-3.3, 4.7, -2.2}, {11, 6, 5}, {3, 7, 16}, 0.1, 5));
        const Medium m = mixed(media, threads);
        Digest d;
        d.floats(m.volume.density.span());
        d.floats(m.parts.span());
        digests[threads > 1] = d.hex();
    }
    CHECK(digests[0] == digests[1]);
}

TEST_CASE("media: a collector's shares are its leaf's extinction, medium by medium") {
    Rig rig = make_rig({16, 12, 8}, {16, 12, 8}, 0.5);
    std::size_t v = 0;
    for (int z = 0; z < 8; ++z)
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 16; ++x, ++v)
                rig.medium.volume.density[v] = float((x * 7 + y * 5 + z * 3) % 11) / 10;
    // Left half: all medium 0; right half: all medium 1 but the last quarter, which is half each.
    split(rig, Optics{}, [&](std::size_t voxel) {
        const std::size_t x = voxel % 16;
        return x < 8 ? 0.0 : x < 12 ? 1.0 : 0.5;
    });
    Prepared prepared;
    Report report;
    Context context;
    context.report = &report;
    REQUIRE(prepare_cells(rig.medium, 2, context, prepared));
    REQUIRE(prepared.shares.size() == 2 * prepared.collectors.size());
    for (std::size_t c = 0; c < prepared.collectors.size(); ++c) {
        const int x = prepared.leaves[std::size_t(prepared.collectors[c].leaf)].lo[0];
        const float* share = prepared.shares.data() + 2 * c;
        CHECK(share[0] + share[1] == doctest::Approx(1).epsilon(1e-6));
        // Cells beside a border share what the trilinear field carries over it.
        if (x < 6) CHECK(share[1] == 0);
        if (x == 6 || x == 8) CHECK((share[1] > 0 && share[1] < 1));
        if (x >= 14) CHECK(share[1] == doctest::Approx(0.5).epsilon(1e-6));
    }
}
