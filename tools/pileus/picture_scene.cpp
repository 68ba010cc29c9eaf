// SPDX-License-Identifier: Apache-2.0
// See picture_scene.h. Nothing in the file is trusted: every attribute is checked as an option is.
// in: attributes of an .exr file -> out: a scene's text and options, or one line for each fault.
// docs/program.md, "A picture made again"
#include "tools/pileus/picture_scene.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>

#include "platform/fs_path.h"
#include "platform/path.h"
#include "src/base/file.h"
#include "src/io/images/image_file.h"
#include "src/methods/registry.h"
#include "src/scene/read_scene.h"
#include "src/scene/toml/toml_tree.h"
#include "tools/pileus/hash_list.h"
#include "tools/pileus/option_text.h"
#include "tools/study/scene_files.h"

namespace pileus {

namespace {

namespace fs = std::filesystem;

/// Attributes by name, without "pileus.".
struct Origin {
    std::string file;
    std::map<std::string, std::string> texts;

    bool has(const std::string& name) const { return texts.count(name) > 0; }
    std::string text(const std::string& name) const {
        const auto found = texts.find(name);
        return found == texts.end() ? std::string() : found->second;
    }
    std::string where(const std::string& name) const { return file + ": pileus." + name; }

    Status need(const std::string& name, std::string& value) const {
        value = text(name);
        if (!value.empty()) return Status::ok();
        return Status::bad_input(where(name) +
                                 ": missing, allowed: a picture that pileus has rendered");
    }
    Status need(const std::string& name, std::int64_t most, std::int64_t& value) const {
        std::string written;
        PILEUS_TRY(need(name, written));
        return read_integer(where(name).c_str(), written, 0, most, value);
    }
};

/// The scene's own text: what --set added to it as remarks is an option of its own.
std::string own_text(std::string text, const std::vector<std::string>& overrides) {
    std::string remarks;
    for (const std::string& setting : overrides) remarks += "\n# --set " + setting;
    const std::size_t length = remarks.size();
    if (text.size() >= length && text.compare(text.size() - length, length, remarks) == 0)
        text.resize(text.size() - length);
    return text;
}

std::vector<std::string> words_of(const std::string& text) {
    std::vector<std::string> words;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t blank = text.find(' ', at);
        if (blank != at) words.push_back(text.substr(at, blank - at));
        at = blank == std::string::npos ? text.size() : blank + 1;
    }
    return words;
}

/// Where names in the scene start.
Status find_directory(const Origin& origin, const std::optional<std::string>& folder,
                      PictureScene& out) {
    const fs::path own = path_of(out.file).parent_path();
    if (folder) {
        std::error_code ignored;
        if (!fs::is_directory(path_of(*folder), ignored))
            return Status::bad_input("--folder: no such folder, " + quote_text(*folder) +
                                     ", allowed: the folder of the scene that made the picture");
        out.directory = *folder;
        return Status::ok();
    }
    out.directory = path_text(own);
    if (!origin.has("folder")) return Status::ok();
    const std::string way = origin.text("folder");
    if (way.empty() || is_absolute_path(way) || !check_file_name(way))
        return Status::bad_input(origin.where("folder") + ": no relative folder, " +
                                 quote_text(way) + ", allowed: such as \"..\"; --folder wins");
    out.directory = path_text((own / path_of(way)).lexically_normal());
    return Status::ok();
}

/// What ended the run, in numbers that no clock decides.
void find_budgets(const Origin& origin, PictureScene& out) {
    const std::string given = origin.text("budget");
    const bool stopped = origin.has("interrupted");
    out.ended = stopped || given.find("seconds=") != std::string::npos ||
                given.find("error=") != std::string::npos;
    out.budgets = words_of(out.ended ? origin.text("budgetUsed") : given);
    if (!out.ended) return;
    const bool chosen = origin.has("light");  // pixels and steps of a march
    if (chosen && method_tools(out.method).hides_pixels) {
        if (origin.text("scale") != "1")
            out.unrepeatable = "a time chose fewer pixels, which no key of " + out.method + " says";
    } else if (chosen) {
        const bool thin = origin.text("temporal") != "0";
        out.overrides.push_back("raymarch.light=" + origin.text("light"));
        out.overrides.push_back(thin ? "raymarch.temporal=" + origin.text("temporal")
                                     : "raymarch.scale=" + origin.text("scale"));
    } else if (out.budgets.empty()) {
        out.unrepeatable = stopped ? "the user ended its run within a pass or generation"
                                   : "it does not say what its budget came to";
    }
}

/// Films whose frames depend on where they began.
bool remembers(const PictureScene& picture, const Scene& scene, bool& clocked) {
    clocked = false;
    const MethodTools tools = method_tools(scene.method);
    if (frames_stand_alone(scene) || tools.film_memory == nullptr) return false;
    const FilmMemory memory = tools.film_memory(scene);
    // A ring that was cut short grows by a generation a frame; other frames end as they like.
    const bool leads = film_begin(scene, picture.frame) < picture.frame;
    clocked = picture.ended && leads && !memory.ring;
    bool cut = picture.ended;
    for (const std::string& budget : picture.budgets) cut |= budget.rfind("generations=", 0) == 0;
    return cut && memory.ring;
}

bool is_there(const std::string& path) {
    std::error_code ignored;
    return fs::exists(path_of(path), ignored);
}

}  // namespace

bool is_picture_scene(const std::string& path) { return file_extension(path) == ".exr"; }

Status read_picture_scene(const std::string& path, const std::optional<std::string>& folder,
                          PictureScene& out) {
    Image image;
    PILEUS_TRY(check_file_name(path));
    PILEUS_TRY(read_image(path, image));
    return take_picture_scene(path, image, folder, out);
}

Status take_picture_scene(const std::string& path, const Image& image,
                          const std::optional<std::string>& folder, PictureScene& out) {
    // The pixels are what counts: they may have been changed since their hash was written down.
    const std::string written = read_hash(image.pixel_hash);
    if (image.scene_text.empty() || written.empty())
        return Status::bad_input(path + ": pileus." +
                                 (image.scene_text.empty() ? "scene" : "pixelHash") +
                                 ": missing, allowed: a picture that pileus has rendered");
    PILEUS_TRY(take_run(path, image, folder, out));
    out.hash = pixel_hash(image);
    out.edited = written != out.hash;
    return Status::ok();
}

Status take_run(const std::string& path, const Image& image,
                const std::optional<std::string>& folder, PictureScene& out) {
    const Origin origin{path, {image.origin.begin(), image.origin.end()}};
    out = PictureScene();
    out.file = path;
    Status faults;
    std::int64_t frame = 0, first = 0;
    add_fault(origin.need("version", out.version), faults);
    add_fault(origin.need("method", out.method), faults);
    add_fault(origin.need("seed", std::numeric_limits<std::int64_t>::max(), out.seed), faults);
    add_fault(origin.need("frame", std::numeric_limits<int>::max(), frame), faults);
    add_fault(origin.need("firstFrame", frame, first), faults);
    add_fault(find_directory(origin, folder, out), faults);
    PILEUS_TRY(faults);
    out.frame = int(frame);
    out.first_frame = int(first);
    out.show = origin.text("show");
    out.commit = origin.text("commit");
    for (int i = 0; origin.has("override." + std::to_string(i)); ++i)
        out.overrides.push_back(origin.text("override." + std::to_string(i)));
    out.text = own_text(image.scene_text, out.overrides);
    find_budgets(origin, out);
    return Status::ok();
}

Status picture_frames(const PictureScene& picture, const Scene& scene, int& first, int& last) {
    const int frames = scene.animation.present ? scene.animation.frames : 1;
    if (picture.frame >= frames)
        return Status::bad_input(picture.file + ": pileus.frame: " + std::to_string(picture.frame) +
                                 ", allowed: 0 to " + std::to_string(frames - 1) + ", or --frames");
    bool clocked = false;
    const bool from_first = remembers(picture, scene, clocked);
    if (clocked)
        return Status::bad_input(picture.file +
                                 ": cannot be made again, it depends on frames before it that a "
                                 "time ended, allowed: --budget");
    first = from_first ? picture.first_frame : picture.frame;
    last = picture.frame;
    return Status::ok();
}

Status check_scene_files(const PictureScene& picture, const Scene& scene) {
    // Of a sequence the picture's frame alone is read.
    Scene at = scene;
    at.world.sequence_frame = picture.frame;
    std::vector<std::string> files;
    for (MediumSettings& medium : at.media)
        if (is_sequence(medium.source.file)) {
            files.push_back(density_path(at, medium));
            medium.source.file.clear();
        }
    if (is_sequence(at.view_files.depth)) {
        files.push_back(depth_path(at));
        at.view_files.depth.clear();
    }
    for (const std::string& file : scene_files(at)) files.push_back(file);
    // Kinds of clouds may share a scene.
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());
    Status faults;
    for (const std::string& file : files)
        if (!is_there(file))
            add_fault(Status::bad_input(picture.file + ": needs " + printable_line(file) +
                                        ": no such file, allowed: --folder, the folder that names "
                                        "in the picture's scene start at"),
                      faults);
    return faults;
}

std::string scene_folder_from(const std::string& scene_directory, const std::string& picture) {
    const auto plain = [](const fs::path& path) {
        const fs::path normal = path.lexically_normal();
        return normal.empty() ? fs::path(".") : normal;
    };
    const fs::path scene = plain(path_of(scene_directory)),
                   own = plain(path_of(picture).parent_path());
    if (scene.is_absolute() != own.is_absolute()) return "";
    // From a folder above the working directory only the disk knows the way down.
    for (auto step = std::mismatch(own.begin(), own.end(), scene.begin(), scene.end()).first;
         step != own.end(); ++step)
        if (*step == "..") return "";
    const fs::path way = scene.lexically_relative(own);
    if (way.empty() || !scene.is_absolute()) return path_text(way);
    // From one absolute folder to another: only up, or only down, as any copy of both would have.
    bool up = false, down = false;
    for (const fs::path& step : way) (step == ".." ? up : down) = true;
    return up && down ? "" : path_text(way);
}

}  // namespace pileus
