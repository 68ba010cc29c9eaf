/* SPDX-License-Identifier: Apache-2.0
 * A flight library through every work and every kind of picture: run by tools/flight.
 * in: a small packed scene, every how many of all settings one is tried -> out: "sound", or what is
 * wrong and exit status 1. docs/flight.md, "Promises" */
#include "tests/flight/program/fly_settings.h"

#include <stdlib.h>

static int wrong(const char* what) {
    printf("%s\n", what);
    return 1;
}

static unsigned char scene[1 << 24];
static int fits(pileus_session* session, const char** what);
static int comes_near(pileus_session* session, const pileus_frame* frame, const char** what);

int main(int argc, char** argv) {
    FILE* file = argc > 1 ? fopen(argv[1], "rb") : NULL;
    const size_t bytes = file != NULL ? fread(scene, 1, sizeof scene, file) : 0;
    const unsigned stride = argc > 2 ? (unsigned)atoi(argv[2]) : 1;
    const char* what = NULL;
    size_t pixels, i;
    uint64_t hash = 0;
    int kind;
    flown_memory memory;
    pileus_error error;
    pileus_packed packed;
    PILEUS_INIT(error);
    PILEUS_INIT(packed);
    if (file != NULL) fclose(file);
    if (pileus_packed_read(scene, bytes, &packed, &error) != PILEUS_OK) return wrong(error.message);
    pixels = (size_t)packed.width * packed.height;
    memory.pixels[0] = memory.pixels[1] = (unsigned char*)calloc(pixels, 16);
    memory.depths[0] = memory.depths[1] = (float*)calloc(pixels, sizeof(float));
    memory.solid = (float*)malloc(pixels * sizeof(float));
    for (i = 0; i < pixels; ++i) memory.solid[i] = i % 3 == 0 ? 3500.0f : 1e30f;
    /* Opened for one kind of picture, with depth images or without: all others fly, too. */
    for (kind = 0; kind < 8; ++kind) {
        const int solid = kind % 2;
        pileus_flight flight;
        pileus_flight_use use;
        pileus_frame frame;
        pileus_session* session = NULL;
        PILEUS_INIT(flight);
        PILEUS_INIT(use);
        flown_opening(kind / 2, &memory, &hash, &frame);
        flight.scene = scene;
        flight.scene_bytes = bytes;
        flight.depth = solid;
        /* Depth images are not in what the packed scene tells. */
        flight.block_bytes = (size_t)packed.block_bytes + (solid ? 16 * pixels + 1024 : 0);
        flight.block = malloc(flight.block_bytes);
        flight.frame = &frame;
        if (pileus_flight_open(&flight, &session, &error) != PILEUS_OK) return wrong(error.message);
        what = fly_settings(session, NULL, &memory, pixels, solid, 0, (unsigned)kind, stride);
        if (what != NULL || fits(session, &what) || comes_near(session, &frame, &what))
            return wrong(what);
        if (pileus_flight_usage(session, &use, &error) != PILEUS_OK) return wrong(error.message);
        if (use.kept + use.lost != 0) return wrong("memory that was kept or lost");
        pileus_flight_close(session);
        free(flight.block);
    }
    free(memory.pixels[0]);
    free(memory.depths[0]);
    free(memory.solid);
    return wrong("sound") - 1;
}

/* The work that fits a budget, and that of the governor, from none to plenty of time. */
static int fits(pileus_session* session, const char** what) {
    pileus_error error;
    pileus_costs costs;
    pileus_governor governor;
    pileus_work work;
    int i;
    PILEUS_INIT(error);
    PILEUS_INIT(costs);
    PILEUS_INIT(governor);
    PILEUS_INIT(work);
    costs.pixel = costs.ray = costs.sample = costs.photon = 1;
    governor.target_s = 0.01;
    for (i = 0; i < 60; ++i) {
        pileus_frame nothing;
        pileus_code code = i % 2 == 0 ? pileus_session_fit(session, &costs, i * 1e4, &work, &error)
                                      : pileus_session_govern(session, &governor, i < 40 ? 1.0 : 1e-4,
                                                              &work, &error);
        PILEUS_INIT(nothing);
        /* Of some methods the view decides what they take; of the least work it may be too much. */
        if (code == PILEUS_OK || code == PILEUS_ERROR_LIMIT)
            code = pileus_session_set_work(session, &work, &error);
        else if (i % 2 == 0 && strstr(error.message, "units: ") == error.message)
            code = PILEUS_OK;
        if (code == PILEUS_OK) code = pileus_session_step(session, 1, NULL, &error);
        if (code == PILEUS_OK) code = pileus_session_render(session, &nothing, &error);
        if (code != PILEUS_OK) {
            static char said[400];
            sprintf(said, "fit, governor: %.300s", error.message);
            *what = said;
            return 1;
        }
    }
    return 0;
}

/* Views from within, which may ask for more than there is: that is told, and the next one is drawn. */
static int comes_near(pileus_session* session, const pileus_frame* frame, const char** what) {
    pileus_error error;
    pileus_camera camera;
    int i;
    PILEUS_INIT(error);
    PILEUS_INIT(camera);
    camera.target_m[0] = 1;
    camera.target_m[2] = 1024;
    camera.near_m = 1;
    camera.fov_deg = 90;
    for (i = 0; i < 24; ++i) {
        pileus_code code;
        camera.position_m[1] = i % 2 == 0 ? -4000 : -1000 + 100 * i;
        camera.position_m[2] = 1000;
        code = pileus_session_set_camera(session, &camera, &error);
        if (code == PILEUS_OK) code = pileus_session_render(session, frame, &error);
        if (code != PILEUS_OK && (i % 2 == 0 || code != PILEUS_ERROR_LIMIT)) {
            *what = "a view from within ended the flight";
            return 1;
        }
    }
    return 0;
}
