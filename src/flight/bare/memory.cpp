// SPDX-License-Identifier: Apache-2.0
// What the flight library has in place of the C++ runtime's memory and of its exceptions. These
// names are seen within the library alone (cmake/PileusFlight.cmake): a host keeps its own.
// in: the block that is lent -> out: memory of it, or the end of the session.
// docs/flight.md, "Memory"
#include "platform/memory.h"

#include <csetjmp>
#include <cstdlib>
#include <new>
#include <string>

#include "src/flight/block.h"

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
    // All lies in the block, which is the caller's to take back. Threads that are lent have no
    // block and take nothing.
    pileus::Block* const from = block();
    if (from != nullptr && from->way_out() != nullptr)
        std::longjmp(*static_cast<std::jmp_buf*>(from->way_out()), 1);
    std::abort();
}

}  // namespace

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
// state to go on from.
namespace std {
void __throw_length_error(const char*) { std::abort(); }
void __throw_logic_error(const char*) { std::abort(); }
void __throw_out_of_range(const char*) { std::abort(); }
void __throw_out_of_range_fmt(const char*, ...) { std::abort(); }
void __throw_invalid_argument(const char*) { std::abort(); }
void __throw_bad_alloc() { std::abort(); }
void __throw_bad_array_new_length() { std::abort(); }
void __throw_bad_function_call() { std::abort(); }
}  // namespace std

extern "C" {
[[noreturn]] void __cxa_pure_virtual() { std::abort(); }
}
