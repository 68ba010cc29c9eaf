/* SPDX-License-Identifier: Apache-2.0
 * What a program of flights asks of the machine that it is tried on.
 * in: names, lines -> out: files in memory, lines where somebody reads them. By a debugger's calls
 * (semihosting.c) on bare metal, by the C library (board_host.c) elsewhere. */
#ifndef PILEUS_BOARD_H
#define PILEUS_BOARD_H
#include <stddef.h>

/* The file at `place`, which has `room` bytes. Returns its size, 0: cannot be read, or is larger.
 */
size_t board_read(const char* name, void* place, size_t room);
void board_print(const char* text);
/* All memory that the program does not have itself. Returns how many bytes. */
size_t board_memory(void** memory);

#endif
