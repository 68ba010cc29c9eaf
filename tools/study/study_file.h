// SPDX-License-Identifier: Apache-2.0
// A study as a user wrote it, after checking: scenes x methods x settings x budgets x seeds.
// in: untrusted TOML -> out: plain values, or every fault with its place.
// docs/study.md, "The file"
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "src/base/status.h"

namespace pileus {

struct StudyScene {
    std::string name, title;
    std::string file;  ///< relative to the working directory, or absolute
    std::vector<std::string> sets;
    std::string reference_budget;
    std::string skipped;  ///< why it cannot run here; empty: it can
};

/// One line in the plots: a method with one of its settings.
struct StudyCurve {
    std::string name, title;
    std::vector<std::string> sets;
    std::vector<std::string> budgets;  ///< as behind --budget, ascending
    std::vector<std::string> scenes;   ///< names; empty: all
};

struct StudyReference {
    std::vector<std::string> sets;
    std::string budget;  ///< of each of the two halves
    std::int64_t first_seed = 1'000'001;
};

struct Study {
    std::string file, title;
    int seeds = 3;
    std::int64_t first_seed = 1;
    std::array<double, 2> targets{0.01, 0.001};  ///< relMSE
    StudyReference reference;
    std::vector<StudyScene> scenes;
    std::vector<StudyCurve> curves;
};

/// Reads a study and all the scenes it names, with every method's settings. A scene whose data
/// needs PILEUS_DATA_DIR is marked as skipped where that is not set. Errors: kBadInput with one
/// line per fault; kLimit for more than 1 MiB of text; kIo when reading fails half way.
Status read_study_file(const std::string& path, Study& out);

/// The same for text in memory; `name` stands for the file in messages, `directory` is where the
/// scenes' paths start. Does not open the scenes.
Status read_study_text(const std::string& text, const std::string& name,
                       const std::string& directory, Study& out);

/// The amount of a budget, "photons=1e6" -> 1e6; `kind` gets what stands before. False: malformed.
bool split_budget(const std::string& text, std::string& kind, double& amount);

/// The tables of docs/study.md as Markdown.
std::string describe_study_keys_markdown();

}  // namespace pileus
