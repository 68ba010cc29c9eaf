// SPDX-License-Identifier: Apache-2.0
// Reads a scene from TOML and checks it completely.
// in: untrusted text and --set overrides -> out: a Scene that later stages can trust.
// docs/scene.md.
#pragma once
#include <string>
#include <vector>

#include "src/base/status.h"
#include "src/scene/scene.h"

namespace pileus {

/// Largest scene text in bytes.
constexpr std::size_t kMaxSceneBytes = std::size_t{1} << 20;

/// Reads the scene file at `path` and applies `overrides` ("key.path=value", later ones win).
/// Errors: kBadInput with one line per fault, also where the file is missing; kLimit for more than
/// 1 MiB of text; kIo when reading fails half way. `out` is changed only on success.
Status read_scene_file(const std::string& path, const std::vector<std::string>& overrides,
                       Scene& out);

/// The same for text in memory. `name` stands for the file in messages, `directory` is where
/// relative paths in the scene start.
Status read_scene_text(const std::string& text, const std::string& name,
                       const std::string& directory, const std::vector<std::string>& overrides,
                       Scene& out);

/// A path from a scene, relative to `directory` unless it is absolute or `directory` is empty.
std::string scene_path(const std::string& directory, const std::string& file);

}  // namespace pileus
