// SPDX-License-Identifier: Apache-2.0
// Threads of every team: every piece once, whoever runs it; nested loops, faults, forks.
// in: loops of small pieces -> out: checks.
// docs/performance.md, "Waiting"; under the preset tsan, too
#include "platform/threads.h"

#include <doctest/doctest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cfenv>
#include <chrono>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "platform/threads.h"

using namespace pileus;

namespace {

/// OpenMP's threads may spin here: the tests are no program of ours.
constexpr TeamKind kTeams[] = {TeamKind::kOwn, TeamKind::kOpenMp};

/// How often each piece ran, and whether all were on threads below `threads`.
struct Runs {
    std::vector<std::atomic<int>> of_piece;
    std::atomic<bool> within{true};

    explicit Runs(std::size_t pieces) : of_piece(pieces) {}
    void loop(int threads) {
        parallel_for(threads, std::int64_t(of_piece.size()), [&](std::int64_t piece, int thread) {
            ++of_piece[std::size_t(piece)];
            if (thread < 0 || thread >= threads) within = false;
        });
    }
    bool each(int times) const {
        bool all = within;
        for (const std::atomic<int>& runs : of_piece) all = all && runs == times;
        return all;
    }
};

/// Two pieces, each waiting until the other has begun: only two threads can end it. Calls `other`
/// on the thread that is not the caller's.
template <class Other>
bool meet(Other other) {
    std::atomic<int> begun{0};
    std::atomic<bool> met{true};
    parallel_for(2, 2, [&](std::int64_t, int thread) {
        ++begun;
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (begun < 2 && met)
            if (std::chrono::steady_clock::now() > end) met = false;
        if (thread == 1) other();
    });
    return met;
}

}  // namespace

TEST_CASE("threads: every piece runs once for any number of threads, lent or not") {
    ThreadPool own(TeamKind::kOwn), openmp(TeamKind::kOpenMp), alone(TeamKind::kSerial);
    for (ThreadPool* pool : {static_cast<ThreadPool*>(nullptr), &own, &openmp, &alone}) {
        const HostGuard lent(Host{nullptr, nullptr, pool});
        for (const int threads : {1, 2, 3, 7})
            for (const std::size_t pieces : {0, 1, 2, 3, 1000}) {
                CAPTURE(threads_name());
                CAPTURE(threads);
                CAPTURE(pieces);
                Runs runs(pieces);
                for (int i = 0; i < 20; ++i) runs.loop(threads);
                CHECK(runs.each(20));
            }
    }
}

TEST_CASE("threads: those of a pool are kept, and get no signals of the host") {
    const auto is_deaf = [] {
        sigset_t blocked;
        return pthread_sigmask(SIG_SETMASK, nullptr, &blocked) == 0 &&
               sigismember(&blocked, SIGINT) == 1;
    };
    for (const TeamKind kind : kTeams) {
        std::set<std::thread::id> seen;
        bool met = true, deaf = true, hears = true;
        const auto loops = [&] {
            ThreadPool pool(kind);
            const PoolGuard lent(pool);
            for (int i = 0; i < 20; ++i) {
                met = met && meet([&] {
                          seen.insert(std::this_thread::get_id());
                          deaf = deaf && is_deaf();
                      });
                parallel_for(2, 2, [&](std::int64_t, int thread) {
                    if (thread == 0) hears = hears && !is_deaf();
                });
            }
            seen.erase(std::this_thread::get_id());
        };
        // OpenMP has other threads for each that begins regions.
        std::thread(loops).join();
        CAPTURE(int(kind));
        CHECK(met);
        CHECK(seen.size() == 1);
        CHECK(deaf);
        CHECK(hears);
    }
}

TEST_CASE("threads: a hundred wake one another, loop after loop") {
    for (const TeamKind kind : kTeams) {
        ThreadPool pool(kind);
        const PoolGuard lent(pool);
        Runs runs(200);
        for (const int threads : {100, 3, 64, 100}) runs.loop(threads);
        CAPTURE(pool.name());
        CHECK(runs.each(4));
    }
    // Pieces that each wait for all others end only on as many threads.
    ThreadPool pool(TeamKind::kOwn);
    const PoolGuard lent(pool);
    constexpr int kAll = 40;
    for (int i = 0; i < 5; ++i) {
        std::atomic<int> begun{0};
        std::atomic<bool> met{true};
        parallel_for(kAll, kAll, [&](std::int64_t, int) {
            ++begun;
            const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
            while (begun < kAll && met) {
                std::this_thread::yield();
                if (std::chrono::steady_clock::now() > end) met = false;
            }
        });
        CHECK(met);
    }
}

TEST_CASE("threads: a loop within a piece has all its pieces run") {
    for (const TeamKind kind : kTeams) {
        ThreadPool pool(kind);
        const PoolGuard lent(pool);
        std::atomic<int> inner{0};
        for (int i = 0; i < 100; ++i)
            parallel_for(3, 5, [&](std::int64_t, int) {
                parallel_for(3, 7, [&](std::int64_t, int) { ++inner; });
            });
        CAPTURE(pool.name());
        CHECK(inner == 100 * 5 * 7);
    }
}

#ifdef __cpp_exceptions
TEST_CASE("threads: what a piece throws reaches the caller, and the pool goes on") {
    for (const TeamKind kind : kTeams) {
        ThreadPool pool(kind);
        const PoolGuard lent(pool);
        for (int i = 0; i < 20; ++i) {
            CHECK_THROWS_AS(parallel_for(3, 50,
                                         [&](std::int64_t piece, int) {
                                             if (piece == 20) throw std::runtime_error("piece 20");
                                         }),
                            std::runtime_error);
            Runs runs(30);
            runs.loop(3);
            CHECK(runs.each(1));
        }
    }
}
#endif

TEST_CASE("threads: several callers, each with threads of its own, at once") {
    std::atomic<int> whole{0};
    std::vector<std::thread> callers;
    for (int c = 0; c < 4; ++c)
        callers.emplace_back([&, c] {
            ThreadPool pool(kTeams[c % 2]);
            const PoolGuard lent(pool);
            Runs runs(64);
            for (int i = 0; i < 200; ++i) runs.loop(3);
            if (runs.each(200)) ++whole;
        });
    for (std::thread& caller : callers) caller.join();
    CHECK(whole == 4);
}

TEST_CASE("threads: pieces have the caller's memory and round to nearest on every thread") {
    static const Allocator allocator{[](void*, std::size_t bytes, std::size_t alignment) {
                                         return std::aligned_alloc(alignment, bytes);
                                     },
                                     [](void*, void* memory) { std::free(memory); }};
    for (const TeamKind kind : kTeams) {
        ThreadPool pool(kind);
        const HostGuard memory(Host{&allocator, nullptr, nullptr});
        const PoolGuard lent(pool);
        REQUIRE(meet([] {}));
        REQUIRE(std::fesetround(FE_UPWARD) == 0);
        bool here = false, nearest = false;
        const bool met = meet([&] {
            here = current_host().allocator == &allocator;
            nearest = std::fegetround() == FE_TONEAREST;
        });
        std::fesetround(FE_TONEAREST);
        REQUIRE(met);
        CHECK(here);
        CHECK(nearest);
    }
}

// The sanitizer ends a forked process that makes threads.
#if !defined(__SANITIZE_THREAD__)
TEST_CASE("threads: a forked process makes threads of its own and ends") {
    for (const TeamKind kind : kTeams) {
        ThreadPool pool(kind);
        const PoolGuard lent(pool);
        REQUIRE(meet([] {}));
        const pid_t child = fork();
        REQUIRE(child >= 0);
        if (child == 0) {
            alarm(60);
            bool well = meet([] {});
            {
                ThreadPool other(kind);
                const Host none;
                const HostGuard nothing(none);
                const PoolGuard mine(other);
                well = well && meet([] {}) && std::string(other.name()) == "own";
            }
            pool.~ThreadPool();
            _exit(well ? 0 : 1);
        }
        int status = 0;
        REQUIRE(waitpid(child, &status, 0) == child);
        REQUIRE(WIFEXITED(status));
        CHECK(WEXITSTATUS(status) == 0);
        CHECK(meet([] {}));
    }
}
#endif
