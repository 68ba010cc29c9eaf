// SPDX-License-Identifier: Apache-2.0
// Threads of our own, which sleep between loops. Who comes late to a loop is not waited for.
// in: a count and a body -> out: see team.h.
// docs/performance.md, "Waiting"
#pragma once
#include <semaphore.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "platform/team/team.h"

namespace pileus {

/// Has no threads until a loop asks for some, and at most as many as the largest loop wanted. Each
/// sleeps on a semaphore of its own; who wakes wakes two more, so that a thousand are awake after
/// ten wake-ups in a row, and one that is held up holds up no other.
class OwnTeam {
public:
    OwnTeam();
    ~OwnTeam();
    OwnTeam(const OwnTeam&) = delete;
    OwnTeam& operator=(const OwnTeam&) = delete;

    /// Whether there are so many threads besides the caller afterwards. Fewer do the work as well.
    bool grow(std::uint32_t count);
    void run(std::uint32_t count, TeamBody body, void* data);

private:
    struct Member;

    void serve(Member& member);
    bool join(std::uint32_t& index);
    void leave();
    void call_two();

    std::vector<std::unique_ptr<Member>> members_;
    // The loop, written while no member is within it.
    TeamBody body_ = nullptr;
    void* data_ = nullptr;
    std::uint32_t most_ = 0;            ///< members that may join it
    std::atomic<std::uint32_t> next_;   ///< the next member to be called
    std::atomic<std::uint32_t> gate_;   ///< who may still join, who is within; see team_own.cpp
    std::atomic<bool> closing_{false};  ///< all members are to end
    sem_t ended_;                       ///< the last member has left a loop that was closed
};

}  // namespace pileus
