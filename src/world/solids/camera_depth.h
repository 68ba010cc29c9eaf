// SPDX-License-Identifier: Apache-2.0
// The distance to solid things as another program's image tells it, in place of meshes.
// in: camera.depth of a scene -> out: metres along each pixel's ray.
// docs/solids.md, "A depth image".
#pragma once
#include "src/io/images/image.h"
#include "src/run/context.h"
#include "src/scene/scene.h"

namespace pileus {

/// It belongs to one camera, so that a world may be seen by several.
struct CameraDepth {
    bool present = false;  ///< the scene has one; the array may not be there yet
    Buffer<float> metres;  ///< [pixel], along the ray; infinity: nothing solid
    std::size_t columns = 0;
    std::uint64_t broken = 0;    ///< values that were no numbers and count as infinity
    std::uint64_t negative = 0;  ///< and below 0, which count as 0

    /// A value along its ray; what is none counts. What hosts write for "nothing there" is as far
    /// as a float reaches.
    void put(std::size_t pixel, double value);
};

/// Whether the scene has one. kBadInput: on a device.
void outline_camera_depth(const Scene& scene, CameraDepth& depth);

/// Reads the scene's image, if it has one. kBadInput: no such file, no channel Z among several,
/// colours in a .pfm, another size than the picture's.
Status read_camera_depth(const Scene& scene, const Context& context, CameraDepth& depth);

/// The same from a picture in memory, in the unit of `files`; `name` opens the messages.
Status take_camera_depth(const Camera& camera, const ViewFiles& files, const std::string& name,
                         const Image& image, CameraDepth& depth);

}  // namespace pileus
