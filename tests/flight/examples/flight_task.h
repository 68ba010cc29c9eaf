/* SPDX-License-Identifier: Apache-2.0
 * A flight as a task of a real-time operating system: see flight_task.c.
 * in: a packed scene, a block, a picture, what the system offers -> out: frames, each in its
 * period. docs/flight.md, "Tasks". */
#ifndef PILEUS_FLIGHT_TASK_H
#define PILEUS_FLIGHT_TASK_H
#include <pileus/pileus.h>

/* What the system and the machine offer. Of FreeRTOS: `ticks` calls xTaskGetTickCount(),
 * `delay_until` vTaskDelayUntil(last, period), `yield` taskYIELD(). */
typedef struct flight_task_hooks {
    void* user;
    uint32_t (*ticks)(void* user);
    void (*delay_until)(void* user, uint32_t* last, uint32_t period);
    void (*yield)(void* user);
    /* Camera and sun of a frame; 0: the task ends. */
    int (*move)(void* user, uint32_t frame, pileus_camera* camera, pileus_sun* sun);
    void (*show)(void* user, uint32_t frame, uint64_t hash);
} flight_task_hooks;

typedef struct flight_task {
    flight_task_hooks hooks;
    pileus_flight flight; /* scene, block */
    pileus_frame picture;
    pileus_flight_use use;
    uint32_t period; /* ticks of a frame */
    uint32_t units;  /* of light in a frame, one in a slice */
    pileus_error error;
} flight_task;

/* The body of the task: returns when `move` ends it, or with the code that error.message explains.
 */
pileus_code flight_task_run(flight_task* task);

#endif
