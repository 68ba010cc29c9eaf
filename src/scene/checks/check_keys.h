// SPDX-License-Identifier: Apache-2.0
// Checks a scene's tree against the key table and then against the laws between keys.
// in: tree of an untrusted scene -> out: a Scene, and every fault with its place.
// docs/scene.md, sections Keys and Messages.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "src/methods/support.h"
#include "src/scene/checks/fault_list.h"
#include "src/scene/keys/all_keys.h"
#include "src/scene/rows/picture_format.h"

namespace pileus {

/// A key of the scene under its full path, such as "medium.0.albedo".
struct FoundKey {
    const Node* node = nullptr;
    bool valid = false;  ///< type and range are as its row asks
    bool given = true;   ///< false: a value of a struct that is its default
};

/// What the checks share, whether a file was read or a program filled in the struct. `found` is
/// ordered by path and points at nodes that outlive the check.
struct SceneCheck {
    Scene& scene;
    FaultList& faults;
    bool written = true;  ///< a text was read: what it leaves out is filled in
    std::map<std::string, FoundKey> found;

    /// The node under a full path where it is given, or null; `valid_key` also asks that it passed
    /// its own check. `lacks`: there is no value, not even a default.
    const Node* key(const std::string& path) const;
    const Node* valid_key(const std::string& path) const;
    bool lacks(const std::string& path) const { return found.find(path) == found.end(); }
};

/// Walks the tree: unknown and missing keys, types, ranges; calls the setters of sound values.
void check_keys(const Node& root, SceneCheck& check);

/// Takes the values of check.scene for what was written: their ranges, by the rows. `values` holds
/// the nodes.
void check_fields(std::vector<std::unique_ptr<Node>>& values, SceneCheck& check);

/// Takes over the path of a file to read, with the folder of the environment variable in place of
/// `${PILEUS_DATA_DIR}` at its front. Returns false after adding a fault.
bool check_path(SceneCheck& check, const Node& node, const char* key, std::string& file);

/// The same of a picture, of a format that `use` takes.
void check_picture(SceneCheck& check, const Node& node, const char* key,
                   bool (*use)(const PictureFormat&), std::string& file);

/// A fault of a node's value: what is wrong, the value, what is allowed.
void add_refusal(SceneCheck& check, const Node& node, const std::string& key,
                 const std::string& what, const std::string& value, const std::string& allowed);

/// The same in the words of the support table.
inline void add_refusal(SceneCheck& check, const Node& node, const std::string& key,
                        const Support& entry, const std::string& value) {
    add_refusal(check, node, key, entry.text, value, entry.allowed);
}

/// A fault of a key, where it is given, that does not go with something else.
void conflict(SceneCheck& check, const std::string& key, const char* with);

/// Laws between the keys of one medium: density, file, phase, bounds.
void check_medium(SceneCheck& check, std::size_t index);
/// Laws between the keys of the ground's surface.
void check_surface(SceneCheck& check);
/// Laws between the keys of detail beyond its grid.
void check_detail(SceneCheck& check, std::size_t index);
/// Each phase function has its own keys: all of them, and no others.
void check_phase(SceneCheck& check, std::size_t index);

/// Laws between the keys of the air, the sun and the sky; dates and times.
void check_atmosphere(SceneCheck& check);
/// Laws between the keys of an animation and what they move.
void check_animation(SceneCheck& check);
/// Laws between the keys of many clouds, and of a scene with them.
void check_clouds(SceneCheck& check);
/// Laws between the keys of lights besides sun and sky.
void check_lights(SceneCheck& check);
/// Laws between the keys of meshes and of the camera's depth.
void check_solids(SceneCheck& check);
/// Laws between the keys of a procedural sky; fills in what its type brings.
void check_sky(SceneCheck& check, std::size_t index);

/// Laws between all keys, and where a text was read defaults that depend on other keys.
void check_laws(SceneCheck& check);

/// Checks one value against its row. Returns false after adding a fault for it.
bool check_value(const KeyRow& row, const Node& node, const std::string& path, FaultList& faults);
/// The same of a list of tables.
bool check_rows(const KeyRow& row, const Node& list, const std::string& path, FaultList& faults);

/// The nearest of `names` within a third of the length (at least 2) in edits; empty if none.
std::string nearest_name(std::string_view name, const std::vector<std::string>& names);

}  // namespace pileus
