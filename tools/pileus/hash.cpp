// SPDX-License-Identifier: Apache-2.0
// pileus hash: the name of a picture's pixels, whatever file they lie in.
// in: an .exr, .pfm or .png file -> out: 16 hex digits on stdout.
// docs/program.md
#include <memory>

#include "src/base/file.h"
#include "src/io/images/picture.h"
#include "src/scene/rows/picture_format.h"
#include "tools/pileus/command.h"

namespace pileus {

namespace {

Status run_hash(const std::string& file, const std::string& layer) {
    Image image;
    std::string said;
    PILEUS_TRY(check_file_name(file));
    PILEUS_TRY(read_picture(file, layer, image, said));
    return print(pixel_hash(image) + '\n');
}

}  // namespace

void add_hash(CLI::App& app, Chosen& chosen) {
    CLI::App* command = app.add_subcommand("hash", "Print the pixel hash of a picture");
    const auto file = std::make_shared<std::string>(), layer = std::make_shared<std::string>();
    command->add_option("file", *file, "A picture: " + picture_extensions(is_read))
        ->required()
        ->type_name("FILE");
    command->add_option("--layer", *layer, "Layer of the file")->type_name("NAME");
    command->footer(help_example("pileus hash cloud.exr --layer cloud"));
    command->callback([=, &chosen] { chosen = [=] { return run_hash(*file, *layer); }; });
}

}  // namespace pileus
