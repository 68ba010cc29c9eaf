// SPDX-License-Identifier: Apache-2.0
// Cells that gather at every tentative collision: track lengths without bias, floors, the ledger.
// in: media of high contrast in diffuse light -> out: the same fluence in every cell; exact
// balances. Blanco and Fournier 2003: in a white medium lit evenly from all sides light is even
// everywhere.
#include "src/world/majorant/majorants.h"
#include "tests/support/trace_harness.h"

using namespace trace_test;

namespace {

/// Checkers of 1 and `low` in x < 5, nothing behind x = 8 and a plain in between.
Rig make_patches(float low) {
    Rig rig = make_rig({12, 7, 6}, {24, 14, 15}, 0.8);
    std::size_t v = 0;
    for (int z = 0; z < 6; ++z)
        for (int y = 0; y < 7; ++y)
            for (int x = 0; x < 12; ++x, ++v)
                rig.medium.volume.density[v] =
                    x < 5 ? ((x + y + z) % 2 == 0 ? 1.0f : low) : (x < 8 ? 0.25f : 0.0f);
    return rig;
}

struct Floored {
    Majorants majorants;
    CellMajorants near;
};

void floor_majorants(Rig& rig, const CellGrid& cells, bool local, Floored& out) {
    Report report;
    Context context;
    context.report = &report;
    context.kernels = rig.kernels;
    REQUIRE(make_cell_majorants(rig.medium, local, cells, context, out.majorants, out.near));
}

void use_cells(Rig& rig, const CellGrid& cells, Floored& floored) {
    rig.majorants.swap(floored.majorants.tracking);
    rig.block = floored.majorants.block;
    for (int a = 0; a < 3; ++a) rig.cells.size[a] = cells.size[a];
    rig.cells.density = floored.near.least_density;
    rig.collectors = cells.count();
    rig.deposit.mode = kDepositCosine;
    rig.deposit.coefficients = 2;
    rig.deposit.places = 20;
}

/// Sums of cell i of a batch of generations, [batch][number].
std::vector<std::vector<double>> cell_sums(Rig& rig, int batches, std::uint64_t photons,
                                           std::uint64_t seed) {
    for (Light& light : rig.lighting.lights) light.photons = photons;
    const TraceInput in = input_of(rig, seed);
    TraceScratch scratch;
    REQUIRE(prepare_trace(in, scratch));
    std::vector<std::vector<double>> out;
    for (int b = 0; b < batches; ++b) {
        PhotonSlot slot;
        REQUIRE(slot.sums.resize(slot_stride(in), "slot"));
        std::vector<TraceTally> tallies(1);
        REQUIRE(trace_generation(in, std::uint64_t(b), scratch, slot, tallies));
        CHECK(balance(tallies[0].light, 0) == 0);
        CHECK(tallies[0].majorant_violations == 0);
        out.emplace_back();
        for (std::int64_t sum : slot.sums.span()) out.back().push_back(double(sum) * 0x1p-20);
    }
    return out;
}

/// Mean over the batches of number `at`, times `scale`.
Mean mean_of(const std::vector<std::vector<double>>& sums, std::size_t at, double scale) {
    const double n = double(sums.size());
    Mean m;
    for (const auto& batch : sums) m.value += batch[at] * scale / n;
    for (const auto& batch : sums) {
        const double d = batch[at] * scale - m.value;
        m.error += d * d;
    }
    m.error = std::sqrt(m.error / (n * (n - 1)));
    return m;
}

void check_even(const char* name, float low, bool local, float g) {
    constexpr int kFew = 64;
    Rig rig = make_patches(low);
    rig.medium.optics[0].phase.g1 = g;
    const CellGrid cells{{5, 3, 2}};
    Floored floored;
    floor_majorants(rig, cells, local, floored);
    const double longest = 1 / (double(floored.near.least_density) * double(rig.medium.sigma));
    const std::vector<std::uint8_t> marks(floored.near.marks.span().begin(),
                                          floored.near.marks.span().end());
    use_cells(rig, cells, floored);
    add_light(rig, diffuse_light(rig.medium, 0));
    // Every cell has its share of the mean path 4V/S; light from all sides has no mean direction.
    const double share = mean_chord(rig) / double(cells.count());
    // The first look at every cell is at the same photons.
    constexpr std::uint64_t kPhotons = 20'000;
    const auto first = cell_sums(rig, kFew, kPhotons, 17);
    for (std::size_t i = 0; i < marks.size(); ++i) {
        if (marks[i] == kCellEmpty) continue;
        const std::string cell = std::string(name) + ", cell " + std::to_string(i);
        const auto measure = [&](std::size_t number) {
            return [&, number](int multiple, std::uint64_t seed) {
                const std::uint64_t photons = kPhotons * std::uint64_t(multiple);
                const auto more = multiple > 1 ? cell_sums(rig, kFew, photons, seed) : first;
                return mean_of(more, 2 * i + number, longest / double(photons));
            };
        };
        check_mean(cell + " flux", share, measure(0));
        check_mean(cell + " cosine", 0, measure(1));
    }
}

}  // namespace

TEST_CASE("cells: the same fluence everywhere in even light, whatever the density") {
    check_even("patches local", 0.01f, true, 0.0f);
    check_even("patches forward", 0.1f, true, 0.85f);
    check_even("patches global", 0.01f, false, 0.3f);
}

TEST_CASE("cells: floors reach what holds medium and what lies beside it, and nothing else") {
    Rig rig = make_patches(0.01f);
    const CellGrid cells{{12, 7, 6}};
    Floored floored;
    floor_majorants(rig, cells, true, floored);
    std::size_t v = 0;
    for (int z = 0; z < 6; ++z)
        for (int y = 0; y < 7; ++y)
            for (int x = 0; x < 12; ++x, ++v) {
                CAPTURE(x);
                const int mark = floored.near.marks[v];
                // Voxel 7 is the last with medium; its footprint ends in the middle of voxel 8.
                CHECK(mark == (x <= 8 ? kCellHolds : x == 9 ? kCellBeside : kCellEmpty));
            }
    // The mean free path is at most a cell's edge wherever a block is not empty.
    const double edge = std::cbrt(2 * 2 * 2.5);
    for (float bound : floored.majorants.tracking.span()) {
        if (bound > 0) CHECK(double(bound) * 0.8 * edge >= 1 - 1e-6);
        if (bound > 0) CHECK(bound >= floored.near.least_density);
    }
}

TEST_CASE("cells: no medium, no floor") {
    Rig rig = make_rig({3, 3, 3}, {3, 3, 3}, 1);
    for (float& value : rig.medium.volume.density.span()) value = 0;
    Floored floored;
    floor_majorants(rig, CellGrid{{2, 2, 2}}, true, floored);
    CHECK(floored.near.marked == 0);
    for (float bound : floored.majorants.tracking.span()) CHECK(bound <= 0);
    CHECK(floored.near.least_density == 1);
}

TEST_CASE("cells: the ledger balances to the last quantum, a million photons into 8 x 4 x 4") {
    Rig rig = make_patches(0.01f);
    set_albedo(rig, {0.9f, 0.99f, 1.0f});
    const CellGrid cells{{8, 4, 4}};
    Floored floored;
    floor_majorants(rig, cells, true, floored);
    use_cells(rig, cells, floored);
    rig.lighting.ground.present = true;
    rig.lighting.ground.z = -3;
    rig.lighting.ground.albedo = 0.5;
    add_light(rig, beam_light(rig.medium, {0.6, 0, -0.8}));
    const TraceTally t = shoot(rig, 1'000'000, 5);
    for (std::size_t c = 0; c < 3; ++c) {
        CHECK(balance(t.light, c) == 0);
        CHECK(balance(t.shadow, c) == 0);
        CHECK(t.light.emitted[c] == 1'000'000 * kPhotonQuanta);
    }
}
