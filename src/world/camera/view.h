// SPDX-License-Identifier: Apache-2.0
// The camera's basis in box-local metres, and the matrices that image files carry.
// in: the scene's camera, the low corner of the box -> out: CameraParams.
// Made in double with our own sine and cosine, then rounded once.
#pragma once
#include "kernels_cpu/core/camera.h"
#include "src/io/images/image.h"
#include "src/scene/scene.h"

namespace pileus {

/// `orbit_deg` turns the camera about the vertical axis through its target, counter-clockwise
/// seen from above.
CameraParams make_camera(const Camera& camera, double orbit_deg, const Double3& box_low_m);

/// A place turned about the vertical axis through `target_m`, counter-clockwise seen from above.
Double3 orbit(const Double3& position_m, const Double3& target_m, double degrees);

/// Metres along the ray of a pixel per metre along the view's axis; x and y from the top left of
/// the whole picture.
double ray_slant(const CameraParams& camera, double x, double y);

/// Angle between pixels' rays of a perspective camera, radians for small ones; metres between
/// parallel ones.
inline float pixel_step(const CameraParams& camera) {
    return 2 * camera.half_height / float(whole_height(camera));
}

/// Fills the image's world_to_camera, world_to_ndc (world metres, row vectors) and
/// screen_window_width, as OpenEXR's standard attributes have them: docs/formats.md.
void set_image_camera(const CameraParams& camera, const Double3& box_low_m, Image& image);

}  // namespace pileus
