// SPDX-License-Identifier: Apache-2.0
// The same bits from every instruction set, number of threads and way of cutting up the work.
// in: one launch done in many ways -> out: equal ledgers and sums; nothing is stored.
// docs/architecture.md, "Determinism": results belong to photons, sums are integers.
#include "src/base/digest.h"
#include "src/methods/collectors/prepare/prepare.h"
#include "tests/support/sky_images.h"
#include "tests/support/trace_harness.h"

using namespace trace_test;

namespace {

/// A coarse lump in which each octant is a collector.
Rig make_lump(const Float3& albedo) {
    Rig rig = make_rig({12, 10, 8}, {120, 100, 80}, 0.05);
    REQUIRE(rig.collector_of_voxel.resize(960, "map"));
    std::size_t v = 0;
    for (int z = 0; z < 8; ++z)
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 12; ++x, ++v) {
                rig.medium.volume.density[v] = float((x * 7 + y * 5 + z * 3) % 11) / 10;
                rig.collector_of_voxel[v] = (x >= 6) + 2 * (y >= 5) + 4 * (z >= 4);
            }
    rig.collectors = 8;
    set_albedo(rig, albedo);
    rig.medium.optics[0].phase.g1 = 0.7f;
    set_majorants(rig, 2);
    rig.lighting.ground.present = true;
    rig.lighting.ground.z = -10;
    rig.lighting.ground.albedo = 0.6;
    add_light(rig, beam_light(rig.medium, {0.48, 0.36, -0.8}));
    add_light(rig, diffuse_light(rig.medium, -1));
    add_light(rig, diffuse_light(rig.medium, 1));
    return rig;
}

std::string digest_of(Span<const std::int64_t> sums, const std::vector<TraceTally>& tallies) {
    Digest d;
    d.integers(sums);
    for (const TraceTally& t : tallies) {
        std::int64_t words[sizeof t / 8];
        std::memcpy(words, &t, sizeof t);
        d.integers({words, sizeof t / 8});
    }
    return d.hex();
}

std::string shoot_digest(Rig& rig, std::uint64_t photons, int generations, bool mapped = false,
                         bool shared = false) {
    for (Light& l : rig.lighting.lights) l.photons = photons;
    TraceInput in = input_of(rig, 42);
    if (mapped) in.ground = make_ground_map(rig.medium, rig.lighting);
    in.shared_sums = shared;
    TraceScratch scratch;
    PhotonSlot slot;
    REQUIRE(prepare_trace(in, scratch));
    REQUIRE(slot.sums.resize(slot_stride(in) * rig.lighting.lights.size(), "sums"));
    std::vector<TraceTally> tallies(rig.lighting.lights.size());
    for (int g = 0; g < generations; ++g)
        REQUIRE(trace_generation(in, std::uint64_t(g), scratch, slot, tallies));
    return digest_of(slot.sums.span(), tallies);
}

/// Photons [0, count) in pieces that end at `ends`, straight through the kernel.
std::string shoot_pieces(const Rig& rig, const std::vector<std::uint32_t>& ends) {
    const Light& light = rig.lighting.lights[0];
    TraceParams k = plain_params(rig, light, make_key(42, light.stream, 0));
    k.mode = rig.deposit.mode;
    k.bands = rig.deposit.bands;
    k.coefficients = rig.deposit.coefficients;
    k.scale = 65536;
    Buffer<std::int64_t> sums;
    REQUIRE(sums.resize(rig.collectors * 3 * std::uint64_t(k.coefficients), "sums"));
    std::vector<TraceTally> tally(1);
    const TraceBuffers b{rig.collector_of_voxel.data(),
                         sums.data(),
                         nullptr,
                         tally.data(),
                         rig.medium.parts.data(),
                         0};
    std::uint32_t begin = 0;
    for (std::uint32_t end : ends) {
        trace_kernel(*rig.kernels, k)(k, b, begin, end);
        begin = end;
    }
    return digest_of(sums.span(), tally);
}

const Float3 kAlbedos[] = {{0.9f, 0.9f, 0.9f}, {0.9f, 0.99f, 1}};

}  // namespace

TEST_CASE("identity: every instruction set passes the power-on test") {
    int tables = 0;
    for (int i = 0; const KernelTable* table = kernel_table_at(i); ++i, ++tables) {
        CAPTURE(table->name);
        CHECK(table->self_test() == expected_self_test());
        CHECK(kernel_table(table->name) == table);
    }
    CHECK(tables >= 1);
    CHECK(kernel_table("no such instruction set") == nullptr);
    CHECK(kernel_table_at(tables) == nullptr);
}

TEST_CASE("identity: every instruction set, every deposit, the same sums") {
    for (const Float3& albedo : kAlbedos)
        for (std::int32_t mode : {kDepositIncident, kDepositOutgoing, kDepositCamera})
            for (int first_order : {0, 1, 2}) {
                if (mode == kDepositCamera && first_order == 1) continue;
                Rig rig = make_lump(albedo);
                rig.deposit.mode = mode;
                rig.deposit.first_order = first_order;
                rig.deposit.axis_degrees = first_order == 0 ? 0 : 5;
                rig.deposit.coefficients = mode == kDepositCamera ? 1
                                                                  : 16 + rig.deposit.axis_degrees +
                                                                        (first_order == 1 ? 1 : 0);
                rig.deposit.camera[1] = -500;
                rig.kernels = kernel_table_at(0);
                const std::string scalar = shoot_digest(rig, 3'000, 1);
                for (int i = 1; const KernelTable* table = kernel_table_at(i); ++i) {
                    CAPTURE(table->name);
                    CAPTURE(mode);
                    rig.kernels = table;
                    CHECK(shoot_digest(rig, 3'000, 1) == scalar);
                }
            }
}

TEST_CASE("identity: cells of their own, every instruction set, number of threads and way to add") {
    for (const Float3& albedo : kAlbedos)
        for (std::int32_t mode : {kDepositIncident, kDepositCosine, kDepositCamera})
            for (int first_order : {0, 2}) {
                Rig rig = make_lump(albedo);
                rig.collectors = 3 * 4 * 5;
                rig.cells = {{3, 4, 5}, 0.05f};
                rig.deposit.mode = mode;
                rig.deposit.first_order = first_order;
                rig.deposit.axis_degrees = mode == kDepositIncident ? 5 : 0;
                rig.deposit.coefficients = mode == kDepositCamera   ? 1
                                           : mode == kDepositCosine ? 2
                                                                    : 21;
                rig.deposit.camera[1] = -500;
                rig.kernels = kernel_table_at(0);
                const std::string scalar = shoot_digest(rig, 3'000, 2, true);
                for (int i = 1; const KernelTable* table = kernel_table_at(i); ++i) {
                    CAPTURE(table->name);
                    CAPTURE(mode);
                    rig.kernels = table;
                    rig.threads = 1;
                    CHECK(shoot_digest(rig, 3'000, 2, true) == scalar);
                    rig.threads = 3;
                    CHECK(shoot_digest(rig, 3'000, 2, true, false) == scalar);
                    CHECK(shoot_digest(rig, 3'000, 2, true, true) == scalar);
                }
            }
}

TEST_CASE("identity: any number of threads") {
    for (const Float3& albedo : kAlbedos) {
        Rig rig = make_lump(albedo);
        const std::string one = shoot_digest(rig, 50'000, 2);
        for (int threads : {2, 3, 8, 16}) {
            rig.threads = threads;
            CHECK(shoot_digest(rig, 50'000, 2) == one);
        }
        // Another seed gives other bits: the digest sees the sums.
        rig.lighting.lights[0].stream += 16;
        CHECK(shoot_digest(rig, 50'000, 2) != one);
    }
}

TEST_CASE("identity: sums of each thread, of all threads and of one, every deposit") {
    for (const Float3& albedo : kAlbedos)
        for (std::int32_t mode : {kDepositIncident, kDepositCamera}) {
            Rig rig = make_lump(albedo);
            rig.deposit.mode = mode;
            if (mode == kDepositCamera) rig.deposit.coefficients = 1;
            rig.deposit.camera[1] = -500;
            rig.threads = 1;
            const std::string one = shoot_digest(rig, 20'000, 2, true);
            for (int i = 0; const KernelTable* table = kernel_table_at(i); ++i) {
                CAPTURE(table->name);
                rig.kernels = table;
                rig.threads = 3;
                CHECK(shoot_digest(rig, 20'000, 2, true, true) == one);
                CHECK(shoot_digest(rig, 20'000, 2, true, false) == one);
            }
        }
}

TEST_CASE("identity: light of a coloured sky map, every instruction set and number of threads") {
    Rig rig = make_lump(kAlbedos[0]);
    const SkyMap map =
        sky_test::sky_map_of(sky_test::rough_sky(12, 7, true), true, rig.medium.extent_m, 33);
    rig.medium.channels = 3;
    rig.lighting.map = map.view;
    rig.lighting.lights.clear();
    add_light(rig, map_light(map));
    rig.kernels = kernel_table_at(0);
    const std::string scalar = shoot_digest(rig, 20'000, 2);
    for (int i = 1; const KernelTable* table = kernel_table_at(i); ++i) {
        CAPTURE(table->name);
        rig.kernels = table;
        for (int threads : {1, 3}) {
            rig.threads = threads;
            CHECK(shoot_digest(rig, 20'000, 2) == scalar);
        }
    }
    // A map turned by a fraction of a texel gives other bits: the digest sees the directions.
    const SkyMap turned =
        sky_test::sky_map_of(sky_test::rough_sky(12, 7, true), true, rig.medium.extent_m, 34);
    rig.lighting.map = turned.view;
    CHECK(shoot_digest(rig, 20'000, 2) != scalar);
}

TEST_CASE("identity: one launch, odd pieces, or one photon at a time") {
    for (const Float3& albedo : kAlbedos) {
        Rig rig = make_lump(albedo);
        std::vector<std::uint32_t> singles;
        for (std::uint32_t i = 1; i <= 2'003; ++i) singles.push_back(i);
        const std::string whole = shoot_pieces(rig, {2'003});
        CHECK(shoot_pieces(rig, {1, 8, 1'001, 1'002, 2'003}) == whole);
        CHECK(shoot_pieces(rig, {0, 17, 17, 2'003}) == whole);
        CHECK(shoot_pieces(rig, singles) == whole);
        CHECK(shoot_pieces(rig, {2'002}) != whole);
    }
}
