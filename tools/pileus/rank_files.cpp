// SPDX-License-Identifier: Apache-2.0
// See rank_files.h. A copy lies where the file lies at rank 0, below the folder of its rank.
#include "tools/pileus/rank_files.h"

#include <algorithm>
#include <filesystem>

#include "platform/fs_path.h"
#include "src/base/file.h"
#include "src/base/printable.h"
#include "tools/pileus/ranks.h"
#include "tools/study/scene_files.h"

namespace pileus {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kPiece = std::uint64_t{1} << 24;

/// From the root on, step by step as it was written: a step back from a link leads elsewhere.
std::string whole_path(const std::string& path) {
    std::error_code error;
    return path_text(fs::absolute(path_of(path), error));
}
std::string normal_path(const std::string& path) {
    return path_text(path_of(whole_path(path)).lexically_normal());
}

void send_number(std::uint64_t& value) {
    send_from_first({reinterpret_cast<char*>(&value), sizeof value});
}

void send_text(std::string& text) {
    std::uint64_t size = text.size();
    send_number(size);
    text.resize(std::size_t(size));
    send_from_first({text.data(), text.size()});
}

/// Whatever happens here, all of the file's bytes are sent: the others wait for them.
Status send_file(std::string path, Buffer<char>& piece) {
    InputFile file;
    // What is not there its reader will say.
    if (!open_file(path, file)) return Status::ok();
    std::uint64_t size = file.size();
    send_text(path);
    send_number(size);
    Status status;
    for (std::uint64_t at = 0; at < size; at += kPiece) {
        const auto count = std::size_t(std::min(kPiece, size - at));
        const FileResult result = file.read(piece.data(), count);
        if (!result) status = read_fault(path, result);
        send_from_first({piece.data(), count});
    }
    return status;
}

/// What is sent: each name once, in order of the places that copies have. Two names that are one
/// place there have to be one file here.
Status list_files(std::vector<std::string>& files) {
    std::vector<std::pair<std::string, std::string>> places;
    for (const std::string& file : files) places.emplace_back(normal_path(file), whole_path(file));
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    files.clear();
    for (std::size_t i = 0; i < places.size(); ++i) {
        files.push_back(places[i].second);
        if (i == 0 || places[i].first != places[i - 1].first) continue;
        const std::string &one = places[i].second, &other = places[i - 1].second;
        FileIdentity a, b;
        if (identify_file(one.c_str(), a) && identify_file(other.c_str(), b) && a == b) continue;
        return Status::bad_input("--stage: " + printable_line(one) + ": is another file than " +
                                 printable_line(other) +
                                 ", allowed: names without steps back from links");
    }
    return Status::ok();
}

/// The scene's file and all that it names, each once.
Status send_files(const SceneArguments& arguments, const std::string& beside, Buffer<char>& piece) {
    Scene scene;
    RenderOptions options;
    PILEUS_TRY(read_scene_options(arguments, scene, options));
    std::vector<std::string> files = scene_files(scene);
    files.push_back(arguments.scene);
    if (!beside.empty()) files.push_back(beside);
    PILEUS_TRY(list_files(files));
    Status status;
    for (const std::string& file : files) {
        const Status sent = send_file(file, piece);
        if (status) status = sent;
    }
    return status;
}

}  // namespace

void add_stage_option(CLI::App& command, std::optional<std::string>& folder) {
    command
        .add_option("--stage", folder,
                    "Among ranks of MPI: rank 0 alone reads the scene's files, and every other "
                    "rank keeps copies in this folder of its own machine while it works")
        ->type_name("DIR");
}

StagedFiles::~StagedFiles() {
    std::error_code error;
    if (!own_.empty()) fs::remove_all(path_of(own_), error);
}

Status StagedFiles::make_folder(const std::string& folder) {
    std::error_code error;
    for (int i = 0; i < 10000; ++i) {
        const std::string name = normal_path(
            folder + "/pileus-rank-" + std::to_string(ranks().rank) + "-" + std::to_string(i));
        // Another run may have its copies here.
        if (!fs::create_directory(path_of(name), error)) {
            if (error) break;
            continue;
        }
        own_ = name;
        return Status::ok();
    }
    return Status::bad_input(
        "--stage: " + printable_line(folder) +
        ": cannot make a folder there, allowed: a folder that can be written into");
}

std::string StagedFiles::copy_of(const std::string& path) const { return own_ + path; }

/// Folders that a name goes through and comes back from have to be there.
void StagedFiles::make_steps(const std::string& path) const {
    std::error_code error;
    fs::path way;
    for (const fs::path& step : path_of(path).parent_path()) {
        way /= step;
        if (step != "..") fs::create_directory(way, error);
    }
}

Status StagedFiles::take_file(const std::string& path, std::uint64_t size) {
    const std::string copy = copy_of(path);
    NewFile file;
    Status status;
    // What is sent is taken, whatever becomes of the copy.
    const auto note = [&](FileResult result) {
        if (!result && status) status = write_fault(copy, result);
    };
    make_steps(copy);
    note(file.begin(copy.c_str()));
    for (std::uint64_t at = 0; at < size; at += kPiece) {
        const auto count = std::size_t(std::min(kPiece, size - at));
        send_from_first({piece_.data(), count});
        if (status) note(file.write_at(at, piece_.data(), count));
    }
    if (status) note(file.flush());
    if (status) note(file.publish());
    if (status) file.keep();
    return status;
}

Status StagedFiles::take_files() {
    Status status;
    for (;;) {
        std::string path;
        send_text(path);
        if (path.empty()) return status;
        std::uint64_t size = 0;
        send_number(size);
        const Status taken = take_file(path, size);
        if (status) status = taken;
    }
}

Status StagedFiles::check_names(const SceneArguments& arguments) const {
    Scene scene;
    RenderOptions options;
    // What is wrong with the scene rank 0 says.
    if (!read_scene_options(arguments, scene, options)) return Status::ok();
    for (const std::string& file : scene_files(scene))
        if (normal_path(file).compare(0, own_.size() + 1, own_ + "/") != 0)
            return Status::bad_input(
                "--stage: " + printable_line(file) +
                ": a name that leads out of the copies, allowed: names that start "
                "at the scene's folder");
    return Status::ok();
}

Status StagedFiles::stage(const std::optional<std::string>& folder, SceneArguments& arguments,
                          std::optional<std::string>* beside) {
    if (!folder) return Status::ok();
    if (ranks().count == 1)
        return Status::bad_input("--stage: one process, allowed: among ranks of MPI");
    const bool first = ranks().is_first();
    Status ready;
    if (arguments.picture)
        ready =
            Status::bad_input("--stage: a picture in place of a scene, allowed: a scene's file");
    else if (folder->empty())
        ready = Status::bad_input("--stage: no name, allowed: a folder");
    else if (!first)
        ready = make_folder(*folder);
    PILEUS_TRY(agree(ready));
    PILEUS_TRY(agree(piece_.resize(kPiece, "files for ranks")));
    const std::string other = beside != nullptr ? beside->value_or("") : "";
    std::string scene = first ? whole_path(arguments.scene) : "";
    std::string second = first && !other.empty() ? whole_path(other) : "";
    send_text(scene);
    send_text(second);
    Status status;
    if (first) {
        status = send_files(arguments, other, piece_);
        std::string end;
        send_text(end);
    } else {
        status = take_files();
        arguments.scene = copy_of(scene);
        if (!other.empty()) *beside = copy_of(second);
        if (status) status = check_names(arguments);
    }
    return agree(status);
}

}  // namespace pileus
