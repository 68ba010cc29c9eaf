// SPDX-License-Identifier: Apache-2.0
// Takes the place of platform/threads.cpp: pieces of work in a shuffled order, on threads at
// random. in: environment variable PILEUS_SHUFFLE, a whole number; unset: in order -> out: every
// piece ran once. docs/determinism.md, "How it is checked"; linked into pileus_spoiled only.
#include <cstdlib>
#include <utility>
#include <vector>

#include "platform/threads.h"

namespace pileus {

namespace {

/// The next number of SplitMix64.
std::uint64_t next(std::uint64_t& state) {
    std::uint64_t x = state += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

}  // namespace

// There are no threads to keep.
ThreadPool::~ThreadPool() { (void)state_; }

PoolGuard::PoolGuard(ThreadPool&) : lent_(current_host()) {}

int hardware_threads() { return 5; }

/// One after the other in truth, so that any order and any thread can be played, and again.
void parallel_pieces(int threads, std::int64_t pieces, void* context, WorkFunction work) {
    const char* text = std::getenv("PILEUS_SHUFFLE");
    if (text == nullptr) {
        for (std::int64_t piece = 0; piece < pieces; ++piece) work(context, piece, 0);
        return;
    }
    std::uint64_t state = std::strtoull(text, nullptr, 10) ^ std::uint64_t(pieces) << 32;
    std::vector<std::int64_t> order;
    for (std::int64_t piece = 0; piece < pieces; ++piece) order.push_back(piece);
    for (std::size_t i = order.size(); i > 1; --i)
        std::swap(order[i - 1], order[std::size_t(next(state) % i)]);
    const std::uint64_t most = threads > 1 ? std::uint64_t(threads) : 1;
    for (const std::int64_t piece : order) work(context, piece, int(next(state) % most));
}

}  // namespace pileus
