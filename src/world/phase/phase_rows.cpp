// SPDX-License-Identifier: Apache-2.0
// The table of phase functions.
// in: one row for each -> out: see src/scene/rows/phase_row.h.
// docs/phase.md; docs/contributing.md, "Add a phase function".
#include "src/scene/rows/phase_row.h"

namespace pileus {

// One row for a phase function: the value of medium.N.phase.type, and the constant of its own file.
#define PILEUS_PHASE_ROWS(ROW)                        \
    ROW("isotropic", isotropic_phase)                 \
    ROW("rayleigh", rayleigh_phase)                   \
    ROW("henyey-greenstein", henyey_greenstein_phase) \
    ROW("cornette-shanks", cornette_shanks_phase)     \
    ROW("two-lobe", two_lobe_phase)                   \
    ROW("hg-draine", hg_draine_phase)                 \
    ROW("cloud", cloud_phase)                         \
    ROW("table", table_phase)                         \
    ROW("moments", moments_phase)

#define PILEUS_ROW(name, row) extern const PhaseRow row;
PILEUS_PHASE_ROWS(PILEUS_ROW)
#undef PILEUS_ROW

namespace {

constexpr NamedPhase kTypes[] = {
#define PILEUS_ROW(name, row) {name, &row},
    PILEUS_PHASE_ROWS(PILEUS_ROW)
#undef PILEUS_ROW
};

constexpr PhaseNames join_names() {
    PhaseNames names{};
    std::size_t at = 0;
    for (const NamedPhase& type : kTypes) {
        if (at > 0) names.text[at++] = '|';
        for (const char* c = type.name; *c != '\0'; ++c) names.text[at++] = *c;
    }
    return names;
}

}  // namespace

constexpr PhaseNames kPhaseNames = join_names();

Span<const NamedPhase> phase_rows() { return {kTypes, sizeof kTypes / sizeof kTypes[0]}; }

const PhaseRow* phase_row_named(const std::string& name) {
    for (const NamedPhase& type : kTypes)
        if (name == type.name) return type.row;
    return nullptr;
}

}  // namespace pileus
