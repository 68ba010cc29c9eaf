// SPDX-License-Identifier: Apache-2.0
// See interrupt.h. The library's only writable globals: a signal has no other way to be told.
#include "platform/interrupt.h"

#include <signal.h>
#include <string.h>
#include <unistd.h>

#include <cstddef>

namespace pileus {

namespace {

constexpr std::size_t kMostWords = 120;

volatile sig_atomic_t interrupt_flag = 0;
volatile sig_atomic_t held = 0;
char line[kMostWords + 1];
std::size_t line_size = 0;
int status_of_end = 1;

/// Calls nothing that a signal may not call.
void on_signal(int) {
    interrupt_flag = 1;
    if (held != 0) return;
    (void)!write(STDERR_FILENO, line, line_size);
    _exit(status_of_end);
}

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

void catch_interrupts(const char* last_words, int exit_status) {
    line_size = strnlen(last_words, kMostWords);
    memcpy(line, last_words, line_size);
    line[line_size++] = '\n';
    status_of_end = exit_status;
    catch_one(SIGINT);
    catch_one(SIGTERM);
}

void hold_interrupts(bool hold) { held = hold ? 1 : 0; }

bool interrupt_asked() { return interrupt_flag != 0; }

}  // namespace pileus
