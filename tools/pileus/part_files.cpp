// SPDX-License-Identifier: Apache-2.0
// See part_files.h.
#include "tools/pileus/part_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/base/file.h"
#include "src/scene/toml/toml_tree.h"
#include "src/session/parts/parts.h"
#include "tools/pileus/command.h"
#include "tools/pileus/option_text.h"
#include "tools/pileus/picture_scene.h"
#include "tools/pileus/rank_files.h"
#include "tools/pileus/render_outputs.h"

namespace pileus {

void add_part_options(CLI::App& command, PartArguments& arguments) {
    command
        .add_option("--part", arguments.part,
                    "Work on one of N parts, on this machine or another, into -o FILE.part for "
                    "pileus merge; of a film on its share of the frames")
        ->type_name("I/N");
    command
        .add_option("--tiles", arguments.tiles,
                    "Render band by band into a tiled .exr, whose tiles have so many pixels along "
                    "a side: a picture of any size in the memory of one band")
        ->type_name("SIDE");
    add_stage_option(command, arguments.stage);
}

int divided_run(const Scene& scene) {
    const bool film = scene.animation.is_film();
    return film ? std::max(film_run(scene), 1) : 0;
}

Status choose_part(const PartArguments& arguments, int run, RenderOptions& options) {
    if (!arguments.part) return Status::ok();
    if (!arguments.tiles) return choose_part(*arguments.part, run, options);
    return Status::bad_input("--tiles: together with --part, allowed: one of both");
}

Status choose_part(const std::string& text, int run, RenderOptions& options) {
    const std::size_t slash = text.find('/');
    std::int64_t index = 0, count = 0;
    if (slash == std::string::npos)
        return Status::bad_input("--part: " + quote_text(text) +
                                 ", allowed: I/N, such as 2/8, 1 <= I <= N");
    PILEUS_TRY(read_integer("--part N", text.substr(slash + 1), 1, kMaxParts, count));
    PILEUS_TRY(read_integer("--part I", text.substr(0, slash), 1, count, index));
    if (run == 0) {
        options.part = {std::uint32_t(index - 1), std::uint32_t(count), true};
        return Status::ok();
    }
    const std::int64_t first = options.first_frame, last = options.last_frame;
    const std::int64_t frames = last - first + 1;
    // Whole runs where there are enough of them.
    const std::int64_t unit = last / run - first / run + 1 >= count ? run : 1;
    const std::int64_t begin = first / unit, units = last / unit - begin + 1;
    options.first_frame = int(std::max(first, (begin + units * (index - 1) / count) * unit));
    options.last_frame = int(std::min(last, (begin + units * index / count) * unit - 1));
    if (options.first_frame <= options.last_frame) return Status::ok();
    return Status::bad_input("--part: " + text + " of " + std::to_string(frames) +
                             " frames has none, allowed: at most as many parts as frames");
}

Status check_part_file(const std::vector<std::string>& files, const RenderOptions& options,
                       const Scene& scene) {
    if (files.size() != 1 || file_extension(files[0]) != ".part")
        return Status::bad_input("--part: writes one file, allowed: -o FILE.part");
    PILEUS_TRY(check_file_name(files[0]));
    PILEUS_TRY(check_names(files, false, options.first_frame, options.first_frame, scene));
    return can_write_file(files[0]);
}

Status read_part_files(const std::vector<std::string>& files, std::vector<Part>& parts) {
    constexpr std::uint64_t kLongest = std::uint64_t{1} << 36;
    for (const std::string& file : files) {
        Buffer<char> bytes;
        PILEUS_TRY(check_file_name(file));
        PILEUS_TRY(read_whole_file(file, kLongest, bytes));
        parts.emplace_back();
        PILEUS_TRY(decode_part(file, bytes.span(), parts.back()));
        bytes = Buffer<char>();
        PILEUS_TRY(fold_photons(parts));
    }
    if (parts.empty()) return Status::bad_input("FILE.part: missing, allowed: one or more");
    return Status::ok();
}

Status write_part(const Scene& scene, const RenderOptions& options, const std::string& file) {
    Part part;
    PILEUS_TRY(render_part(scene, options, part));
    const std::string folder = scene_folder_from(scene.directory, file);
    if (!folder.empty()) part.rows.origin.emplace_back("folder", folder);
    Buffer<char> bytes;
    PILEUS_TRY(encode_part(part, bytes));
    PILEUS_TRY(write_file(file, bytes.span()));
    return print(fmt::format(
        "{:16} {}\n", fmt::format("part {}/{}", options.part.index + 1, options.part.count), file));
}

}  // namespace pileus
