// SPDX-License-Identifier: Apache-2.0
// The files that rendering a scene reads.
// in: a checked scene -> out: paths.
// docs/program.md, "What is never overwritten"; docs/study.md, "Runs"
#pragma once
#include <string>
#include <vector>

#include "src/scene/scene.h"

namespace pileus {

/// Densities, tables of phase functions, the sky map, meshes with the files that a .gltf names, the
/// camera's depth image, and the scenes of kinds of clouds, each with what it reads, in this order
/// and each as often as it is named; relative to the
/// working directory, or absolute. The scene's own text is not among them, nor is the cache of
/// noise volumes, which holds nothing of a user's. Whether they are there shows when they are read.
std::vector<std::string> scene_files(const Scene& scene);

}  // namespace pileus
