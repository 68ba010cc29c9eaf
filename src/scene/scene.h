// SPDX-License-Identifier: Apache-2.0
// The scene as a user wrote it, after checking: plain values in the units of the keys, in four
// parts. in: TOML (docs/scene.md) -> out: these structs. Functions take the part that they need.
#pragma once
#include "src/scene/description.h"
#include "src/scene/frame_state.h"
#include "src/scene/methods/method_tables.h"
#include "src/scene/scene_file.h"

namespace pileus {

struct Scene : SceneFile, Description, FrameState, MethodTables {};

}  // namespace pileus
