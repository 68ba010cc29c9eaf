// SPDX-License-Identifier: Apache-2.0
// The text of a scene, and what messages and a picture's own record need of it.
// in: a file, options -> out: plain values. docs/scene.md
#pragma once
#include <map>
#include <string>
#include <vector>

namespace pileus {

struct SceneFile {
    std::vector<std::string> overrides;         ///< texts of the --set options
    std::string text;                           ///< the file's own text
    std::string file;                           ///< name for messages
    std::string directory;                      ///< paths in the scene are relative to it
    std::map<std::string, std::string> places;  ///< of its keys, "file:line:column", for messages
};

}  // namespace pileus
