// SPDX-License-Identifier: Apache-2.0
// pileus info: what this program is and runs on, or what a file holds.
// in: nothing, or a scene, picture or density grid -> out: lines "name  value".
// docs/program.md
#include "tools/pileus/info.h"

#include <fmt/format.h>

#include <memory>

#include "kernels_cpu/isa/kernels.h"
#include "platform/device.h"
#include "platform/threads.h"
#include "src/base/file.h"
#include "src/io/images/image_file.h"
#include "src/io/netcdf/netcdf_file.h"
#include "src/io/text/packed_bytes.h"
#include "src/io/volumes/vdb/vdb_file.h"
#include "src/scene/rows/mesh_format.h"
#include "src/scene/rows/picture_format.h"
#include "src/scene/rows/volume_format.h"
#include "tools/pileus/command.h"
#include "tools/pileus/ranks.h"
#include "tools/pileus/raw_options.h"
#include "tools/pileus/version_text.h"

namespace pileus {

std::string info_line(const char* name, const std::string& value) {
    return fmt::format("{:<14} {}\n", name, value);
}

std::string compiler_text() {
#ifdef __clang__
    return std::string("Clang ") + __clang_version__;
#else
    return std::string("GCC ") + __VERSION__;
#endif
}

namespace {

struct InfoArguments {
    std::string file, grid;
    bool phase = false, scene = false;
    std::vector<double> place;
    RawOptions raw;
};

std::string isa_text() {
    const KernelTable* chosen = kernel_table(nullptr);
    std::string text;
    for (int i = 0; const KernelTable* table = kernel_table_at(i); ++i)
        text += fmt::format("{}{} ({} {}{})", i > 0 ? ", " : "", table->name, table->width,
                            table->width > 1 ? "lanes" : "lane", table == chosen ? ", chosen" : "");
    return text;
}

/// How many threads a run has by default, and whose.
std::string threads_text() {
    const std::string team = threads_name();
    return fmt::format("{}, {}", team == "serial" ? 1 : hardware_threads(), team);
}

/// A device that --isa can name, or why there is none.
std::string device_text() {
    std::string why;
    return has_cuda_device(why) ? "cuda (" + cuda_device_text() + ")" : "cuda: " + why;
}

/// The formats that depend on a library tell whether it was built in.
std::string library_text() {
    std::string text;
    for (const PictureFormat& format : picture_formats()) {
        if (format.library == nullptr) continue;
        text += std::string(format.title) + (format.built ? " yes, " : " no, ");
    }
    return text + packing_library_text() + ", " + netcdf_library_text() + ", " +
           grib_library_text();
}

std::string program_lines() {
    return info_line("version", version_text()) + info_line("compiler", compiler_text()) +
           info_line("isa", isa_text()) + info_line("threads", threads_text()) +
           info_line("mpi", has_mpi() ? "yes" : "no") + info_line("device", device_text()) +
           info_line("libraries", library_text()) +
           info_line("volumes", volume_format_extensions()) +
           info_line("pictures", picture_extensions(is_written)) +
           info_line("meshes", mesh_extensions());
}

Status run_info(const InfoArguments& arguments) {
    if (arguments.file.empty() && arguments.phase)
        return Status::bad_input(
            "--phase: no file, nothing, allowed: a table of angles and values");
    if (arguments.file.empty() && arguments.scene)
        return Status::bad_input("--scene: no file, nothing, allowed: a picture");
    if (arguments.file.empty()) return print(program_lines());
    PILEUS_TRY(check_file_name(arguments.file));
    const std::string extension = file_extension(arguments.file);
    const PictureFormat* picture = picture_format_of(arguments.file);
    const VolumeFormat* volume = volume_format_of(arguments.file);
    std::string lines;
    MediumSettings medium;
    if (!arguments.place.empty() && (volume == nullptr || !volume->is_weather))
        return Status::bad_input("--place: for weather data, allowed: left out");
    if (arguments.scene && (picture == nullptr || !is_radiance(*picture)))
        return Status::bad_input("--scene: of a picture, allowed: a file in " +
                                 picture_extensions(is_radiance));
    if (arguments.phase) {
        PILEUS_TRY(phase_lines(arguments.file, lines));
    } else if (extension == ".toml") {
        PILEUS_TRY(scene_lines(arguments.file, lines));
    } else if (picture != nullptr && is_radiance(*picture)) {
        PILEUS_TRY(arguments.scene ? scene_text_of(arguments.file, lines)
                                   : image_lines(arguments.file, lines));
    } else if (volume != nullptr) {
        medium.source.grid = arguments.grid;
        if (volume->bare) PILEUS_TRY(read_raw_facts(arguments.file, arguments.raw, medium));
        PILEUS_TRY(volume->is_weather ? weather_lines(arguments.file, medium, lines)
                                      : volume_lines(arguments.file, medium, lines));
    } else {
        return Status::bad_input(arguments.file + ": extension: unknown, \"" + extension +
                                 "\", allowed: .toml, " + picture_extensions(is_radiance) + ", " +
                                 volume_format_extensions());
    }
    if (!arguments.place.empty())
        PILEUS_TRY(place_line(arguments.file, medium, arguments.place, lines));
    return print(lines);
}

}  // namespace

void add_info(CLI::App& app, Chosen& chosen) {
    CLI::App* command = app.add_subcommand("info", "Describe this program, or a file");
    const auto arguments = std::make_shared<InfoArguments>();
    command->add_option("file", arguments->file, "A scene, picture or density grid")
        ->type_name("FILE");
    command
        ->add_option("--grid", arguments->grid,
                     "Name of the grid of a " + grid_format_extensions() + " file")
        ->type_name("NAME");
    command
        ->add_option("--place", arguments->place,
                     "Where a longitude and latitude lie in a file of weather data")
        ->expected(2)
        ->type_name("LON LAT");
    command->add_flag("--phase", arguments->phase, "The file is a table of a phase function");
    command->add_flag("--scene", arguments->scene, "Print the scene that a picture was made of");
    add_raw_options(*command, arguments->raw);
    command->footer(help_example("pileus info cloud.vdb --grid density"));
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_info(*arguments); }; });
}

}  // namespace pileus
