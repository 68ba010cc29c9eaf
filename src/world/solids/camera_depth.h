// SPDX-License-Identifier: Apache-2.0
// The distance to solid things as another program's image tells it, in place of meshes.
// in: camera.depth of a scene -> out: metres along each pixel's ray.
// docs/solids.md, "A depth image".
#pragma once
#include "src/io/images/image.h"
#include "src/world/solids/solids.h"

namespace pileus {

/// Fills solids.camera_depth from the scene's image, if it has one. kBadInput: no such file, no
/// channel Z among several, colours in a .pfm, another size than the picture's.
Status read_camera_depth(const Scene& scene, Solids& solids);

/// The same from a picture in memory; `name` opens the messages.
Status take_camera_depth(const Camera& camera, const std::string& name, const Image& image,
                         Solids& solids);

}  // namespace pileus
