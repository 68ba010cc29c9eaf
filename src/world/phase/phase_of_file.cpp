// SPDX-License-Identifier: Apache-2.0
// The phase functions table and moments: what a file holds.
// in: the path of a file -> out: a table.
// docs/phase.md, "Files".
#include "src/scene/read_scene.h"
#include "src/scene/rows/phase_row.h"
#include "src/world/phase/phase_table.h"

namespace pileus {
namespace {

constexpr KeyRow kKeys[] = {
    {"medium.N.phase.file",
     field<&MediumSettings::optics, &MediumOptics::phase, &PhaseSettings::file>, any(), "",
     "path of a table of angles and values, or of Legendre moments, relative to the scene "
     "file; required by both",
     kNoNote}};

Status make_table(const std::string& directory, const PhaseSettings& settings, PhaseStore& store,
                  PhaseParams& params) {
    const std::string path = scene_path(directory, settings.file);
    PhaseNodes nodes;
    PILEUS_TRY(read_phase_table(path, nodes));
    PILEUS_TRY(make_phase_table(path, nodes, store));
    params = store.params();
    return Status::ok();
}

Status make_moments(const std::string& directory, const PhaseSettings& settings, PhaseStore& store,
                    PhaseParams& params) {
    const std::string path = scene_path(directory, settings.file);
    Buffer<double> moments;
    double clipped = 0;
    PILEUS_TRY(read_phase_moments(path, moments));
    PILEUS_TRY(make_phase_from_moments(path, moments.span(), store, clipped));
    if (clipped > kMaxClipped)
        return Status::bad_input(path + ": moments: their sum is negative over " +
                                 std::to_string(clipped) +
                                 " of the light, allowed: at most 0.01; more moments, or a table");
    params = store.params();
    return Status::ok();
}

}  // namespace

extern const PhaseRow table_phase{keys_of(kKeys), make_table};
extern const PhaseRow moments_phase{keys_of(kKeys), make_moments};

}  // namespace pileus
