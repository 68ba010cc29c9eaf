// SPDX-License-Identifier: Apache-2.0
// All memory of a flight session in one block that the caller gives.
// in: a block -> out: before sealing a heap; then pieces that live no longer than a call.
// docs/flight.md, "Memory"
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "platform/memory.h"

namespace pileus {

/// What a block has seen. Bytes count its own records, too.
struct BlockUse {
    std::uint64_t bytes = 0;         ///< of the block
    std::uint64_t kept_bytes = 0;    ///< of what lives as long as the session, when it was sealed
    std::uint64_t open_bytes = 0;    ///< most in use before
    std::uint64_t frame_bytes = 0;   ///< most that a call took since
    std::uint64_t frame_pieces = 0;  ///< taken by calls since, all in all
    std::uint64_t refused = 0;       ///< pieces that there was no room for
    std::uint64_t kept_pieces = 0;   ///< of calls, which left them: 0, or something is wrong
    std::uint64_t lost_pieces = 0;   ///< of the session itself that calls gave back: likewise
    std::uint64_t small_bytes = 0;   ///< most that pictures took of small objects before
};

/// Lies at the start of its own block. Taking before sealing is first fit in the order of
/// addresses; afterwards a stack: a piece goes on top, and what is given back is free once all
/// above it is. Both may be used by several threads. Small objects, which nobody can do without,
/// have the end of the stack to themselves: twice what they took for a picture before sealing.
class Block {
public:
    /// Null: fewer bytes than the records need.
    static Block* make(void* memory, std::uint64_t bytes);

    /// At least `bytes` at a multiple of 64, or null.
    void* take(std::size_t bytes) { return take(bytes, false); }
    /// The same for an object of the C++ runtime.
    void* take_small(std::size_t bytes) { return take(bytes, true); }
    void give(void* memory);
    /// The same for whoever takes arrays.
    Allocator allocator();

    /// Where a library without exceptions goes when memory ends for a small object: a JumpPlace of
    /// the calling thread.
    void set_way_out(void* way_out);
    /// Null on other threads.
    void* way_out() const;
    /// A call went there once the block was sealed: what it changed may be half done.
    void break_off() { broken_ = true; }
    bool is_broken() const { return broken_; }

    /// Small objects of pictures are counted from here on.
    void begin_pictures();
    /// From now on what is free behind all that is in use serves calls. False: too little for small
    /// objects.
    bool seal();
    bool is_sealed() const { return frame_base_ != 0; }

    /// The end of a call: whether all of it was given back. What was not stays.
    bool is_clear();

    const BlockUse& use() const { return use_; }

private:
    struct Piece;
    explicit Block(std::uint64_t bytes);
    Piece* at(std::uint64_t place);
    void* take(std::size_t bytes, bool small);
    void* take_kept(std::uint64_t size, bool small);
    void* take_frame(std::uint64_t size, bool small);
    void give_kept(Piece* piece);
    void give_frame(std::uint64_t place);

    std::uint64_t end_ = 0;         ///< of the last piece, bytes from the start
    std::uint64_t frame_base_ = 0;  ///< where calls' pieces begin; 0: not sealed
    std::uint64_t top_ = 0;         ///< behind the last of them
    std::uint64_t last_ = 0;        ///< that piece; 0: none
    std::uint64_t small_now_ = 0;   ///< bytes of small objects before sealing
    std::uint64_t small_kept_ = 0;  ///< of these before the first picture
    std::uint64_t small_room_ = 0;  ///< at the end, for small objects alone
    bool broken_ = false;
    void* way_out_ = nullptr;
    const void* thread_ = nullptr;  ///< of the way out, as something that it alone has
    BlockUse use_;
    std::atomic_flag busy_ = ATOMIC_FLAG_INIT;
};

}  // namespace pileus
