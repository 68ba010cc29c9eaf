// SPDX-License-Identifier: Apache-2.0
// The majorant grid against a direct search, and the choice of its block against its formula.
// in: small density fields -> out: passes or fails.
// docs/methods.md 1 and 2 (local majorants).
#include <doctest/doctest.h>

#include "src/world/majorant/majorant.h"
#include "tests/law/prepare_fields.h"

using namespace pileus;
using namespace prepare_test;

namespace {

float direct_majorant(const Field& f, int block, int bx, int by, int bz) {
    const int b[3] = {bx, by, bz};
    int lo[3], hi[3];
    for (int a = 0; a < 3; ++a) {
        lo[a] = std::max(b[a] * block - 1, 0);
        hi[a] = std::min((b[a] + 1) * block, f.grid.size[a] - 1);
    }
    float largest = 0;
    for (int k = lo[2]; k <= hi[2]; ++k)
        for (int j = lo[1]; j <= hi[1]; ++j)
            for (int i = lo[0]; i <= hi[0]; ++i)
                largest = std::max(largest, f.rho[voxel_index(f.grid, i, j, k)]);
    return largest;
}

double direct_cost(const Field& f, int block, double sigma, const TrackingCosts& costs) {
    int n[3];
    block_counts(f.grid, block, n);
    double total = 0;
    for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j < n[1]; ++j)
            for (int i = 0; i < n[0]; ++i) {
                const int b[3] = {i, j, k};
                double e[3];
                for (int a = 0; a < 3; ++a)
                    e[a] =
                        std::min(block, f.grid.size[a] - b[a] * block) * double(f.grid.cell_m[a]);
                const double majorant = double(direct_majorant(f, block, i, j, k));
                total += sigma * majorant * e[0] * e[1] * e[2] * costs.tentative +
                         2 * (e[0] * e[1] + e[1] * e[2] + e[2] * e[0]) / 4 *
                             (majorant > 0 ? costs.crossing : costs.empty);
            }
    return total;
}

}  // namespace

TEST_CASE("law: the majorant grid is the largest density over each block and its border") {
    for (const Field& f : {speckle(13, 8, 10, 1), speckle(1, 1, 9, 2), speckle(1, 1, 1, 3)})
        for (int block : {1, 2, 3, 4, 8, 13, 100})
            for (int threads : {1, 3}) {
                Buffer<float> m;
                REQUIRE(bool(majorant_grid(f.span(), f.grid, block, threads, m)));
                int n[3];
                block_counts(f.grid, block, n);
                REQUIRE(m.size() == std::size_t(n[0]) * std::size_t(n[1]) * std::size_t(n[2]));
                std::size_t at = 0, wrong = 0;
                for (int k = 0; k < n[2]; ++k)
                    for (int j = 0; j < n[1]; ++j)
                        for (int i = 0; i < n[0]; ++i)
                            wrong += m[at++] != direct_majorant(f, block, i, j, k);
                CHECK(wrong == 0);
            }
}

TEST_CASE("law: the predicted cost of every block size is its formula, the least one wins") {
    for (const Field& f : {balls(70, 20, 33, 4), speckle(5, 3, 2, 5), zeros(3, 40, 40)})
        for (double sigma : {1e-4, 0.05, 3.0}) {
            const TrackingCosts costs{1.0, 0.7};
            BlockChoice choice, again;
            REQUIRE(bool(choose_block(f.span(), f.grid, sigma, costs, 1, choice)));
            REQUIRE(bool(choose_block(f.span(), f.grid, sigma, costs, 3, again)));
            REQUIRE(choice.candidates >= 1);
            int best = 0;
            for (int c = 0; c < choice.candidates; ++c) {
                const double cost = direct_cost(f, choice.edge[c], sigma, costs);
                // Two orders of a sum of at most 5e4 positive doubles.
                CHECK(std::fabs(choice.cost[c] - cost) <= 1e-11 * cost);
                CHECK(choice.cost[c] == again.cost[c]);
                if (choice.cost[c] <= choice.cost[best]) best = c;
            }
            CHECK(choice.block == choice.edge[best]);
            const int* n = f.grid.size;
            CHECK(choice.edge[choice.candidates - 1] == std::max(n[0], std::max(n[1], n[2])));
        }
}

TEST_CASE("law: thin or empty media get one block, thick and ragged ones small blocks") {
    const TrackingCosts costs;
    BlockChoice empty, thin, ragged;
    const Field nothing = zeros(40, 40, 40);
    REQUIRE(bool(choose_block(nothing.span(), nothing.grid, 1.0, costs, 1, empty)));
    CHECK(empty.block == 40);
    // Where every size costs the same, the fewest blocks win.
    REQUIRE(bool(choose_block(nothing.span(), nothing.grid, 1.0, {1.0, 0.0, 0.0}, 1, empty)));
    CHECK(empty.block == 40);
    const Field f = balls(64, 64, 64, 3);
    REQUIRE(bool(choose_block(f.span(), f.grid, 1e-6, costs, 1, thin)));
    CHECK(thin.block == 64);
    REQUIRE(bool(choose_block(f.span(), f.grid, 100.0, costs, 1, ragged)));
    CHECK(ragged.block == 1);
}

TEST_CASE("law: an empty block knows the distance to the next that is not") {
    Field f = speckle(37, 22, 31, 5);
    // Almost all is air, so that there are distances.
    for (std::size_t i = 0; i < f.rho.size(); ++i)
        if (i % 5003 != 17) f.rho[i] = 0;
    for (int block : {3, 5}) {
        Buffer<float> plain, marked;
        REQUIRE(bool(majorant_grid(f.span(), f.grid, block, 1, plain)));
        REQUIRE(bool(majorant_grid(f.span(), f.grid, block, 1, marked)));
        int n[3], far = 0;
        block_counts(f.grid, block, n);
        mark_empty_blocks(marked.span(), n, 2);
        const auto at = [&](int i, int j, int k) { return std::size_t((k * n[1] + j) * n[0] + i); };
        for (int k = 0; k < n[2]; ++k)
            for (int j = 0; j < n[1]; ++j)
                for (int i = 0; i < n[0]; ++i) {
                    int nearest = 1 << 20;
                    for (int c = 0; c < n[2]; ++c)
                        for (int b = 0; b < n[1]; ++b)
                            for (int a = 0; a < n[0]; ++a)
                                if (plain[at(a, b, c)] > 0)
                                    nearest = std::min(nearest,
                                                       std::max({std::abs(a - i), std::abs(b - j),
                                                                 std::abs(c - k)}));
                    const float expected = nearest == 0 ? plain[at(i, j, k)] : -float(nearest - 1);
                    if (marked[at(i, j, k)] != expected) FAIL_CHECK("block " << at(i, j, k));
                    far = std::max(far, nearest);
                }
        CHECK(far > 2);
    }
}
