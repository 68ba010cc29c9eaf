// SPDX-License-Identifier: Apache-2.0
// Takes the place of platform/team/pieces.cpp: pieces of work in a shuffled order, on threads at
// random or, where PILEUS_TEAM names a team, on its threads. in: environment variable
// PILEUS_SHUFFLE, a whole number; unset: in order -> out: every piece ran once.
// docs/determinism.md, "How it is checked"; linked into pileus_spoiled only.
#include <cstdlib>
#include <utility>
#include <vector>

#include "platform/threads.h"

// The program's own loop by another name, for the teams.
#define parallel_pieces parallel_pieces_of_a_team
#include "platform/team/pieces.cpp"
#undef parallel_pieces

namespace pileus {

namespace {

/// The next number of SplitMix64.
std::uint64_t next(std::uint64_t& state) {
    std::uint64_t x = state += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// What a piece of a shuffled loop calls.
struct Shuffled {
    std::vector<std::int64_t> order;
    void* context;
    WorkFunction work;
};

}  // namespace

/// One after the other in truth, so that any order and any thread can be played, and again.
void parallel_pieces(int threads, std::int64_t pieces, void* context, WorkFunction work) {
    const char* text = std::getenv("PILEUS_SHUFFLE");
    if (text == nullptr) {
        for (std::int64_t piece = 0; piece < pieces; ++piece) work(context, piece, 0);
        return;
    }
    std::uint64_t state = std::strtoull(text, nullptr, 10) ^ std::uint64_t(pieces) << 32;
    Shuffled shuffled{{}, context, work};
    std::vector<std::int64_t>& order = shuffled.order;
    for (std::int64_t piece = 0; piece < pieces; ++piece) order.push_back(piece);
    for (std::size_t i = order.size(); i > 1; --i)
        std::swap(order[i - 1], order[std::size_t(next(state) % i)]);
    const std::uint64_t most = threads > 1 ? std::uint64_t(threads) : 1;
    if (std::getenv("PILEUS_TEAM") == nullptr) {
        for (const std::int64_t piece : order) work(context, piece, int(next(state) % most));
        return;
    }
    parallel_pieces_of_a_team(threads, pieces, &shuffled,
                              [](void* all, std::int64_t piece, int thread) {
                                  const Shuffled& s = *static_cast<const Shuffled*>(all);
                                  s.work(s.context, s.order[std::size_t(piece)], thread);
                              });
}

}  // namespace pileus
