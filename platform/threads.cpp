// SPDX-License-Identifier: Apache-2.0
// See threads.h.
#include "platform/threads.h"

#include "platform/fp_mode.h"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace pileus {

int hardware_threads() {
#ifdef _OPENMP
    return omp_get_num_procs();
#else
    return 1;
#endif
}

void parallel_pieces(int threads, std::int64_t pieces, void* context, WorkFunction work) {
#ifdef _OPENMP
    if (threads > 1 && pieces > 1) {
#pragma omp parallel num_threads(threads)
        {
            const FpModeGuard guard;
#pragma omp for schedule(dynamic, 1)
            for (std::int64_t piece = 0; piece < pieces; ++piece)
                work(context, piece, omp_get_thread_num());
        }
        return;
    }
#endif
    (void)threads;
    for (std::int64_t piece = 0; piece < pieces; ++piece) work(context, piece, 0);
}

}  // namespace pileus
