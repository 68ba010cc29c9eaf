// SPDX-License-Identifier: Apache-2.0
// A picture that was shown fades away while those of another density come.
// in: the last picture's planes and camera, a new picture -> out: planes of both by weight.
// docs/living.md
#pragma once
#include "src/picture/late_rows.h"
#include "src/run/context.h"

namespace pileus {

/// A picture, and where in it media show: rows [first, last), columns [left, right).
struct FadingPicture {
    Planes planes;  ///< of it transmittance, colour, background, cloud, opaque_depth
    std::int32_t width = 0, height = 0;
    std::int32_t first = 0, last = 0, left = 0, right = 0;
};

/// Whether planes are whole ones of so many pixels, but for what was left to the last pass.
bool are_whole(const Planes& planes, std::int32_t width, std::int32_t height);

/// What of a picture fades, and its half_depth, to another. kLimit: out of memory.
Status copy_picture(const Context& context, const Planes& from, Planes& to);

/// Takes such planes over and looks where media show. `late`: what of them
/// was left to the last pass and is made now (docs/realtime.md, "One pass after the march"), or
/// null. kLimit: out of memory; what is shown is as before.
Status keep_picture(const Context& context, std::int32_t width, std::int32_t height,
                    const LateRows* late, Planes& planes, FadingPicture& kept);

struct FadeInput {
    CameraParams before, camera;  ///< of the picture that fades, and of the new one
    MediumView medium;            ///< its box: where rays are when no depth is known
    float share = 1;              ///< of the new picture, 0 to 1
    bool solids = false;          ///< things that may have moved stand before or in the media
};

/// Whether new pictures like this one can be mixed with the one that fades: they have its planes.
bool can_mix(const FadeInput& in, const FadingPicture& old, const Planes& planes);

/// Mixes the picture that fades into a new one by weight, as the new one's camera sees it: an old
/// pixel is looked up where its place in the medium, or on the ground, was seen. What was not seen
/// then, or stands behind other things, stays the new picture's; so does the sky. `planes` have
/// half_depth where the cameras differ.
void mix_pictures(const Context& context, const FadeInput& in, const FadingPicture& old,
                  Planes& planes);

}  // namespace pileus
