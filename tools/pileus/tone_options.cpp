// SPDX-License-Identifier: Apache-2.0
// See tone_options.h.
// in: texts from the command line -> out: checked settings.
// docs/exposure.md
#include "tools/pileus/tone_options.h"

#include "src/io/images/develop/tones.h"
#include "src/io/images/develop/white_balance.h"
#include "src/scene/keys/key_value.h"
#include "src/scene/rows/picture_format.h"
#include "tools/pileus/option_text.h"

namespace pileus {
namespace {

bool shows_tone(const std::string& path) {
    const PictureFormat* format = picture_format_of(path);
    return format != nullptr && !format->radiance;
}

Status read_stops(const std::string& text, ToneSettings& tone) {
    constexpr double kMaxStops = 64;
    tone.automatic = text == "auto";
    if (tone.automatic) return Status::ok();
    double stops = 0;
    Status status = read_number("--exposure", text, -kMaxStops, kMaxStops, stops);
    if (!status) status.message += ", or auto";
    tone.stops = float(stops);
    return status;
}

}  // namespace

const char* ToneArguments::given() const {
    return exposure        ? "--exposure"
           : tone          ? "--tone"
           : white_balance ? "--white-balance"
           : glare         ? "--glare"
                           : nullptr;
}

void add_tone_options(CLI::App& command, ToneArguments& arguments,
                      const std::string& exposure_help) {
    command.add_option("--exposure", arguments.exposure, exposure_help)->type_name("STOPS|auto");
    command
        .add_option("--tone", arguments.tone,
                    "Tone curve of .png and .ppm: " + tone_names() + "; left out: standard")
        ->type_name("NAME");
    command
        .add_option("--white-balance", arguments.white_balance,
                    "Colour temperature that .png and .ppm show as white; left out: light as it is")
        ->type_name("KELVIN");
    command
        .add_option("--glare", arguments.glare,
                    "Share of the light that a lens spreads in .png and .ppm; left out: 0")
        ->type_name("SHARE");
}

Status read_tone(const ToneArguments& arguments, ToneSettings& tone) {
    Status faults;
    if (arguments.exposure) add_fault(read_stops(*arguments.exposure, tone), faults);
    if (arguments.tone && !find_tone(*arguments.tone, tone.tone))
        add_fault(Status::bad_input("--tone: no such curve, " + quote_text(*arguments.tone) +
                                    ", allowed: " + tone_names()),
                  faults);
    if (arguments.white_balance)
        add_fault(read_number("--white-balance", *arguments.white_balance, kMinWhite, kMaxWhite,
                              tone.white_k),
                  faults);
    if (arguments.glare)
        add_fault(read_number("--glare", *arguments.glare, 0, 1, tone.glare), faults);
    return faults;
}

Status refuse_tone(const ToneArguments& arguments) {
    if (arguments.given() == nullptr) return Status::ok();
    return Status::bad_input(std::string(arguments.given()) +
                             ": a view's colours are no light, allowed: leave it out, or --show "
                             "illumination");
}

Status check_tone_files(const ToneArguments& arguments, const std::vector<std::string>& files) {
    const char* const option = arguments.given();
    if (option == nullptr) return Status::ok();
    for (const std::string& file : files)
        if (shows_tone(file)) return Status::ok();
    return Status::bad_input(std::string(option) +
                             ": no file shows it, radiance is written as it is, allowed: with a "
                             ".png or .ppm file");
}

std::string tone_text(const ToneArguments& arguments) {
    std::string text;
    const auto add = [&](const char* name, const std::optional<std::string>& value) {
        if (value) text += (text.empty() ? "" : ", ") + (name + (' ' + *value));
    };
    add("exposure", arguments.exposure);
    add("tone", arguments.tone);
    add("white balance", arguments.white_balance);
    add("glare", arguments.glare);
    return text;
}

}  // namespace pileus
