// SPDX-License-Identifier: Apache-2.0
// See interrupt.h. The library's one writable global: a signal has no other way to be told.
#include "platform/interrupt.h"

#include <signal.h>

namespace pileus {

namespace {

volatile sig_atomic_t interrupt_flag = 0;

void on_signal(int) { interrupt_flag = 1; }

void catch_one(int number) {
    struct sigaction before;
    if (sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) return;
    struct sigaction action = {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    // The second signal finds the default action; reads and writes go on.
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    (void)sigaction(number, &action, nullptr);
}

}  // namespace

void catch_interrupts() {
    catch_one(SIGINT);
    catch_one(SIGTERM);
}

bool interrupt_asked() { return interrupt_flag != 0; }

}  // namespace pileus
