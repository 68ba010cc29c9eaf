// SPDX-License-Identifier: Apache-2.0
// The pictures that a study needs, each as one command line, and what making them cost.
// in: a Study -> out: runs in the order in which they are made, each with a digest of all that
// can change its result or its time. docs/study.md, "Runs"
#pragma once
#include <string>
#include <vector>

#include "tools/study/study_file.h"

namespace pileus {

struct StudyOptions {
    std::string program;     ///< the file to run
    std::string folder;      ///< where everything goes
    std::string references;  ///< folder of the references; empty: references/ below `folder`
    std::string version;     ///< of the program: references made by another are not taken
    std::string isa;         ///< empty: the widest
    int threads = 1;         ///< of each run; runs follow one another
    /// Names with which variables begin that runs do not see: a launcher's, which has not started
    /// them.
    std::vector<std::string> hidden;
    std::vector<std::string> only_scenes, only_methods;  ///< names; empty: all
    /// Told after every run, with the line for it; may be null.
    void (*progress)(void* context, const std::string& line) = nullptr;
    void* context = nullptr;
};

/// One picture. A reference has curve -1, and its half in `repeat`.
struct StudyRun {
    int scene = 0, curve = -1, budget = 0, repeat = 0;
    std::int64_t seed = 0;
    double amount = 0;               ///< of its budget
    std::vector<std::string> words;  ///< behind the program: render SCENE --set ... --seed N
    std::string digest;              ///< 16 hex digits
    std::string image, record;       ///< files; the report lies in the record

    bool is_reference() const { return curve < 0; }
};

/// What a run cost. Times of the process are from its start to its end: reading, preparing,
/// rendering, writing; those of rendering leave the files out.
struct RunRecord {
    bool done = false;
    bool earlier = false;  ///< taken from an earlier study
    std::string fault;     ///< why it is not done; empty: not tried
    double wall_s = 0, cpu_s = 0, render_wall_s = 0, render_cpu_s = 0;
    double peak_bytes = 0;
    double photons = 0, scatterings = 0, samples_per_pixel = 0;
    std::string hash, isa;
};

/// Lists the runs: for each scene its two halves, then seed by seed every budget of every curve,
/// so that a slow minute of the machine meets all of them. Skipped scenes have none. Errors:
/// kBadInput (a name in `only_...` that is not there, an output that is a file which is read),
/// those of reading scenes and their files.
Status list_runs(const Study& study, const StudyOptions& options, std::vector<StudyRun>& runs);

/// Reads what an earlier study left of this run: true where record and picture are whole.
bool read_record(const StudyRun& run, RunRecord& record);

/// Writes the record beside the run's picture, in one step.
Status write_record(const StudyRun& run, const RunRecord& record);

/// Takes times, counts and hash out of a report of `render`. False: no such report.
bool read_report(const std::string& path, RunRecord& record);

}  // namespace pileus
