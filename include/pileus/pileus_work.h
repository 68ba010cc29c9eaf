/* SPDX-License-Identifier: Apache-2.0
 * The part of pileus.h that says what a frame may cost; included by it, not by itself.
 * docs/realtime.md, "Work and the governor".
 */
#ifndef PILEUS_H
#error "include pileus.h"
#endif
#ifndef PILEUS_WORK_H
#define PILEUS_WORK_H

/* ---- Work ------------------------------------------------------------------------------- */

/** What a frame may cost, in units that no clock decides: the same work makes the same bits on any
 * machine. 0 in a member: as the scene has it. */
typedef struct pileus_work {
    uint32_t struct_size;
    uint32_t scale;    /**< 1, 2, 4: one pixel of so many along x and y is marched */
    uint32_t temporal; /**< 2, 4: the same by temporal reprojection; where the scene has it alone */
    uint32_t steps;    /**< most of a ray: raymarch, optical-depth; bins: particles, marched */
    uint32_t light_refresh; /**< 1 to 64: frames in which sunlight on nodes follows the sun */
    uint32_t reserved;
    uint64_t photons; /**< of one unit of light, at most the scene's: collectors, and photon-grid
                           with ring = true */
} pileus_work;

/** For the steps and pictures from now on. PILEUS_BAD_INPUT: a member that the session's method
 * does not have, or more photons than the scene's; in a flight also more steps. */
PILEUS_API pileus_code pileus_session_set_work(pileus_session* session, const pileus_work* work,
                                               pileus_error* error);
/** As it is set now, members filled in that the method has. */
PILEUS_API pileus_code pileus_session_work(const pileus_session* session, pileus_work* work,
                                           pileus_error* error);

/** What the governor remembers. Clear it by PILEUS_INIT and set target_s; the rest is its own. */
typedef struct pileus_governor {
    uint32_t struct_size;
    uint32_t level;  /**< 0: all of the scene's work; each more is less work */
    double target_s; /**< wall time that a frame may take, above 0 */
    uint32_t own_counts[4];
    double own_times[16];
} pileus_governor;

/** Chooses the work of the next frame. `frame_s`: seconds that the frame before took, by your own
 * clock; 0 before the first. The library looks at no clock: the same seconds give the same work.
 * Keep `work` beside the frame, set it, and the frame can be made again to the bit. */
PILEUS_API pileus_code pileus_session_govern(const pileus_session* session,
                                             pileus_governor* governor, double frame_s,
                                             pileus_work* work, pileus_error* error);

/** Maximum cost of a frame: one unit of light (pileus_session_step) and one picture. It
 * depends on the work, the sizes and the kinds of light, not on where the camera is or what it
 * sees. */
typedef struct pileus_units {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t pixels;  /**< of the picture */
    uint64_t rays;    /**< pixels that are marched; path: samples of pixels */
    uint64_t samples; /**< places at which these rays look up the medium; path: 0 */
    uint64_t photons; /**< of the unit of light: collectors, photon-grid */
} pileus_units;

/** Of a frame of this work; null: as it is set now. Ask once camera, lights and depths are set: a
 * picture that cannot use the one before (`temporal`) has all its pixels marched. PILEUS_BAD_INPUT:
 * as pileus_session_set_work; or what a frame takes depends on the view: particles, billboards, a
 * periodic medium that is marched by its cells. */
PILEUS_API pileus_code pileus_session_most_units(pileus_session* session, const pileus_work* work,
                                                 pileus_units* most, pileus_error* error);

/** What one unit of each costs where it costs the most, in seconds, instructions or whatever adds
 * up; `fixed`: of a frame whatever its work. 0 and more. docs/flight.md, "Work". */
typedef struct pileus_costs {
    uint32_t struct_size;
    uint32_t reserved;
    double fixed, pixel, ray, sample, photon;
} pileus_costs;

/** The governor's first work, from all to less and less, whose most units cost no more than `most`:
 * no clock, and no frame above it. PILEUS_LIMIT: even the least costs more; `work` is that. Errors:
 * those of pileus_session_most_units. */
PILEUS_API pileus_code pileus_session_fit(pileus_session* session, const pileus_costs* costs,
                                          double most, pileus_work* work, pileus_error* error);

#endif /* PILEUS_WORK_H */
