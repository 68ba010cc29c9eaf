// SPDX-License-Identifier: Apache-2.0
// Shares out pieces of work: what they throw, the host's memory, the floating-point mode.
// in, out: see threads.h.
#include <atomic>
#include <exception>

#include "platform/fp_mode.h"
#include "platform/threads.h"

namespace pileus {
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
