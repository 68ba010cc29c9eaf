// SPDX-License-Identifier: Apache-2.0
// See memory.h.
#include <cstdlib>

#include "platform/memory.h"

namespace pileus {

void* take_aligned(std::size_t alignment, std::size_t bytes) {
    return std::aligned_alloc(alignment, bytes);
}

void give_aligned(void* memory) { std::free(memory); }

}  // namespace pileus
