// SPDX-License-Identifier: Apache-2.0
// See context.h and stage_clock.h; in no flight, which has no clock.
#include "src/run/context.h"

#include "platform/clock.h"

namespace pileus {

std::function<bool()> patient_stop(const Context& context) {
    if (!context.interrupted) return {};
    const double since = wall_seconds();
    return
        [&context, since] { return wall_seconds() - since > kPatienceSeconds && context.stop(); };
}

StageClock::StageClock(const Context& context, const char* stage)
    : report_(context.report), stage_(stage) {
    context.tell(stage, 0);
    wall_ = wall_seconds();
    cpu_ = cpu_seconds();
}

StageClock::~StageClock() {
    const double wall = wall_seconds() - wall_, cpu = cpu_seconds() - cpu_;
    for (StageTime& s : report_->clocks.stages)
        if (s.name == stage_) {
            s.wall_s += wall;
            s.cpu_s += cpu;
            return;
        }
    report_->clocks.stages.push_back({stage_, wall, cpu});
}

}  // namespace pileus
