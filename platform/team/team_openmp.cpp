// SPDX-License-Identifier: Apache-2.0
// See teams.h. The one file that is compiled with OpenMP.
#include <omp.h>
#include <sched.h>

#include "platform/team/no_signals.h"
#include "platform/team/teams.h"

namespace pileus {
namespace {

/// libomp takes the time that its threads spin from the thread that begins a region.
class NoSpinning {
#ifdef __clang__
public:
    NoSpinning() : before_(kmp_get_blocktime()) { kmp_set_blocktime(0); }
    ~NoSpinning() { kmp_set_blocktime(before_); }

private:
    int before_;
#endif
};

}  // namespace

bool openmp_can_be_told() {
#ifdef __clang__
    return true;
#else
    return false;
#endif
}

void run_on_openmp(std::uint32_t threads, std::uint32_t count, TeamBody body, void* data) {
    [[maybe_unused]] const NoSpinning quiet;
    const NoSignals of_new_threads;
#pragma omp parallel num_threads(int(threads))
    {
        const std::uint32_t index = std::uint32_t(omp_get_thread_num());
        if (index == 0) of_new_threads.give_back();
        if (index < count) body(data, index);
    }
}

void unbind_from_openmp() {
    const int places = omp_get_num_places();
    cpu_set_t all;
    CPU_ZERO(&all);
    for (int place = 0; place < places; ++place) {
        int processors[CPU_SETSIZE];
        const int count = omp_get_place_num_procs(place);
        if (count > CPU_SETSIZE) return;
        omp_get_place_proc_ids(place, processors);
        for (int i = 0; i < count; ++i)
            if (processors[i] < CPU_SETSIZE) CPU_SET(std::size_t(processors[i]), &all);
    }
    if (CPU_COUNT(&all) > 0) (void)::sched_setaffinity(0, sizeof all, &all);
}

}  // namespace pileus
