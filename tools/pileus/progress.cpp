// SPDX-License-Identifier: Apache-2.0
// Writes the progress line, and no more often than a person can tell.
// in: stage names and shares -> out: see progress.h.
// docs/program.md
#include "tools/pileus/progress.h"

#include <cstdio>

namespace pileus {

namespace {

constexpr int kWidth = 40;  // of the line; blanks over it clear any terminal

}  // namespace

void Progress::tell(const char* stage, double share) {
    if (!shown_) return;
    const double held = share >= 0 ? (share <= 1 ? share : 1.0) : 0.0;
    const int percent = int(held * 100);
    if (percent == percent_ && stage_ == stage) return;
    percent_ = percent;
    stage_ = stage;
    std::fprintf(stderr, "\r%-*.*s%4d%%", kWidth - 5, kWidth - 6, stage, percent);
    std::fflush(stderr);
}

void Progress::clear() {
    if (percent_ < 0) return;
    percent_ = -1;
    std::fprintf(stderr, "\r%*s\r", kWidth, "");
    std::fflush(stderr);
}

}  // namespace pileus
