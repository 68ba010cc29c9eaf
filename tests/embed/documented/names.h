/* SPDX-License-Identifier: Apache-2.0
 * What parts of programs in the pages call their own: handles, structs, memory.
 * in: - -> out: declarations. tests/embed/check_documented */
#ifndef PILEUS_DOCUMENTED_NAMES_H
#define PILEUS_DOCUMENTED_NAMES_H
#include <pileus/pileus.h>
#include <stdio.h>

extern pileus_scene *scene, *sky_scene;
extern pileus_world *world, *sky_world;
extern pileus_session *session, *sky, *next;
extern pileus_clouds* clouds;
extern pileus_sky* whole_sky;
extern pileus_depth_image depth;
extern void* colour;
extern double hours, view[16], projection[16];
extern int32_t number;
extern pileus_error error;
extern pileus_frame frame;
extern pileus_camera camera;
extern pileus_sun sun;
extern pileus_host* host;
extern pileus_governor governor;
extern pileus_work work;
extern pileus_costs costs, measured;
extern pileus_packed packed;
extern pileus_flight flight;
extern pileus_cloud* places;
extern uint32_t kind, count;
extern size_t scene_bytes;
extern void* block;
extern double seconds_of_last_frame;
#endif
