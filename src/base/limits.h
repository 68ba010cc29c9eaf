// SPDX-License-Identifier: Apache-2.0
// How much a scene may ask for: on by default, one struct that is passed down, each with a switch.
// in: --limit NAME=VALUE -> out: numbers that are compared before anything is allocated.
// docs/program.md, "Limits".
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "src/base/status.h"

namespace pileus {

constexpr int kMaxThreads = 1024;  ///< of a run, a host, an option

enum class LimitId : std::size_t {
    kText,
    kMedia,
    kFile,
    kSide,
    kVoxels,
    kSamples,
    kLeaves,
    kPhotons,
    kGenerations,
    kPixels,
    kFrames,
    kMemory,
    kScatterings,
    kWork,
    kTriangles,
    kCount
};
constexpr std::size_t kLimitCount = std::size_t(LimitId::kCount);

struct LimitRow {
    const char* name;
    std::uint64_t fallback;  ///< when no switch is given
    std::uint64_t most;      ///< that a switch may allow; more cannot be held
    const char* unit;
    const char* what;
};

/// The row of one limit; a constant table.
const LimitRow& limit_row(LimitId id);

/// The limits of one run; the defaults of the table at first.
struct Limits {
    Limits();
    std::uint64_t operator[](LimitId id) const { return value[std::size_t(id)]; }
    std::uint64_t& operator[](LimitId id) { return value[std::size_t(id)]; }
    std::array<std::uint64_t, kLimitCount> value;
};

/// kLimit with the line `where: limits.NAME: needs X, allowed: at most Y (--limit NAME=...)` when
/// `needed` is more than the limit; the line ends otherwise where no switch can raise it.
Status check_limit(const Limits& limits, LimitId id, std::uint64_t needed,
                   const std::string& where);

/// Takes "NAME=VALUE": a whole number, with k M G T (powers of 1000) or Ki Mi Gi Ti behind it.
/// kBadInput: no such limit, no number, or more than the row's `most`.
Status set_limit(const std::string& text, Limits& limits);

/// One line a limit: name, default, most, what it bounds; for --help and docs/program.md.
std::string describe_limits();

}  // namespace pileus
