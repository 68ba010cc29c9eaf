// SPDX-License-Identifier: Apache-2.0
// The step cloud of I3RC phase I by photons: a periodic medium against the consensus.
// in: PILEUS_DATA_DIR/reference, data/i3rc/step -> out: rows of R, T, A; per column T.
// Cahalan et al. 2005, BAMS 86, 1275; docs/methods.md 2, "Periodic media"; docs/testing.md.
#include "src/base/file.h"
#include "tests/support/long_tests.h"
#include "tests/support/trace_harness.h"

using namespace trace_test;

namespace {

constexpr int kColumns = 32;
constexpr double kColumnM = 15.625, kHighM = 250, kThin = 2, kThick = 18;
constexpr double kGate = 0.003;        // of the published consensus, domain means
constexpr double kColumnGate = 0.015;  // root mean square over the columns

Rig make_step(float albedo) {
    const double width = kColumns * kColumnM;
    Rig rig = make_rig({kColumns, 1, 1}, {width, width, kHighM}, kThick / kHighM);
    for (int x = 0; x < kColumns / 2; ++x)
        rig.medium.volume.density[std::size_t(x)] = float(kThin / kThick);
    rig.medium.grid.periodic = rig.medium.grid.constant = true;
    set_albedo(rig, {albedo, albedo, albedo});
    rig.medium.optics[0].phase = {kPhaseHg, 0.85f, 0, 1};
    set_majorants(rig, 1);
    return rig;
}

Light sun_at(const Rig& rig, double zenith_deg) {
    const double turn = zenith_deg * 3.14159265358979323846 / 180;
    return beam_light(rig.medium, {std::sin(turn), 0, -std::cos(turn)});
}

/// Text of a file below the data folder; empty, with a line that says so, where there is none.
std::string read_text(const std::string& name) {
    const char* root = std::getenv("PILEUS_DATA_DIR");
    if (root == nullptr) {
        std::printf("skipped: PILEUS_DATA_DIR is not set\n");
        return {};
    }
    Buffer<char> bytes;
    REQUIRE(read_whole_file(std::string(root) + name, 1 << 20, bytes));
    return std::string(bytes.data(), bytes.size());
}

/// Consensus of one quantity of one experiment.
double consensus(const std::string& table, const std::string& experiment, const char* quantity) {
    const std::size_t row = table.find("step," + experiment + ",");
    REQUIRE(row != std::string::npos);
    const std::size_t key = table.find(std::string(",") + quantity + ",32,", row);
    REQUIRE(key != std::string::npos);
    return std::strtod(table.c_str() + key + std::strlen(quantity) + 5, nullptr);
}

std::uint64_t photons() { return long_tests() ? 20'000'000 : 600'000; }

}  // namespace

TEST_CASE("step cloud: fluxes of the domain agree with the consensus") {
    const std::string table = read_text("/reference/i3rc_step_domain_means.csv");
    if (table.empty()) return;
    const struct {
        const char* name;
        double zenith_deg;
        float albedo;
        bool transmitted, absorbed;
    } cases[] = {{"exp1", 0, 1, true, false},
                 {"exp2", 60, 1, false, false},
                 {"exp4", 60, 0.99f, true, true}};
    for (const auto& c : cases) {
        Rig rig = make_step(c.albedo);
        add_light(rig, sun_at(rig, c.zenith_deg));
        const auto row = [&](const char* quantity, auto fate) {
            const double reference = consensus(table, c.name, quantity);
            check_mean(
                std::string("step cloud ") + c.name + " " + quantity, reference,
                [&](int multiple, std::uint64_t seed) {
                    const TraceTally t = shoot(rig, photons() * std::uint64_t(multiple), seed);
                    CHECK(t.light.sides[0] == 0);
                    CHECK(t.light.terminated[0] == 0);
                    return share_mean(fate(t.light), t);
                },
                kGate * reference);
        };
        row("R", [](const Fates& f) { return f.top[0]; });
        if (c.transmitted) row("T", [](const Fates& f) { return f.bottom[0]; });
        if (c.absorbed) row("A", [](const Fates& f) { return f.absorbed[0]; });
    }
}

TEST_CASE("step cloud: light below each column agrees with the consensus") {
    const std::string text = read_text("/data/i3rc/step/I3RC_cons_res_case1_exp1_T.txt");
    if (text.empty()) return;
    Rig rig = make_step(1);
    Light sun = sun_at(rig, 0);
    sun.photons = 4 * photons();
    add_light(rig, sun);
    // A black ground right below counts what arrives, one cell per column along x.
    rig.lighting.ground.present = true;
    TraceInput in = input_of(rig, 21);
    in.ground.cells = kColumns;
    for (float& n : in.ground.per_metre) n = float(1 / kColumnM);
    TraceScratch scratch;
    PhotonSlot slot;
    std::vector<TraceTally> tallies(1);
    REQUIRE(prepare_trace(in, scratch));
    REQUIRE(slot.sums.resize(slot_stride(in), "slot"));
    REQUIRE(trace_generation(in, 0, scratch, slot, tallies));
    CHECK(balance(tallies[0].light, 0) == 0);

    const char* at = text.c_str();
    double square = 0, mean = 0;
    for (int x = 0; x < kColumns; ++x) {
        char* end = nullptr;
        const double reference = std::strtod(at, &end);
        at = end;
        double arrived = std::exp(x < kColumns / 2 ? -kThin : -kThick);
        for (int y = 0; y < kColumns; ++y)
            arrived += double(slot.sums[std::size_t(y * kColumns + x)]) /
                       double(std::uint64_t{1} << in.deposit.places) * kColumns /
                       double(tallies[0].photons);
        mean += arrived / kColumns;
        square += (arrived / reference - 1) * (arrived / reference - 1) / kColumns;
    }
    std::printf("step cloud exp1: T per column, rms %.2g of the consensus, mean %.6f\n",
                std::sqrt(square), mean);
    // 75 000 photons a column leave a noise of 0.4 %, which the gate takes without loosening.
    CHECK(std::sqrt(square) <= kColumnGate);
}
