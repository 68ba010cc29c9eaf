/* SPDX-License-Identifier: Apache-2.0
 * A host with terrain of its own under the weather of a report: sky, clouds, haze, their shadows.
 * in: a scene with [atmosphere], a METAR, hours after the scene's time, a file for the picture ->
 * out: a line with the picture's checksum; a PPM file.
 * docs/whole-sky.md explains each step. Needs nothing but pileus.h and the C library. */
#include <math.h>
#include <pileus/pileus.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 640, HEIGHT = 360, SHADOW = 1024 };
static const double kShadowSize = 40000;

static void check(pileus_code code, const pileus_error* error) {
    if (code == PILEUS_OK) return;
    fprintf(stderr, "%s\n", error->message);
    exit((int)code);
}

/* The host's world: hills on a 3 km grid. */
static double hills(double x, double y) {
    return 120 + 90 * sin(x / 900) * sin(y / 1300) + 160 * sin(x / 4100 + 1) * sin(y / 3700);
}

/* The first hill along a ray, m; infinity: none. */
static float hill_at(const double eye[3], const double ray[3]) {
    double t;
    for (t = 5; t < 60000; t *= 1.01)
        if (eye[2] + t * ray[2] < hills(eye[0] + t * ray[0], eye[1] + t * ray[1])) return (float)t;
    return INFINITY;
}

int main(int argc, char** argv) {
    static float depth[WIDTH * HEIGHT], colour[4 * WIDTH * HEIGHT], shadow[SHADOW * SHADOW];
    static float heights[SHADOW * SHADOW];
    const char* const size = "camera.resolution=[640,360]";
    pileus_error error = pileus_error_default();
    pileus_depth_image host_depth = pileus_depth_image_default();
    pileus_shadow_map map = pileus_shadow_map_default();
    pileus_sky_light light = pileus_sky_light_default();
    pileus_camera camera = pileus_camera_default();
    pileus_frame frame = pileus_frame_default();
    pileus_scene* scene = NULL;
    pileus_sky* sky = NULL;
    double sum = 0;
    int x, y, c;
    if (argc < 4) {
        fprintf(stderr, "usage: %s SKY.toml METAR HOURS [PICTURE.ppm]\n", argv[0]);
        return 2;
    }

    /* Once: the sky, and its weather. */
    check(pileus_scene_read(argv[1], &size, 1, &scene, &error), &error);
    check(pileus_sky_create(scene, NULL, &sky, &error), &error);
    pileus_scene_free(scene);
    check(pileus_sky_set_weather(sky, argv[2], 1, 0, &error), &error);

    /* Each frame: the clock, the camera. */
    check(pileus_sky_set_time(sky, atof(argv[3]), &error), &error);
    camera.position_m[2] = 700;
    camera.target_m[1] = 1000;
    camera.target_m[2] = 760;
    camera.fov_deg = 55;
    check(pileus_session_set_camera(pileus_sky_session(sky), &camera, &error), &error);

    /* What the sky does to the host's world: its shadow, its light. */
    map.width = map.height = SHADOW;
    map.low_m[0] = map.low_m[1] = -kShadowSize / 2;
    map.size_m[0] = map.size_m[1] = kShadowSize;
    for (y = 0; y < SHADOW; ++y)
        for (x = 0; x < SHADOW; ++x)
            heights[y * SHADOW + x] = (float)hills(((x + 0.5) / SHADOW - 0.5) * kShadowSize,
                                                   (0.5 - (y + 0.5) / SHADOW) * kShadowSize);
    map.heights = heights;
    map.texels = shadow;
    map.format = PILEUS_SHADOW_R32F;
    check(pileus_sky_shadow(sky, &map, &error), &error);
    light.position_m[2] = 300;
    check(pileus_sky_light_at(sky, &light, 1, &error), &error);

    /* The host's own picture: radiance of its hills, and how far they are. */
    for (y = 0; y < HEIGHT; ++y)
        for (x = 0; x < WIDTH; ++x) {
            const double up = tan(27.5 * 3.14159265358979 / 180);
            const double sx = ((x + 0.5) / WIDTH * 2 - 1) * up * WIDTH / HEIGHT;
            const double sy = (1 - (y + 0.5) / HEIGHT * 2) * up, tilt = 0.06;
            const double dir[3] = {sx, 1 - tilt * sy, sy + tilt};
            const double length = sqrt(dir[0] * dir[0] + dir[1] * dir[1] + dir[2] * dir[2]);
            const double ray[3] = {dir[0] / length, dir[1] / length, dir[2] / length};
            const int i = y * WIDTH + x;
            depth[i] = hill_at(camera.position_m, ray);
            if (!(depth[i] < INFINITY)) continue;
            {
                const double px = ray[0] * depth[i], py = ray[1] * depth[i];
                const int u = (int)((px / kShadowSize + 0.5) * SHADOW);
                const int v = (int)((0.5 - py / kShadowSize) * SHADOW);
                const int inside = u >= 0 && v >= 0 && u < SHADOW && v < SHADOW;
                const float lit = inside ? shadow[v * SHADOW + u] : light.sun_share;
                const float albedo[3] = {0.07f, 0.1f, 0.04f};
                for (c = 0; c < 3; ++c) {
                    const float sun = light.sun_share > 0 ? light.sun[c] / light.sun_share : 0;
                    colour[4 * i + c] = albedo[c] / 3.14159f * (lit * 0.6f * sun + light.level[c]);
                }
                colour[4 * i + 3] = 1;
            }
        }

    /* All that is above the ground, over it. */
    host_depth.values = depth;
    frame.colour = colour;
    frame.format = PILEUS_FORMAT_RGBA32F;
    frame.blend = PILEUS_BLEND_OVER;
    check(pileus_sky_render(sky, &host_depth, &frame, &error), &error);
    for (x = 0; x < 4 * WIDTH * HEIGHT; ++x) sum += colour[x];
    printf("sum %.3f, sun %.4f of %.3f left\n", sum, light.sun_share, light.sun[1]);
    if (argc > 4) {
        FILE* file = fopen(argv[4], "wb");
        if (file == NULL) return 4;
        fprintf(file, "P6\n%d %d\n255\n", WIDTH, HEIGHT);
        for (x = 0; x < WIDTH * HEIGHT; ++x)
            for (c = 0; c < 3; ++c) {
                const double v = 255 * pow(1 - exp(-9.0 * colour[4 * x + c]), 1 / 2.2);
                fputc((int)v, file);
            }
        if (fclose(file) != 0) return 4;
    }
    pileus_sky_free(sky);
    return 0;
}
