/* SPDX-License-Identifier: Apache-2.0
 * Flies a session through every work and every kind of picture, one after the other.
 * in: a session, another to compare with or null -> out: null, or what is wrong.
 * docs/flight.md, "What may change". For programs with the flight library and for tests. */
#ifndef PILEUS_FLY_SETTINGS_H
#define PILEUS_FLY_SETTINGS_H

#ifndef PILEUS_H /* tests find it elsewhere */
#include <pileus/pileus.h>
#endif
#include <stdio.h>
#include <string.h>

enum { kFlownWorks = 32, kFlownFormats = 5, kFlownBlends = 3, kFlownTargets = 60 };

/* Of the same picture twice: a flight's, and that of the session it is compared with. */
typedef struct flown_memory {
    unsigned char* pixels[2]; /* 16 bytes each */
    float* depths[2];
    float* solid; /* a depth image that hides a part */
} flown_memory;

/* What is set of frame `number`: all of it exact, and never twice the same view. */
static int flown_set(pileus_session* session, int number, const flown_memory* memory, int solid,
                     unsigned lamps, pileus_error* error) {
    pileus_camera camera;
    pileus_sun sun;
    pileus_depth_image depth;
    pileus_lamp lights[2];
    unsigned i;
    PILEUS_INIT(camera);
    PILEUS_INIT(sun);
    PILEUS_INIT(depth);
    camera.position_m[0] = 16 + 50 * (number % 8);
    camera.position_m[1] = -4000 + 250 * (number % 8);
    camera.position_m[2] = 256;
    camera.target_m[2] = 1024;
    camera.fov_deg = 40;
    camera.near_m = 1;
    sun.present = 1;
    sun.azimuth_deg = 120;
    sun.elevation_deg = 35 + 0.5 * (number % 16);
    sun.irradiance[0] = sun.irradiance[1] = sun.irradiance[2] = 1;
    if (pileus_session_set_frame(session, number, error)) return 1;
    if (pileus_session_set_camera(session, &camera, error)) return 1;
    if (pileus_session_set_sun(session, &sun, error)) return 1;
    if (solid >= 0) {
        depth.values = solid ? memory->solid : NULL;
        if (pileus_session_set_depth(session, &depth, error)) return 1;
    }
    for (i = 0; i < lamps && i < 2; ++i) {
        PILEUS_INIT(lights[i]);
        lights[i].light[0] = lights[i].light[1] = lights[i].light[2] = 1e6f;
        lights[i].position_m[1] = -700 - 10 * (number % 4);
        lights[i].position_m[2] = 900;
    }
    /* Now none, now one, now both. */
    if (lamps > 0 &&
        pileus_session_set_lamps(session, lights, (unsigned)number % (lamps + 1), error))
        return 1;
    return (int)pileus_session_step(session, 1, NULL, error);
}

/* Works that a session has: scales or temporal ones, slices of sunlight, all or less of the rest.
 */
static unsigned flown_works(const pileus_work* whole, pileus_work* out) {
    static const uint32_t kScales[] = {1, 2, 4}, kTemporal[] = {2, 4}, kRefresh[] = {1, 4, 64};
    const unsigned thin = whole->temporal > 0 ? 2 : whole->scale > 0 ? 3 : 1;
    const unsigned slices = whole->light_refresh > 0 ? 3 : 1;
    const unsigned less = whole->steps > 1 || whole->photons > 1 ? 2 : 1;
    unsigned i, j, k, count = 0;
    for (i = 0; i < thin; ++i)
        for (j = 0; j < slices; ++j)
            for (k = 0; k < less; ++k) {
                pileus_work* work = &out[count++];
                PILEUS_INIT(*work);
                if (whole->temporal > 0)
                    work->temporal = kTemporal[i];
                else if (whole->scale > 0)
                    work->scale = kScales[i];
                if (whole->light_refresh > 0) work->light_refresh = kRefresh[j];
                if (k == 1 && whole->steps > 1) work->steps = whole->steps / 2;
                if (k == 1 && whole->photons > 1) work->photons = whole->photons / 2;
            }
    return count;
}

static void flown_frame(int target, int which, const flown_memory* memory, uint64_t* hash,
                        pileus_frame* frame) {
    PILEUS_INIT(*frame);
    frame->format = (uint32_t)(target % kFlownFormats);
    frame->blend = (uint32_t)(target / kFlownFormats % kFlownBlends);
    frame->colour = memory->pixels[which];
    if (target / (kFlownFormats * kFlownBlends) % 2 == 1) frame->hash = hash;
    if (target / (2 * kFlownFormats * kFlownBlends) % 2 == 1) {
        frame->depth = memory->depths[which];
        frame->depth_format = (uint32_t)(target % 2);
    }
}

/* Of all works, targets and, with `solid`, depth images or none, every `stride`th from `first` on.
 */
static const char* fly_settings(pileus_session* session, pileus_session* other,
                                const flown_memory* memory, size_t pixels, int solid,
                                unsigned lamps, unsigned first, unsigned stride) {
    static char said[400];
    pileus_session* const both[2] = {session, other};
    pileus_work whole, works[kFlownWorks];
    pileus_error error;
    unsigned count, at, all;
    int number = 1;
    PILEUS_INIT(error);
    PILEUS_INIT(whole);
    if (pileus_session_work(session, &whole, &error)) return "pileus_session_work";
    count = flown_works(&whole, works);
    all = count * kFlownTargets * (solid ? 2 : 1);
    for (at = first; at < all; at += stride, ++number) {
        /* Works change fastest: from one to another in each frame. */
        const pileus_work* work = &works[at % count];
        const int target = (int)(at / count % kFlownTargets);
        const int hidden = solid ? (int)(at / count / kFlownTargets) : -1;
        uint64_t hash[2] = {0, 0};
        int i;
        for (i = 0; i < (other != NULL ? 2 : 1); ++i) {
            pileus_frame frame;
            pileus_code code = pileus_session_set_work(both[i], work, &error);
            /* One sum of photons has no smaller generations; what is refused does no harm. */
            if (code == PILEUS_ERROR_INPUT && work->photons > 0) code = PILEUS_OK;
            flown_frame(target, i, memory, &hash[i], &frame);
            if (code != PILEUS_OK || flown_set(both[i], number, memory, hidden, lamps, &error) ||
                pileus_session_render(both[i], &frame, &error)) {
                sprintf(said, "%s, work %u of %u, target %d, depth image %d: %.200s",
                        i == 0 ? "flight" : "session", at % count, count, target, hidden,
                        error.message);
                return said;
            }
        }
        if (other != NULL &&
            (hash[0] != hash[1] || memcmp(memory->pixels[0], memory->pixels[1], 16 * pixels) ||
             memcmp(memory->depths[0], memory->depths[1], sizeof(float) * pixels))) {
            sprintf(said,
                    "another picture than a session's: work %u of %u, target %d, depth image %d",
                    at % count, count, target, hidden);
            return said;
        }
    }
    return NULL;
}

/* How the four kinds of flights that are tried are opened. */
static void flown_opening(int kind, const flown_memory* memory, uint64_t* hash,
                          pileus_frame* frame) {
    static const int kTargets[4] = {0, 9, 2, 18};
    flown_frame(kTargets[kind], 0, memory, hash, frame);
}

#endif
