// SPDX-License-Identifier: Apache-2.0
// One line on a terminal that says which stage is running and how far it is.
// in: stage names and shares, from one thread -> out: stderr, rewritten in place; else nothing.
// docs/program.md
#pragma once
#include <string>

namespace pileus {

class Progress {
public:
    explicit Progress(bool shown) : shown_(shown) {}
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress() { clear(); }

    /// Of a film: `done` of `count` frames are made, in `seconds`; before the first, and where
    /// there is but one, nothing is said of the time that is left.
    void frames(int done, int count, double seconds);
    /// Rewrites the line when the stage or its whole percent has changed. share: 0..1.
    void tell(const char* stage, double share);
    /// Takes the line away, so that other text can follow.
    void clear();

private:
    bool shown_;
    std::string frame_, stage_;
    int percent_ = -1;
};

/// "2 h 05 min", "3 min 20 s", "12 s": rounded up to a whole second, or minute from an hour on.
std::string time_text(double seconds);

}  // namespace pileus
