// SPDX-License-Identifier: Apache-2.0
// See memory.h. Windows keeps these apart from what malloc gives.
#include <malloc.h>

#include "platform/memory.h"

namespace pileus {

void* take_aligned(std::size_t alignment, std::size_t bytes) {
    return _aligned_malloc(bytes, alignment);
}

void give_aligned(void* memory) { _aligned_free(memory); }

}  // namespace pileus
