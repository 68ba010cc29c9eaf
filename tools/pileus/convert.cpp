// SPDX-License-Identifier: Apache-2.0
// pileus convert: a density grid from one format to another.
// in: a grid, weather data or particles that a scene could read -> out: a .vdb, .nc, .raw or .ply
// file, and the lines to use it. docs/program.md
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "src/base/file.h"
#include "src/io/volumes/volume_file.h"
#include "src/scene/rows/volume_format.h"
#include "src/scene/toml/toml_tree.h"
#include "tools/pileus/command.h"
#include "tools/pileus/info.h"
#include "tools/pileus/raw_options.h"
#include "tools/study/output_check.h"

namespace pileus {

namespace {

struct ConvertArguments {
    std::string from, to, grid, time, member;
    std::vector<int> resolution;
    RawOptions raw;
    bool y_up = false;
};

/// The raw options describe whichever of the two files is raw, so only one may be.
Status check_files(const ConvertArguments& arguments, bool& from_raw, bool& to_raw) {
    const VolumeFormat *from = volume_format_of(arguments.from),
                       *to = volume_format_of(arguments.to);
    from_raw = from != nullptr && from->bare;
    to_raw = to != nullptr && to->bare;
    if (to == nullptr || to->write == nullptr || file_extension(arguments.to) == ".gz")
        return Status::bad_input(arguments.to + ": extension: unknown, " +
                                 quote_text(file_extension(arguments.to)) +
                                 ", allowed: " + volume_format_extensions(true, " "));
    if (from_raw && to_raw)
        return Status::bad_input(arguments.to + ": both files are raw, allowed: one of them");
    const bool weather = from != nullptr && from->is_weather;
    const bool celled = weather || (from != nullptr && from->is_particles);
    if ((!arguments.time.empty() || !arguments.member.empty()) && !weather)
        return Status::bad_input(arguments.from +
                                 ": --time, --member: for NetCDF files, allowed: left out");
    if (!arguments.resolution.empty() && !celled)
        return Status::bad_input(arguments.from +
                                 ": --resolution: for NetCDF files and particles, allowed: left "
                                 "out");
    if (to_raw && !arguments.raw.size.empty())
        return Status::bad_input("--size: for a .raw file that is read, allowed: left out");
    return Status::ok();
}

Status write_grid(const ConvertArguments& arguments, const Volume& volume) {
    MediumSettings form;
    form.source.raw_big_endian = arguments.raw.big_endian;
    PILEUS_TRY(read_raw_type(arguments.raw, form.source.raw_type));
    return volume_format_of(arguments.to)->write(form, arguments.to, volume);
}

/// Bare numbers are told from texts in a scene alone: here a name is tried first, then an index.
WeatherChoice choice_of(const std::string& text) {
    WeatherChoice choice;
    choice.by_name = true;
    choice.name = text;
    return choice;
}

/// What a scene would say of weather data or particles.
Status read_made_options(const ConvertArguments& arguments, MediumSettings& medium) {
    if (!arguments.time.empty()) medium.weather.time = choice_of(arguments.time);
    if (!arguments.member.empty()) medium.weather.member = choice_of(arguments.member);
    for (std::size_t a = 0; a < arguments.resolution.size(); ++a) {
        const int cells = arguments.resolution[a];
        if (cells < 1 || cells > kMaxVolumeSide)
            return Status::bad_input("--resolution: out of range, " + std::to_string(cells) +
                                     ", allowed: 1 to " + std::to_string(kMaxVolumeSide));
        medium.box.resolution[a] = cells;
    }
    return Status::ok();
}

/// A text as a scene holds it, whole: TOML takes the escapes of JSON.
std::string toml_text(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// The keys of a scene's medium that reads the new file; a comment where a number changed meaning.
std::string scene_text(const ConvertArguments& arguments, bool raw, const Volume& volume) {
    const auto& n = volume.size;
    std::string text;
    RawType type = RawType::kFloat32;
    const bool known = bool(read_raw_type(arguments.raw, type));
    const double scale = raw && known ? raw_scale(volume, type) : 1.0;
    if (raw) {
        text = fmt::format("density = {{ file = {}, type = \"{}\", size = [{}, {}, {}]{} }}\n",
                           toml_text(arguments.to), arguments.raw.type, n[0], n[1], n[2],
                           arguments.raw.big_endian ? ", endian = \"big\"" : "");
        if (scale != 1.0 && !volume.in_extinction)
            text += fmt::format("# densities were divided by {}: multiply extinction_per_m by it\n",
                                scale);
    } else {
        text = fmt::format("density = {}\n", toml_text(arguments.to));
    }
    const VolumeFormat* to = volume_format_of(arguments.to);
    if (to != nullptr && to->is_weather) {
        if (!volume.in_extinction)
            text +=
                "# relative densities: extinction_scale is the extinction at density 1, per m\n";
    } else if (volume.in_extinction)
        text += fmt::format("extinction_per_m = {}\n", scale);
    const auto& b = volume.bounds_m;
    if (raw && volume.knows_bounds)
        text += fmt::format("bounds_m = [[{}, {}, {}], [{}, {}, {}]]\n", b[0][0], b[0][1], b[0][2],
                            b[1][0], b[1][1], b[1][2]);
    return text;
}

Status run_convert(const ConvertArguments& arguments) {
    bool from_raw = false, to_raw = false;
    PILEUS_TRY(check_files(arguments, from_raw, to_raw));
    MediumSettings medium;
    medium.source.grid = arguments.grid;
    PILEUS_TRY(read_made_options(arguments, medium));
    RawType type;
    PILEUS_TRY(read_raw_type(arguments.raw, type));
    OutputCheck check;
    check.reads(arguments.from, "the grid that is read");
    PILEUS_TRY(check.writes(arguments.to));
    PILEUS_TRY(can_write_file(arguments.to));
    if (from_raw) PILEUS_TRY(read_raw_facts(arguments.from, arguments.raw, medium));
    Volume volume;
    PILEUS_TRY(read_volume(medium, arguments.from, volume));
    if (arguments.y_up) PILEUS_TRY(permute_y_up(volume));
    PILEUS_TRY(write_grid(arguments, volume));

    std::string lines = info_line("grid", arguments.to);
    lines += size_lines(volume.size, volume.knows_bounds, volume.bounds_m);
    return print(lines + scene_text(arguments, to_raw, volume));
}

}  // namespace

void add_convert(CLI::App& app, Chosen& chosen) {
    CLI::App* command = app.add_subcommand("convert", "Write a density grid in another format");
    const auto arguments = std::make_shared<ConvertArguments>();
    command->add_option("in", arguments->from, "A file: " + volume_format_extensions())
        ->required()
        ->type_name("IN");
    command
        ->add_option("out", arguments->to, "The file to write: " + volume_format_extensions(true))
        ->required()
        ->type_name("OUT");
    command
        ->add_option("--grid", arguments->grid,
                     "Name of the grid of a " + grid_format_extensions() + " file")
        ->type_name("NAME");
    command
        ->add_option("--time", arguments->time,
                     "Which time of a NetCDF file: an index from 0, or the beginning of a date")
        ->type_name("TIME");
    command->add_option("--member", arguments->member, "Which member of a NetCDF file")
        ->type_name("MEMBER");
    command
        ->add_option("--resolution", arguments->resolution,
                     "Cells of weather data or particles, along x, y, z")
        ->expected(3)
        ->type_name("NX NY NZ");
    command->add_flag("--y-up", arguments->y_up, "Turn a grid whose y axis points up to z up");
    add_raw_options(*command, arguments->raw);
    command->footer(help_example("pileus convert cloud.vdb cloud.raw --type uint16"));
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_convert(*arguments); }; });
}

}  // namespace pileus
