// SPDX-License-Identifier: Apache-2.0
// The way of a scene: bytes, tree, overrides, keys, laws.
// in: a file or text -> out: a checked Scene, or all of its faults.
// docs/scene.md.
#include "src/scene/read_scene.h"

#include <string_view>
#include <system_error>

#include "platform/fp_mode.h"
#include "platform/fs_path.h"
#include "platform/path.h"
#include "src/base/file.h"
#include "src/scene/checks/check_keys.h"
#include "src/scene/keys/key_value.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {
namespace {

/// Before each override in a scene's text.
constexpr std::string_view kSetLine = "\n# --set ";

Status too_long(const std::string& name) {
    return Status::limit(name + ": scene text too long, allowed: at most " +
                         std::to_string(kMaxSceneBytes) + " bytes");
}

Status read_text(const std::string& path, std::string& text) {
    const std::string allowed = ", allowed: a readable TOML file";
    PILEUS_TRY(check_file_name(path));
    InputFile file;
    const FileResult opened = file.open_any(path.c_str());
    if (opened.fault == FileFault::kDirectory)
        return Status::bad_input(path + ": is a folder" + allowed);
    if (opened.fault == FileFault::kMissing)
        return Status::bad_input(path + ": no such file" + allowed);
    if (!opened)
        return Status::bad_input(path + ": cannot be opened, " +
                                 std::generic_category().message(opened.error) + allowed);
    char block[16384];
    for (std::size_t got = 1; got > 0;) {
        const FileResult result = file.read_some(block, sizeof block, got);
        if (!result) return read_fault(path, result);
        text.append(block, got);
        if (text.size() > kMaxSceneBytes) return too_long(path);
    }
    if (text.size() < file.size()) return read_fault(path, {FileFault::kShort, 0});
    return Status::ok();
}

/// The last run of '#' becomes a number of as many digits or more.
std::string numbered(std::string file, std::int64_t number) {
    if (!is_sequence(file)) return file;
    const std::size_t last = file.rfind('#');
    std::size_t first = last;
    while (first > 0 && file[first - 1] == '#') --first;
    std::string digits = std::to_string(number);
    const std::size_t width = last - first + 1;
    if (digits.size() < width) digits.insert(0, width - digits.size(), '0');
    return file.replace(first, width, digits);
}

}  // namespace

std::string scene_path(const std::string& directory, const std::string& file) {
    if (directory.empty() || is_absolute_path(file)) return file;
    return folder_length(directory) == directory.size() ? directory + file : directory + "/" + file;
}

bool is_sequence(const std::string& file) {
    return file.find('#', folder_length(file)) != std::string::npos;
}

bool has_sequence(const Scene& scene) {
    for (const MediumSettings& medium : scene.media)
        if (is_sequence(medium.source.file)) return true;
    return false;
}

namespace {

/// A file may have '#' in its name and be no sequence: it is there as it stands.
std::string path_of_frame(const Scene& scene, const std::string& file, std::int64_t number) {
    const std::string plain = scene_path(scene.directory, file);
    InputFile there;
    if (!is_sequence(file) || open_file(plain, there)) return plain;
    return scene_path(scene.directory, numbered(file, number));
}

}  // namespace

std::string density_path(const Scene& scene, const MediumSettings& medium) {
    return path_of_frame(scene, medium.source.file,
                         std::int64_t(medium.source.first_frame) + scene.world.sequence_frame);
}

std::string depth_path(const Scene& scene) {
    return path_of_frame(scene, scene.view_files.depth, scene.world.sequence_frame);
}

Status read_scene_text(const std::string& text, const std::string& name,
                       const std::string& directory, const std::vector<std::string>& overrides,
                       Scene& out) {
    if (text.size() > kMaxSceneBytes) return too_long(name);
    // Read numbers in the rounding mode of the standard, whatever the caller's is.
    const FpModeGuard guard;
    Node root;
    FaultList faults(name, overrides);
    SyntaxFault syntax;
    if (!parse_toml(text, root, syntax)) {
        Place place;
        place.line = syntax.line;
        place.column = syntax.column;
        faults.add(place, "", "not TOML, " + syntax.what);
        return faults.status();
    }
    apply_overrides(overrides, root, faults);
    Scene scene;
    SceneCheck check{scene, faults, true, {}};
    check_keys(root, check);
    check_laws(check);
    PILEUS_TRY(faults.status());
    for (const auto& [key, found] : check.found)
        scene.places[key] = faults.place_text(found.node->at);
    // What was set from outside belongs to the scene: the text must make the picture again.
    scene.text = text;
    for (const std::string& setting : overrides) scene.text.append(kSetLine) += setting;
    scene.overrides = overrides;
    scene.file = name;
    scene.directory = directory;
    out = std::move(scene);
    return Status::ok();
}

std::string text_without_overrides(const Scene& scene) {
    std::size_t added = 0;
    for (const std::string& setting : scene.overrides) added += kSetLine.size() + setting.size();
    return scene.text.substr(0, scene.text.size() - added);
}

Status scene_document(const Scene& scene, std::string& document) {
    const FpModeGuard guard;
    Node root;
    FaultList faults(scene.file, scene.overrides);
    SyntaxFault syntax;
    if (!parse_toml(text_without_overrides(scene), root, syntax))
        return Status::bad_input(scene.file + ": not TOML, " + syntax.what);
    apply_overrides(scene.overrides, root, faults);
    PILEUS_TRY(faults.status());
    document = toml_document(root);
    return Status::ok();
}

Status check_scene(const Scene& scene) {
    // The laws work on a scene of their own.
    Scene checked = scene;
    FaultList faults(scene.file.empty() ? "scene" : scene.file, {});
    std::vector<std::unique_ptr<Node>> values;
    SceneCheck check{checked, faults, false, {}};
    check_fields(values, check);
    check_laws(check);
    return faults.status();
}

Status check_changed(const char*, const Scene& scene, void (*change)(const void*, Scene&),
                     const void* values) {
    Scene changed = scene;
    change(values, changed);
    changed.file = "session";
    // The checks know maps by their files.
    changed.view_files.sky_map = changed.sky.mapped ? "host.pfm" : "";
    return check_scene(changed);
}

Status at_key(const Scene& scene, const std::string& key, Status status) {
    if (status) return status;
    // The path of a file may stand in a table of its own.
    auto place = scene.places.find(key + ".file");
    if (place == scene.places.end()) place = scene.places.find(key);
    const bool known = place != scene.places.end();
    const std::string start = known ? place->second + ": " + place->first : key;
    status.message = start + ": " + status.message;
    return status;
}

Status read_scene_file(const std::string& path, const std::vector<std::string>& overrides,
                       Scene& out) {
    std::string text;
    PILEUS_TRY(read_text(path, text));
    return read_scene_text(text, path, path_text(path_of(path).parent_path()), overrides, out);
}

}  // namespace pileus
