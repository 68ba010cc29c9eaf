// SPDX-License-Identifier: Apache-2.0
// See block.h.
#include "src/flight/block.h"

#include <new>

namespace pileus {
namespace {

/// Memory is handed out at multiples of this; a piece's record lies before it.
constexpr std::uint64_t kUnit = 64;

/// What calls other than pictures take of small objects, texts of faults.
constexpr std::uint64_t kMinSmall = 16u << 10;

class Turn {
public:
    explicit Turn(std::atomic_flag& busy) : busy_(busy) {
        while (busy_.test_and_set(std::memory_order_acquire)) {
        }
    }
    ~Turn() { busy_.clear(std::memory_order_release); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

private:
    std::atomic_flag& busy_;
};

}  // namespace

/// The record of a piece: so many bytes from here on are its own, the record included.
struct Block::Piece {
    std::uint64_t size;    ///< a multiple of kUnit
    std::uint64_t before;  ///< size of the piece before, or of a call's its place; 0: none
    std::uint64_t used;
    std::uint64_t small;  ///< whether it is a small object
};

// Places of records are half a unit before a multiple of it.
constexpr std::uint64_t kRecord = 32;

Block::Block(std::uint64_t bytes) : end_(bytes) { use_.bytes = bytes; }

Block* Block::make(void* memory, std::uint64_t bytes) {
    const std::uint64_t first = (sizeof(Block) + kUnit - 1) / kUnit * kUnit + kRecord;
    const auto start = reinterpret_cast<std::uintptr_t>(memory);
    const std::uint64_t skipped = (kUnit - start % kUnit) % kUnit;
    if (memory == nullptr || bytes < skipped + first + 4 * kUnit) return nullptr;
    bytes -= skipped;
    char* const begin = static_cast<char*>(memory) + skipped;
    Block* const block = new (begin) Block((bytes - first) / kUnit * kUnit + first);
    *block->at(first) = {block->end_ - first, 0, 0, 0};
    block->use_.bytes = bytes + skipped;
    return block;
}

Block::Piece* Block::at(std::uint64_t place) {
    return reinterpret_cast<Piece*>(reinterpret_cast<char*>(this) + place);
}

void* Block::take(std::size_t bytes, bool small) {
    const Turn turn(busy_);
    if (bytes > end_) {
        ++use_.refused;
        return nullptr;
    }
    const std::uint64_t size = (std::uint64_t(bytes) + kRecord + kUnit - 1) / kUnit * kUnit;
    void* const memory = is_sealed() ? take_frame(size, small) : take_kept(size, small);
    if (memory == nullptr) ++use_.refused;
    return memory;
}

Allocator Block::allocator() {
    return {[](void* block, std::size_t bytes, std::size_t) {
                return static_cast<Block*>(block)->take(bytes);
            },
            [](void* block, void* memory) { static_cast<Block*>(block)->give(memory); }, this,
            true};
}

void* Block::take_kept(std::uint64_t size, bool small) {
    std::uint64_t place = (sizeof(Block) + kUnit - 1) / kUnit * kUnit + kRecord;
    for (; place < end_; place += at(place)->size) {
        Piece& piece = *at(place);
        if (piece.used != 0 || piece.size < size) continue;
        if (piece.size > size) {
            Piece& rest = *at(place + size);
            rest = {piece.size - size, size, 0, 0};
            if (place + piece.size < end_) at(place + piece.size)->before = rest.size;
            piece.size = size;
        }
        piece.used = 1;
        piece.small = small ? 1 : 0;
        if (small) small_now_ += size;
        if (small_now_ > small_kept_ + use_.small_bytes)
            use_.small_bytes = small_now_ - small_kept_;
        const std::uint64_t reached = place + size;
        if (reached > use_.open_bytes) use_.open_bytes = reached;
        return at(place) + 1;
    }
    return nullptr;
}

void* Block::take_frame(std::uint64_t size, bool small) {
    const std::uint64_t left = end_ - top_, others = small ? 0 : small_room_;
    if (left < others || size > left - others) return nullptr;
    *at(top_) = {size, last_, 1, small ? 1u : 0u};
    last_ = top_;
    top_ += size;
    ++use_.frame_pieces;
    if (top_ - frame_base_ > use_.frame_bytes) use_.frame_bytes = top_ - frame_base_;
    return at(last_) + 1;
}

void Block::give(void* memory) {
    if (memory == nullptr) return;
    const Turn turn(busy_);
    Piece* const piece = static_cast<Piece*>(memory) - 1;
    const auto place =
        std::uint64_t(reinterpret_cast<char*>(piece) - reinterpret_cast<char*>(this));
    if (is_sealed() && place >= frame_base_) return give_frame(place);
    if (is_sealed()) ++use_.lost_pieces;
    give_kept(piece);
}

void Block::give_kept(Piece* piece) {
    piece->used = 0;
    if (piece->small != 0) small_now_ -= piece->size;
    piece->small = 0;
    const auto place =
        std::uint64_t(reinterpret_cast<char*>(piece) - reinterpret_cast<char*>(this));
    const std::uint64_t limit = is_sealed() ? frame_base_ : end_;
    const auto join = [&](std::uint64_t first, std::uint64_t second) {
        at(first)->size += at(second)->size;
        if (first + at(first)->size < limit) at(first + at(first)->size)->before = at(first)->size;
    };
    if (place + piece->size < limit && at(place + piece->size)->used == 0)
        join(place, place + piece->size);
    if (piece->before != 0 && at(place - piece->before)->used == 0)
        join(place - piece->before, place);
}

void Block::give_frame(std::uint64_t place) {
    at(place)->used = 0;
    while (last_ != 0 && at(last_)->used == 0) {
        top_ = last_;
        last_ = at(last_)->before;
    }
}

void Block::set_way_out(void* way_out) {
    way_out_ = way_out;
    thread_ = &current_host();
}

void* Block::way_out() const { return thread_ == &current_host() ? way_out_ : nullptr; }

void Block::begin_pictures() {
    const Turn turn(busy_);
    small_kept_ = small_now_;
    use_.small_bytes = 0;
}

bool Block::seal() {
    const Turn turn(busy_);
    std::uint64_t place = (sizeof(Block) + kUnit - 1) / kUnit * kUnit + kRecord, behind = place;
    for (; place < end_; place += at(place)->size)
        if (at(place)->used != 0) behind = place + at(place)->size;
    frame_base_ = top_ = behind;
    last_ = 0;
    use_.kept_bytes = behind;
    // An ordinary library has them elsewhere.
    const bool none = small_now_ == 0 && use_.small_bytes == 0;
    small_room_ = none ? 0 : 2 * use_.small_bytes + kMinSmall;
    return end_ - top_ >= small_room_;
}

bool Block::is_clear() {
    if (!is_sealed() || last_ == 0) return true;
    const Turn turn(busy_);
    std::uint64_t kept = 0;
    for (std::uint64_t place = last_; place != 0; place = at(place)->before) ++kept;
    use_.kept_pieces = kept;
    return false;
}

}  // namespace pileus
