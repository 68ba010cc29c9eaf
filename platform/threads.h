// SPDX-License-Identifier: Apache-2.0
// Runs pieces of work on several threads: those that are lent, or some for the time of the loop.
// in: a count and a function of (piece, thread) -> out: every piece ran once.
// docs/performance.md, "Waiting"; docs/embedding.md
#pragma once
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "platform/memory.h"
#include "platform/team/team.h"

namespace pileus {

/// Has no threads until a loop asks for some, and at most as many as the largest loop wanted.
class ThreadPool {
public:
    ThreadPool() = default;
    explicit ThreadPool(TeamKind kind) : team_(make_team(kind)) {}
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    /// run_team (team/team.h). Who comes late is not waited for by threads of our own, so that each
    /// body takes what work is left. A pool that is at work, as within one of its own bodies, has
    /// the caller do all.
    void run(std::uint32_t count, TeamBody body, void* data);
    const char* name() const;

private:
    Team* team_ = nullptr;
};

/// Lends `pool` to this thread while it lives, unless threads are lent already.
class PoolGuard {
public:
    explicit PoolGuard(ThreadPool& pool);

private:
    HostGuard lent_;
};

using WorkFunction = void (*)(void* context, std::int64_t piece, int thread);

/// Threads that `parallel_pieces` uses when asked for 0: of processors that this process may use.
int hardware_threads();

/// Whose threads they are that this thread's loops would run on: of a team (team/team.h), or "the
/// host's".
const char* threads_name();

/// Calls work(context, piece, thread) for piece in [0, pieces); thread in [0, threads).
void parallel_pieces(int threads, std::int64_t pieces, void* context, WorkFunction work);

/// The same for a lambda `void(std::int64_t piece, int thread)`.
template <class Function>
void parallel_for(int threads, std::int64_t pieces, Function&& function) {
    parallel_pieces(threads, pieces, &function, [](void* context, std::int64_t piece, int thread) {
        (*static_cast<std::remove_reference_t<Function>*>(context))(piece, thread);
    });
}

/// Calls function(i) for i in [0, count), some thousands to a piece of work.
template <class Function>
void parallel_each(int threads, std::uint64_t count, Function&& function) {
    constexpr std::uint64_t kPiece = 4096;
    parallel_for(threads, std::int64_t((count + kPiece - 1) / kPiece),
                 [&](std::int64_t piece, int) {
                     const std::uint64_t begin = std::uint64_t(piece) * kPiece;
                     const std::uint64_t end = begin + kPiece < count ? begin + kPiece : count;
                     for (std::uint64_t i = begin; i < end; ++i) function(std::size_t(i));
                 });
}

}  // namespace pileus
