/* SPDX-License-Identifier: Apache-2.0
 * A flight as a task of a real-time operating system: a frame a period, its light in slices of one
 * unit, between which tasks of the same priority run. No header of a system, no function of a C library.
 * in, out: see flight_task.h. docs/flight.md, "Tasks". */
#include "tests/flight/examples/flight_task.h"

/* No clock decides what is drawn: a late task draws the same pictures, later. */
static pileus_code draw(flight_task* task, pileus_session* session, uint32_t frame,
                        pileus_camera* camera, pileus_sun* sun) {
    pileus_error* const error = &task->error;
    uint32_t unit;
    pileus_code code = pileus_session_set_frame(session, (int32_t)frame, error);
    if (code == PILEUS_OK) code = pileus_session_set_camera(session, camera, error);
    if (code == PILEUS_OK) code = pileus_session_set_sun(session, sun, error);
    for (unit = 0; code == PILEUS_OK && unit < task->units; ++unit) {
        code = pileus_session_step(session, 1, NULL, error);
        task->hooks.yield(task->hooks.user);
    }
    if (code == PILEUS_OK) code = pileus_session_render(session, task->flight.frame, error);
    return code;
}

pileus_code flight_task_run(flight_task* task) {
    const flight_task_hooks* const hooks = &task->hooks;
    pileus_session* session = NULL;
    pileus_camera camera;
    pileus_sun sun;
    uint64_t hash = 0;
    uint32_t frame, last;
    pileus_code code;
    PILEUS_INIT(task->error);
    PILEUS_INIT(task->use);
    PILEUS_INIT(camera);
    PILEUS_INIT(sun);
    task->picture.hash = &hash;
    task->flight.frame = &task->picture;
    code = pileus_flight_open(&task->flight, &session, &task->error);
    if (code != PILEUS_OK) return code;
    last = hooks->ticks(hooks->user);
    for (frame = 0; hooks->move(hooks->user, frame, &camera, &sun) != 0; ++frame) {
        code = draw(task, session, frame, &camera, &sun);
        if (code != PILEUS_OK) break;
        hooks->show(hooks->user, frame, hash);
        hooks->delay_until(hooks->user, &last, task->period);
    }
    if (code == PILEUS_OK) code = pileus_flight_usage(session, &task->use, &task->error);
    pileus_flight_close(session);
    return code;
}
