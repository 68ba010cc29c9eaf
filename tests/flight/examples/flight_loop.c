/* SPDX-License-Identifier: Apache-2.0
 * A flight in one block: a packed scene, frames under a sun and a camera that move.
 * in: a packed scene, frames, every how many frames a line is written -> out: a line with the hash
 * of the picture for each of those, one with the digest of all frames, one with what the block has
 * seen. docs/flight.md explains each step. Needs nothing but pileus.h and the C library. */
#include <pileus/pileus.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int check(pileus_code code, const pileus_error* error) {
    if (code != PILEUS_OK) fprintf(stderr, "%s\n", error->message);
    return (int)code;
}

/* Before the flight a program may read files and ask for memory. `scene`: at a multiple of 64
 * bytes, within what is returned. */
static void* read_file(const char* path, size_t* size, void** scene) {
    FILE* file = fopen(path, "rb");
    long end;
    char* memory = NULL;
    if (file == NULL) return NULL;
    if (fseek(file, 0, SEEK_END) == 0 && (end = ftell(file)) > 0 && fseek(file, 0, SEEK_SET) == 0) {
        memory = (char*)malloc((size_t)end + 64);
        *scene = memory + (64 - (size_t)memory % 64) % 64;
        *size = memory != NULL ? fread(*scene, 1, (size_t)end, file) : 0;
    }
    fclose(file);
    return memory;
}

/* What moves: the camera to and fro, nearer and farther; the sun up and down. All of it exact: the
 * same numbers on every machine. */
static int fly(pileus_session* session, const pileus_camera* start, long frame,
               pileus_frame* picture, pileus_error* error) {
    pileus_camera camera = *start;
    pileus_sun sun;
    const long step = frame % 128;
    const double share = (double)(step < 64 ? step : 128 - step) / 64;
    PILEUS_INIT(sun);
    camera.position_m[0] += 1000 * share;
    camera.position_m[1] += 1500 * share;
    sun.present = 1;
    sun.azimuth_deg = 120;
    sun.elevation_deg = 20 + 25 * share;
    sun.irradiance[0] = sun.irradiance[1] = sun.irradiance[2] = 1;
    if (pileus_session_set_frame(session, (int32_t)frame, error)) return 1;
    if (pileus_session_set_camera(session, &camera, error)) return 1;
    if (pileus_session_set_sun(session, &sun, error)) return 1;
    if (pileus_session_step(session, 1, NULL, error)) return 1;
    return (int)pileus_session_render(session, picture, error);
}

int main(int argc, char** argv) {
    const long frames = argc > 2 ? atol(argv[2]) : 10, every = argc > 3 ? atol(argv[3]) : 1;
    size_t scene_bytes = 0;
    void *file, *scene = NULL;
    long frame;
    uint64_t hash = 0, all = 0xcbf29ce484222325u;
    pileus_error error;
    pileus_packed packed;
    pileus_flight flight;
    pileus_flight_use use;
    pileus_frame picture;
    pileus_camera camera;
    pileus_session* session = NULL;
    PILEUS_INIT(error);
    PILEUS_INIT(packed);
    PILEUS_INIT(flight);
    PILEUS_INIT(use);
    PILEUS_INIT(picture);
    PILEUS_INIT(camera);
    if (argc < 2 || every < 1) {
        fprintf(stderr, "usage: %s PACKED_SCENE [FRAMES [EVERY]]\n", argv[0]);
        return 2;
    }
    file = read_file(argv[1], &scene_bytes, &scene);
    if (file == NULL) {
        fprintf(stderr, "%s: cannot be read\n", argv[1]);
        return 2;
    }
    if (check(pileus_packed_read(scene, scene_bytes, &packed, &error), &error)) return 2;

    /* One block, one picture. */
    picture.format = PILEUS_FORMAT_RGBA8_SRGB;
    picture.colour = malloc(4 * (size_t)packed.width * packed.height);
    picture.hash = &hash;
    flight.scene = scene;
    flight.scene_bytes = scene_bytes;
    flight.in_place = 1; /* the scene stays where it is */
    flight.block_bytes = (size_t)packed.in_place_bytes;
    flight.block = malloc(flight.block_bytes);
    flight.frame = &picture;
    if (check(pileus_flight_open(&flight, &session, &error), &error)) return 3;

    /* From here on nothing asks for memory. */
    camera.position_m[1] = -3000;
    camera.position_m[2] = 600;
    camera.target_m[2] = 900;
    camera.fov_deg = 40;
    for (frame = 0; frame < frames; ++frame) {
        int byte;
        if (fly(session, &camera, frame, &picture, &error))
            return check((pileus_code)error.code, &error);
        for (byte = 0; byte < 8; ++byte) all = (all ^ (hash >> (8 * byte) & 0xff)) * 0x100000001b3u;
        if (frame % every == 0)
            printf("%ld %08lx%08lx\n", frame, (unsigned long)(hash >> 32),
                   (unsigned long)(hash & 0xffffffffu));
    }
    printf("all %08lx%08lx\n", (unsigned long)(all >> 32), (unsigned long)(all & 0xffffffffu));
    if (check(pileus_flight_usage(session, &use, &error), &error)) return 1;
    printf("block %lu kept %lu opened %lu frame %lu refused %lu left %lu lost %lu\n",
           (unsigned long)use.block_bytes, (unsigned long)use.kept_bytes,
           (unsigned long)use.open_bytes, (unsigned long)use.frame_bytes,
           (unsigned long)use.refused, (unsigned long)use.kept, (unsigned long)use.lost);
    pileus_flight_close(session);
    free(flight.block);
    free(file);
    free(picture.colour);
    return use.refused + use.kept + use.lost == 0 ? 0 : 1;
}
