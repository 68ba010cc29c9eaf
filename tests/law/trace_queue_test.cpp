// SPDX-License-Identifier: Apache-2.0
// What makes tracing fast must not change its law: packed lanes, leaps, draws that serve twice.
// in: lanes, words and small clouds -> out: the same as without, or the exponential law.
// docs/methods.md 3, "Queues".
#include "kernels_cpu/core/pack.h"
#include "kernels_cpu/media/walk.h"
#include "src/world/majorant/majorant.h"
#include "tests/support/trace_harness.h"
#include "tests/support/widths.h"

using namespace trace_test;

namespace {

template <int W>
void check_pack() {
    for (std::uint32_t set = 0; set<(1u << W); set += W> 8 ? 7 : 1) {
        std::int32_t packed[2 * W] = {};
        pack(packed, iota<I<W>>() + 100, set);
        int at = 0;
        for (int i = 0; i < W; ++i)
            if ((set >> i) & 1u) CHECK(packed[at++] == 100 + i);
        CHECK(count_bits(set) == at);
    }
}

/// Three lumps far apart in air, each voxel a collector of its own octant.
Rig make_lumps() {
    Rig rig = make_rig({40, 36, 28}, {400, 360, 280}, 0.05);
    REQUIRE(rig.collector_of_voxel.resize(40 * 36 * 28, "map"));
    std::size_t v = 0;
    for (int z = 0; z < 28; ++z)
        for (int y = 0; y < 36; ++y)
            for (int x = 0; x < 40; ++x, ++v) {
                const bool lump = (x < 6 && y < 5) || (x > 30 && z > 22) || (y == 20 && z == 9);
                rig.medium.volume.density[v] = lump ? float((x + y + z) % 5) / 4 : 0.0f;
                rig.collector_of_voxel[v] = (x >= 20) + 2 * (y >= 18) + 4 * (z >= 14);
            }
    rig.collectors = 8;
    rig.medium.optics[0].phase.g1 = 0.5f;
    add_light(rig, diffuse_light(rig.medium, 0));
    set_majorants(rig, 2);
    return rig;
}

void mark_empties(Rig& rig) {
    int counts[3];
    block_counts(rig.medium.grid, rig.block, counts);
    mark_empty_blocks(rig.majorants.span(), counts, 1);
}

}  // namespace

TEST_CASE("law: packed lanes lie side by side in their order") { PILEUS_EACH_WIDTH(check_pack); }

TEST_CASE("law: leaps over empty blocks change crossings and nothing else") {
    Rig rig = make_lumps();
    const TraceTally plain = shoot(rig, 60'000, 5);
    mark_empties(rig);
    const TraceTally leaps = shoot(rig, 60'000, 5);
    CHECK(leaps.crossings * 2 < plain.crossings);
    CHECK(leaps.majorant_violations == 0);
    CHECK(balance(leaps.light, 0) == 0);
    // Positions are rounded elsewhere, so that one photon in many takes another way. Were a lump
    // leapt over, a third of the light would be missing.
    const auto close = [](std::int64_t a, std::int64_t b, double part) {
        CHECK(std::fabs(double(a) - double(b)) <= part * double(b));
    };
    close(leaps.scatterings, plain.scatterings, 0.01);
    close(leaps.tentative, plain.tentative, 0.01);
    close(leaps.path, plain.path, 0.01);
    CHECK(plain.scatterings > 10'000);
}

TEST_CASE("law: leaps give the same bits at every width") {
    Rig rig = make_lumps();
    mark_empties(rig);
    rig.kernels = kernel_table_at(0);
    const TraceTally scalar = shoot(rig, 5'003, 6);
    for (int i = 1; const KernelTable* table = kernel_table_at(i); ++i) {
        rig.kernels = table;
        const TraceTally other = shoot(rig, 5'003, 6);
        CHECK(std::memcmp(&scalar, &other, sizeof other) == 0);
    }
}

TEST_CASE("law: the draw that refuses a collision is the next free flight") {
    for (float real : {0.0f, 0.25f, 0.9f, 0.999f}) {
        // Every word of a fine comb that refuses: their flights have mean 1 and variance 1.
        double n = 0, sum = 0, square = 0;
        for (std::uint64_t i = 0; i < (1u << 20); ++i) {
            const std::uint32_t word = std::uint32_t(i) * 4096u + 2048u;
            if (!(uniform(word) >= real)) continue;
            const double tau = double(next_flight(word, real, true, [] { return 0x80000000u; }));
            CHECK_MESSAGE(tau > 0, word);
            n += 1, sum += tau, square += tau * tau;
        }
        // A comb of n words misses the mean by 1/(2n), and the second moment by ln(n)^2/n.
        const double off = std::log(n) * std::log(n) / n;
        CHECK(std::fabs(sum / n - 1) < off);
        CHECK(std::fabs(square / n - 2) < 4 * off);
    }
    // The last words of all go on for 32 more bits.
    CHECK(next_flight(0xffffffffu, 0.0f, true, [] { return 0xffffffffu; }) > 22.0f);
    CHECK(next_flight(0xffffffffu, 0.0f, true, [] { return 0u; }) > 40.0f);
    CHECK(next_flight(0xffffffffu, 0.0f, true, [] { return 0u; }) < 50.0f);
    CHECK(next_flight(0u, 0.0f, true, [] { return 0u; }) > 0.0f);
}
