// SPDX-License-Identifier: Apache-2.0
// Writes the progress line, and no more often than a person can tell.
// in: stage names and shares -> out: see progress.h.
// docs/program.md
#include "tools/pileus/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace pileus {

namespace {

constexpr int kWidth = 78;  // of the line; blanks over it clear any terminal

}  // namespace

void Progress::tell(const char* stage, double share) {
    if (!shown_) return;
    const double held = share >= 0 ? (share <= 1 ? share : 1.0) : 0.0;
    const int percent = int(held * 100);
    if (percent == percent_ && stage_ == stage) return;
    percent_ = percent;
    stage_ = stage;
    const std::string text = frame_ + stage;
    std::fprintf(stderr, "\r%-*.*s%4d%%", kWidth - 5, kWidth - 6, text.c_str(), percent);
    std::fflush(stderr);
}

void Progress::frames(int done, int count, double seconds) {
    if (!shown_ || count < 2) return;
    frame_ = fmt::format("frame {}/{}  ", std::min(done + 1, count), count);
    if (done > 0 && done < count) frame_ += time_text(seconds / done * (count - done)) + " left  ";
}

std::string time_text(double seconds) {
    // A year is more than any film takes, and fits.
    const auto whole = std::int64_t(std::ceil(std::min(std::max(seconds, 0.0), 3e9)));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    const std::int64_t minutes = (whole + 59) / 60;
    return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

void Progress::clear() {
    if (percent_ < 0) return;
    percent_ = -1;
    std::fprintf(stderr, "\r%*s\r", kWidth, "");
    std::fflush(stderr);
}

}  // namespace pileus
