/* SPDX-License-Identifier: Apache-2.0
 * A flight through a sky of a hundred clouds: two kinds, each in four turns, near and far.
 * in: a sky's scene file, a cloud's, frames, a file for the last picture -> out: a line for each
 * picture with its hash and what was drawn anew; a PPM file.
 * docs/clouds.md explains each step. Needs nothing but pileus.h and the C library. */
#include <pileus/pileus.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 960, HEIGHT = 540, CLOUDS = 100, KINDS = 2 };

static void check(pileus_code code, const pileus_error* error) {
    if (code == PILEUS_OK) return;
    fprintf(stderr, "%s\n", error->message);
    exit((int)code);
}

/* The same numbers on every machine. */
static double number(uint32_t* state) {
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / 16777216.0;
}

/* Streets of clouds, 3 km apart, to the horizon. */
static void place(pileus_cloud* clouds) {
    uint32_t state = 7;
    int i;
    for (i = 0; i < CLOUDS; ++i) {
        pileus_cloud* c = &clouds[i];
        PILEUS_INIT(*c);
        c->kind = (uint32_t)(i % KINDS);
        c->offset_m[0] = 3000.0 * (i % 10 - 4.5) * (1 + i / 10 * 0.35) + 1400 * number(&state);
        c->offset_m[1] = 4000 + i / 10 * (i / 10 + 1) * 800.0 + 1400 * number(&state);
        c->offset_m[2] = 700 + 300 * number(&state);
        c->yaw_deg = 90.0 * (int)(4 * number(&state));
        c->scale = 0.8 + 0.8 * number(&state);
    }
}

int main(int argc, char** argv) {
    static unsigned char colour[4 * WIDTH * HEIGHT];
    static pileus_cloud places[CLOUDS];
    const int frames = argc > 3 ? atoi(argv[3]) : 10;
    const char* const size = "camera.resolution=[960,540]";
    pileus_error error;
    pileus_scene* scene = NULL;
    pileus_world* world = NULL;
    pileus_session* sky = NULL;
    pileus_clouds* clouds = NULL;
    int kind, frame;
    PILEUS_INIT(error);
    if (argc < 3) {
        fprintf(stderr, "usage: %s SKY.toml CLOUD.toml [FRAMES [PICTURE.ppm]]\n", argv[0]);
        return 2;
    }

    /* Once: the sky, and each kind of cloud. */
    check(pileus_scene_read(argv[1], &size, 1, &scene, &error), &error);
    check(pileus_world_create(scene, NULL, NULL, 0, &world, &error), &error);
    check(pileus_session_create(world, scene, NULL, &sky, &error), &error);
    check(pileus_clouds_create(sky, &clouds, &error), &error);
    pileus_world_free(world);
    pileus_scene_free(scene);
    for (kind = 0; kind < KINDS; ++kind) {
        const char* overrides[5] = {"method.name=\"raymarch\"", "raymarch.steps=48",
                                    "raymarch.stop_below=0.003",
                                    "medium.0.resolution=[96,96,66]", NULL};
        char seed[40];
        sprintf(seed, "medium.0.shape_seed=%d", kind);
        overrides[4] = seed;
        check(pileus_scene_read(argv[2], overrides, 5, &scene, &error), &error);
        check(pileus_world_create(scene, NULL, NULL, 0, &world, &error), &error);
        check(pileus_clouds_add_kind(clouds, world, scene, NULL, &error), &error);
        pileus_world_free(world);
        pileus_scene_free(scene);
    }
    place(places);
    check(pileus_clouds_place(clouds, places, CLOUDS, &error), &error);

    /* Each frame: the camera, and a picture. */
    for (frame = 0; frame < frames; ++frame) {
        pileus_camera camera;
        pileus_frame picture;
        pileus_cloud_stats stats;
        uint64_t hash = 0;
        PILEUS_INIT(camera);
        camera.position_m[1] = camera.target_m[1] = 4.0 * frame;
        camera.position_m[2] = 1500;
        camera.target_m[1] += 100;
        camera.target_m[2] = 1503;
        camera.fov_deg = 50;
        check(pileus_session_set_camera(sky, &camera, &error), &error);
        PILEUS_INIT(picture);
        picture.colour = colour;
        picture.hash = &hash;
        check(pileus_clouds_render(clouds, &picture, &error), &error);
        PILEUS_INIT(stats);
        check(pileus_clouds_stats(clouds, &stats, &error), &error);
        printf("%d %016llx visible %u, marched %u, pictures made anew %u\n", frame,
               (unsigned long long)hash, stats.visible, stats.marched, stats.captured);
    }
    if (argc > 4) {
        FILE* file = fopen(argv[4], "wb");
        int i;
        if (file == NULL) return 4;
        fprintf(file, "P6\n%d %d\n255\n", WIDTH, HEIGHT);
        for (i = 0; i < WIDTH * HEIGHT; ++i) fwrite(colour + 4 * i, 1, 3, file);
        if (fclose(file) != 0) return 4;
    }
    pileus_clouds_free(clouds);
    pileus_session_free(sky);
    return 0;
}
