// SPDX-License-Identifier: Apache-2.0
// See team_own.h.
#include "platform/team/team_own.h"

#include <cerrno>
#include <thread>

#include "platform/team/no_signals.h"

namespace pileus {
namespace {

// The gate of a loop, in one word that every machine changes at once: members within it, those that
// may still join, and whether the caller has closed it.
constexpr std::uint32_t kWithin = 1;
constexpr std::uint32_t kFree = 1u << 16;
constexpr std::uint32_t kClosed = 1u << 31;
constexpr std::uint32_t kMaxMembers = (1u << 15) - 1;

std::uint32_t members_within(std::uint32_t gate) { return gate % kFree; }
std::uint32_t members_free(std::uint32_t gate) { return (gate & ~kClosed) / kFree; }

void wait_for(sem_t& semaphore) {
    while (::sem_wait(&semaphore) != 0 && errno == EINTR) continue;
}

}  // namespace

struct OwnTeam::Member {
    sem_t call;
    std::atomic<bool> called{false};  ///< and has not yet looked at the gate: needs no second call
    std::thread thread;

    Member() { (void)::sem_init(&call, 0, 0); }
    ~Member() { (void)::sem_destroy(&call); }
    void wake() {
        if (!called.exchange(true)) (void)::sem_post(&call);
    }
};

OwnTeam::OwnTeam() : next_(0), gate_(kClosed) { (void)::sem_init(&ended_, 0, 0); }

OwnTeam::~OwnTeam() {
    closing_ = true;
    for (const std::unique_ptr<Member>& member : members_) member->wake();
    for (const std::unique_ptr<Member>& member : members_) member->thread.join();
    (void)::sem_destroy(&ended_);
}

bool OwnTeam::grow(std::uint32_t count) {
    if (count > kMaxMembers) count = kMaxMembers;
    if (members_.size() >= count) return true;
    const NoSignals guard;
    try {
        members_.reserve(count);
        while (members_.size() < count) {
            auto member = std::make_unique<Member>();
            Member& made = *member;
            made.thread = std::thread([this, &made] { serve(made); });
            members_.push_back(std::move(member));
        }
    } catch (...) {
        return false;
    }
    return true;
}

/// A member that comes late, called for an earlier loop, joins the one that is open now.
bool OwnTeam::join(std::uint32_t& index) {
    std::uint32_t gate = gate_;
    while ((gate & kClosed) == 0 && members_free(gate) > 0) {
        if (!gate_.compare_exchange_weak(gate, gate - kFree + kWithin)) continue;
        index = most_ - members_free(gate) + 1;
        return true;
    }
    return false;
}

void OwnTeam::leave() {
    const std::uint32_t gate = gate_.fetch_sub(kWithin);
    if ((gate & kClosed) != 0 && members_within(gate) == 1) (void)::sem_post(&ended_);
}

void OwnTeam::call_two() {
    for (int i = 0; i < 2; ++i) {
        const std::uint32_t member = next_.fetch_add(1);
        if (member >= most_) return;
        members_[member]->wake();
    }
}

void OwnTeam::serve(Member& member) {
    for (;;) {
        wait_for(member.call);
        member.called = false;
        if (closing_) return;
        std::uint32_t index = 0;
        if (!join(index)) continue;
        call_two();
        body_(data_, index);
        leave();
    }
}

void OwnTeam::run(std::uint32_t count, TeamBody body, void* data) {
    (void)grow(count - 1);
    most_ = count - 1 < members_.size() ? count - 1 : std::uint32_t(members_.size());
    body_ = body;
    data_ = data;
    next_ = 0;
    gate_ = most_ * kFree;
    call_two();
    body(data, 0);
    if (members_within(gate_.fetch_or(kClosed)) > 0) wait_for(ended_);
}

}  // namespace pileus
