// SPDX-License-Identifier: Apache-2.0
// See scene_files.h. Of a .gltf only the names of its buffers are looked at.
// in: a scene; JSON that nobody has checked -> out: paths.
// glTF 2.0, section 3.6.1 (buffers)
#define JSON_NOEXCEPTION 1
#include "tools/study/scene_files.h"

#include <nlohmann/json.hpp>

#include "platform/path.h"
#include "src/base/file.h"
#include "src/scene/read_scene.h"

namespace pileus {

namespace {

constexpr std::uint64_t kMaxText = std::uint64_t{1} << 28;

/// "a%20b" is "a b". RFC 3986, 2.1
std::string decode_percent(const std::string& text) {
    const auto digit = [](char c) {
        return c >= '0' && c <= '9'   ? c - '0'
               : c >= 'a' && c <= 'f' ? c - 'a' + 10
               : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                      : -1;
    };
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool two = text[i] == '%' && i + 2 < text.size();
        const int high = two ? digit(text[i + 1]) : -1, low = two ? digit(text[i + 2]) : -1;
        out += high >= 0 && low >= 0 ? char(high * 16 + low) : text[i];
        if (high >= 0 && low >= 0) i += 2;
    }
    return out;
}

/// Files beside a .gltf; none where it cannot be read, which its reader will say.
void add_buffers(const std::string& path, std::vector<std::string>& files) {
    Buffer<char> text;
    if (!read_whole_file(path, kMaxText, text)) return;
    // Keep the buffers alone: whatever else the text holds takes no memory.
    using PlainJson = nlohmann::json;
    const auto wanted = [](int depth, PlainJson::parse_event_t event, PlainJson& parsed) {
        return depth <= 3 &&
               !(depth == 1 && event == PlainJson::parse_event_t::key && parsed != "buffers");
    };
    const PlainJson json = PlainJson::parse(text.data(), text.data() + text.size(), wanted, false);
    if (!json.is_object() || !json.contains("buffers") || !json["buffers"].is_array()) return;
    const std::string folder = path.substr(0, folder_length(path));
    for (const PlainJson& buffer : json["buffers"]) {
        if (!buffer.is_object() || !buffer.contains("uri") || !buffer["uri"].is_string()) continue;
        const std::string uri = buffer["uri"].get<std::string>();
        if (uri.compare(0, 5, "data:") != 0)
            files.push_back(scene_path(folder, decode_percent(uri)));
    }
}

/// What a scene names itself.
void add_files(const Scene& scene, std::vector<std::string>& files) {
    const auto add = [&](const std::string& file) {
        if (!file.empty()) files.push_back(scene_path(scene.directory, file));
    };
    Scene at = scene;
    const int frames = scene.animation.present ? scene.animation.frames : 1;
    const auto each_frame = [&](const auto& path) {
        for (at.world.sequence_frame = 0; at.world.sequence_frame < frames;
             ++at.world.sequence_frame)
            files.push_back(path());
    };
    for (const MediumSettings& medium : scene.media) {
        if (is_sequence(medium.source.file)) {
            each_frame([&] { return density_path(at, medium); });
        } else {
            add(medium.source.file);
        }
        add(medium.optics.phase.file);
    }
    add(scene.view_files.sky_map);
    for (const SolidSettings& solid : scene.solids) {
        add(solid.albedo_map);
        add(solid.file);
        if (file_extension(solid.file) == ".gltf") add_buffers(std::string(files.back()), files);
    }
    if (is_sequence(scene.view_files.depth))
        each_frame([&] { return depth_path(at); });
    else
        add(scene.view_files.depth);
}

}  // namespace

std::vector<std::string> scene_files(const Scene& scene) {
    std::vector<std::string> files;
    add_files(scene, files);
    for (const CloudKindSettings& settings : scene.clouds.kinds) {
        files.push_back(scene_path(scene.directory, settings.scene));
        Scene kind;
        // What is wrong with it its reader will say.
        if (read_scene_file(std::string(files.back()), settings.sets, kind)) add_files(kind, files);
    }
    return files;
}

}  // namespace pileus
