// SPDX-License-Identifier: Apache-2.0
// Photon numbers around 2^32, none, one and two photons; free flights at the ends of their range.
// in: generations far along a stream -> out: exact ledgers and sums.
// The index's high half is part of the key: streams differ across 2^32.
#include "kernels_cpu/photons/trace_start.h"
#include "tests/support/trace_harness.h"

using namespace trace_test;

namespace {

bool same_tally(const TraceTally& a, const TraceTally& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

TraceTally run_kernel(const Rig& rig, const TraceParams& k, std::uint32_t begin,
                      std::uint32_t end) {
    TraceTally tally{};
    const TraceBuffers b{nullptr, nullptr, nullptr, &tally, nullptr, 0};
    rig.kernels->trace(k, b, begin, end);
    return tally;
}

TraceTally generation_of(Rig& rig, std::uint64_t photons, std::uint64_t generation,
                         std::uint64_t seed) {
    rig.lighting.lights[0].photons = photons;
    const TraceInput in = input_of(rig, seed);
    TraceScratch scratch;
    PhotonSlot slot;
    REQUIRE(prepare_trace(in, scratch));
    std::vector<TraceTally> tallies(1);
    REQUIRE(trace_generation(in, generation, scratch, slot, tallies));
    CHECK(slot.generations == 1);
    return tallies[0];
}

}  // namespace

TEST_CASE("photon index: a generation across 2^32 is two launches with two keys") {
    Rig rig = make_slab(2, 0.9f, 0.75f);
    add_light(rig, beam_light(rig.medium, {0, 0, -1}));
    constexpr std::uint64_t photons = 100'003, generation = 42'948, seed = 9;
    constexpr std::uint64_t first = photons * generation, border = std::uint64_t{1} << 32;
    static_assert(first < border && first + photons > border, "the generation spans 2^32");
    const TraceTally whole = generation_of(rig, photons, generation, seed);
    CHECK(whole.photons == std::int64_t(photons));
    CHECK(balance(whole.light, 0) == 0);

    // By hand: the slab has no structure across, so that the starting points do not matter.
    const Light& light = rig.lighting.lights[0];
    TraceParams k = plain_params(rig, light, make_key(seed, light.stream, 0));
    k.first_photon = std::uint32_t(first);
    TraceTally sum = run_kernel(rig, k, 0, std::uint32_t(border - first));
    k.key = make_key(seed, light.stream, 1);
    k.first_photon = 0;
    add_tally(run_kernel(rig, k, 0, std::uint32_t(first + photons - border)), sum);
    // Only photons that start within a few thicknesses of an edge can tell the two apart.
    const std::int64_t edge = whole.light.sides[0] + sum.light.sides[0];
    CHECK(edge <= 10 * kPhotonQuanta);
    CHECK(std::llabs(whole.light.top[0] - sum.light.top[0]) <= edge);
    CHECK(std::llabs(whole.light.bottom[0] - sum.light.bottom[0]) <= edge);
    CHECK(std::llabs(whole.light.absorbed[0] - sum.light.absorbed[0]) <= edge);
}

TEST_CASE("photon index: photons i and i + 2^32 have random numbers of their own") {
    Rig rig = make_slab(2, 0.9f, 0.75f);
    add_light(rig, beam_light(rig.medium, {0, 0, -1}));
    const Light& light = rig.lighting.lights[0];
    TraceParams low = plain_params(rig, light, make_key(9, light.stream, 0));
    TraceParams high = plain_params(rig, light, make_key(9, light.stream, 1));
    low.first_photon = high.first_photon = 0xfffffff0u;
    const TraceTally a = run_kernel(rig, low, 0, 16), b = run_kernel(rig, high, 0, 16);
    CHECK(a.path != b.path);  // 16 sums of continuous lengths: equal only if the streams are
    // The same numbers again give the same bits.
    CHECK(same_tally(a, run_kernel(rig, low, 0, 16)));
}

TEST_CASE("photon index: none, one and two photons") {
    Rig rig = make_slab(2, 0.9f, 0.75f);
    add_light(rig, diffuse_light(rig.medium, 0));
    const TraceTally none = generation_of(rig, 0, 7, 1);
    CHECK(same_tally(none, TraceTally{}));
    const TraceTally one = generation_of(rig, 1, 0, 1), next = generation_of(rig, 1, 1, 1);
    CHECK(one.photons == 1);
    CHECK(one.light.emitted[0] == kPhotonQuanta);
    CHECK(balance(one.light, 0) == 0);
    CHECK(!same_tally(one, next));
    const TraceTally two = generation_of(rig, 2, 0, 1);
    CHECK(two.photons == 2);
    CHECK(balance(two.light, 0) == 0);
}

TEST_CASE("photon index: generations beyond 2^32 photons keep the mean") {
    Rig rig = make_slab(2, 0.9f, 0.75f);
    add_light(rig, beam_light(rig.medium, {0, 0, -1}));
    // 5e6 generations of 100 003 photons: the index has 39 bits.
    const auto from = [&](std::uint64_t start) {
        return [&rig, start](int multiple, std::uint64_t seed) {
            TraceTally sum{};
            for (int i = 0; i < 4 * multiple; ++i)
                add_tally(generation_of(rig, 100'003, start + std::uint64_t(i), seed), sum);
            return share_mean(sum.light.top[0], sum);
        };
    };
    // Half a unit of the reference's last digit is its own error.
    check_mean("R, generation 42 946 on", 0.09739, from(42'946), 5e-6);
    check_mean("R, generation 5 000 000 on", 0.09739, from(5'000'000), 5e-6);
}

TEST_CASE("free flight: reaches past 40 optical depths, never 0 and never infinite") {
    float longest = 0, shortest = 1e30f;
    for (std::uint32_t word = 0; word < 256; ++word)
        for (std::uint32_t more : {0u, 1u << 8, 0x80000000u, 0xffffffffu}) {
            const float tau = free_flight(word, more);
            CHECK(tau >= 16.6355f);
            CHECK(tau < 45.0f);
            longest = std::max(longest, tau);
        }
    CHECK(longest > 40.0f);
    for (std::uint32_t word : {0xffffffffu, 0xffffff00u, 0xfffffe00u, 0x100u, 0x1ffu})
        shortest = std::min(shortest, free_flight(word, 0u));
    CHECK(shortest > 0.0f);
    CHECK(shortest < 1e-7f);
}

TEST_CASE("free flight: the tail beyond 16.6 optical depths is exponential") {
    // All words of the tail, 2^-24 of the whole, stratified: 256 words times 1024 values of `more`.
    constexpr int kMore = 1024;
    const double depths[] = {17, 18, 20, 22, 25};
    for (double depth : depths) {
        int beyond = 0;
        for (std::uint32_t word = 0; word < 256; ++word)
            for (std::uint32_t i = 0; i < kMore; ++i)
                beyond += double(free_flight(word, (i << 22) + (1u << 21))) > depth ? 1 : 0;
        const double p = beyond * 0x1p-24 / (256.0 * kMore), exact = std::exp(-depth);
        std::printf("P(tau > %g) = %.6g ref %.6g\n", depth, p, exact);
        // Strata place the border to within one of 2^18 of them.
        CHECK(std::fabs(p - exact) <= 0x1p-24 * 0x1p-18 + 1e-6 * exact);
    }
}
