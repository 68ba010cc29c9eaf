// SPDX-License-Identifier: Apache-2.0
// What every stage may use besides its input: threads, kernels, progress, and the stage clock.
// in: options of a run -> out: stages timed one after the other into the report.
#pragma once
#include <functional>

#include "kernels_cpu/isa/kernels.h"
#include "src/base/limits.h"
#include "src/base/report.h"

namespace pileus {

struct Context {
    int threads = 1;
    const KernelTable* kernels = nullptr;
    Report* report = nullptr;
    Limits limits;
    std::uint64_t frames = 1;  ///< pictures of this run
    std::function<void(const char* stage, double share)> progress;
    std::function<bool()> interrupted;  ///< whether the user wants an end

    bool stop() const { return interrupted && interrupted(); }
    void tell(const char* stage, double share) const {
        if (progress) progress(stage, share);
    }
};

/// Adds the time of its scope to the stage of that name.
class StageClock {
public:
    StageClock(const Context& context, const char* stage);
    ~StageClock();
    StageClock(const StageClock&) = delete;
    StageClock& operator=(const StageClock&) = delete;

private:
    Report* report_;
    const char* stage_;
    double wall_, cpu_;
};

/// Rows [0, rows) of a kernel in pieces over the threads, or all of them on the device. Fails where
/// a device does.
template <class Kernel, class Params, class Buffers>
Status run_rows(const Context& context, Kernel kernel, const Params& params, const Buffers& buffers,
                std::uint32_t rows);

}  // namespace pileus

#include "platform/threads.h"
#include "src/run/device_launch.h"

namespace pileus {

template <class Kernel, class Params, class Buffers>
Status run_rows(const Context& context, Kernel kernel, const Params& params, const Buffers& buffers,
                std::uint32_t rows) {
    constexpr std::uint32_t kPiece = 4;
    if (context.kernels->device != nullptr)
        return launch_on_device(*context.kernels->device, params, buffers, rows);
    parallel_for(context.threads, (rows + kPiece - 1) / kPiece, [&](std::int64_t piece, int) {
        const std::uint32_t begin = std::uint32_t(piece) * kPiece;
        kernel(params, buffers, begin, begin + kPiece < rows ? begin + kPiece : rows);
    });
    return Status::ok();
}

}  // namespace pileus
