/* SPDX-License-Identifier: Apache-2.0
 * What a flight library does where things are not as they should be: run by tools/flight.
 * in: a packed scene -> out: "sound", or the first thing that is wrong and exit status 1.
 * docs/flight.md, "Promises" */
#include <pileus/pileus.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/flight/program/rounding.h"

static int wrong(const char* what) {
    printf("%s\n", what);
    return 1;
}

/* Threads of a host that has none. */
static void run(void* user, uint32_t count, void (*body)(void* data, uint32_t index), void* data) {
    uint32_t i;
    ++*(long*)user;
    for (i = count; i-- > 0;) body(data, i);
}

static unsigned char scene[1 << 24];

int main(int argc, char** argv) {
    FILE* file = argc > 1 ? fopen(argv[1], "rb") : NULL;
    size_t bytes = file != NULL ? fread(scene, 1, sizeof scene, file) : 0;
    uint64_t hash = 0, alone = 0;
    long calls = 0;
    int part;
    pileus_error error;
    pileus_packed packed;
    pileus_flight flight;
    pileus_flight_use use;
    pileus_frame picture;
    pileus_sun sun;
    pileus_session* session = NULL;
    PILEUS_INIT(error);
    PILEUS_INIT(packed);
    PILEUS_INIT(flight);
    PILEUS_INIT(use);
    PILEUS_INIT(picture);
    PILEUS_INIT(sun);
    if (file != NULL) fclose(file);
    if (pileus_packed_read(scene, bytes, &packed, &error) != PILEUS_OK) return wrong(error.message);
    picture.colour = malloc(4 * (size_t)packed.width * packed.height);
    picture.hash = &hash;
    flight.scene = scene;
    flight.scene_bytes = bytes;
    flight.block = malloc((size_t)packed.block_bytes);
    flight.frame = &picture;
    flight.user = &calls;

    /* Blocks that are too small, wherever they end: a code, and the caller's rounding as it was. */
    for (part = 0; part < 400; ++part) {
        /* In short steps small objects are what there is no room for, in long ones arrays. */
        flight.block_bytes = part < 200 ? 64 * (size_t)part
                                        : (size_t)(packed.block_bytes * (uint64_t)part / 800);
        flight.run = part % 2 == 0 ? run : NULL;
        flight.threads = 3;
        round_upwards(1);
        if (pileus_flight_open(&flight, &session, &error) == PILEUS_OK)
            pileus_flight_close(session);
        else if (error.code != PILEUS_ERROR_LIMIT)
            return wrong(error.message);
        if (!rounds_upwards()) return wrong("another rounding after opening in vain");
    }
    round_upwards(0);
    if (pileus_packed_read(scene, bytes - 1, &packed, &error) != PILEUS_ERROR_INPUT)
        return wrong("a scene cut short was taken");
    if (pileus_session_step(NULL, 1, NULL, &error) != PILEUS_ERROR_INPUT)
        return wrong("no session was taken for one");

    /* Alone and on lent threads: the same picture. What is out of range is refused and does no harm. */
    flight.block_bytes = (size_t)packed.block_bytes + (1 << 21);
    flight.block = realloc(flight.block, flight.block_bytes);
    for (part = 0; part < 2; ++part) {
        flight.run = part == 0 ? NULL : run;
        calls = 0;
        if (pileus_flight_open(&flight, &session, &error) != PILEUS_OK) return wrong(error.message);
        sun.present = 1;
        sun.elevation_deg = 91;
        if (pileus_session_set_sun(session, &sun, &error) != PILEUS_ERROR_INPUT)
            return wrong("a sun beyond the zenith was taken");
        if (strstr(error.message, "sun.elevation_deg") == NULL) return wrong(error.message);
        if (pileus_session_step(session, 1, NULL, &error) != PILEUS_OK ||
            pileus_session_render(session, &picture, &error) != PILEUS_OK ||
            pileus_flight_usage(session, &use, &error) != PILEUS_OK)
            return wrong(error.message);
        if (part == 0) alone = hash;
        if (part == 1 && calls == 0) return wrong("lent threads were not used");
        if (hash != alone) return wrong("another picture on lent threads");
        if (use.refused + use.kept + use.lost != 0) return wrong("memory that was kept or refused");
        pileus_flight_close(session);
    }
    free(flight.block);
    free(picture.colour);
    printf("sound\n");
    return 0;
}
