// SPDX-License-Identifier: Apache-2.0
// What a run tells about itself: plan, times, energy, errors, counters, digests.
// in: the stages as they finish -> out: plain values; src/io/text/report_json.h writes them.
// docs/report.md explains each key.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

// Digests are texts here, 16 hex digits each: src/base/digest.h makes them.
namespace pileus {

struct StageTime {
    std::string name;
    double wall_s = 0, cpu_s = 0;
};

/// Fractions of the emitted power, first channel; `standard_error` of each in the same order.
struct EnergyRow {
    std::string light;
    double emitted = 0, top = 0, bottom = 0, sides = 0, absorbed = 0, ground = 0, sky = 0,
           terminated = 0, solid = 0, direct_bottom = 0;
    double top_error = 0, bottom_error = 0, sides_error = 0, absorbed_error = 0;
    std::int64_t balance_quanta = 0;  ///< emitted minus all fates, in integers: always 0
};

struct ReportLeftOut {
    std::string what, why;
};
/// An array, and the stages between which it lives.
struct ReportBytes {
    std::string item;
    std::uint64_t bytes = 0;
    std::string first, last;
};
struct ReportStage {
    std::string stage;
    std::uint64_t bytes = 0;  ///< of all arrays that live then
};
/// Why a sum of integers cannot overflow.
struct ReportBound {
    std::string sum;
    double addends = 0, largest = 0;
    int places = 0;
    double worst = 0, allowed = 0;
};
struct ReportLimit {
    std::string name;
    bool known = true;  ///< false: what is needed shows only once the values are read
    std::uint64_t needs = 0, allowed = 0;
};
struct ReportWork {
    bool known = false;
    double photons = 0, scatterings_per_photon = 0, scatterings = 0;
    std::string law;
    std::string of = "photons";  ///< what is counted as photons: they, or paths
};

/// Wall time that a rendering is expected to take, of pictures beside files; 0: nobody asked.
struct ReportForetold {
    double total_s = 0, first_frame_s = 0, next_frame_s = 0;
};

/// Work of one frame in units that no clock decides; 0: the method has none of it.
struct ReportFrameWork {
    int scale = 0, temporal = 0, steps = 0, light_refresh = 0;
    std::int64_t photons = 0;
    std::string light;  ///< `raymarch.light` as it was chosen for this; empty: not by time
};

/// A kind of a sky of many clouds.
struct ReportCloudKind {
    std::string name, scene, method;
    std::uint64_t clouds = 0;  ///< of this kind
};

/// Many clouds, and how the last picture shows them; no kinds: the scene has none.
struct ReportClouds {
    std::vector<ReportCloudKind> kinds;
    std::uint64_t clouds = 0, visible = 0;  ///< in all; of them in the picture
    std::uint64_t marched = 0, shown = 0;   ///< drawn anew; shown by pictures of earlier frames
    std::uint64_t captured = 0, lit = 0;    ///< pictures made anew; kinds in a turn that were lit
    std::uint64_t marched_pixels = 0, captured_pixels = 0;
    double worst_px = 0;  ///< largest error of a far cloud's picture
};

struct Report {
    std::string version, scene, method, isa, hash;
    int threads = 1;
    std::string team;  ///< whose threads: platform/threads.h
    std::int64_t seed = 0;
    int frame = 0, first_frame = 0;      ///< of the animation, and where this run began
    std::string budget, show;            ///< options of the run; empty: none
    std::string budget_used;             ///< makes this picture again whatever ended it
    std::vector<std::string> layers;     ///< of the picture, as scenes name them
    std::vector<std::string> overrides;  ///< texts of its --set options

    std::vector<std::string> needed;
    std::vector<ReportLeftOut> left_out;
    std::vector<ReportBytes> bytes;
    std::vector<ReportStage> stage_bytes;
    bool exact = false;             ///< false: bytes are upper bounds
    std::uint64_t total_bytes = 0;  ///< peak over the stages
    std::vector<ReportBound> bounds;
    std::vector<ReportLimit> limits;
    ReportWork work;
    ReportForetold foretold;
    ReportFrameWork frame_work;
    std::string bias_of, bias, bias_page;
    std::string accumulation, accumulation_why;  ///< who adds to which sums; empty: no such sums
    std::int64_t peak_bytes = 0;                 ///< of the whole process

    double total_s = 0, cpu_s = 0;
    double frame_wall_s = 0, frame_cpu_s = 0;  ///< of the last picture alone, from light to layers
    std::vector<StageTime> stages;

    std::uint64_t photons = 0, generations = 0, scatterings = 0, tentative = 0, crossings = 0;
    std::uint64_t leaves = 0, collectors = 0, samples = 0;
    std::uint64_t paths = 0, samples_per_pixel = 0, shadow_rays = 0;  ///< of method `path`
    std::uint64_t ahead_pixels = 0, ahead_samples = 0;   ///< the first pixels have so many more
    std::uint64_t ring_generations = 0, ring_whole = 0;  ///< an animation's ring; 0: none
    std::uint64_t earlier_paths = 0, earlier_scatterings = 0;  ///< of these, from a state file
    bool interrupted = false;  ///< the user ended the run before its budget
    double tracing_cpu_s = 0, tracing_wall_s = 0;
    double mean_path_m = 0;  ///< per photon, inside the box
    std::vector<EnergyRow> energy;

    ReportClouds clouds;

    std::uint64_t buffer_nodes = 0;  ///< of a swept optical depth, compared with rays; 0: none
    double buffer_rms = 0, buffer_largest = 0, buffer_mean = 0;  ///< of transmittance

    bool has_error = false;
    double mean_relative = 0, rmse_estimate = 0;  ///< over pixels with A > 0.02

    std::uint64_t verified_pixels = 0, verified_samples = 0;  ///< by paths; 0: none
    double verify_bias = 0, verify_standard_error = 0;        ///< shares of the mean by paths
    double verify_relmse = 0;                                 ///< the paths' noise taken off

    std::vector<std::string> warnings;  ///< a line for each: what makes the picture doubtful
    std::vector<std::pair<std::string, std::uint64_t>> counters;
    std::vector<std::pair<std::string, std::uint64_t>> executed;  ///< 0: left out, and truly so
    std::vector<std::pair<std::string, std::string>> digests;     ///< stage -> 16 hex digits
};

}  // namespace pileus
