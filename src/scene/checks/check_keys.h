// SPDX-License-Identifier: Apache-2.0
// Checks a scene's tree against the key table and then against the laws between keys.
// in: tree of an untrusted scene -> out: a Scene, and every fault with its place.
// docs/scene.md, sections Keys and Messages.
#pragma once
#include <map>
#include <string>
#include <string_view>

#include "src/scene/checks/fault_list.h"
#include "src/scene/keys/all_keys.h"

namespace pileus {

/// A key found in the scene under its full path, such as "medium.0.albedo".
struct FoundKey {
    const Node* node = nullptr;
    bool valid = false;  ///< type and range are as its row asks
};

/// What the checks share. `found` is ordered by path and points into the tree.
struct SceneCheck {
    Scene& scene;
    const Node& root;
    FaultList& faults;
    std::map<std::string, FoundKey> found;

    /// The node under a full path, or null; `valid_key` also asks that it passed its own check.
    const Node* key(const std::string& path) const;
    const Node* valid_key(const std::string& path) const;
};

/// Walks the tree: unknown and missing keys, types, ranges; calls the setters of sound values.
void check_keys(SceneCheck& check);

/// Takes over the path of a file to read, with the folder of the environment variable in place of
/// `${PILEUS_DATA_DIR}` at its front. Returns false after adding a fault.
bool check_path(SceneCheck& check, const Node& node, const char* key, std::string& file);

/// Laws between the keys of one medium: density, file, phase, bounds.
void check_medium(SceneCheck& check, std::size_t index);

/// Laws between the keys of meshes and of the camera's depth.
void check_solids(SceneCheck& check);
/// Laws between the keys of a procedural sky; fills in what its type brings.
void check_sky(SceneCheck& check, std::size_t index);

/// Laws between all other keys, and defaults that depend on other keys.
void check_scene(SceneCheck& check);

/// Checks one value against its row. Returns false after adding a fault for it.
bool check_value(const KeyRow& row, const Node& node, const std::string& path, FaultList& faults);

/// The nearest of `names` within a third of the length (at least 2) in edits; empty if none.
std::string nearest_name(std::string_view name, const std::vector<std::string>& names);

}  // namespace pileus
