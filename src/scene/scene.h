// SPDX-License-Identifier: Apache-2.0
// The scene as a user wrote it, after checking: plain values in the units of the keys, in four
// parts. in: TOML (docs/scene.md) -> out: these structs. Functions take the part that they need.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "src/scene/description.h"
#include "src/scene/frame_state.h"
#include "src/scene/methods/method_tables.h"

namespace pileus {

// The text of a scene, and what messages and a picture's own record need of it.

struct SceneFile {
    std::vector<std::string> overrides;         ///< texts of the --set options
    std::string text;                           ///< the file's own text
    std::string file;                           ///< name for messages
    std::string directory;                      ///< paths in the scene are relative to it
    std::map<std::string, std::string> places;  ///< of its keys, "file:line:column", for messages
};

struct Scene : SceneFile, Description, FrameState, MethodTables {};

}  // namespace pileus
