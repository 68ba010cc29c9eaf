// SPDX-License-Identifier: Apache-2.0
// Threads that are made below this get no signals: those are for the host's own. Windows has none.
// in: nothing -> out: all signals blocked on this thread, until the end or `give_back`.
#pragma once
#include "platform/signal_mask.h"

namespace pileus {

class NoSignals {
public:
    NoSignals() : before_(block_all_signals()) {}
    ~NoSignals() { give_back(); }
    NoSignals(const NoSignals&) = delete;
    NoSignals& operator=(const NoSignals&) = delete;

    void give_back() const { set_signals(before_); }

private:
    SignalMask before_;
};

}  // namespace pileus
