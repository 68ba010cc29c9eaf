// SPDX-License-Identifier: Apache-2.0
// What every stage may use besides its input: threads, kernels, progress, and the stage clock.
// in: options of a run -> out: stages timed one after the other into the report.
#pragma once
#include <functional>

#include "kernels_cpu/isa/kernels.h"
#include "src/base/limits.h"
#include "src/plan/part_light.h"
#include "src/plan/report.h"
#include "src/run/stage_clock.h"

namespace pileus {

class WorkShare;

struct Context {
    int threads = 1;
    const KernelTable* kernels = nullptr;
    Report* report = nullptr;
    Limits limits;
    std::uint64_t frames = 1;      ///< pictures of this run
    WorkPart part;                 ///< of each, that this run works on
    WorkShare* sharing = nullptr;  ///< of fluxes, where several processes measure one
    bool digests = true;           ///< of what a picture is made from go to the report
    std::function<void(const char* stage, double share)> progress;
    std::function<bool()> interrupted;  ///< whether the user wants an end
    std::function<void(bool)> holding;  ///< told whether an end now would lose light

    bool stop() const { return interrupted && interrupted(); }
    void hold(bool light) const {
        if (holding) holding(light);
    }
    void tell(const char* stage, double share) const {
        if (progress) progress(stage, share);
    }
};

/// Pieces [0, pieces) of work over the threads, function(piece, thread), until `ended()` says so:
/// the calling thread asks before all and between its pieces, the others end after theirs. An empty
/// function never ends. Returns whether all pieces ran.
template <class Function>
bool run_until(int threads, std::int64_t pieces, const std::function<bool()>& ended,
               Function function);

/// How long a piece of a picture may run before it is ended within, seconds: a shorter one is
/// finished, so that the picture is one of whole passes.
constexpr double kPatienceSeconds = 1.0;

/// context.stop(), but only once `kPatienceSeconds` have passed since now.
std::function<bool()> patient_stop(const Context& context);

/// Rows [0, rows) of a kernel in pieces over the threads.
template <class Kernel, class Params, class Buffers>
void run_host_rows(const Context& context, Kernel kernel, const Params& params,
                   const Buffers& buffers, std::uint32_t rows);

/// The same, or all of them on the device. Fails where a device does.
template <class Kernel, class Params, class Buffers>
Status run_rows(const Context& context, Kernel kernel, const Params& params, const Buffers& buffers,
                std::uint32_t rows);

}  // namespace pileus

#include <atomic>

#include "platform/threads.h"
#include "src/run/device_launch.h"
#include "src/run/on_device.h"

namespace pileus {

template <class Function>
bool run_until(int threads, std::int64_t pieces, const std::function<bool()>& ended,
               Function function) {
    if (!ended) {
        parallel_for(threads, pieces, function);
        return true;
    }
    if (ended()) return false;
    std::atomic<bool> end{false};
    parallel_for(threads, pieces, [&](std::int64_t piece, int thread) {
        // Thread 0 is the caller: what it calls back need not be ready for several threads.
        if (thread == 0 && !end.load() && ended()) end.store(true);
        if (!end.load()) function(piece, thread);
    });
    return !end.load();
}

template <class Kernel, class Params, class Buffers>
void run_host_rows(const Context& context, Kernel kernel, const Params& params,
                   const Buffers& buffers, std::uint32_t rows) {
    constexpr std::uint32_t kPiece = 4;
    parallel_for(context.threads, (rows + kPiece - 1) / kPiece, [&](std::int64_t piece, int) {
        const std::uint32_t begin = std::uint32_t(piece) * kPiece;
        kernel(params, buffers, begin, begin + kPiece < rows ? begin + kPiece : rows);
    });
}

template <class Kernel, class Params, class Buffers>
Status run_rows(const Context& context, Kernel kernel, const Params& params, const Buffers& buffers,
                std::uint32_t rows) {
    if (on_device(context.kernels->device))
        return launch_on_device(*context.kernels->device, params, buffers, rows);
    run_host_rows(context, kernel, params, buffers, rows);
    return Status::ok();
}

}  // namespace pileus
