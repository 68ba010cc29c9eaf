// SPDX-License-Identifier: Apache-2.0
// What readers may hold in memory, so that a small file that unpacks to gigabytes is refused first.
// in: the limits of a run -> out: kLimit before memory is taken.
// docs/program.md, "Limits".
#pragma once
#include "src/base/limits.h"

namespace pileus {

/// Readers of this thread keep to `limits` while it lives; the limits outlive it. Guards nest.
class ReadingLimit {
public:
    explicit ReadingLimit(const Limits& limits);
    ~ReadingLimit();
    ReadingLimit(const ReadingLimit&) = delete;
    ReadingLimit& operator=(const ReadingLimit&) = delete;

private:
    const Limits* before_;
};

/// Counts bytes that a reader of this thread holds while it reads on.
class ReadingHold {
public:
    explicit ReadingHold(std::uint64_t bytes);
    ~ReadingHold();
    ReadingHold(const ReadingHold&) = delete;
    ReadingHold& operator=(const ReadingHold&) = delete;

private:
    std::uint64_t bytes_;
};

/// What may still be taken beside all that is held; where no guard stands, 2^34 bytes in all.
std::uint64_t reading_room();

/// kLimit, with the line of `limits.memory`, where `bytes` more are too many.
Status check_reading(const std::string& where, std::uint64_t bytes);

}  // namespace pileus
