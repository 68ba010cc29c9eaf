// SPDX-License-Identifier: Apache-2.0
// The step cloud of the I3RC intercomparison, column by column, by path and by photons.
// in: PILEUS_DATA_DIR/data/i3rc/step and reference/ -> out: rows, or why it was skipped.
// docs/validation.md; Cahalan et al. 2005, BAMS 86, 1275: phase I, case 1.
#include "tests/shared/published.h"
#include "tests/shared/step_cloud.h"
#include "tests/support/validation_rows.h"

using namespace step_cloud;
using namespace validation;

namespace {

/// Gates of the consensus of many codes: relative, of the domain's mean and of the columns' rms.
struct Gate {
    double domain, columns;
};
constexpr Gate kFluxGate = {0.003, 0.015}, kRadianceGate = {0.01, 0.03};

const char* const kHead =
    "| experiment | quantity | what | consensus | value | standard error | z | detectable bias |\n"
    "|---|---|---|---|---|---|---|---|";

std::vector<double> consensus(const std::string& root, int experiment, const std::string& what) {
    const auto v = published::read_numbers(root + "/data/i3rc/step/I3RC_cons_res_case1_exp" +
                                           std::to_string(experiment) + "_" + what + ".txt");
    REQUIRE(v.size() == std::size_t(kColumns));
    return v;
}

Mean domain_mean(const Columns& columns) {
    Mean m;
    for (const Mean& c : columns) {
        m.value += c.value / kColumns;
        m.error += c.error * c.error / (kColumns * kColumns);
    }
    m.error = std::sqrt(m.error);
    return m;
}

/// Mean square of the columns' relative differences, freed of the noise of the columns.
Mean mean_square(const Columns& columns, const std::vector<double>& reference) {
    Mean m;
    for (std::size_t i = 0; i < kColumns; ++i) {
        const double d = columns[i].value / reference[i] - 1;
        const double s = columns[i].error / reference[i];
        m.value += (d * d - s * s) / kColumns;
        m.error += (4 * d * d * s * s + 2 * s * s * s * s) / (kColumns * kColumns);
    }
    m.error = std::sqrt(m.error);
    return m;
}

/// Share of the arriving light that each column absorbs, by photons: collisions are counted in
/// voxels, and of each 1 - albedo is absorbed.
Columns absorbed_by_photons(const Experiment& e, std::uint64_t photons, std::uint64_t seed) {
    Rig rig = make_step(e);
    rig.collectors = kColumns;
    REQUIRE(rig.collector_of_voxel.resize(rig.medium.volume.density.size(), "columns"));
    for (std::size_t i = 0; i < rig.collector_of_voxel.size(); ++i)
        rig.collector_of_voxel.data()[i] = std::int32_t(i);
    rig.deposit.bands = 1;
    rig.deposit.coefficients = 1;
    const SineCosine zenith = sincos_deg(e.zenith_deg);
    add_light(rig, beam_light(rig.medium, {zenith.sine, 0, -zenith.cosine}));

    constexpr int kParts = 64;
    rig.lighting.lights[0].photons = photons / kParts;
    const TraceInput in = input_of(rig, seed);
    TraceScratch scratch;
    REQUIRE(prepare_trace(in, scratch));
    std::array<double, kColumns> sum{}, square{};
    for (int part = 0; part < kParts; ++part) {
        PhotonSlot slot;
        REQUIRE(slot.sums.resize(slot_stride(in), "slot"));
        std::vector<TraceTally> tallies(1);
        REQUIRE(trace_generation(in, std::uint64_t(part), scratch, slot, tallies));
        for (std::size_t i = 0; i < kColumns; ++i) {
            // Band 0 is 1/sqrt(4 pi) of each collision; a column gets 1/32 of the photons.
            const double collisions = double(slot.sums[i]) * std::sqrt(4 * std::acos(-1.0)) /
                                      double(std::uint64_t{1} << in.deposit.places);
            const double a =
                (1 - e.albedo) * collisions * kColumns / double(rig.lighting.lights[0].photons);
            sum[i] += a / kParts;
            square[i] += a * a / kParts;
        }
    }
    Columns out;
    for (std::size_t i = 0; i < kColumns; ++i)
        out[i] = {sum[i], std::sqrt((square[i] - sum[i] * sum[i]) / (kParts - 1))};
    return out;
}

void check_quantity(const std::string& root, const Experiment& e, const std::string& quantity,
                    Section& section) {
    const std::vector<double> reference = consensus(root, e.number, quantity);
    double mean = 0;
    for (double v : reference) mean += v / kColumns;
    const Gate gate = quantity[0] == 'I' ? kRadianceGate : kFluxGate;
    const auto columns = [&](int multiple, std::uint64_t seed) {
        return quantity == "A"
                   ? absorbed_by_photons(e, samples(64'000, 10'000'000) * std::uint64_t(multiple),
                                         seed)
                   : by_path(e, quantity, samples(2'000, 100'000) * std::uint64_t(multiple), seed);
    };
    const std::string name = text_of("step cloud, experiment %d, %s", e.number, quantity.c_str());
    const std::string cells = text_of("%d | %s", e.number, quantity.c_str());
    Columns c;
    section.check(name, cells + text_of(" | mean, gate %g %%", 100 * gate.domain), mean,
                  gate.domain * mean, [&](int multiple, std::uint64_t seed) {
                      c = columns(multiple, seed);
                      return domain_mean(c);
                  });
    // The square of the columns' difference is what noise can be taken off; its root is shown.
    const Mean square = trace_test::check_mean(
        name + ", columns, square", 0,
        [&](int multiple, std::uint64_t seed) {
            if (multiple > 1) c = columns(multiple, seed);
            return mean_square(c, reference);
        },
        gate.columns * gate.columns);
    const double rms = std::sqrt(std::fmax(square.value, 0));
    section.line(text_of("| %s | columns, rms, gate %g %% | 0 %% | %.2f %% | %.1e | | |",
                         cells.c_str(), 100 * gate.columns, 100 * rms,
                         square.error / (2 * std::fmax(rms, std::sqrt(square.error)))));
}

}  // namespace

TEST_CASE("validation: the step cloud's columns") {
    const std::string root = published::data_folder();
    if (root.empty()) return;
    Section section("step-cloud", kHead);
    for (const published::Row& row :
         published::read_table(root + "/reference/i3rc_step_domain_means.csv"))
        for (const Experiment& e : kExperiments)
            if (row.text("experiment") == "exp" + std::to_string(e.number))
                check_quantity(root, e, row.text("quantity"), section);
}
