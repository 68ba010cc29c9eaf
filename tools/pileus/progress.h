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

    /// Rewrites the line when the stage or its whole percent has changed. share: 0..1.
    void tell(const char* stage, double share);
    /// Takes the line away, so that other text can follow.
    void clear();

private:
    bool shown_;
    std::string stage_;
    int percent_ = -1;
};

}  // namespace pileus
