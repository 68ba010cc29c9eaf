/* SPDX-License-Identifier: Apache-2.0
 * A frame loop: camera and sun move over a cloud, which is blended over the program's own picture.
 * in: a scene file, a method, frames, "over" or "plain" (without the picture), a file for the last one
 * -> out: a line with the hash of each picture, a PPM file.
 * docs/embedding.md explains each step. Needs nothing but pileus.h and the C library. */
#include <pileus/pileus.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 160, HEIGHT = 90 };

static void check(pileus_code code, const pileus_error* error) {
    if (code == PILEUS_OK) return;
    fprintf(stderr, "%s\n", error->message);
    exit((int)code);
}

/* The picture that the program itself would draw: a slope of blue, and a wall 3 km away. */
static void draw_own_picture(unsigned char* colour, float* depth) {
    int x, y;
    for (y = 0; y < HEIGHT; ++y)
        for (x = 0; x < WIDTH; ++x) {
            unsigned char* pixel = colour + 4 * (y * WIDTH + x);
            const int wall = x < WIDTH / 4;
            pixel[0] = (unsigned char)(wall ? 90 : 40);
            pixel[1] = (unsigned char)(wall ? 80 : 90 + y / 2);
            pixel[2] = (unsigned char)(wall ? 70 : 200);
            pixel[3] = 255;
            depth[y * WIDTH + x] = wall ? 3000.0f : 1e30f;
        }
}

int main(int argc, char** argv) {
    static unsigned char colour[4 * WIDTH * HEIGHT];
    static float depth[WIDTH * HEIGHT];
    const int frames = argc > 3 ? atoi(argv[3]) : 10;
    const int over = argc <= 4 || strcmp(argv[4], "plain") != 0;
    char method[64];
    const char* overrides[5];
    int frame;
    uint32_t i;
    pileus_error error;
    pileus_scene* scene = NULL;
    pileus_world* world = NULL;
    pileus_session* session = NULL;
    pileus_progress light;
    pileus_camera camera;
    pileus_sun sun;
    PILEUS_INIT(error);
    PILEUS_INIT(light);
    PILEUS_INIT(camera);
    PILEUS_INIT(sun);
    if (argc < 2) {
        fprintf(stderr, "usage: %s SCENE [METHOD [FRAMES [over|plain [PICTURE.ppm]]]]\n", argv[0]);
        return 2;
    }

    /* Once: the world is read and prepared. */
    snprintf(method, sizeof method, "method.name=\"%s\"", argc > 2 ? argv[2] : "collectors");
    overrides[0] = method;
    overrides[1] = "collectors.photons=20000";
    overrides[2] = "collectors.generations=10";
    overrides[3] = "path.samples_per_pixel=2";
    overrides[4] = "camera.resolution=[160,90]";
    check(pileus_scene_read(argv[1], overrides, 5, &scene, &error), &error);
    check(pileus_world_create(scene, NULL, NULL, 0, &world, &error), &error);
    check(pileus_session_create(world, scene, NULL, &session, &error), &error);
    check(pileus_session_progress(session, &light, &error), &error);

    for (frame = 0; frame < frames; ++frame) {
        const double start[3] = {0, -3000, 600}, target[3] = {0, 0, 900};
        /* Photons stay for frames to come; paths belong to one camera. */
        const int stays = strcmp(light.unit, "generation") == 0;
        const uint32_t units = frame == 0 || !stays ? light.whole : 1;
        pileus_depth_image opaque;
        pileus_frame picture;
        uint64_t hash = 0;
        const double share = frames > 1 ? (double)frame / (frames - 1) : 0;
        PILEUS_INIT(opaque);
        PILEUS_INIT(picture);

        /* What has moved. */
        camera.width = WIDTH;
        camera.height = HEIGHT;
        camera.fov_deg = 40;
        memcpy(camera.target_m, target, sizeof target);
        pileus_orbit(start, target, 90 * share, camera.position_m);
        check(pileus_session_set_camera(session, &camera, &error), &error);
        sun.present = 1;
        sun.azimuth_deg = 65;
        sun.elevation_deg = 20 + 30 * share;
        for (i = 0; i < 3; ++i) sun.irradiance[i] = 1;
        check(pileus_session_set_sun(session, &sun, &error), &error);
        check(pileus_session_set_frame(session, frame, &error), &error);

        /* Light, then the cloud over the picture and behind the wall. */
        draw_own_picture(colour, depth);
        opaque.kind = PILEUS_DEPTH_DISTANCE;
        opaque.values = depth;
        if (over) check(pileus_session_set_depth(session, &opaque, &error), &error);
        check(pileus_session_step(session, units, NULL, &error), &error);
        picture.colour = colour;
        picture.format = PILEUS_FORMAT_RGBA8_SRGB;
        picture.blend = over ? PILEUS_BLEND_OVER : PILEUS_BLEND_REPLACE;
        picture.hash = &hash;
        check(pileus_session_render(session, &picture, &error), &error);
        printf("%d %08lx%08lx\n", frame, (unsigned long)(hash >> 32),
               (unsigned long)(hash & 0xffffffffu));
    }
    if (argc > 5) {
        FILE* file = fopen(argv[5], "wb");
        if (file == NULL) return 4;
        fprintf(file, "P6\n%d %d\n255\n", WIDTH, HEIGHT);
        for (i = 0; i < WIDTH * HEIGHT; ++i) fwrite(colour + 4 * i, 1, 3, file);
        fclose(file);
    }
    pileus_session_free(session);
    pileus_world_free(world);
    pileus_scene_free(scene);
    return 0;
}
