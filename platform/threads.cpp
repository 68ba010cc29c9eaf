// SPDX-License-Identifier: Apache-2.0
// See threads.h.
#include "platform/threads.h"

#include <atomic>
#include <exception>

#include "platform/fp_mode.h"
#include "platform/memory.h"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace pileus {

int hardware_threads() {
#ifdef _OPENMP
    return omp_get_num_procs();
#else
    return 1;
#endif
}

namespace {

/// The first of what pieces threw, where memory ended: it must not leave a thread.
class Thrown {
public:
    template <class Work>
    void guard(Work work) {
        if (any_.load(std::memory_order_relaxed)) return;
        try {
            work();
        } catch (...) {
            if (!any_.exchange(true)) first_ = std::current_exception();
        }
    }
    void pass_on() const {
        if (first_ != nullptr) std::rethrow_exception(first_);
    }

private:
    std::atomic<bool> any_{false};
    std::exception_ptr first_;
};

/// Pieces that a host's threads take one after the other.
struct SharedPieces {
    std::int64_t pieces;
    void* context;
    WorkFunction work;
    Host host;
    std::int64_t stride;                 ///< pieces that are taken at once
    std::atomic<std::uint32_t> next{0};  ///< 32 bits, which every machine adds to by itself
    Thrown thrown{};
};

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

void run_on_host(const Executor& executor, int threads, std::int64_t pieces, void* context,
                 WorkFunction work, const Host& host) {
    SharedPieces shared{pieces, context, work, host, pieces / (1 << 30) + 1};
    executor.run(executor.user, std::uint32_t(threads), take_pieces, &shared);
    shared.thrown.pass_on();
}

}  // namespace

void parallel_pieces(int threads, std::int64_t pieces, void* context, WorkFunction work) {
    const Host host = current_host();
    if (host.executor != nullptr && threads > 1 && pieces > 1) {
        run_on_host(*host.executor, threads, pieces, context, work, host);
        return;
    }
#ifdef _OPENMP
    if (threads > 1 && pieces > 1) {
        Thrown thrown;
#pragma omp parallel num_threads(threads)
        {
            const FpModeGuard guard;
            const HostGuard lent(host);
#pragma omp for schedule(dynamic, 1)
            for (std::int64_t piece = 0; piece < pieces; ++piece)
                thrown.guard([&] { work(context, piece, omp_get_thread_num()); });
        }
        thrown.pass_on();
        return;
    }
#endif
    (void)threads;
    for (std::int64_t piece = 0; piece < pieces; ++piece) work(context, piece, 0);
}

}  // namespace pileus
