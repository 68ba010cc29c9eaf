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

/// The text that `scene` was read from, without its overrides.
std::string text_without_overrides(const Scene& scene);
/// `scene` as a TOML document that reads as the same scene without overrides.
Status scene_document(const Scene& scene, std::string& document);

/// Checks a scene that a program has filled in as one that was read: every value by its row, then
/// the laws between them; a key with its default counts as left out. Such a scene holds what
/// reading would have filled in: of a kind of cloud, of the paper's variant. kBadInput, one line
/// `file: key: what, value, allowed` for each fault.
Status check_scene(const Scene& scene);

/// Of a value that a host sets: the fault of the scene with it, or none where that is sound. `key`
/// names what is out of range, or asks for this check; a flight, which lacks it, refuses that.
Status check_changed(const char* key, const Scene& scene, void (*change)(const void*, Scene&),
                     const void* values);
/// The same with a function of a lambda.
template <class Change>
Status check_changed(const char* key, const Scene& scene, const Change& change) {
    return check_changed(
        key, scene,
        [](const void* values, Scene& changed) { (*static_cast<const Change*>(values))(changed); },
        &change);
}

/// A fault of what `key` names, such as a file that is not there: begins with the key and where it
/// stands, "s.toml:12:11: medium.0.density: cloud.vdb: ...". Passes a sound status on.
Status at_key(const Scene& scene, const std::string& key, Status status);

/// A path from a scene, relative to `directory` unless it is absolute or `directory` is empty.
std::string scene_path(const std::string& directory, const std::string& file);

/// Whether a file's name has '#', whose last run stands for the digits of a frame's number.
bool is_sequence(const std::string& file);
bool has_sequence(const Scene& scene);
/// The path of a medium's file, and of the camera's depth; of a sequence that of
/// WorldKey::sequence_frame.
std::string density_path(const Scene& scene, const MediumSettings& medium);
std::string depth_path(const Scene& scene);

}  // namespace pileus
