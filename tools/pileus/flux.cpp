// SPDX-License-Identifier: Apache-2.0
// pileus flux: what a scene's media send back, let through and keep of light.
// in: a scene -> out: shares with standard errors on stdout, as lines or JSON; maps as a picture;
// absorbed power as a volume.
// docs/flux.md
#include "src/session/flux/flux.h"

#include <memory>

#include "platform/clock.h"
#include "src/base/file.h"
#include "src/io/images/image_file.h"
#include "src/session/parts/flux_parts.h"
#include "src/session/run_context.h"
#include "tools/pileus/command.h"
#include "tools/pileus/flux_text.h"
#include "tools/pileus/option_text.h"
#include "tools/pileus/output_set.h"
#include "tools/pileus/part_files.h"
#include "tools/pileus/progress.h"
#include "tools/pileus/rank_files.h"
#include "tools/pileus/rank_render.h"
#include "tools/pileus/ranks.h"
#include "tools/pileus/scene_options.h"
#include "tools/study/output_check.h"
#include "tools/study/scene_files.h"

namespace pileus {
namespace {

struct FluxArguments {
    SceneArguments scene;
    std::vector<std::string> columns, cells, below;
    std::optional<std::string> method, file, absorbed, density, heat_capacity, sensors, part, stage;
    std::vector<std::string> merged;
    bool json = false, quiet = false;
};

Status read_counts(const char* option, const std::vector<std::string>& texts, int* counts,
                   std::size_t axes) {
    for (std::size_t a = 0; a < axes && !texts.empty(); ++a) {
        std::int64_t n = 0;
        // One number counts along all axes.
        PILEUS_TRY(read_integer(option, texts[a < texts.size() ? a : 0], 1, 32768, n));
        counts[a] = int(n);
    }
    return Status::ok();
}

/// By paths, unless only photons can do what is asked.
Status read_method(const FluxArguments& arguments, FluxSettings& settings) {
    settings.absorbed = arguments.absorbed.has_value();
    if (!arguments.method) {
        settings.method = settings.absorbed ? FluxMethod::kPhotons : FluxMethod::kPath;
        return Status::ok();
    }
    if (*arguments.method != "path" && *arguments.method != "photons")
        return Status::bad_input("--method: unknown, \"" + *arguments.method +
                                 "\", allowed: path, photons");
    settings.method = *arguments.method == "path" ? FluxMethod::kPath : FluxMethod::kPhotons;
    return Status::ok();
}

Status read_below(const FluxArguments& arguments, FluxSettings& settings) {
    settings.from_below = !arguments.below.empty();
    if (!settings.from_below) return Status::ok();
    const auto& texts = arguments.below;
    if (texts.size() == 2)
        return Status::bad_input("--from-below: two numbers, allowed: one, or R G B");
    double most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        double& radiance = settings.below_radiance[c];
        PILEUS_TRY(read_number("--from-below", texts[texts.size() == 3 ? c : 0], 0, 1e9, radiance));
        most = radiance > most ? radiance : most;
    }
    return most >= 1e-9 ? Status::ok()
                        : Status::bad_input(
                              "--from-below: dark, allowed: a channel of 1e-9 to "
                              "1e+9");
}

Status read_heating(const FluxArguments& arguments, AirHeating& heating) {
    if (!arguments.density && !arguments.heat_capacity) return Status::ok();
    if (!arguments.density || !arguments.heat_capacity)
        return Status::bad_input(
            std::string(arguments.density ? "--heat-capacity" : "--density") +
            ": missing, allowed: both of --density and --heat-capacity, or neither");
    if (!arguments.absorbed)
        return Status::bad_input(
            "--density: heats by what --absorbed measures, allowed: beside it");
    PILEUS_TRY(read_number("--density", *arguments.density, 1e-9, 1e5, heating.density_kg_m3));
    return read_number("--heat-capacity", *arguments.heat_capacity, 1e-3, 1e6,
                       heating.heat_capacity_j_kg_k);
}

Status read_settings(const FluxArguments& arguments, FluxSettings& settings, AirHeating& heating) {
    PILEUS_TRY(read_method(arguments, settings));
    PILEUS_TRY(read_counts("--columns", arguments.columns, settings.columns.data(), 2));
    PILEUS_TRY(read_counts("--cells", arguments.cells, settings.cells.data(), 3));
    if (!arguments.cells.empty() && !settings.absorbed)
        return Status::bad_input("--cells: of what --absorbed measures, allowed: beside it");
    PILEUS_TRY(read_below(arguments, settings));
    PILEUS_TRY(read_heating(arguments, heating));
    if (!arguments.sensors) return Status::ok();
    settings.sensor_file = *arguments.sensors;
    return read_sensors(settings.sensor_file, settings.sensors);
}

/// The description beside a volume.
std::string head_file(const std::string& volume) { return volume + ".json"; }

Status check_files(const FluxArguments& arguments, const Scene& scene) {
    OutputCheck check;
    for (const std::string& part : arguments.merged) check.reads(part, "a part");
    check.reads(scene.file, "the scene itself");
    for (const std::string& read : scene_files(scene))
        check.reads(read, "a file that the scene reads");
    if (arguments.sensors) check.reads(*arguments.sensors, "the file of the sensors");
    if (arguments.absorbed) {
        if (file_extension(*arguments.absorbed) != ".raw")
            return Status::bad_input(*arguments.absorbed + ": extension: unknown, \"" +
                                     file_extension(*arguments.absorbed) + "\", allowed: .raw");
        for (const std::string& file : {*arguments.absorbed, head_file(*arguments.absorbed)}) {
            PILEUS_TRY(check.writes(file));
            PILEUS_TRY(can_write_file(file));
        }
    }
    if (!arguments.file || arguments.file->empty()) return Status::ok();
    PILEUS_TRY(check.writes(*arguments.file));
    if (!arguments.part) PILEUS_TRY(can_write_image(*arguments.file));
    return can_write_file(*arguments.file);
}

/// Maps and volumes.
Status add_files(const FluxArguments& arguments, const AirHeating& heating, const FluxResult& flux,
                 const Image& maps, OutputSet& set) {
    if (arguments.file && !arguments.file->empty())
        PILEUS_TRY(set.add_image(maps, *arguments.file, ToneSettings{}));
    if (arguments.absorbed) {
        Buffer<char> bytes;
        std::string head;
        PILEUS_TRY(absorbed_file(flux.absorbed, heating, *arguments.absorbed, bytes, head));
        PILEUS_TRY(set.add_bytes(bytes.span(), *arguments.absorbed));
        PILEUS_TRY(set.add_bytes({head.data(), head.size()}, head_file(*arguments.absorbed)));
    }
    return Status::ok();
}

/// The options that a measurement is of, beside those that a report tells.
std::string options_text(const FluxArguments& a) {
    std::string text = "method " + a.method.value_or("") + ", absorbed " +
                       (a.absorbed ? "yes" : "no") + ", sensors " + a.sensors.value_or("");
    for (const auto* list : {&a.columns, &a.cells, &a.below}) {
        text += ',';
        for (const std::string& word : *list) text += ' ' + word;
    }
    return text;
}

/// What parts of this measurement have in common.
void note_run(const FluxArguments& arguments, const Scene& scene, const Report& report,
              Image& told) {
    note_part(scene, report, told);
    told.origin.emplace_back("flux", options_text(arguments));
}

Status write_flux_part(const FluxArguments& arguments, const Scene& scene, RenderOptions& options,
                       const FluxSettings& settings) {
    if (!arguments.merged.empty() || ranks().count > 1)
        return Status::bad_input("--part: together with --merge or ranks of MPI, allowed: alone");
    if (!arguments.file || file_extension(*arguments.file) != ".part")
        return Status::bad_input("--part: writes one file, allowed: -o FILE.part");
    if (options.budget.samples <= 0 && options.budget.photons < 0)
        return Status::bad_input(
            "--part: no part knows how far the others are, allowed: --budget samples=N or "
            "photons=N");
    PILEUS_TRY(choose_part(*arguments.part, 0, options));
    KeptShare kept(options.part);
    options.sharing = &kept;
    options.part = WorkPart();
    FluxResult flux;
    Image maps;
    Report report;
    PILEUS_TRY(measure_flux(scene, options, settings, flux, maps, report));
    Part part;
    part.division = Division::kFlux;
    part.part = kept.part();
    PILEUS_TRY(kept.take(part.light));
    note_run(arguments, scene, report, part.rows);
    Buffer<char> bytes;
    PILEUS_TRY(encode_part(part, bytes));
    return write_file(*arguments.file, bytes.span());
}

/// All parts of this measurement, in their order.
Status read_flux_parts(const FluxArguments& arguments, const Scene& scene,
                       const RenderOptions& options, std::vector<Part>& parts) {
    Report report;
    Context context;
    PILEUS_TRY(make_context(scene, options, context, report));
    Part own;
    own.name = "this measurement";
    PILEUS_TRY(read_part_files(arguments.merged, parts));
    report.method = parts[0].told("method");
    note_run(arguments, scene, report, own.rows);
    own.division = Division::kFlux;
    own.part = parts[0].part;
    own.part.index = 0;
    PILEUS_TRY(check_one_work(parts[0], own));
    return check_parts(false, parts);
}

Status run_flux(FluxArguments& arguments) {
    Scene scene;
    RenderOptions options;
    FluxSettings settings;
    AirHeating heating;
    StagedFiles staged;
    PILEUS_TRY(staged.stage(arguments.stage, arguments.scene, &arguments.sensors));
    PILEUS_TRY(agree(read_settings(arguments, settings, heating)));
    // A detector needs no view; scenes do, above the ground.
    for (const char* key :
         {"camera.position_m=[0,-1,1e6]", "camera.target_m=[0,0,1e6]", "camera.up=[0,0,1]"})
        arguments.scene.sets.insert(arguments.scene.sets.begin(), key);
    PILEUS_TRY(agree(read_scene_options(arguments.scene, scene, options)));
    PILEUS_TRY(agree(check_files(arguments, scene)));
    if (arguments.part) return agree(write_flux_part(arguments, scene, options, settings));
    std::vector<Part> parts;
    if (!arguments.merged.empty()) PILEUS_TRY(read_flux_parts(arguments, scene, options, parts));
    ToldShare told(parts);
    options.sharing = parts.empty() ? rank_share() : &told;
    if (options.sharing == rank_share() && !arguments.scene.threads)
        PILEUS_TRY(share_ranks(false, 0, options));
    const bool first = ranks().is_first();
    Progress progress(first && !arguments.quiet && stderr_is_terminal());
    options.progress = [&progress](const char* stage, double share) {
        progress.tell(stage, share);
    };
    FluxResult flux;
    Image maps;
    Report report;
    const Status status = measure_flux(scene, options, settings, flux, maps, report);
    progress.clear();
    PILEUS_TRY(agree(status));
    if (!parts.empty()) PILEUS_TRY(told.end());
    if (!first) return agree(Status::ok());
    maps.scene_text = scene.text;
    OutputSet set;
    Status written = add_files(arguments, heating, flux, maps, set);
    if (written)
        written = set.commit(arguments.json ? flux_json(settings, flux, heating, report)
                                            : flux_lines(settings, flux, heating));
    return agree(written);
}

}  // namespace

void add_flux(CLI::App& app, Chosen& chosen) {
    CLI::App* command = app.add_subcommand(
        "flux", "Measure what the media send back, let through and keep of light");
    const auto arguments = std::make_shared<FluxArguments>();
    add_scene_options(*command, arguments->scene,
                      "pileus flux cloud.toml --columns 64 64 --budget samples=256 -o maps.exr");
    command
        ->add_option("--columns", arguments->columns,
                     "Of the maps along x and y; left out: the cells of the media")
        ->expected(1, 2)
        ->type_name("N [N]");
    command->add_option("-o,--output", arguments->file, "Maps, a pixel a column, e.g. maps.exr")
        ->type_name("FILE");
    command->add_option("--method", arguments->method, "path (the default) or photons")
        ->type_name("NAME");
    command
        ->add_option("--absorbed", arguments->absorbed,
                     "Absorbed power per volume, by photons, e.g. heat.raw")
        ->type_name("FILE");
    command->add_option("--cells", arguments->cells, "Of it; left out: the cells of the media")
        ->expected(1, 3)
        ->type_name("N [N N]");
    command->add_option("--density", arguments->density, "Of the air, for heating in K/day")
        ->type_name("KG_M3");
    command
        ->add_option("--heat-capacity", arguments->heat_capacity,
                     "Of the air, at constant pressure")
        ->type_name("J_KG_K");
    command->add_option("--sensors", arguments->sensors, "Places and levels to measure light at")
        ->type_name("FILE.toml");
    command
        ->add_option("--from-below", arguments->below,
                     "Instead of all lights: this radiance from the whole lower half space")
        ->expected(1, 3)
        ->type_name("RADIANCE");
    command
        ->add_option("--part", arguments->part,
                     "Measure one of N parts, on this machine or another, into -o FILE.part")
        ->type_name("I/N");
    command
        ->add_option("--merge", arguments->merged,
                     "What all parts have measured, with the same options")
        ->type_name("FILE.part");
    add_stage_option(*command, arguments->stage);
    command->add_flag("--json", arguments->json, "Print JSON");
    command->add_flag("-q,--quiet", arguments->quiet, "No progress");
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_flux(*arguments); }; });
}

}  // namespace pileus
