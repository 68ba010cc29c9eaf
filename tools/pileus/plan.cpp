// SPDX-License-Identifier: Apache-2.0
// pileus plan: what a rendering would need, what it leaves out and why, and its memory.
// in: a scene -> out: lines for people, or JSON with the report's keys.
// docs/program.md; docs/report.md
#include <fmt/format.h>

#include <memory>

#include "src/io/report_json.h"
#include "tools/pileus/command.h"
#include "tools/pileus/option_text.h"
#include "tools/pileus/scene_options.h"

namespace pileus {

namespace {

struct PlanArguments {
    SceneArguments scene;
    bool json = false;
};

std::string plan_lines(const Report& report) {
    std::string text = "needed\n";
    for (const std::string& part : report.needed) text += fmt::format("  {}\n", part);
    text += "left out\n";
    for (const ReportLeftOut& part : report.left_out)
        text += fmt::format("  {}: {}\n", part.what, part.why);
    text += "memory\n";
    for (const ReportBytes& item : report.bytes)
        text += fmt::format("  {:<36} {:>18} bytes\n", item.item, item.bytes);
    text += fmt::format("  {:<36} {:>18} bytes, {}\n", "total", report.total_bytes,
                        bytes_text(report.total_bytes));
    return text;
}

Status run_plan(const PlanArguments& arguments) {
    Scene scene;
    RenderOptions options;
    Report report;
    PILEUS_TRY(read_scene_options(arguments.scene, scene, options));
    PILEUS_TRY(plan_scene(scene, options, report));
    return print(arguments.json ? plan_json(report) : plan_lines(report));
}

}  // namespace

void add_plan(CLI::App& app, Chosen& chosen) {
    CLI::App* command = app.add_subcommand("plan", "Say what a rendering needs, without tracing");
    const auto arguments = std::make_shared<PlanArguments>();
    add_scene_options(*command, arguments->scene);
    command->add_flag("--json", arguments->json, "Print JSON");
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_plan(*arguments); }; });
}

}  // namespace pileus
