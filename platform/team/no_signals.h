// SPDX-License-Identifier: Apache-2.0
// Threads that are made below this get no signals: those are for the host's own.
// in: nothing -> out: all signals blocked on this thread, until the end or `give_back`.
#pragma once
#include <signal.h>

namespace pileus {

class NoSignals {
public:
    NoSignals() {
        sigset_t all;
        (void)::sigfillset(&all);
        (void)::pthread_sigmask(SIG_SETMASK, &all, &before_);
    }
    ~NoSignals() { give_back(); }
    NoSignals(const NoSignals&) = delete;
    NoSignals& operator=(const NoSignals&) = delete;

    void give_back() const { (void)::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

private:
    sigset_t before_;
};

}  // namespace pileus
