// SPDX-License-Identifier: Apache-2.0
// pileus flux: what a scene's media send back, let through and keep of the sun's light.
// in: a scene -> out: shares with standard errors on stdout, as lines or JSON; maps as a picture.
// docs/flux.md
#define JSON_NOEXCEPTION 1
#include "src/session/flux.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "platform/clock.h"
#include "src/base/output_check.h"
#include "src/io/images/image_file.h"
#include "src/io/text/scene_files.h"
#include "tools/pileus/command.h"
#include "tools/pileus/option_text.h"
#include "tools/pileus/output_set.h"
#include "tools/pileus/progress.h"
#include "tools/pileus/scene_options.h"

namespace pileus {
namespace {

using Json = nlohmann::ordered_json;

struct FluxArguments {
    SceneArguments scene;
    std::vector<std::string> columns;
    std::optional<std::string> file;
    bool json = false, quiet = false;
};

/// All channels as one, weighed by the sun's light in each.
struct Weighed {
    double mean = 0, standard_error = 0;
};
Weighed weigh(const FluxResult& flux, const FluxShare& share) {
    Weighed out;
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const double weight = double(flux.irradiance[c]);
        sum += weight;
        out.mean += weight * share.mean[c];
        // Channels share their paths: their errors add up.
        out.standard_error += weight * share.standard_error[c];
    }
    return {out.mean / sum, out.standard_error / sum};
}

/// What is not direct.
FluxShare diffuse_of(const FluxResult& flux) {
    FluxShare out = flux.transmittance;
    for (std::size_t c = 0; c < 3; ++c) out.mean[c] -= flux.transmittance_direct.mean[c];
    return out;
}

Json json_of(const FluxResult& flux, const FluxShare& share) {
    const Weighed all = weigh(flux, share);
    return {{"mean", all.mean},
            {"standard_error", all.standard_error},
            {"channels", share.mean},
            {"channel_errors", share.standard_error}};
}

std::string json_text(const FluxResult& flux, const Report& report) {
    Json json;
    json["version"] = report.version;
    json["scene"] = report.scene;
    json["method"] = report.method;
    json["seed"] = report.seed;
    json["mu0"] = flux.mu0;
    json["irradiance"] = flux.irradiance;
    json["reflectance"] = json_of(flux, flux.reflectance);
    json["transmittance"] = json_of(flux, flux.transmittance);
    json["transmittance_direct"] = json_of(flux, flux.transmittance_direct);
    json["transmittance_diffuse"] = json_of(flux, diffuse_of(flux));
    json["absorptance"] = json_of(flux, flux.absorptance);
    json["columns"] = flux.columns;
    json["samples_per_column"] = flux.samples;
    json["paths"] = flux.paths;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string lines_of(const FluxResult& flux) {
    std::string text;
    const auto add = [&](const char* name, const FluxShare& share) {
        const Weighed all = weigh(flux, share);
        text += fmt::format("{:24} {:.6f}  standard error {:.6f}\n", name, all.mean,
                            all.standard_error);
    };
    add("reflectance", flux.reflectance);
    add("transmittance", flux.transmittance);
    add("  direct", flux.transmittance_direct);
    add("  diffuse", diffuse_of(flux));
    add("absorptance", flux.absorptance);
    text += fmt::format(
        "of the sun's irradiance on a level plane, mu0 {:.6g}; {} x {} columns, {} "
        "paths each\n",
        flux.mu0, flux.columns[0], flux.columns[1], flux.samples);
    return text;
}

Status read_columns(const std::vector<std::string>& texts, FluxSettings& settings) {
    for (std::size_t a = 0; a < 2 && !texts.empty(); ++a) {
        std::int64_t n = 0;
        // One number counts along both axes.
        PILEUS_TRY(read_integer("--columns", texts[a < texts.size() ? a : 0], 1, 32768, n));
        settings.columns[a] = int(n);
    }
    return Status::ok();
}

Status check_file(const std::string& file, const Scene& scene) {
    if (file.empty()) return Status::ok();
    OutputCheck check;
    check.reads(scene.file, "the scene itself");
    for (const std::string& read : scene_files(scene))
        check.reads(read, "a file that the scene reads");
    PILEUS_TRY(check.writes(file));
    PILEUS_TRY(can_write_image(file));
    return can_write_file(file);
}

Status run_flux(FluxArguments& arguments) {
    Scene scene;
    RenderOptions options;
    FluxSettings settings;
    PILEUS_TRY(read_columns(arguments.columns, settings));
    // A detector needs no view.
    for (const char* key :
         {"camera.position_m=[0,-1,0]", "camera.target_m=[0,0,0]", "camera.up=[0,0,1]"})
        arguments.scene.sets.insert(arguments.scene.sets.begin(), key);
    PILEUS_TRY(read_scene_options(arguments.scene, scene, options));
    const std::string file = arguments.file.value_or("");
    PILEUS_TRY(check_file(file, scene));
    Progress progress(!arguments.quiet && stderr_is_terminal());
    options.progress = [&progress](const char* stage, double share) {
        progress.tell(stage, share);
    };
    FluxResult flux;
    Image maps;
    Report report;
    const Status status = measure_flux(scene, options, settings, flux, maps, report);
    progress.clear();
    PILEUS_TRY(status);
    OutputSet set;
    std::string text = arguments.json ? json_text(flux, report) : lines_of(flux);
    if (!file.empty()) {
        maps.scene_text = scene.text;
        PILEUS_TRY(set.add_image(maps, file, ToneSettings{}));
        PILEUS_TRY(set.commit());
    }
    PILEUS_TRY(print(text));
    set.keep();
    return Status::ok();
}

}  // namespace

void add_flux(CLI::App& app, Chosen& chosen) {
    CLI::App* command = app.add_subcommand(
        "flux", "Measure what the media send back, let through and keep of the sun's light");
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
    command->add_flag("--json", arguments->json, "Print JSON");
    command->add_flag("-q,--quiet", arguments->quiet, "No progress");
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_flux(*arguments); }; });
}

}  // namespace pileus
