// SPDX-License-Identifier: Apache-2.0
// pileus compare: how far a picture is from a reference, in figures and pictures.
// in: two pictures, perhaps the reference's second half -> out: lines or JSON, pictures, exit 1
// over a limit. docs/compare.md
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "lab/compare/difference.h"
#include "lab/compare/metrics_json.h"
#include "lab/compare/picture.h"
#include "src/base/file.h"
#include "src/base/limits.h"
#include "src/io/images/picture_layers.h"
#include "src/scene/rows/picture_format.h"
#include "tools/pileus/block_files.h"
#include "tools/pileus/command.h"
#include "tools/pileus/option_text.h"
#include "tools/pileus/output_set.h"
#include "tools/pileus/tone_options.h"
#include "tools/study/output_check.h"

namespace pileus {

namespace {

/// As typed.
struct CompareArguments {
    std::string a, reference, half, layer;
    std::optional<std::string> reference_layer, alpha, range, threads, tone, density;
    ToneArguments shown;
    std::optional<std::string> difference, z_map, flip;
    std::optional<std::string> max_relmse, max_rmse, max_abs, max_bias, max_flip;
    std::optional<std::string> significance;
    bool json = false, no_flip = false, all = false, welch = false;
};

struct Limit {
    const char* option;
    const char* figure;
    const std::optional<std::string>* text;
    double most = 0;
};

/// What the options mean.
struct Settings {
    MetricOptions metrics;
    FlipOptions flip;
    ToneSettings exposure;
    double range = 0;  ///< 0: by the percentile
    std::vector<Limit> limits;
};

Status read_flip(const CompareArguments& arguments, FlipOptions& flip) {
    Status faults;
    if (arguments.tone) {
        const std::string& tone = *arguments.tone;
        if (tone == "hable")
            flip.tone = FlipTone::kHable;
        else if (tone == "reinhard")
            flip.tone = FlipTone::kReinhard;
        else if (tone != "aces")
            add_fault(Status::bad_input("--flip-tone: no such curve, " + tone +
                                        ", allowed: aces, hable, reinhard"),
                      faults);
    }
    if (arguments.density)
        add_fault(
            read_number("--pixels-per-degree", *arguments.density, 1, 1000, flip.pixels_per_degree),
            faults);
    if (arguments.threads) {
        std::int64_t threads = 0;
        add_fault(read_integer("--threads", *arguments.threads, 1, kMaxThreads, threads), faults);
        flip.threads = int(threads);
    }
    return faults;
}

Status read_settings(const CompareArguments& arguments, Settings& settings) {
    Status faults = read_flip(arguments, settings.flip);
    if (arguments.alpha)
        add_fault(
            read_number("--alpha-least", *arguments.alpha, 0, 1, settings.metrics.alpha_least),
            faults);
    add_fault(read_tone(arguments.shown, settings.exposure), faults);
    if (!arguments.shown.exposure && arguments.shown.given() != nullptr)
        add_fault(Status::bad_input(std::string(arguments.shown.given()) +
                                    ": without --exposure, allowed: together with it"),
                  faults);
    if (arguments.all) settings.metrics.alpha_least = -1;
    if (arguments.range)
        add_fault(read_number("--range", *arguments.range, 1e-30, 1e30, settings.range), faults);
    settings.limits = {{"--max-relmse", "relMSE", &arguments.max_relmse},
                       {"--max-rmse", "RMSE", &arguments.max_rmse},
                       {"--max-abs", "largest difference", &arguments.max_abs},
                       {"--max-bias", "bias over the mean", &arguments.max_bias},
                       {"--max-flip", "FLIP", &arguments.max_flip}};
    for (Limit& limit : settings.limits)
        if (*limit.text)
            add_fault(read_number(limit.option, **limit.text, 0, 1e30, limit.most), faults);
    if (arguments.no_flip && (arguments.flip || arguments.max_flip))
        add_fault(Status::bad_input("--no-flip: not together with --flip and --max-flip, allowed: "
                                    "one of them"),
                  faults);
    return faults;
}

/// Refuses what could not be written or would overwrite what is read, before the work is done.
Status check_outputs(const CompareArguments& arguments) {
    Status faults;
    OutputCheck check;
    for (const std::string& in : {arguments.a, arguments.reference, arguments.half})
        check.reads(in, "a picture to compare");
    for (const auto* output : {&arguments.difference, &arguments.z_map, &arguments.flip}) {
        if (!*output) continue;
        const std::string& path = **output;
        const Status name = check_file_name(path);
        add_fault(name, faults);
        if (!name) continue;
        add_fault(check.writes(path), faults);
        const Status format = can_write_image(path);
        add_fault(format, faults);
        if (format) add_fault(can_write_file(path), faults);
    }
    return faults;
}

bool shows_colours(const std::string& path) {
    const PictureFormat* format = picture_format_of(path);
    return format != nullptr && !format->radiance;
}

/// Values for formats of light, colours for pictures of 8 bits.
Status add_signed(const Image& values, double scale, const std::string& path, OutputSet& set) {
    if (!shows_colours(path)) return set.add_image(values, path, {});
    Image colours;
    PILEUS_TRY(signed_colours(values, scale, colours));
    return set.add_image(colours, path, {});
}

Status add_pictures(const CompareArguments& arguments, const Settings& settings, const Image& a,
                    const Image& reference, const Metrics& metrics, const FlipResult& flip_result,
                    OutputSet& set) {
    const double least = settings.metrics.alpha_least;
    Image picture;
    if (arguments.difference) {
        PILEUS_TRY(difference_picture(a, reference, least, picture));
        const double range = settings.range > 0 ? settings.range : metrics.percentile_999;
        PILEUS_TRY(add_signed(picture, range, *arguments.difference, set));
    }
    if (arguments.z_map) {
        constexpr double kRange = 6;
        PILEUS_TRY(z_picture(a, reference, least, picture));
        PILEUS_TRY(add_signed(picture, kRange, *arguments.z_map, set));
    }
    if (arguments.flip) {
        PILEUS_TRY(shows_colours(*arguments.flip) ? flip_colours(flip_result, picture)
                                                  : flip_picture(flip_result, picture));
        PILEUS_TRY(set.add_image(picture, *arguments.flip, {}));
    }
    return Status::ok();
}

/// One line per figure above its limit; what is not a number is above any.
Status check_limits(const std::string& file, const Settings& settings, const Metrics& metrics) {
    const double bias = metrics.bias / metrics.mean_reference;
    const double figures[5] = {metrics.relmse, metrics.rmse, metrics.largest,
                               bias < 0 ? -bias : bias, metrics.flip_mean};
    Status faults;
    bool asked = false;
    for (std::size_t i = 0; i < settings.limits.size(); ++i) {
        const Limit& limit = settings.limits[i];
        if (!*limit.text) continue;
        asked = true;
        if (figures[i] <= limit.most) continue;
        add_fault({Code::kCheckFailed,
                   fmt::format("{}: {}: above {}, {:.6g}, allowed: at most {:g}", file,
                               limit.figure, limit.option, figures[i], limit.most)},
                  faults);
    }
    // The largest difference is one pixel's: one that does not count for the means is one, too.
    const Limit& abs = settings.limits[2];
    if (*abs.text && metrics.uncounted_largest > abs.most && !(metrics.largest > abs.most))
        add_fault({Code::kCheckFailed,
                   fmt::format("{}: {}: above {} at pixel {}, {}, {:.6g}, where alpha is too low "
                               "to count, allowed: at most {:g}",
                               file, abs.figure, abs.option, metrics.uncounted_x,
                               metrics.uncounted_y, metrics.uncounted_largest, abs.most)},
                  faults);
    if (*abs.text && metrics.uncounted_not_finite > 0)
        add_fault({Code::kCheckFailed,
                   fmt::format("{}: pixels: not finite, {} whose alpha is too low to count, "
                               "allowed: none under {}",
                               file, metrics.uncounted_not_finite, abs.option)},
                  faults);
    if (asked && metrics.not_finite > 0)
        add_fault({Code::kCheckFailed,
                   fmt::format("{}: pixels: not finite, {}, allowed: none in what is compared",
                               file, metrics.not_finite)},
                  faults);
    return faults;
}

/// A picture as it is to be compared: as it is in the file, or as a display shows it.
Status read_one(const CompareArguments& arguments, const Settings& settings,
                const std::string& file, const std::string& layer, Image& image,
                std::string& said) {
    PILEUS_TRY(read_picture(file, layer, image, said));
    if (!arguments.shown.exposure || image.display_colours) return Status::ok();
    said += (said.empty() ? "" : ", ") + ("shown at " + tone_text(arguments.shown));
    return develop_image(settings.exposure, image);
}

/// kBadInput where one holds radiance and the other what a display shows of it.
Status check_same_kind(const std::string& name, const Image& image, const std::string& other_name,
                       const Image& other) {
    if (image.display_colours == other.display_colours) return Status::ok();
    const std::string& shown = image.display_colours ? name : other_name;
    const std::string& light = image.display_colours ? other_name : name;
    return Status::bad_input(shown + ": values: light of a display, while " + light +
                             " holds radiance, allowed: two files of one kind, or --exposure "
                             "STOPS|auto to compare what a display shows");
}

/// The two pictures, of one size; the second perhaps the mean of two halves, which stay.
Status read_pictures(const CompareArguments& arguments, const Settings& settings, Image& a,
                     Image& reference, Image (&halves)[2], ComparisonText& text) {
    const std::string& layer = arguments.layer;
    const std::string other = arguments.reference_layer.value_or(layer);
    PILEUS_TRY(read_one(arguments, settings, arguments.a, layer, a, text.said_a));
    PILEUS_TRY(
        read_one(arguments, settings, arguments.reference, other, reference, text.said_reference));
    PILEUS_TRY(check_same_kind(arguments.a, a, arguments.reference, reference));
    const Image* cut = nullptr;
    if (arguments.half.empty()) PILEUS_TRY(cut_to_part(a, reference, cut));
    if (cut != nullptr) {
        std::string& said = cut == &a ? text.said_a : text.said_reference;
        said += (said.empty() ? "" : ", ") +
                fmt::format("{} x {} pixels of it, which the other is", cut->width, cut->height);
    }
    if (!arguments.half.empty()) {
        Image &first = halves[0], &second = halves[1];
        std::string said;
        std::swap(first, reference);
        PILEUS_TRY(read_one(arguments, settings, arguments.half, other, second, said));
        PILEUS_TRY(check_same_kind(arguments.half, second, arguments.reference, first));
        PILEUS_TRY(check_same_size(arguments.half.c_str(), second, first));
        PILEUS_TRY(merge_halves(first, second, reference));
        reference.display_colours = first.display_colours;
        text.halves = true;
    }
    PILEUS_TRY(check_same_size(arguments.a.c_str(), a, reference));
    text.a = arguments.a;
    text.reference = arguments.reference;
    text.width = a.width;
    text.height = a.height;
    return Status::ok();
}

Status run_compare(const CompareArguments& arguments) {
    if (arguments.welch)
        return compare_blocks(arguments.a, arguments.reference, arguments.significance,
                              arguments.json);
    if (arguments.significance)
        return Status::bad_input("--significance: without --welch, allowed: with it");
    Settings settings;
    Status faults = read_settings(arguments, settings);
    add_fault(check_outputs(arguments), faults);
    for (const std::string& file : {arguments.a, arguments.reference})
        add_fault(check_file_name(file), faults);
    PILEUS_TRY(faults);

    Image a, reference, halves[2];
    ComparisonText text;
    PILEUS_TRY(read_pictures(arguments, settings, a, reference, halves, text));
    text.alpha_least = settings.metrics.alpha_least;
    Metrics metrics;
    PILEUS_TRY(text.halves ? compare_with_halves(a, halves[0], halves[1], settings.metrics, metrics)
                           : compare_images(a, reference, settings.metrics, metrics));
    FlipResult flip_result;
    settings.flip.hdr = !(a.display_colours && reference.display_colours);
    if (!arguments.no_flip) {
        PILEUS_TRY(flip(a, reference, settings.flip, flip_result));
        metrics.flip_mean = flip_result.mean;
    }

    OutputSet set;
    PILEUS_TRY(add_pictures(arguments, settings, a, reference, metrics, flip_result, set));
    const FlipResult* seen = arguments.no_flip ? nullptr : &flip_result;
    PILEUS_TRY(set.commit(arguments.json ? metrics_json(text, metrics, seen)
                                         : metrics_lines(text, metrics, seen)));
    return check_limits(arguments.a, settings, metrics);
}

void add_files(CLI::App& command, CompareArguments& arguments) {
    command.add_option("a", arguments.a, "The picture: " + picture_extensions(is_read))
        ->required()
        ->type_name("FILE");
    command.add_option("reference", arguments.reference, "What it is measured against")
        ->required()
        ->type_name("FILE");
    command
        .add_option("--half", arguments.half,
                    "A second, independent picture of the reference: the mean of both is the "
                    "reference, their difference its noise")
        ->type_name("FILE");
    command.add_option("--difference", arguments.difference, "Write a - reference")
        ->type_name("FILE");
    command.add_option("--z-map", arguments.z_map, "Write the difference in standard errors")
        ->type_name("FILE");
    command.add_option("--flip", arguments.flip, "Write FLIP's value of each pixel")
        ->type_name("FILE");
    command
        .add_option("--range", arguments.range,
                    "Difference of the darkest red and blue in a .png or .ppm; left out: the 99.9 "
                    "percentile")
        ->type_name("X");
}

void add_choices(CLI::App& command, CompareArguments& arguments) {
    command.add_option("--layer", arguments.layer, "Layer of the files to compare")
        ->type_name("NAME");
    command
        .add_option("--reference-layer", arguments.reference_layer,
                    "Layer of the reference; left out: that of --layer")
        ->type_name("NAME");
    add_tone_options(command, arguments.shown,
                     "Compare pictures of radiance as a display shows them: stops, or auto; left "
                     "out: as they are, and never with a .png");
    command
        .add_option("--alpha-least", arguments.alpha,
                    "Pixels count whose alpha in the reference is above this; left out: 0.02")
        ->type_name("X");
    command.add_flag("--all-pixels", arguments.all, "All pixels count");
    command.add_flag("--no-flip", arguments.no_flip, "Leave FLIP out");
    command.add_option("--flip-tone", arguments.tone, "Tone curve of HDR-FLIP; left out: aces")
        ->type_name("aces|hable|reinhard");
    command.add_option("--pixels-per-degree", arguments.density, "For FLIP; left out: 67.02")
        ->type_name("N");
    command.add_option("--threads", arguments.threads, "For FLIP; left out: all")->type_name("N");
}

}  // namespace

void add_compare(CLI::App& app, Chosen& chosen) {
    CLI::App* command =
        app.add_subcommand("compare", "Measure a picture against a reference; exit 1 over a limit");
    const auto arguments = std::make_shared<CompareArguments>();
    add_files(*command, *arguments);
    add_choices(*command, *arguments);
    const char* most = "Exit 1 above this";
    command->add_option("--max-relmse", arguments->max_relmse, most)->type_name("X");
    command->add_option("--max-rmse", arguments->max_rmse, most)->type_name("X");
    command->add_option("--max-abs", arguments->max_abs, "Exit 1 above this, largest difference")
        ->type_name("X");
    command->add_option("--max-bias", arguments->max_bias, "Exit 1 above this share of the mean")
        ->type_name("X");
    command->add_option("--max-flip", arguments->max_flip, "Exit 1 above this, mean of FLIP")
        ->type_name("X");
    command->add_flag("--json", arguments->json, "Print JSON");
    command->add_flag("--welch", arguments->welch,
                      "Both files are blocks of render --blocks or another program: test whether "
                      "their means differ; other options of pictures are left alone");
    command
        ->add_option("--significance", arguments->significance,
                     "Of --welch: chance of finding a difference where there is none; left out: "
                     "6.8e-6")
        ->type_name("P");
    command->footer(help_example(
        "pileus compare cloud.exr reference.exr --difference difference.png --max-relmse 0.01"));
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_compare(*arguments); }; });
}

}  // namespace pileus
