// SPDX-License-Identifier: Apache-2.0
// Reader of phase functions that users bring: values at angles, or Legendre moments.
// in: text whose comments run from '#' to the end of the line -> out: checked nodes or moments.
// docs/phase.md, "Files"; docs/formats.md
#pragma once
#include <string>

#include "src/base/buffer.h"
#include "src/base/span.h"

namespace pileus {

constexpr std::uint64_t kMaxPhaseNodes = 65536;
constexpr std::uint64_t kMaxPhaseMoments = 4096;

/// Of a phase function: angles ascend from exactly 0 to exactly 180 degrees, values are finite and
/// not negative, one at least is above 0; in any unit.
struct PhaseNodes {
    Buffer<double> angle_deg, value;
};

/// Lines `angle value`, 2 to kMaxPhaseNodes of them. kBadInput with file:line:column; kLimit: too
/// long a text, or out of memory.
Status read_phase_table(const std::string& path, PhaseNodes& nodes);

/// The same from memory; `name` opens the lines of faults.
Status decode_phase_table(const std::string& name, Span<const char> text, PhaseNodes& nodes);

/// Lines of one number each: Legendre moments from degree 0, whose moment is 1, each in [-1, 1];
/// 1 to kMaxPhaseMoments of them. Faults as read_phase_table's.
Status read_phase_moments(const std::string& path, Buffer<double>& moments);

/// The same from memory.
Status decode_phase_moments(const std::string& name, Span<const char> text,
                            Buffer<double>& moments);

}  // namespace pileus
