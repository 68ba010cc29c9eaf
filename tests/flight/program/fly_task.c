/* SPDX-License-Identifier: Apache-2.0
 * Flies packed scenes by the example of a task, with hooks that do no more than count: the digests are
 * those of flight_loop.c. in: [frames, packed scenes] -> out: a line each with the digest of all frames.
 * For this machine and for images of bare metal. docs/flight.md, "Bare metal" */
#include <stdint.h>

#include "tests/flight/bare/board.h"
#include "tests/flight/examples/flight_task.h"

typedef struct counts {
    uint32_t frames, slices, periods, time;
    uint64_t all;
} counts;

static uint32_t ticks(void* user) { return ((counts*)user)->time; }

static void delay_until(void* user, uint32_t* last, uint32_t period) {
    counts* const c = (counts*)user;
    *last += period;
    c->time = *last;
    ++c->periods;
}

static void yield(void* user) { ++((counts*)user)->slices; }

/* As flight_loop.c moves them: exact, the same numbers on every machine. */
static int move(void* user, uint32_t frame, pileus_camera* camera, pileus_sun* sun) {
    const uint32_t step = frame % 128;
    const double share = (double)(step < 64 ? step : 128 - step) / 64;
    if (frame == ((counts*)user)->frames) return 0;
    camera->position_m[0] = 1000 * share;
    camera->position_m[1] = -3000 + 1500 * share;
    camera->position_m[2] = 600;
    camera->target_m[2] = 900;
    camera->fov_deg = 40;
    sun->present = 1;
    sun->azimuth_deg = 120;
    sun->elevation_deg = 20 + 25 * share;
    sun->irradiance[0] = sun->irradiance[1] = sun->irradiance[2] = 1;
    return 1;
}

static void show(void* user, uint32_t frame, uint64_t hash) {
    counts* const c = (counts*)user;
    int byte;
    (void)frame;
    for (byte = 0; byte < 8; ++byte) c->all = (c->all ^ (hash >> (8 * byte) & 0xff)) * 0x100000001b3u;
}

/* "all ", sixteen digits and an end of line. */
static void print_digest(uint64_t all) {
    char line[22] = "all ";
    int i;
    for (i = 0; i < 16; ++i) line[4 + i] = "0123456789abcdef"[all >> (60 - 4 * i) & 15];
    line[20] = '\n';
    line[21] = 0;
    board_print(line);
}

static uint32_t number_of(const char* text) {
    uint32_t value = 0;
    while (*text >= '0' && *text <= '9') value = 10 * value + (uint32_t)(*text++ - '0');
    return value;
}

/* Scene, picture and block lie in `memory`, one behind the other. */
static int fly(const char* name, uint32_t frames, char* memory, size_t room) {
    flight_task task = {0};
    counts counted = {0, 0, 0, 0, 0xcbf29ce484222325u};
    pileus_packed packed;
    size_t at = (64 - (size_t)memory % 64) % 64, size, pixels;
    PILEUS_INIT(task.error);
    PILEUS_INIT(packed);
    PILEUS_INIT(task.picture);
    PILEUS_INIT(task.flight);
    task.flight.scene = memory + at;
    size = board_read(name, memory + at, room - at);
    if (size == 0) {
        board_print("cannot be read\n");
        return 2;
    }
    task.flight.scene_bytes = size;
    at += (size + 63) / 64 * 64;
    if (pileus_packed_read(task.flight.scene, size, &packed, &task.error) == PILEUS_OK) {
        pixels = 4 * (size_t)packed.width * packed.height;
        task.picture.format = PILEUS_FORMAT_RGBA8_SRGB;
        task.picture.colour = memory + at;
        at += (pixels + 63) / 64 * 64;
        task.flight.in_place = 1;
        task.flight.block = memory + at;
        task.flight.block_bytes = (size_t)packed.in_place_bytes;
        if (at >= room || task.flight.block_bytes > room - at) {
            board_print("too little memory\n");
            return 2;
        }
        counted.frames = frames;
        task.hooks.user = &counted;
        task.hooks.ticks = ticks;
        task.hooks.delay_until = delay_until;
        task.hooks.yield = yield;
        task.hooks.move = move;
        task.hooks.show = show;
        task.period = 100;
        task.units = 1;
        if (flight_task_run(&task) == PILEUS_OK) {
            const int sound = counted.periods == frames && counted.slices == frames &&
                              task.use.refused + task.use.kept + task.use.lost == 0;
            print_digest(counted.all);
            if (!sound) board_print("pieces kept, refused or lost\n");
            return sound ? 0 : 1;
        }
    }
    board_print(task.error.message);
    board_print("\n");
    return 1;
}

int main(int argc, char** argv) {
    void* memory = NULL;
    const size_t room = board_memory(&memory);
    int i, status = 0;
    if (argc < 3 || number_of(argv[1]) == 0 || memory == NULL) {
        board_print("usage: fly_task FRAMES PACKED_SCENE...\n");
        return 2;
    }
    for (i = 2; i < argc; ++i) {
        const int one = fly(argv[i], number_of(argv[1]), (char*)memory, room);
        if (one > status) status = one;
    }
    return status;
}
