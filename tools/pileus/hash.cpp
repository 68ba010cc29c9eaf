// SPDX-License-Identifier: Apache-2.0
// pileus hash: the name of a picture's pixels, whatever file they lie in.
// in: an .exr or .pfm file -> out: 16 hex digits on stdout.
// docs/program.md
#include <memory>

#include "src/base/file.h"
#include "src/io/image_file.h"
#include "tools/pileus/command.h"

namespace pileus {

namespace {

Status run_hash(const std::string& file) {
    Image image;
    PILEUS_TRY(check_file_name(file));
    PILEUS_TRY(read_image(file, image));
    return print(pixel_hash(image) + '\n');
}

}  // namespace

void add_hash(CLI::App& app, Chosen& chosen) {
    CLI::App* command = app.add_subcommand("hash", "Print the pixel hash of a picture");
    const auto file = std::make_shared<std::string>();
    command->add_option("file", *file, "An .exr or .pfm file")->required()->type_name("FILE");
    command->callback([file, &chosen] { chosen = [file] { return run_hash(*file); }; });
}

}  // namespace pileus
