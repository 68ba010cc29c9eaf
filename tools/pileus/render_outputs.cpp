// SPDX-License-Identifier: Apache-2.0
// See render_outputs.h.
// in: names, a scene, frames -> out: faults, or files.
// docs/program.md, "render"; "What is never overwritten"
#include "tools/pileus/render_outputs.h"

#include <fmt/format.h>

#include <filesystem>

#include "platform/fs_path.h"
#include "src/base/file.h"
#include "src/io/images/image_file.h"
#include "src/io/volumes/weather_file.h"
#include "src/plan/report_json.h"
#include "src/scene/rows/picture_format.h"
#include "src/world/camera/places.h"
#include "tools/pileus/command.h"
#include "tools/pileus/option_text.h"
#include "tools/pileus/picture_scene.h"
#include "tools/pileus/version_text.h"
#include "tools/study/output_check.h"
#include "tools/study/scene_files.h"

namespace pileus {

namespace {

/// "a.pgw" of "a.png"; "a.wld" of the others, which readers of maps look for, too.
std::string world_name(const std::string& picture) {
    const std::string extension = file_extension(picture);
    return picture.substr(0, picture.size() - extension.size()) +
           (extension == ".png" ? ".pgw" : ".wld");
}

/// Its six numbers, a line each.
std::string world_text(const Image& image) {
    std::string text;
    for (const auto& [name, value] : image.origin)
        if (name == "world_file") text = value + '\n';
    for (char& c : text)
        if (c == ' ') c = '\n';
    return text;
}

}  // namespace

std::string frame_path(const std::string& path, int frame, bool numbered) {
    return numbered ? numbered_path(path, frame) : path;
}

Status check_names(const std::vector<std::string>& all, bool numbered, int first_frame,
                   int last_frame, const Scene& scene) {
    OutputCheck check;
    Status faults;
    check.reads(scene.file, "the scene itself");
    for (const std::string& file : scene_files(scene))
        check.reads(file, "a file that the scene reads");
    for (int frame = first_frame; frame <= last_frame && faults; ++frame)
        for (const std::string& name : all) {
            const std::string path = frame_path(name, frame, numbered);
            // Names of files that are not there yet clash in all frames or in none.
            std::error_code ignored;
            const bool there =
                std::filesystem::exists(std::filesystem::symlink_status(path_of(path), ignored));
            if (frame == first_frame || there) add_fault(check.writes(path), faults);
        }
    return faults;
}

Status check_outputs(const Outputs& outputs, const Scene& scene, const RenderOptions& options) {
    Status faults;
    std::vector<std::string> all = outputs.files;
    all.insert(all.end(), outputs.world_files.begin(), outputs.world_files.end());
    if (!outputs.report.empty()) all.push_back(outputs.report);
    if (!options.budget.state.empty()) all.push_back(options.budget.state);
    std::vector<std::string> sound;
    for (const std::string& name : all) {
        const Status status = name.empty() ? Status::ok() : check_file_name(name);
        add_fault(status ? status : Status::io(status.message), faults);
        if (status) sound.push_back(name);
    }
    add_fault(check_names(sound, outputs.numbered, outputs.first_frame, options.last_frame, scene),
              faults);
    PILEUS_TRY(faults);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Status format = i < outputs.files.size() ? can_write_image(all[i]) : Status::ok();
        add_fault(format, faults);
        if (format)
            add_fault(can_write_file(frame_path(all[i], outputs.first_frame, outputs.numbered)),
                      faults);
    }
    return faults;
}

Status add_world_files(const Scene& scene, Outputs& outputs) {
    Scene placed = scene;
    WeatherFiles files;
    PILEUS_TRY(place_camera(placed, &files));
    if (picture_place(placed, placed.camera, 0, &files).empty())
        return Status::bad_input(scene.file +
                                 ": --world-file: no map, allowed: an orthographic camera that "
                                 "looks straight down on weather data");
    for (const std::string& file : outputs.files) {
        const std::string name = world_name(file);
        bool known = false;  // a.exr and a.pfm have one
        for (const std::string& other : outputs.world_files) known = known || other == name;
        if (!known) outputs.world_files.push_back(name);
    }
    return Status::ok();
}

Status check_frame_hash(const Scene& scene, const Outputs& outputs, int frame,
                        const std::vector<std::string>& hashes) {
    if (outputs.hashes.empty()) return Status::ok();
    const std::string& expected = outputs.hashes[std::size_t(frame - outputs.first_frame)];
    for (const std::string& hash : hashes)
        if (hash == expected) return Status::ok();
    const std::string where =
        outputs.numbered ? fmt::format("{}: frame {}", scene.file, frame) : scene.file;
    if (hashes.empty())
        return Status::check_failed(
            fmt::format("{}: hash: not rendered, expected {}", where, expected));
    return Status::check_failed(
        fmt::format("{}: hash: differs, expected {}, got {}", where, expected, hashes[0]) +
        outputs.remark);
}

namespace {

/// Adds one file. `hash` becomes that of its pixels as they are read again: some formats keep less
/// of them than an .exr does.
Status add_picture(const Image& image, const std::string& path, const ToneSettings& tone,
                   OutputSet& set, std::string& hash) {
    Buffer<char> bytes;
    PILEUS_TRY(encode_image(image, path, tone, bytes));
    PILEUS_TRY(set.add(path, bytes.span()));
    const PictureFormat* format = picture_format_of(path);
    if (format == nullptr || !is_read(*format) || format->extension == std::string(".exr"))
        return Status::ok();
    Image again;
    PILEUS_TRY(format->decode(path, bytes.span(), again, kMaxImagePixels));
    hash = pixel_hash(again);
    return Status::ok();
}

}  // namespace

Status write_frame(const Outputs& outputs, const Scene& scene, int frame, Image& image,
                   const Report& report, std::vector<std::string>& hashes) {
    OutputSet set;
    std::string lines;
    if (*commit_text() != '\0') image.origin.emplace_back("commit", commit_text());
    const std::size_t told = image.origin.size();
    for (const std::string& file : outputs.files) {
        const std::string path = frame_path(file, frame, outputs.numbered);
        // Each file says where its scene lies from there.
        const std::string folder = scene_folder_from(scene.directory, path);
        if (!folder.empty()) image.origin.emplace_back("folder", folder);
        std::string hash = image.pixel_hash;
        PILEUS_TRY(add_picture(image, path, outputs.tone, set, hash));
        image.origin.resize(told);
        lines += fmt::format("{} {}\n", hash, path);
        hashes.push_back(hash);
    }
    hashes.push_back(image.pixel_hash);
    const std::string world = world_text(image);
    for (const std::string& file : outputs.world_files) {
        const std::string path = frame_path(file, frame, outputs.numbered);
        PILEUS_TRY(set.add(path, {world.data(), world.size()}));
        lines += fmt::format("{:16} {}\n", "world file", path);
    }
    if (!outputs.report.empty()) {
        const std::string path = frame_path(outputs.report, frame, outputs.numbered);
        PILEUS_TRY(set.add_report(report, path));
        lines += fmt::format("{:16} {}\n", "report", path);
    }
    if (report.verify.pixels > 0)
        lines += fmt::format(
            "{:16} bias {:+.2f} % with a standard error of {:.2f} %, relMSE {:.2g}, over "
            "{} pixels\n",
            "verify", 100 * report.verify.bias, 100 * report.verify.standard_error,
            report.verify.relmse, report.verify.pixels);
    if (report.verify.has_errors)
        lines += fmt::format(
            "{:16} noise {:.2g} of it, pixels off by {:.2f} % beside; 1 sigma holds {:.0f} %, 2 "
            "sigma {:.0f} % of them\n",
            "", report.verify.noise, 100 * report.verify.bias_rms, 100 * report.verify.within[0],
            100 * report.verify.within[1]);
    if (outputs.report_printed) lines = report_json(report);
    if (outputs.nothing && image.pixel_hash == outputs.hashes.at(0))
        lines += fmt::format("{} {}\n", image.pixel_hash, scene.file);
    PILEUS_TRY(set.commit(lines));
    if (!outputs.says_exposure || image.display_colours) return Status::ok();
    double stops = 0;
    PILEUS_TRY(measured_stops(image, outputs.tone, stops));
    const std::string name = frame_path(outputs.files.at(0), frame, outputs.numbered);
    std::fprintf(stderr, "%s\n", fmt::format("exposure {}: {:+.2f} stops", name, stops).c_str());
    return Status::ok();
}

}  // namespace pileus
