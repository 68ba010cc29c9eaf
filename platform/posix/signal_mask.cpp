// SPDX-License-Identifier: Apache-2.0
// See signal_mask.h.
#include "platform/signal_mask.h"

#include "platform/posix/signals.h"

namespace pileus {

SignalMask block_all_signals() {
    sigset_t all, before;
    (void)sigfillset(&all);  // a macro on some systems
    (void)::pthread_sigmask(SIG_SETMASK, &all, &before);
    return mask_of(before);
}

void set_signals(const SignalMask& mask) {
    const sigset_t signals = signals_of(mask);
    (void)::pthread_sigmask(SIG_SETMASK, &signals, nullptr);
}

}  // namespace pileus
