// SPDX-License-Identifier: Apache-2.0
// See process.h. The library's only writable global: a signal has no other way to be told.
#include <signal.h>
#include <string.h>
#include <unistd.h>

#include <cstddef>

#include "platform/process.h"

namespace pileus {

namespace {

constexpr std::size_t kMaxWords = 120;

struct {
    volatile sig_atomic_t asked, held;
    char line[kMaxWords + 1];
    std::size_t line_size;
    int exit_status;
} interrupt_state;

/// Calls nothing that a signal may not call.
void on_signal(int) {
    interrupt_state.asked = 1;
    if (interrupt_state.held != 0) return;
    (void)!write(STDERR_FILENO, interrupt_state.line, interrupt_state.line_size);
    _exit(interrupt_state.exit_status);
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
    auto& s = interrupt_state;
    s.line_size = strnlen(last_words, kMaxWords);
    memcpy(s.line, last_words, s.line_size);
    if (s.line_size > 0) s.line[s.line_size++] = '\n';
    s.exit_status = exit_status;
    catch_one(SIGINT);
    catch_one(SIGTERM);
}

void hold_interrupts(bool hold) { interrupt_state.held = hold ? 1 : 0; }

bool interrupt_asked() { return interrupt_state.asked != 0; }

}  // namespace pileus
