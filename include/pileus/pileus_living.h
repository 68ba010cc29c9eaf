/* SPDX-License-Identifier: Apache-2.0
 * The part of pileus.h that replaces a session's density; included by it, not by itself.
 * docs/living.md.
 */
#ifndef PILEUS_H
#error "include pileus.h"
#endif
#ifndef PILEUS_LIVING_H
#define PILEUS_LIVING_H

/* ---- Clouds that live -------------------------------------------------------------------- */

/** Exchanges two sessions over different worlds: from its next picture on `session` draws the world
 * of `next` by the light that `next` was given, and its own last picture fades away over `frames`
 * pictures; picture i of them has i / frames of the new world. 0 and 1 switch at once, and so does
 * a session without a picture; at most 10 000. `next` gets what `session` drew before, to be freed
 * or to be lit over a later world (a session belongs to its world: make another one). A hand-over
 * while an earlier one fades goes on from the mixture that was shown.
 *
 * `session` keeps its camera, depth image, placement and frame number, its work where both scenes
 * allow the same, its threads, and its host's functions; memory goes back to whom it came from.
 * Sun, sky, ground and lights are those that were set in `next`: set them there before it is lit.
 *
 * Call it between two frames, before what is set for the next one. Neither session may be in use
 * meanwhile. PILEUS_BAD_INPUT: another method, another size of pictures, another number of threads,
 * a session of a flight or without media, the same session twice; a view that `next` cannot have.
 * PILEUS_LIMIT: out of memory. After a fault `session` is as it was. docs/living.md has a loop that
 * uses it. */
PILEUS_API pileus_code pileus_session_hand_over(pileus_session* session, pileus_session* next,
                                                uint32_t frames, pileus_error* error);

#endif /* PILEUS_LIVING_H */
