// SPDX-License-Identifier: Apache-2.0
// pileus follow: the way of one photon, event by event.
// in: a scene, the number of a photon -> out: a table on stdout.
// docs/program.md; docs/how-it-works.md
#include "lab/views/follow.h"

#include <fmt/format.h>

#include <memory>

#include "tools/pileus/command.h"
#include "tools/pileus/option_text.h"
#include "tools/pileus/scene_options.h"

namespace pileus {

namespace {

constexpr std::int64_t kMaxLights = 64;
constexpr std::int64_t kMaxPhotons = 0xffffffff;

struct FollowArguments {
    SceneArguments scene;
    std::string photon = "0", light = "0";
};

std::string way_lines(const PhotonWay& way) {
    std::string text = fmt::format(
        "light {}\n{:>6} {:<10} {:>5} {:>9} {:>9} {:>9} {:>9} {:>7} "
        "{:>7} {:>7}\n",
        way.light, "event", "what", "order", "path m", "x m", "y m", "z m", "dx", "dy", "dz");
    for (std::size_t i = 0; i < way.points.size(); ++i) {
        const PathPoint& p = way.points[i];
        text += fmt::format(
            "{:>6} {:<10} {:>5} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>7.3f} {:>7.3f} {:>7.3f}\n",
            i, path_event_name(p.event), p.order, p.path_m, p.at_m[0], p.at_m[1], p.at_m[2],
            p.direction[0], p.direction[1], p.direction[2]);
    }
    return text;
}

Status run_follow(const FollowArguments& arguments) {
    Scene scene;
    RenderOptions options;
    std::int64_t photon = 0, light = 0;
    Status faults;
    add_fault(read_integer("--photon", arguments.photon, 0, kMaxPhotons, photon), faults);
    add_fault(read_integer("--light", arguments.light, 0, kMaxLights, light), faults);
    add_fault(read_scene_options(arguments.scene, scene, options), faults);
    PILEUS_TRY(faults);
    PhotonWay way;
    PILEUS_TRY(follow(scene, options, int(light), std::uint32_t(photon), way));
    return print(way_lines(way));
}

}  // namespace

void add_follow(CLI::App& app, Chosen& chosen) {
    CLI::App* command = app.add_subcommand("follow", "Print the way of one photon");
    const auto arguments = std::make_shared<FollowArguments>();
    add_scene_options(*command, arguments->scene, "pileus follow cloud.toml --photon 3");
    command->add_option("--photon", arguments->photon, "Its number, from 0")->type_name("N");
    command->add_option("--light", arguments->light, "Number of its light, from 0")->type_name("N");
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_follow(*arguments); }; });
}

}  // namespace pileus
