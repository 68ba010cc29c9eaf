// SPDX-License-Identifier: Apache-2.0
// See process.h. The library's only writable global: the console's handler has no other way to be
// told.
#include <windows.h>

#include <atomic>
#include <cstring>

#include "platform/process.h"

namespace pileus {

namespace {

constexpr std::size_t kMaxWords = 120;

struct {
    std::atomic<bool> caught, asked, held;  ///< of catch_interrupts
    std::atomic<bool> waiting, came;        ///< of an InterruptHold
    char line[kMaxWords + 1];
    DWORD line_size;
    UINT exit_status;
} interrupt_state;

/// On a thread that Windows makes for it. FALSE: the program ends as ever.
BOOL WINAPI on_event(DWORD) {
    auto& s = interrupt_state;
    if (s.waiting) {
        s.came = true;
        return TRUE;
    }
    // The second ends it.
    if (!s.caught || s.asked.exchange(true)) return FALSE;
    if (s.held) return TRUE;
    DWORD written = 0;
    (void)::WriteFile(::GetStdHandle(STD_ERROR_HANDLE), s.line, s.line_size, &written, nullptr);
    // Ends all threads at once, and nothing that is written at an end is.
    (void)::TerminateProcess(::GetCurrentProcess(), s.exit_status);
    return TRUE;
}

}  // namespace

void catch_interrupts(const char* last_words, int exit_status) {
    auto& s = interrupt_state;
    std::size_t size = std::strlen(last_words);
    if (size > kMaxWords) size = kMaxWords;
    std::memcpy(s.line, last_words, size);
    if (size > 0) s.line[size++] = '\n';
    s.line_size = static_cast<DWORD>(size);
    s.exit_status = static_cast<UINT>(exit_status);
    if (!s.caught.exchange(true)) (void)::SetConsoleCtrlHandler(on_event, TRUE);
}

void hold_interrupts(bool hold) { interrupt_state.held = hold; }

bool interrupt_asked() { return interrupt_state.asked; }

InterruptHold::InterruptHold() {
    interrupt_state.came = false;
    interrupt_state.waiting = true;
    (void)::SetConsoleCtrlHandler(on_event, TRUE);
}

InterruptHold::~InterruptHold() {
    const bool came = pending();
    interrupt_state.waiting = false;
    (void)::SetConsoleCtrlHandler(on_event, FALSE);
    if (came) ::ExitProcess(static_cast<UINT>(STATUS_CONTROL_C_EXIT));
}

bool InterruptHold::pending() const { return interrupt_state.came; }

}  // namespace pileus
