/* SPDX-License-Identifier: Apache-2.0
 * See tests/flight/bare/board.h: a machine with a C library. in, out: its files, its standard output. */
#include <stdio.h>
#include <stdlib.h>

#include "tests/flight/bare/board.h"

size_t board_read(const char* name, void* place, size_t room) {
    FILE* const file = fopen(name, "rb");
    size_t size = 0;
    if (file == NULL) return 0;
    size = fread(place, 1, room, file);
    if (fgetc(file) != EOF) size = 0;
    fclose(file);
    return size;
}

void board_print(const char* text) { fputs(text, stdout); }

size_t board_memory(void** memory) {
    const size_t room = (size_t)1 << 30;
    *memory = malloc(room);
    return *memory != NULL ? room : 0;
}
