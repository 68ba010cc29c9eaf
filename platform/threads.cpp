// SPDX-License-Identifier: Apache-2.0
// See threads.h.
#include "platform/threads.h"

#include <atomic>
#include <exception>

#include "platform/fp_mode.h"
#include "platform/memory.h"

#if PILEUS_WITH_THREADS
#include <signal.h>
#include <unistd.h>

#include <condition_variable>
#include <mutex>
#include <new>
#include <thread>
#include <vector>
#endif
#ifdef __linux__
#include <sched.h>
#endif

namespace pileus {

int hardware_threads() {
    int count = 1;
#if PILEUS_WITH_THREADS
    count = int(std::thread::hardware_concurrency());
#ifdef __linux__
    // Those that this process may run on.
    cpu_set_t own;
    if (::sched_getaffinity(0, sizeof own, &own) == 0) count = CPU_COUNT(&own);
#endif
#endif
    return count > 1 ? count : 1;
}

#if PILEUS_WITH_THREADS
namespace {

/// Threads that are made below this get no signals: those are for the host's own.
class NoSignals {
public:
    NoSignals() {
        sigset_t all;
        (void)::sigfillset(&all);
        (void)::pthread_sigmask(SIG_SETMASK, &all, &before_);
    }
    ~NoSignals() { (void)::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

private:
    sigset_t before_;
};

}  // namespace

/// The loop at work, and who is at it. All but `busy` belongs to the mutex.
struct ThreadPool::State {
    const pid_t process = ::getpid();
    std::mutex mutex;
    std::condition_variable begun, ended;
    std::vector<std::thread> threads;
    void (*body)(void*, std::uint32_t) = nullptr;
    void* data = nullptr;
    std::uint32_t joined = 0;  ///< bodies of this loop that have begun, the caller's apart
    std::uint32_t wanted = 0;  ///< bodies that may still begin
    std::uint32_t active = 0;  ///< bodies that run, the caller's apart
    bool closing = false;
    std::atomic<bool> busy{false};

    void serve();
    void grow(std::uint32_t count);
    void close();
};

void ThreadPool::State::serve() {
    std::unique_lock<std::mutex> lock(mutex);
    for (;;) {
        begun.wait(lock, [&] { return wanted > 0 || closing; });
        if (closing) return;
        --wanted;
        ++active;
        const std::uint32_t index = ++joined;
        void (*const run)(void*, std::uint32_t) = body;
        void* const with = data;
        lock.unlock();
        run(with, index);
        lock.lock();
        if (--active == 0 && wanted == 0) ended.notify_one();
    }
}

/// Fewer threads than asked for do the work as well.
void ThreadPool::State::grow(std::uint32_t count) {
    if (threads.size() >= count) return;
    const NoSignals guard;
    try {
        while (threads.size() < count) threads.emplace_back([this] { serve(); });
    } catch (...) {
    }
}

void ThreadPool::State::close() {
    {
        const std::lock_guard<std::mutex> lock(mutex);
        closing = true;
    }
    begun.notify_all();
    for (std::thread& thread : threads) thread.join();
}

ThreadPool::~ThreadPool() {
    // A process that was forked has a copy of what its threads were at, and no thread.
    if (state_ == nullptr || state_->process != ::getpid()) return;
    state_->close();
    delete state_;
}

void ThreadPool::run(std::uint32_t count, void (*body)(void*, std::uint32_t), void* data) {
    if (state_ == nullptr || state_->process != ::getpid()) state_ = new (std::nothrow) State;
    if (count < 2 || state_ == nullptr || state_->busy.exchange(true)) return body(data, 0);
    State& s = *state_;
    {
        const std::lock_guard<std::mutex> lock(s.mutex);
        s.grow(count - 1);
        s.body = body;
        s.data = data;
        s.joined = 0;
        s.wanted = count - 1 < s.threads.size() ? count - 1 : std::uint32_t(s.threads.size());
    }
    if (count > s.threads.size())
        s.begun.notify_all();
    else
        for (std::uint32_t i = 1; i < count; ++i) s.begun.notify_one();
    body(data, 0);
    {
        std::unique_lock<std::mutex> lock(s.mutex);
        s.wanted = 0;
        s.ended.wait(lock, [&] { return s.active == 0; });
    }
    s.busy = false;
}

#else

ThreadPool::~ThreadPool() { (void)state_; }

void ThreadPool::run(std::uint32_t, void (*body)(void*, std::uint32_t), void* data) {
    body(data, 0);
}
#endif

namespace {

/// The first of what pieces threw, where memory ended: it must not leave a thread.
class Thrown {
public:
    template <class Work>
    void guard(Work work) {
        if (any_.load(std::memory_order_relaxed)) return;
#ifdef __cpp_exceptions
        try {
            work();
        } catch (...) {
            if (!any_.exchange(true)) first_ = std::current_exception();
        }
#else
        work();
#endif
    }
    void pass_on() const {
#ifdef __cpp_exceptions
        if (first_ != nullptr) std::rethrow_exception(first_);
#endif
    }

private:
    std::atomic<bool> any_{false};
#ifdef __cpp_exceptions
    std::exception_ptr first_;
#endif
};

/// Pieces that threads take one after the other.
struct SharedPieces {
    std::int64_t pieces;
    void* context;
    WorkFunction work;
    Host host;
    std::int64_t stride;                 ///< pieces that are taken at once
    std::atomic<std::uint32_t> next{0};  ///< 32 bits, which every machine adds to by itself
    Thrown thrown{};
};

Host with_pool(ThreadPool& pool) {
    Host host = current_host();
    if (host.executor == nullptr && host.pool == nullptr) host.pool = &pool;
    return host;
}

void take_pieces(void* data, std::uint32_t index) {
    SharedPieces& shared = *static_cast<SharedPieces*>(data);
    const FpModeGuard guard;
    const HostGuard lent(shared.host);
    for (;;) {
        const std::int64_t first =
            std::int64_t(shared.next.fetch_add(1, std::memory_order_relaxed)) * shared.stride;
        if (first >= shared.pieces) return;
        for (std::int64_t piece = first; piece < first + shared.stride && piece < shared.pieces;
             ++piece)
            shared.thrown.guard([&] { shared.work(shared.context, piece, int(index)); });
    }
}

}  // namespace

PoolGuard::PoolGuard(ThreadPool& pool) : lent_(with_pool(pool)) {}

void parallel_pieces(int threads, std::int64_t pieces, void* context, WorkFunction work) {
    if (threads <= 1 || pieces <= 1) {
        for (std::int64_t piece = 0; piece < pieces; ++piece) work(context, piece, 0);
        return;
    }
    const Host host = current_host();
    SharedPieces shared{pieces, context, work, host, pieces / (1 << 30) + 1};
    if (host.executor != nullptr) {
        host.executor->run(host.executor->user, std::uint32_t(threads), take_pieces, &shared);
    } else {
        ThreadPool own;  // has no threads where it is not used
        ThreadPool& pool = host.pool != nullptr ? *host.pool : own;
        pool.run(std::uint32_t(pieces < threads ? pieces : threads), take_pieces, &shared);
    }
    shared.thrown.pass_on();
}

}  // namespace pileus
