// SPDX-License-Identifier: Apache-2.0
// pileus pack: a scene and all that it reads in one file, for sessions without files.
// in: a scene -> out: a packed scene; on stdout its size and that of the block that it needs.
// docs/flight.md, "Packed scenes"; docs/program.md
#include <fmt/format.h>

#include <memory>

#include "src/base/file.h"
#include "src/flight/flight.h"
#include "src/methods/registry.h"
#include "tools/pileus/command.h"
#include "tools/pileus/option_text.h"
#include "tools/pileus/scene_options.h"
#include "tools/study/output_check.h"
#include "tools/study/scene_files.h"

namespace pileus {

namespace {

struct PackArguments {
    SceneArguments scene;
    std::string to;
};

Status pack_and_measure(const Scene& scene, const RenderOptions& options, std::string& bytes,
                        FlightNeed& need) {
    std::shared_ptr<const World> world;
    PILEUS_TRY(make_world(scene, options, world));
    PILEUS_TRY(pack_scene(scene, *world, bytes));
    PILEUS_TRY(measure_flight(bytes, options, need));
    tell_block(need.block, need.in_place, bytes);
    return Status::ok();
}

/// "  230400 pixels, 14400 rays, ...".
std::string units_text(const FrameUnits& most) {
    if (most.pixels == 0) return "depends on the view";
    return fmt::format("{} pixels, {} rays, {} samples, {} photons", most.pixels, most.rays,
                       most.samples, most.photons);
}

Status run_pack(const PackArguments& arguments) {
    Scene scene;
    RenderOptions options;
    PILEUS_TRY(read_scene_options(arguments.scene, scene, options));
    OutputCheck outputs;
    outputs.reads(scene.file, "the scene itself");
    for (const std::string& read : scene_files(scene))
        outputs.reads(read, "a file that the scene reads");
    PILEUS_TRY(outputs.writes(arguments.to));
    PILEUS_TRY(can_write_file(arguments.to));
    std::string bytes;
    FlightNeed need;
    PILEUS_TRY(pack_and_measure(scene, options, bytes, need));
    PILEUS_TRY(write_file(arguments.to, {bytes.data(), bytes.size()}));
    return print(fmt::format(
        "{:<28} {:>12}  {} bytes\n{:<28} {:>12}  {} bytes\n{:<28} {:>12}\n{:<28} {:>12}\n"
        "{:<28} {:>12}\n{:<28} {:>12}  {} bytes\n{:<28} {}\n",
        "packed scene", bytes_text(bytes.size()), bytes.size(), "block of a session",
        bytes_text(need.block), need.block, "  kept", bytes_text(need.kept), "  while it is opened",
        bytes_text(need.open), "  most of a frame", bytes_text(need.frame),
        "  with arrays in place", bytes_text(need.in_place), need.in_place,
        "work of a frame, at most", units_text(need.most)));
}

}  // namespace

void add_pack(CLI::App& app, Chosen& chosen) {
    CLI::App* command = app.add_subcommand(
        "pack", "Pack a scene and all that it reads, for sessions of the flight profile");
    const auto arguments = std::make_shared<PackArguments>();
    add_scene_options(*command, arguments->scene, "pileus pack cloud.toml -o cloud.packed");
    command->add_option("-o", arguments->to, "The file to write")->required()->type_name("FILE");
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_pack(*arguments); }; });
}

}  // namespace pileus
