// SPDX-License-Identifier: Apache-2.0
// Makes the pictures of a study that are not there yet, one after the other.
// in: runs -> out: what each cost, its picture on the disk.
// docs/study.md, "Runs"
#pragma once
#include <vector>

#include "platform/process.h"
#include "tools/study/study_runs.h"

namespace pileus {

/// Fills `records`, one for each run: from an earlier study, or by running the program. A run that
/// fails keeps its fault, and the next one follows. `stopped`: an interrupt came; what is done
/// stays done. Errors: kIo where a record cannot be written.
Status execute_runs(const Study& study, const StudyOptions& options,
                    const std::vector<StudyRun>& runs, const InterruptHold& hold,
                    std::vector<RunRecord>& records, bool& stopped);

/// Seconds that the runs still missing will take, foretold from those that are done: the same
/// curve and scene at the nearest budget, in proportion; else the curve elsewhere; else the mean.
/// References count too.
double remaining_seconds(const std::vector<StudyRun>& runs, const std::vector<RunRecord>& records);

}  // namespace pileus
