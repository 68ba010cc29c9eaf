// SPDX-License-Identifier: Apache-2.0
// The phase functions that a scene may name: their keys, and how the kernels' numbers come of them.
// in: the table in src/world/phase/phase_rows.cpp -> out: rows for keys, checks and loading.
// docs/phase.md; docs/contributing.md, "Add a phase function".
#pragma once
#include "src/base/span.h"
#include "src/base/status.h"
#include "src/scene/keys/key_row.h"

namespace pileus {

struct PhaseParams;
struct PhaseStore;

/// What a scene says of one phase function, apart from its name; each stands in a file of its own.
struct PhaseRow {
    /// Those without a default are required. Rows may share a path: such keys are the same but for
    /// their meaning.
    Span<const KeyRow> keys;
    /// Fills `params`, and `store` where they point into a table. Keys have passed their checks;
    /// numbers may be at either end of their range. Errors: those of readers.
    Status (*make)(const std::string& directory, const PhaseSettings& settings, PhaseStore& store,
                   PhaseParams& params);
    /// Either of the two `keys` is enough: the second is another way to say the first.
    bool one_is_enough = false;
};

/// A row of the table: the value of medium.N.phase.type.
struct NamedPhase {
    const char* name;
    const PhaseRow* row;
};

/// All, in the order of messages; null where a name is none.
Span<const NamedPhase> phase_rows();
const PhaseRow* phase_row_named(const std::string& name);

/// All names, parted by '|': in constant memory, for rows of keys point to it.
struct PhaseNames {
    char text[1024];
};
extern const PhaseNames kPhaseNames;

/// A number of a phase function and its key, all that the row of the key is made from.
struct PhaseNumber {
    const char* path;  ///< "medium.N.phase.g"
    Allowed allowed;
    const char* unit;
    const char* help;
    double without = 0;  ///< what it is in a struct that does not set it

    constexpr const char* name() const { return path + sizeof "medium.N.phase"; }
};

inline double number_in(const PhaseSettings& settings, const PhaseNumber& number) {
    const auto found = settings.numbers.find(number.name());
    return found == settings.numbers.end() ? number.without : found->second;
}

/// The field of a number, and the row of a key that is required.
template <const PhaseNumber& kNumber>
constexpr KeyField phase_field{
    KeyKind::kNumber,
    [](const KeySource& s) { return node_of(number_in(s.medium.optics.phase, kNumber)); },
    [](const KeyTarget& t, const Node& n) {
        t.medium.optics.phase.numbers[kNumber.name()] = number_of(n);
    }};
template <const PhaseNumber& kNumber>
constexpr KeyRow phase_key{kNumber.path, phase_field<kNumber>, kNumber.allowed,
                           kNumber.unit, kNumber.help,         kNoNote};

template <std::size_t kCount>
constexpr Span<const KeyRow> keys_of(const KeyRow (&rows)[kCount]) {
    return {rows, kCount};
}

}  // namespace pileus
