// SPDX-License-Identifier: Apache-2.0
// The files that the runs of a study read: their names, and a digest of what they hold.
// in: scenes with settings -> out: digests for the names of runs; clashes of outputs with inputs.
// docs/study.md, "Runs"
#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tools/study/study_file.h"
#include "tools/study/study_runs.h"

namespace pileus {

/// Each file is read once, however many scenes and methods name it.
class StudyFiles {
public:
    /// Digest of a scene's text and of every file that it reads under these settings: a changed
    /// volume, mesh or table makes other pictures. Errors: those of reading the scene and its
    /// files; kBadInput for an animation.
    Status digest_scene(const std::string& scene, const std::vector<std::string>& sets,
                        std::string& hex);

    /// Refuses a study that would write over its own text, its program or what its runs read.
    Status check_outputs(const Study& study, const StudyOptions& options,
                         const std::vector<StudyRun>& runs) const;

private:
    Status digest_file(const std::string& path, std::uint64_t& digest);

    std::map<std::string, std::uint64_t> files_;  ///< path -> digest of its bytes
    std::set<std::string> scenes_;
};

}  // namespace pileus
