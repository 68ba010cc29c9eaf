// SPDX-License-Identifier: Apache-2.0
// See memory.h.
#include "platform/memory.h"

namespace pileus {
namespace {

/// Holds something only below a guard, so that no state outlives a call.
#ifdef PILEUS_ONE_THREAD
Host lent;  // no thread pointer, and one task that calls
#else
thread_local Host lent;
#endif

}  // namespace

const Allocator kCallersMemory{nullptr, [](void*, void*) {}, nullptr};

const Host& current_host() { return lent; }

HostGuard::HostGuard(const Host& host) : before_(lent) { lent = host; }
HostGuard::~HostGuard() { lent = before_; }

void* take_memory(std::size_t bytes, const Allocator*& from) {
    constexpr std::size_t kAlignment = 64;
    from = lent.allocator;
    if (from != nullptr) return from->allocate(from->user, bytes, kAlignment);
#ifdef PILEUS_FLIGHT
    return nullptr;  // has no memory but its block
#else
    return take_aligned(kAlignment, bytes);
#endif
}

void give_memory(void* memory, const Allocator* from) {
    if (memory == nullptr) return;
    if (from != nullptr) return from->release(from->user, memory);
#ifndef PILEUS_FLIGHT
    give_aligned(memory);
#endif
}

}  // namespace pileus
