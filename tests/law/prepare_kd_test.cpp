// SPDX-License-Identifier: Apache-2.0
// The kD-tree against a plain one that sorts anew in every node.
// in: samples with exact densities -> out: passes or fails.
// Elek 2011, section 5.3.
#include <doctest/doctest.h>

#include "src/methods/collectors/prepare/tree.h"
#include "tests/law/prepare_fields.h"

using namespace pileus;
using namespace prepare_test;

namespace {

struct Box {
    int lo[3], hi[3];
};

/// Summed squared deviation of densities from their mean; exact sums for multiples of 1/256.
double deviation(const std::vector<Sample>& samples) {
    double sum = 0, square = 0;
    for (const Sample& s : samples) {
        sum += double(s.density);
        square += double(s.density) * double(s.density);
    }
    return samples.empty() ? 0.0 : square - sum * sum / double(samples.size());
}

/// The plane of one axis: the median, snapped to the nearest face strictly inside.
int plane(std::vector<Sample> samples, const Box& box, int axis) {
    std::sort(samples.begin(), samples.end(),
              [&](const Sample& a, const Sample& b) { return a.x[axis] < b.x[axis]; });
    const std::size_t n = samples.size();
    const float median = 0.5f * (samples[(n - 1) / 2].x[axis] + samples[n / 2].x[axis]);
    return std::min(std::max(int(median + 0.5f), box.lo[axis] + 1), box.hi[axis] - 1);
}

void split(const std::vector<Sample>& samples, const Box& box, const Grid& grid, float range,
           std::vector<Box>& leaves) {
    float low = 1e9f, high = -1e9f;
    for (const Sample& s : samples)
        low = std::min(low, s.density), high = std::max(high, s.density);
    int best = -1;
    double least = 0;
    std::vector<Sample> halves[2];
    Box boxes[2] = {box, box};
    for (int a = 0; a < 3 && samples.size() >= 2 && high - low >= range; ++a) {
        if (box.hi[a] - box.lo[a] < 2) continue;
        const int face = plane(samples, box, a);
        std::vector<Sample> sides[2];
        for (const Sample& s : samples) sides[s.x[a] >= float(face)].push_back(s);
        const double cost = deviation(sides[0]) + deviation(sides[1]);
        const auto edge = [&](int axis) {
            return double(box.hi[axis] - box.lo[axis]) * double(grid.cell_m[axis]);
        };
        if (best >= 0 && (cost > least || (cost == least && edge(a) <= edge(best)))) continue;
        best = a, least = cost;
        for (int h = 0; h < 2; ++h) halves[h] = sides[h], boxes[h] = box;
        boxes[0].hi[a] = boxes[1].lo[a] = face;
    }
    if (best < 0) {
        leaves.push_back(box);
        return;
    }
    for (int h = 0; h < 2; ++h) split(halves[h], boxes[h], grid, range, leaves);
}

}  // namespace

TEST_CASE("law: presorted lists build the same tree as sorting in every node") {
    std::size_t most = 0;
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        const Field f = speckle(20 + int(seed), 17, 9, seed);
        // Two thirds lie scattered, one third on few spots; densities are multiples of 1/256.
        std::vector<Sample> samples;
        for (std::uint32_t s = 0; s < 500; ++s) {
            Sample sample{};
            for (std::uint32_t a = 0; a < 3; ++a) {
                const std::uint32_t at = s % 3 == 0 ? s % 5 : s;
                sample.x[a] = noise(seed, 4 * at + a) * float(f.grid.size[a]);
            }
            sample.density = float(int(noise(seed, 4 * s + 3) * 256.0f)) / 256.0f;
            samples.push_back(sample);
        }
        TreeOptions options;
        options.density_range = 0.25f * float(seed % 3);
        Buffer<Leaf> leaves;
        REQUIRE(bool(
            build_tree({samples.data(), samples.size()}, f.span(), f.grid, options, 1, leaves)));
        std::vector<Box> expected;
        const Box all{{0, 0, 0}, {f.grid.size[0], f.grid.size[1], f.grid.size[2]}};
        split(samples, all, f.grid, options.density_range, expected);
        REQUIRE(leaves.size() == expected.size());
        int different = 0;
        for (std::size_t l = 0; l < expected.size(); ++l)
            for (int a = 0; a < 3; ++a)
                different +=
                    leaves[l].lo[a] != expected[l].lo[a] || leaves[l].hi[a] != expected[l].hi[a];
        CHECK(different == 0);
        most = std::max(most, expected.size());
    }
    CHECK(most > 300);
}

TEST_CASE("law: samples that pile up in a corner end in a bounded walk, with nothing lost") {
    // Every split here peels few voxels: the deepest tree that the grid allows along x.
    const Field f = zeros(4096, 2, 2);
    std::vector<Sample> samples;
    float x = 4095.5f;
    for (int s = 0; s < 2000; ++s) {
        samples.push_back({{x, 0.5f, 0.5f}, float(s % 2)});
        samples.push_back({{x, 0.5f, 0.5f}, float(s % 2)});
        if (s % 40 == 0) x = std::max(0.5f, x * 0.5f);
    }
    TreeOptions options;
    options.density_range = 0;
    Buffer<Leaf> leaves;
    REQUIRE(
        bool(build_tree({samples.data(), samples.size()}, f.span(), f.grid, options, 1, leaves)));
    std::int64_t voxels = 0;
    for (const Leaf& l : leaves.span())
        voxels += std::int64_t(l.hi[0] - l.lo[0]) * (l.hi[1] - l.lo[1]) * (l.hi[2] - l.lo[2]);
    CHECK(voxels == 4096 * 4);
}
