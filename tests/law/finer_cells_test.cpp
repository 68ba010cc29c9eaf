// SPDX-License-Identifier: Apache-2.0
// Cells for light where the data's are deep: how many take the place of one, and what they hold.
// in: small grids of known optical depth -> out: factors in closed form; densities at places.
// docs/methods.md 2, "Cells for light"
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "src/world/medium/refine.h"
#include "src/world/world.h"
#include "tests/support/host_cells.h"

using namespace pileus;

namespace {

Medium make_medium(const std::array<int, 3>& size, const std::array<double, 3>& extent_m,
                   double per_m) {
    Medium m;
    m.volume.size = size;
    m.sigma = float(per_m);
    m.density_max = 1;
    for (std::size_t a = 0; a < 3; ++a) {
        m.extent_m[a] = extent_m[a];
        m.grid.size[a] = size[a];
        m.grid.cell_m[a] = float(extent_m[a] / size[a]);
    }
    return m;
}

float next(std::uint32_t& state) {
    state = state * 1664525u + 1013904223u;
    return float(state >> 8) * 0x1p-24f;
}

void fill(Buffer<float>& values, std::size_t count) {
    REQUIRE(values.resize(count, "test"));
    std::uint32_t state = 7;
    for (float& v : values.span()) v = next(state);
}

using Factor = std::array<int, 3>;

}  // namespace

TEST_CASE("finer cells: of one optical depth, an odd number, and no more than there is room for") {
    const Limits limits;
    CHECK(finer_cells(make_medium({8, 8, 8}, {8, 8, 8}, 0), limits) == Factor{1, 1, 1});
    CHECK(finer_cells(make_medium({8, 8, 8}, {8, 8, 8}, 1), limits) == Factor{1, 1, 1});
    CHECK(finer_cells(make_medium({8, 8, 8}, {8, 8, 8}, 1.01), limits) == Factor{3, 3, 3});
    CHECK(finer_cells(make_medium({8, 8, 8}, {8, 16, 40}, 1), limits) == Factor{1, 3, 5});
    CHECK(finer_cells(make_medium({1, 1, 1}, {40, 40, 40}, 1), limits) == Factor{41, 41, 41});
    // Few cells along an axis that is not thin.
    CHECK(finer_cells(make_medium({1, 1, 1}, {1, 1, 1}, 1), limits) == Factor{5, 5, 5});
    CHECK(finer_cells(make_medium({2, 3, 4}, {1, 1, 1}, 1), limits) == Factor{3, 3, 1});
    CHECK(finer_cells(make_medium({1, 1, 1}, {1, 2, 0.5}, 0.25), limits) == Factor{1, 3, 1});
    // As many as memory has, or as they are.
    CHECK(finer_cells(make_medium({400, 400, 1}, {400, 400, 1}, 1), limits) == Factor{1, 1, 3});
    Limits hundred;
    hundred[LimitId::kVoxels] = 100;
    CHECK(finer_cells(make_medium({1, 1, 1}, {1, 1, 1}, 1), hundred) == Factor{3, 3, 3});
    // No larger than 2^19, whatever the extinction.
    for (const double per_m : {100.0, 1e10, 1e30}) {
        const Factor f = finer_cells(make_medium({6, 6, 4}, {6, 6, 4}, per_m), limits);
        const double cells = 144.0 * f[0] * f[1] * f[2];
        CHECK(cells <= 0x1p19);
        CHECK(cells > 0x1p17);
        CHECK(f[0] % 2 == 1);
    }
    CHECK(finer_cells(make_medium({64, 64, 64}, {64, 64, 64}, 9), limits) == Factor{1, 1, 1});
    // A deck: cells as wide as weather models have stay, its height is divided.
    CHECK(finer_cells(make_medium({30, 30, 1}, {3e5, 3e5, 240}, 0.0625), limits) ==
          Factor{1, 1, 15});
    // No side and no product over the limits of the scene.
    Limits few;
    few[LimitId::kSide] = 10;
    CHECK(finer_cells(make_medium({2, 3, 10}, {60, 60, 60}, 1), few) == Factor{5, 3, 1});
    few = Limits{};
    few[LimitId::kVoxels] = 1000;
    const Factor f = finer_cells(make_medium({2, 2, 2}, {60, 60, 60}, 1), few);
    CHECK(8 * f[0] * f[1] * f[2] <= 1000);
}

TEST_CASE("finer cells: the same density everywhere, of every part") {
    for (const bool periodic : {false, true})
        for (const bool constant : {false, true}) {
            CAPTURE(periodic);
            CAPTURE(constant);
            Medium coarse = make_medium({5, 4, 3}, {10, 8, 9}, 1);
            coarse.grid.periodic = periodic;
            coarse.grid.constant = constant;
            coarse.count = 3;
            fill(coarse.volume.density, 60);
            fill(coarse.parts, 120);
            Medium fine = make_medium({5, 4, 3}, {10, 8, 9}, 1);
            fine.grid = coarse.grid;
            fine.count = 3;
            fill(fine.volume.density, 60);
            fill(fine.parts, 120);
            const Factor factor{3, 1, 7};
            REQUIRE(refine_medium(factor, 2, fine));
            REQUIRE(fine.volume.density.size() == 15 * 4 * 21);
            REQUIRE(fine.parts.size() == 2 * 15 * 4 * 21);
            std::uint32_t state = 3;
            double worst = 0;
            for (int i = 0; i < 2000; ++i) {
                float p[3], q[3];
                for (std::size_t a = 0; a < 3; ++a) {
                    p[a] = next(state) * float(coarse.grid.size[a]);
                    q[a] = p[a] * float(factor[a]);
                }
                // Beside the face of a constant cell rounding decides which it is.
                bool near_face = false;
                for (const float c : q)
                    near_face |= constant && std::fabs(c - std::round(c)) < 1e-3f;
                if (near_face) continue;
                for (std::size_t part = 0; part < 3; ++part) {
                    const auto span = [&](const Medium& m) {
                        const std::size_t n = voxel_count(m.grid);
                        return part == 0
                                   ? m.volume.density.span()
                                   : Span<float>{
                                         const_cast<float*>(m.parts.data()) + (part - 1) * n, n};
                    };
                    const Span<const float> from{span(coarse).data, span(coarse).size};
                    const Span<const float> to{span(fine).data, span(fine).size};
                    worst = std::max(worst, std::fabs(double(density_at(from, coarse.grid, p)) -
                                                      double(density_at(to, fine.grid, q))));
                }
            }
            // A few roundings of numbers up to 1, in places of up to 21 cells: 2^-20 of a cell.
            CHECK(worst < 4e-6);
            // The old centres are kept to the last bit.
            CHECK(fine.volume.density[voxel_index(fine.grid, 1, 0, 3)] == coarse.volume.density[0]);
        }
}

TEST_CASE("finer cells: a world has them, as its outline says") {
    Scene scene;
    scene.media.resize(1);
    MediumSettings& m = scene.media[0];
    m.density = "uniform:box";
    m.box.has_bounds = true;
    m.box.bounds_m = {{{0, 0, 0}, {40, 40, 40}}};
    m.box.resolution = {2, 2, 2};
    m.optics.extinction_per_m = 0.25;
    Report report;
    Context context;
    context.report = &report;
    World world;
    REQUIRE(outline_world(scene, WorldUse::kGrid, {}, context, world));
    CHECK(world.medium.grid.size[0] == 10);
    REQUIRE(load_world(scene, {}, context, world));
    CHECK(world.medium.grid.size[2] == 10);
    CHECK(world.medium.grid.cell_m[1] == 4.0f);
    CHECK(world.medium.volume.density.size() == 1000);
    const char* told =
        "light on cells 5 x 5 x 5 times as fine: the density's are up to 5 optical depths deep";
    CHECK(std::count(world.media_plan.needed.begin(), world.media_plan.needed.end(), told) == 1);
}
