// SPDX-License-Identifier: Apache-2.0
// Keys of a medium's phase function: its type; the rest comes from the rows of the types.
// in: rows of phase_row.h -> out: rows of keys.
// docs/scene.md; docs/phase.md.
#include "src/scene/keys/all_keys.h"
#include "src/scene/rows/phase_row.h"

namespace pileus {
namespace {

constexpr KeyRow kType{"medium.N.phase.type",
                       field<&MediumSettings::optics, &MediumOptics::phase, &PhaseSettings::type>,
                       one_of(kPhaseNames.text),
                       "",
                       "phase function; a medium without `phase` scatters alike in all directions",
                       kRequired};

}  // namespace

std::vector<const KeyRow*> phase_keys() {
    std::vector<const KeyRow*> rows{&kType};
    for (const NamedPhase& type : phase_rows())
        for (const KeyRow& key : type.row->keys) {
            bool known = false;
            for (const KeyRow* row : rows) known |= std::string_view(row->path) == key.path;
            if (!known) rows.push_back(&key);
        }
    return rows;
}

}  // namespace pileus
