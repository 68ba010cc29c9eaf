// SPDX-License-Identifier: Apache-2.0
// What the flight library has in place of the C++ runtime's memory and of its exceptions. These
// names are seen within the library alone (cmake/PileusFlight.cmake): a host keeps its own.
// in: the block that is lent -> out: memory of it, or the end of the session.
// docs/flight.md, "Memory"
#include "platform/memory.h"

#include <new>
#include <string>

#include "src/flight/block.h"
#include "src/flight/jump.h"

namespace {

/// A flight lends nothing but blocks.
pileus::Block* block() {
    const pileus::Allocator* const from = pileus::current_host().allocator;
    return from != nullptr ? static_cast<pileus::Block*>(from->user) : nullptr;
}

void* take(std::size_t bytes) {
    pileus::Block* const from = block();
    return from != nullptr ? from->take_small(bytes) : nullptr;
}

void give(void* memory) {
    if (pileus::Block* const to = block()) to->give(memory);
}

void* take_or_leave(std::size_t bytes) {
    if (void* const memory = take(bytes)) return memory;
    pileus::leave_call();
}

}  // namespace

namespace pileus {

/// All lies in the block, which is the caller's to take back. Threads that are lent have no way
/// out and take nothing: there an instruction that no processor has is the end.
[[gnu::noinline]] void leave_call() {
    Block* const from = block();
    if (from != nullptr && from->way_out() != nullptr)
        __builtin_longjmp(static_cast<JumpPlace*>(from->way_out())->words, 1);
    __builtin_trap();
}

}  // namespace pileus

void* operator new(std::size_t bytes) { return take_or_leave(bytes); }
void* operator new[](std::size_t bytes) { return take_or_leave(bytes); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return take(bytes); }
void operator delete(void* memory) noexcept { give(memory); }
void operator delete[](void* memory) noexcept { give(memory); }
void operator delete(void* memory, std::size_t) noexcept { give(memory); }
void operator delete[](void* memory, std::size_t) noexcept { give(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { give(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { give(memory); }

// Texts are compiled here, so that they take memory as all else does.
template class std::basic_string<char>;

// A container was asked for what it does not have, which is a fault of the library: there is no
// state to go on from, and the session takes no more calls.
namespace std {
void __throw_length_error(const char*) { pileus::leave_call(); }
void __throw_logic_error(const char*) { pileus::leave_call(); }
void __throw_out_of_range(const char*) { pileus::leave_call(); }
void __throw_out_of_range_fmt(const char*, ...) { pileus::leave_call(); }
void __throw_invalid_argument(const char*) { pileus::leave_call(); }
void __throw_bad_alloc() { pileus::leave_call(); }
void __throw_bad_array_new_length() { pileus::leave_call(); }
void __throw_bad_function_call() { pileus::leave_call(); }
}  // namespace std

extern "C" {
[[noreturn]] void __cxa_pure_virtual() { pileus::leave_call(); }
}
