// SPDX-License-Identifier: Apache-2.0
// The memory of a flight: a heap until it is sealed, then pieces that calls give back.
// in: requests of many sizes -> out: no two pieces overlap, nothing is lost, counts are right.
// src/flight/block.h; docs/flight.md, "Memory"
#include "src/flight/block.h"

#include <doctest/doctest.h>

#include <cstring>
#include <thread>
#include <vector>

namespace pileus {
namespace {

struct Piece {
    unsigned char* memory;
    std::size_t bytes;
    unsigned char mark;
};

/// A number that looks drawn.
std::uint32_t draw(std::uint64_t& state) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return std::uint32_t(state >> 33);
}

bool holds(const Piece& piece) {
    for (std::size_t i = 0; i < piece.bytes; ++i)
        if (piece.memory[i] != piece.mark) return false;
    return true;
}

}  // namespace

TEST_CASE("a block hands out memory of its own that does not overlap, at multiples of 64") {
    std::vector<unsigned char> memory(1 << 20);
    for (const std::size_t skipped : {0, 1, 31, 63}) {
        unsigned char* const begin = memory.data() + skipped;
        Block* const block = Block::make(begin, memory.size() - 64);
        REQUIRE(block != nullptr);
        std::vector<Piece> pieces;
        std::uint64_t state = skipped + 1;
        for (int i = 0; i < 20000; ++i) {
            if (draw(state) % 3 > 0 || pieces.empty()) {
                const std::size_t bytes = draw(state) % 5000;
                auto* const at = static_cast<unsigned char*>(block->take(bytes));
                if (at == nullptr) continue;
                REQUIRE(reinterpret_cast<std::uintptr_t>(at) % 64 == 0);
                REQUIRE(at >= begin);
                REQUIRE(at + bytes <= begin + memory.size() - 64);
                pieces.push_back({at, bytes, static_cast<unsigned char>(draw(state))});
                std::memset(at, pieces.back().mark, bytes);
            } else {
                const std::size_t n = draw(state) % pieces.size();
                REQUIRE(holds(pieces[n]));
                block->give(pieces[n].memory);
                pieces[n] = pieces.back();
                pieces.pop_back();
            }
        }
        for (const Piece& piece : pieces) block->give(piece.memory);
        // All of it is one piece again.
        CHECK(block->take((1 << 20) - 1024) != nullptr);
    }
}

TEST_CASE("a block without room says so and counts it") {
    alignas(64) unsigned char memory[4096];
    CHECK(Block::make(nullptr, 4096) == nullptr);
    CHECK(Block::make(memory, 100) == nullptr);
    Block* const block = Block::make(memory, sizeof memory);
    REQUIRE(block != nullptr);
    CHECK(block->take(sizeof memory) == nullptr);
    CHECK(block->take(SIZE_MAX) == nullptr);
    CHECK(block->use().refused == 2);
    void* const some = block->take(1);
    CHECK(some != nullptr);
    block->give(some);
    block->give(nullptr);
}

TEST_CASE("after sealing pieces are a stack, and what a call leaves is told") {
    alignas(64) unsigned char memory[16384];
    Block* const block = Block::make(memory, sizeof memory);
    REQUIRE(block != nullptr);
    void* const kept = block->take(1000);
    void* const gone = block->take(1000);
    block->give(gone);
    block->seal();
    CHECK(block->is_sealed());
    CHECK(block->is_clear());
    void *const a = block->take(100), *const b = block->take(200), *const c = block->take(300);
    REQUIRE(c != nullptr);
    // Given back in another order: the room comes back with the last of those on top.
    block->give(a);
    block->give(b);
    CHECK_FALSE(block->is_clear());
    CHECK(block->use().kept_pieces == 3);
    block->give(c);
    CHECK(block->is_clear());
    CHECK(block->take(100) == a);
    block->give(a);
    CHECK(block->use().frame_pieces == 4);
    CHECK(block->use().lost_pieces == 0);
    block->give(kept);
    CHECK(block->use().lost_pieces == 1);
    CHECK(block->take(sizeof memory) == nullptr);
    CHECK(block->use().refused == 1);
}

TEST_CASE("small objects have the end of a sealed block to themselves") {
    alignas(64) static unsigned char memory[1 << 17];
    Block* const block = Block::make(memory, sizeof memory);
    REQUIRE(block != nullptr);
    void* const before = block->take_small(5000);
    block->begin_pictures();
    void* const small = block->take_small(3000);
    block->give(small);
    REQUIRE(block->seal());
    // 3000 bytes and a record in whole units, twice, and the texts of faults.
    CHECK(block->use().small_bytes == 3072);
    const std::uint64_t room = 2 * 3072 + (16 << 10);
    std::vector<void*> arrays;
    while (void* const piece = block->take(1024)) arrays.push_back(piece);
    CHECK(arrays.size() > 80);
    std::uint64_t taken = 0;
    std::vector<void*> objects;
    while (void* const piece = block->take_small(1000)) objects.push_back(piece), taken += 1000;
    CHECK(taken + 2048 > room * 1000 / 1088);
    for (void* const piece : objects) block->give(piece);
    for (void* const piece : arrays) block->give(piece);
    CHECK(block->is_clear());
    block->give(before);
    // A block without that room is not for calls.
    Block* const tight = Block::make(memory, 8192);
    void* const one = tight->take_small(2000);
    tight->give(one);
    CHECK_FALSE(tight->seal());
}

TEST_CASE("a way out is the thread's that set it") {
    alignas(64) unsigned char memory[4096];
    Block* const block = Block::make(memory, sizeof memory);
    int place = 0;
    CHECK(block->way_out() == nullptr);
    block->set_way_out(&place);
    CHECK(block->way_out() == &place);
    void* other = &place;
    std::thread([&] { other = block->way_out(); }).join();
    CHECK(other == nullptr);
}

}  // namespace pileus
