/* SPDX-License-Identifier: Apache-2.0
 * See board.h: the calls of Arm's semihosting, which qemu and debuggers answer; and the start in C.
 * in: memory as image.ld divides it -> out: main() with a cleared .bss; its status at the end. */
#include <stdint.h>

#include "tests/flight/bare/board.h"

extern char image_bss[], image_bss_end[], image_end[], image_memory_end[];
int main(int argc, char** argv);
__attribute__((noreturn)) void _start(void);

static int32_t call(uint32_t number, const void* parameters) {
    register uint32_t r0 __asm__("r0") = number;
    register const void* r1 __asm__("r1") = parameters;
    __asm__ volatile("svc 0xab" : "+r"(r0) : "r"(r1) : "memory", "lr");
    return (int32_t)r0;
}

enum { kOpen = 1, kClose = 2, kWrite0 = 4, kRead = 6, kLength = 12, kCommand = 21, kExit = 32, kWords = 64 };

/* main() with the words of the command line. */
static int run(void) {
    static char line[1024], *words[kWords];
    uint32_t asked[2] = {(uint32_t)(uintptr_t)line, sizeof line};
    int count = 0;
    if (call(kCommand, asked) != 0) return 2;
    for (char* at = line; *at != 0 && count < kWords;) {
        words[count++] = at;
        while (*at != 0 && *at != ' ') ++at;
        while (*at == ' ') *at++ = 0;
    }
    return main(count, words);
}

void _start(void) {
    uint32_t ended[2] = {0x20026 /* by itself */, 0};
    for (char* byte = image_bss; byte != image_bss_end; ++byte) *byte = 0;
    ended[1] = (uint32_t)run();
    for (;;) call(kExit, ended);
}

size_t board_read(const char* name, void* place, size_t room) {
    uint32_t length = 0;
    while (name[length] != 0) ++length;
    const uint32_t opened[3] = {(uint32_t)(uintptr_t)name, 1 /* "rb" */, length};
    const int32_t file = call(kOpen, opened);
    if (file < 0) return 0;
    const uint32_t handle[1] = {(uint32_t)file};
    const int32_t size = call(kLength, handle);
    const uint32_t wanted[3] = {handle[0], (uint32_t)(uintptr_t)place, (uint32_t)size};
    const int whole = size > 0 && (size_t)size <= room && call(kRead, wanted) == 0;
    call(kClose, handle);
    return whole ? (size_t)size : 0;
}

void board_print(const char* text) { call(kWrite0, text); }

size_t board_memory(void** memory) {
    *memory = image_end;
    return (size_t)(image_memory_end - image_end);
}
