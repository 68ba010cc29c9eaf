// SPDX-License-Identifier: Apache-2.0
// pileus plan: what a rendering would need, what it leaves out and why, memory, bounds, cost.
// in: a scene -> out: lines for people, or JSON with the report's keys.
// docs/program.md; docs/report.md
#include <fmt/format.h>

#include <memory>

#include "src/methods/registry.h"
#include "src/plan/report_json.h"
#include "tools/pileus/command.h"
#include "tools/pileus/foretell.h"
#include "tools/pileus/option_text.h"
#include "tools/pileus/rank_plan.h"
#include "tools/pileus/scene_options.h"

namespace pileus {

namespace {

struct PlanArguments {
    SceneArguments scene;
    std::optional<std::string> ranks, link;
    bool json = false, exact = false, time = false;
};

std::string part_lines(const Plan& plan) {
    std::string text = "needed\n";
    for (const std::string& part : plan.needed) text += fmt::format("  {}\n", part);
    text += "left out\n";
    for (const LeftOut& part : plan.left_out)
        text += fmt::format("  {}: {}\n", part.what, part.why);
    return text;
}

std::string memory_lines(const Plan& plan) {
    std::string text = fmt::format("memory ({}), and from which stage to which\n",
                                   plan.exact ? "exact" : "at most");
    for (const MemoryRow& item : plan.memory.rows())
        text += fmt::format("  {:<28} {:>12}  {} to {}\n", item.item, bytes_text(item.bytes),
                            stage_name(item.first), stage_name(item.last));
    std::string peak;
    for (std::size_t s = 0; s < kStageCount && peak.empty(); ++s)
        if (plan.runs(Stage(s)) && plan.memory.live(Stage(s)) == plan.memory.peak())
            peak = stage_name(Stage(s));
    return text + fmt::format("  {:<28} {:>12}  {} bytes, in stage {}\n", "total at once",
                              bytes_text(plan.memory.peak()), plan.memory.peak(), peak);
}

std::string bound_lines(const Plan& plan) {
    if (plan.bounds.empty()) return "";
    std::string text = "bounds of the sums, in whole numbers of 64 bits\n";
    for (const SumBound& b : plan.bounds)
        text += fmt::format("  {:<28} {:.3g} addends x {:.3g} x 2^{} = {:.2g} < {:.2g}\n", b.sum,
                            b.addends, b.largest, b.places, b.worst, b.allowed);
    return text;
}

std::string accumulation_lines(const Accumulation& accumulation) {
    if (accumulation.kind.empty()) return "";
    return fmt::format("accumulation of photons\n  {:<28} {}\n", accumulation.kind,
                       accumulation.why);
}

std::string work_lines(const Plan& plan) {
    const WorkEstimate& work = plan.work;
    std::string text =
        work.photons > 0 || plan.work_of == std::string("photons")
            ? fmt::format("work, foretold\n  {:<28} {:.4g}\n", plan.work_of, work.photons)
            : fmt::format("work, foretold\n  {:<28} as the error or the time decides\n",
                          plan.work_of);
    if (!work.known)
        return text +
               fmt::format("  {:<28} shows once the values are read: --exact\n", "scatterings");
    return text + fmt::format("  {:<28} about {:.3g} each, {:.3g} in all ({})\n", "scatterings",
                              work.scatterings_per_photon, work.scatterings, work.law);
}

std::string limit_lines(const Plan& plan) {
    std::string text = "limits (--limit NAME=N)\n";
    for (const LimitUse& limit : plan.limits)
        text +=
            fmt::format("  {:<28} {} of {}\n", limit_row(limit.id).name,
                        limit.known ? fmt::to_string(limit.needs) : "not known yet", limit.allowed);
    return text;
}

std::string time_lines(const ForetoldTime& time) {
    if (!(time.total_s > 0)) return "";
    std::string text =
        fmt::format("time on this machine\n  {:<28} about {:.3g} s\n", "in all", time.total_s);
    if (time.next_s > 0)
        text += fmt::format("  {:<28} about {:.3g} s\n  {:<28} about {:.3g} s\n", "first frame",
                            time.first_s, "each further frame", time.next_s);
    return text;
}

std::string plan_lines(const Plan& plan) {
    return part_lines(plan) + memory_lines(plan) + bound_lines(plan) +
           accumulation_lines(plan.accumulation) +
           fmt::format("bias, where no noise is left\n  {:<28} {} ({})\n", plan.bias.method,
                       plan.bias.size, plan.bias.page) +
           work_lines(plan) + time_lines(plan.foretold) + limit_lines(plan);
}

/// In place of the plan: what ranks cost.
Status tell_ranks(const PlanArguments& arguments, const Scene& scene, const Plan& plan) {
    std::int64_t most = 0;
    RankLink link;
    MethodRow row;
    PILEUS_TRY(read_integer("--ranks", *arguments.ranks, 1, kMaxParts, most));
    if (arguments.link) PILEUS_TRY(read_link(*arguments.link, link));
    PILEUS_TRY(find_method(scene, row));
    const std::vector<RankCost> costs = rank_costs(plan, row.division, link, int(most));
    return print(arguments.json ? rank_json(costs) : rank_lines(costs, link));
}

Status run_plan(PlanArguments& arguments) {
    Scene scene;
    RenderOptions options;
    Report report;
    PILEUS_TRY(take_picture(arguments.scene));
    PILEUS_TRY(read_scene_options(arguments.scene, scene, options));
    options.last_frame = scene.animation.present ? scene.animation.frames - 1 : 0;
    if (arguments.scene.picture) {
        PILEUS_TRY(picture_frames(*arguments.scene.picture, scene, options.first_frame,
                                  options.last_frame));
        PILEUS_TRY(check_scene_files(*arguments.scene.picture, scene));
    }
    PILEUS_TRY(plan_scene(scene, options, arguments.exact, report));
    if (arguments.time || arguments.ranks) {
        ForetoldTime time;
        PILEUS_TRY(foretell_time(scene, options, time));
        report.plan.foretold = time;
    }
    if (arguments.ranks) return tell_ranks(arguments, scene, report.plan);
    return print(arguments.json ? plan_json(report) : plan_lines(report.plan));
}

}  // namespace

void add_plan(CLI::App& app, Chosen& chosen) {
    CLI::App* command =
        app.add_subcommand("plan", "Say what a rendering needs, from sizes, without its values");
    const auto arguments = std::make_shared<PlanArguments>();
    add_scene_options(*command, arguments->scene,
                      "pileus plan cloud.toml --budget photons=1000000");
    add_picture_options(*command, arguments->scene);
    command->add_flag("--json", arguments->json, "Print JSON");
    command->add_flag("--exact", arguments->exact,
                      "Read the values and prepare everything but the photons: exact bytes");
    command->add_flag("--time", arguments->time,
                      "Render it small twice to say how long it will take");
    command
        ->add_option("--ranks", arguments->ranks,
                     "Instead: what 1, 2, 4, ... to N ranks or parts would hold, send and take")
        ->type_name("N");
    command
        ->add_option("--link", arguments->link,
                     "Of their network: latency of a message and bandwidth; left out: 2,10")
        ->type_name("US,GB_PER_S");
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_plan(*arguments); }; });
}

}  // namespace pileus
