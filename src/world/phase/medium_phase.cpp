// SPDX-License-Identifier: Apache-2.0
// See medium_phase.h.
// in: settings -> out: parameters, tables.
// docs/phase.md.
#include "src/world/phase/medium_phase.h"

#include "src/base/printable.h"
#include "src/scene/rows/phase_row.h"

namespace pileus {

Status load_phase(const std::string& directory, const PhaseSettings& phase, PhaseStore& store,
                  PhaseParams& params) {
    params = {};
    const PhaseRow* row = phase_row_named(phase.type);
    if (row == nullptr)
        return Status::bad_input("phase.type: unknown value, " + printable(phase.type));
    return row->make(directory, phase, store, params);
}

}  // namespace pileus
