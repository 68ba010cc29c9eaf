// SPDX-License-Identifier: Apache-2.0
// See memory.h.
#include "platform/memory.h"

#include <cstdlib>

namespace pileus {
namespace {

/// Holds something only below a guard, so that no state outlives a call.
thread_local Host lent;

}  // namespace

const Host& current_host() { return lent; }

HostGuard::HostGuard(const Host& host) : before_(lent) { lent = host; }
HostGuard::~HostGuard() { lent = before_; }

void* take_memory(std::size_t bytes, const Allocator*& from) {
    constexpr std::size_t kAlignment = 64;
    from = lent.allocator;
    return from != nullptr ? from->allocate(from->user, bytes, kAlignment)
                           : std::aligned_alloc(kAlignment, bytes);
}

void give_memory(void* memory, const Allocator* from) {
    if (memory == nullptr) return;
    if (from != nullptr)
        from->release(from->user, memory);
    else
        std::free(memory);
}

}  // namespace pileus
