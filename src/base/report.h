// SPDX-License-Identifier: Apache-2.0
// What a run tells about itself: plan, times, energy, errors, counters, digests.
// in: the stages as they finish -> out: plain values; src/io/report_json.h writes them.
// docs/report.md explains each key.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "src/base/digest.h"

namespace pileus {

struct StageTime {
    std::string name;
    double wall_s = 0, cpu_s = 0;
};

/// Fractions of the emitted power, first channel; `standard_error` of each in the same order.
struct EnergyRow {
    std::string light;
    double emitted = 0, top = 0, bottom = 0, sides = 0, absorbed = 0, ground = 0, sky = 0,
           terminated = 0, direct_bottom = 0;
    double top_error = 0, bottom_error = 0, sides_error = 0, absorbed_error = 0;
    std::int64_t balance_quanta = 0;  ///< emitted minus all fates, in integers: always 0
};

struct ReportLeftOut {
    std::string what, why;
};
struct ReportBytes {
    std::string item;
    std::uint64_t bytes = 0;
};

struct Report {
    std::string version, scene, method, isa, hash;
    int threads = 1;
    std::int64_t seed = 0;

    std::vector<std::string> needed;
    std::vector<ReportLeftOut> left_out;
    std::vector<ReportBytes> bytes;
    std::uint64_t total_bytes = 0;
    std::int64_t peak_bytes = 0;  ///< of the whole process

    double total_s = 0, cpu_s = 0;
    std::vector<StageTime> stages;

    std::uint64_t photons = 0, generations = 0, scatterings = 0, tentative = 0, crossings = 0;
    std::uint64_t leaves = 0, collectors = 0, samples = 0;
    double tracing_cpu_s = 0, tracing_wall_s = 0;
    double mean_path_m = 0;  ///< per photon, inside the box
    std::vector<EnergyRow> energy;

    bool has_error = false;
    double mean_relative = 0, rmse_estimate = 0;  ///< over pixels with A > 0.02

    std::vector<std::pair<std::string, std::uint64_t>> counters;
    std::vector<std::pair<std::string, std::string>> digests;  ///< stage -> 16 hex digits
};

}  // namespace pileus
