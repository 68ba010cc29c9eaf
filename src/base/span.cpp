// SPDX-License-Identifier: Apache-2.0
// See span.h.
// in: an index that no reader should have let through -> out: the end of the process.
#include "src/base/span.h"

#include <cstdio>
#include <cstdlib>

namespace pileus {

void stop_out_of_range(std::size_t index, std::size_t count, std::size_t size) {
    std::fprintf(
        stderr,
        "pileus: defect: %zu elements from %zu on asked of an array of %zu; stopped before "
        "memory is damaged\n",
        count, index, size);
    std::abort();
}

}  // namespace pileus
