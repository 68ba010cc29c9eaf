// SPDX-License-Identifier: Apache-2.0
// Runs pieces of work on several threads: those that are lent, or some for the time of the loop.
// in: a count and a function of (piece, thread) -> out: every piece ran once.
// docs/performance.md, "Waiting"; docs/embedding.md
#pragma once
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "platform/memory.h"

namespace pileus {

/// Has no threads until a loop asks for some, and at most as many as the largest loop wanted.
class ThreadPool {
public:
    ThreadPool() = default;
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    /// Calls body(data, 0) here and body(data, i), 0 < i < count, on threads that come before this
    /// one is done; returns when all have returned. Who comes late is not waited for, so that each
    /// body takes what work is left. A pool that is at work, as within one of its own bodies, has
    /// the caller do all. Bodies throw nothing.
    void run(std::uint32_t count, void (*body)(void* data, std::uint32_t index), void* data);

private:
    struct State;
    State* state_ = nullptr;
};

/// Lends `pool` to this thread while it lives, unless threads are lent already.
class PoolGuard {
public:
    explicit PoolGuard(ThreadPool& pool);

private:
    HostGuard lent_;
};

using WorkFunction = void (*)(void* context, std::int64_t piece, int thread);

/// Threads that `parallel_pieces` uses when asked for 0.
int hardware_threads();

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
