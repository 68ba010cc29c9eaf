// SPDX-License-Identifier: Apache-2.0
// What a run tells about itself: its plan, times, counts, errors, digests.
// in: the stages as they finish -> out: plain values; report_json.h writes them.
// docs/report.md explains each key.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src/plan/frame_work.h"
#include "src/plan/plan.h"

// Digests are texts here, 16 hex digits each: src/base/digest.h makes them.
namespace pileus {

/// Numbers under names, in the order of the report. The names are literals, so that counting takes
/// no memory but the row's.
using Counts = std::vector<std::pair<std::string_view, std::uint64_t>>;

/// Stage -> 16 hex digits.
using Digests = std::vector<std::pair<std::string, std::string>>;

/// What a run was asked for, and what it runs on.
struct RunHead {
    std::string version, scene, method, isa;
    int threads = 1;
    int ranks = 1;     ///< of MPI, each with so many threads
    std::string team;  ///< whose threads: platform/threads.h
    std::int64_t seed = 0;
    int first_frame = 0;                 ///< of the animation, where this run began
    std::string budget, show;            ///< options of the run; empty: none
    std::vector<std::string> layers;     ///< of the picture, as scenes name them
    std::vector<std::string> overrides;  ///< texts of its --set options
};

/// Which picture it is, and what makes it again.
struct PictureHead {
    std::string hash;
    int frame = 0;             ///< of the animation
    std::string budget_used;   ///< makes this picture again whatever ended it
    bool interrupted = false;  ///< the user ended the run before its budget
    FrameWork frame_work;      ///< 0: the method has none of it
    std::string light_rule;    ///< `raymarch.light` as it was chosen for this; empty: not by time
};

struct StageTime {
    std::string name;
    double wall_s = 0, cpu_s = 0;
};

/// What clocks and the process tell: no two runs are alike in these.
struct Clocks {
    double total_s = 0, cpu_s = 0;
    double frame_wall_s = 0, frame_cpu_s = 0;  ///< of the last picture alone, from light to layers
    double tracing_wall_s = 0, tracing_cpu_s = 0;
    std::vector<StageTime> stages;
    std::int64_t peak_bytes = 0;  ///< of the whole process
};

/// Of photons or of paths.
struct EventCounts {
    std::uint64_t scatterings = 0, tentative = 0, crossings = 0;
};

/// One standard error of some of the shares below.
struct EnergyErrors {
    double top = 0, bottom = 0, sides = 0, absorbed = 0;
};

/// Fractions of the emitted power, first channel.
struct EnergyRow {
    std::string light;
    double emitted = 0, top = 0, bottom = 0, sides = 0, absorbed = 0, ground = 0, sky = 0,
           terminated = 0, solid = 0, direct_bottom = 0;
    EnergyErrors error;
    std::int64_t balance_quanta = 0;  ///< emitted minus all fates, in integers: always 0
};

struct PhotonCounts {
    std::uint64_t traced = 0, generations = 0;
    std::uint64_t ring_generations = 0, ring_whole = 0;  ///< an animation's ring; 0: none
    double mean_path_m = 0;                              ///< per photon, inside the box
    std::vector<EnergyRow> energy;                       ///< one for each light
};

/// What method `collectors` prepared.
struct CollectorCounts {
    std::uint64_t samples = 0, leaves = 0, collectors = 0;
};

/// Of method `path`.
struct PathCounts {
    std::uint64_t traced = 0, samples_per_pixel = 0, shadow_rays = 0;
    std::uint64_t ahead_pixels = 0, ahead_samples = 0;   ///< the first pixels have so many more
    std::uint64_t earlier = 0, earlier_scatterings = 0;  ///< of these, from a state file
};

/// How far a swept optical depth of the sun is from that of rays, over a sparse set of its nodes.
struct SweepCheck {
    std::uint64_t nodes = 0;      ///< compared; 0: none
    double rms = 0, largest = 0;  ///< of the transmittance exp(-depth)
    double mean = 0;              ///< the same, ours minus that of rays: above 0 is too bright
};

/// Light by discrete ordinates; of several colours the worst.
struct OrdinateFigures {
    std::uint64_t nodes = 0;  ///< 0: none
    int iterations = 0;
    double residual = 0;    ///< change of the mean radiance over its norm, of the last iteration
    double node_depth = 0;  ///< largest optical depth of a node's shortest edge that counts
};

struct ErrorFigures {
    bool known = false;
    double mean_relative = 0, rmse_estimate = 0;  ///< over pixels with A > 0.02
    std::string of;                               ///< whose noise they are, or why there are none
};

/// The picture against paths through some of its pixels; no pixels: none were traced.
struct VerifyFigures {
    std::uint64_t pixels = 0, samples = 0;
    double bias = 0, standard_error = 0;  ///< shares of the mean by paths
    double relmse = 0;                    ///< the paths' noise taken off
    bool has_errors = false;              ///< the picture has a layer of them
    double noise = 0;                     ///< what of `relmse` is noise by that layer
    double bias_rms = 0;                  ///< root of what is not
    double within[2] = {};                ///< share of numbers within one error, within two
};

/// A kind of a sky of many clouds.
struct CloudKindCount {
    std::string name, scene, method;
    std::uint64_t clouds = 0;  ///< of this kind
};

/// Many clouds, and how the last picture shows them; no kinds and no layers: the scene has none.
struct CloudCounts {
    std::vector<CloudKindCount> kinds, layers;
    std::vector<std::string> notes;         ///< what was assumed of a report of the weather
    std::uint64_t clouds = 0, visible = 0;  ///< in all; of them in the picture
    std::uint64_t marched = 0, shown = 0;   ///< drawn anew; shown by pictures of earlier frames
    std::uint64_t captured = 0, lit = 0;    ///< pictures made anew; kinds in a turn that were lit
    std::uint64_t marched_pixels = 0, captured_pixels = 0;
    double worst_px = 0;  ///< largest error of a far cloud's picture
};

struct Report : RunHead, PictureHead {
    Plan plan;  ///< as it was when all but light was made
    Clocks clocks;
    EventCounts events;
    PhotonCounts photons;
    CollectorCounts prepared;
    PathCounts paths;
    SweepCheck sweep;
    OrdinateFigures ordinates;
    ErrorFigures errors;
    VerifyFigures verify;
    CloudCounts clouds;

    std::vector<std::string> warnings;  ///< a line for each: what makes the picture doubtful
    Counts counters;
    Counts executed;  ///< 0: left out, and truly so
    Digests digests;
};

}  // namespace pileus
