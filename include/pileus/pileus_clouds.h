/* SPDX-License-Identifier: Apache-2.0
 * Skies of many clouds: kinds that are prepared once and stand in as many places as you like. C99.
 *
 * The sky around them is a session of pileus.h over a scene without media: its camera, sun, air or
 * sky, ground, depths and frame number are those of the pictures, and are set in it. A kind is a
 * world and a scene as for a session of its own. Rules are those of pileus.h; one thread uses a sky
 * and its clouds at a time. docs/clouds.md
 */
#ifndef PILEUS_CLOUDS_H
#define PILEUS_CLOUDS_H

#include "pileus.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pileus_clouds pileus_clouds;

/** Clouds in a sky, none at first. `sky` may be drawn by itself, too, and is then without clouds;
 * freed before them it goes with the last of its clouds. PILEUS_BAD_INPUT: a session with media,
 * one of a flight. */
PILEUS_API pileus_code pileus_clouds_create(pileus_session* sky, pileus_clouds** clouds,
                                            pileus_error* error);
PILEUS_API void pileus_clouds_free(pileus_clouds* clouds);

/** A kind of cloud: media in boxes, with a method of sessions. Of its scene sun, sky, air, ground,
 * lights and camera do not count. `kind` is its number, from 0 on. World and scene may be freed
 * afterwards. */
PILEUS_API pileus_code pileus_clouds_add_kind(pileus_clouds* clouds, const pileus_world* world,
                                              const pileus_scene* scene, uint32_t* kind,
                                              pileus_error* error);

/** Where a cloud stands: turned about the z axis through its kind's origin (counter-clockwise seen
 * from above), made larger, then shifted. */
typedef struct pileus_cloud {
    uint32_t struct_size;
    uint32_t kind;
    double offset_m[3]; /**< each within 1e7 */
    double yaw_deg;     /**< -360 to 360; clouds of one kind and turn share their light */
    double scale;       /**< 0.01 to 100, 0: 1; the optical thickness stays as it is */
} pileus_cloud;

/** All clouds, up to 1000, in place of those that there were; each element has the size that the
 * first tells.
 * One that has the number and the place that it had keeps its pictures. What a new kind or turn
 * needs is lit with the next picture. */
PILEUS_API pileus_code pileus_clouds_place(pileus_clouds* clouds, const pileus_cloud* places,
                                           uint32_t count, pileus_error* error);

/** How exact far clouds are. 0 in a member: what is in brackets. */
typedef struct pileus_cloud_detail {
    uint32_t struct_size;
    int32_t off;           /**< not 0: every cloud is marched whole in every picture */
    double error_px;       /**< pixels that parts of a far cloud may be off, 0.001 to 16 [0.5] */
    double near_px;        /**< clouds of that size are marched in every picture [256] */
    uint32_t near_scale;   /**< of those one pixel of so many along x and y, 1, 2, 4 [2] */
    uint32_t blend_frames; /**< over which an impostor of a far cloud cross-fades to the next [8] */
    double sharpness;      /**< texels of a far cloud for a pixel along x and y, 0.25 to 4 [1] */
    uint64_t frame_pixels; /**< of far clouds that one picture may draw anew [60000] */
    double sun_deg;        /**< that the sun may move before clouds are lit anew, to 10 [0.5] */
} pileus_cloud_detail;
PILEUS_API pileus_code pileus_clouds_set_detail(pileus_clouds* clouds,
                                                const pileus_cloud_detail* detail,
                                                pileus_error* error);

/** Draws sky, ground and clouds for what the sky is set to now, as pileus_session_render does. */
PILEUS_API pileus_code pileus_clouds_render(pileus_clouds* clouds, const pileus_frame* frame,
                                            pileus_error* error);

/** Of the last picture. */
typedef struct pileus_cloud_stats {
    uint32_t struct_size;
    uint32_t clouds, visible; /**< in all; of them in the picture */
    uint32_t marched;         /**< drawn anew for this picture */
    uint32_t captured;        /**< far clouds whose picture was drawn anew */
    uint32_t lit;             /**< kinds in a turn that were lit */
    uint64_t marched_pixels, captured_pixels;
    double worst_px; /**< largest error of a far cloud's picture, in pixels */
} pileus_cloud_stats;
PILEUS_API pileus_code pileus_clouds_stats(const pileus_clouds* clouds, pileus_cloud_stats* stats,
                                           pileus_error* error);

#ifdef __cplusplus
}
#endif

#endif /* PILEUS_CLOUDS_H */
