// SPDX-License-Identifier: Apache-2.0
// pileus hash: the names of pictures' pixels, whatever files they lie in, and whether they are as
// they should be. in: .exr, .pfm or .png files, a list of hashes -> out: 16 hex digits on stdout, a
// line for each of several files; exit 1 where one differs. docs/program.md
#include <algorithm>
#include <memory>
#include <optional>

#include "lab/compare/picture.h"
#include "src/base/file.h"
#include "src/scene/rows/picture_format.h"
#include "tools/pileus/command.h"
#include "tools/pileus/hash_list.h"
#include "tools/pileus/option_text.h"

namespace pileus {

namespace {

struct HashArguments {
    std::vector<std::string> files;
    std::optional<std::string> expect;
    std::string layer;
};

Status hash_of(const std::string& file, const std::string& layer, std::string& hash) {
    Image image;
    std::string said;
    PILEUS_TRY(check_file_name(file));
    PILEUS_TRY(read_picture(file, layer, image, said));
    hash = pixel_hash(image);
    return Status::ok();
}

/// Whether a picture is as the list says.
Status check_hash(const std::string& file, const std::string& hash, const HashArguments& arguments,
                  const std::vector<ListedHash>& list) {
    const std::string expect = arguments.expect.value_or("");
    for (const ListedHash& entry : list) {
        if (!entry.file.empty() && !same_name(entry.file, file)) continue;
        if (entry.hash == hash) return Status::ok();
        return Status::check_failed(file + ": hash: differs, expected " + entry.hash + ", got " +
                                    hash);
    }
    return Status::check_failed(file + ": hash: not in " + expect + ", got " + hash);
}

/// The list, and the files to look at: those given, or else all that the list names.
Status read_list(HashArguments& arguments, std::vector<ListedHash>& list) {
    if (!arguments.expect && arguments.files.empty())
        return Status::bad_input(
            "pileus hash: FILE: missing, allowed: pictures, or --expect LIST; see pileus hash "
            "--help");
    if (!arguments.expect) return Status::ok();
    PILEUS_TRY(read_hash_list(*arguments.expect, list));
    if (list[0].file.empty() && arguments.files.size() != 1)
        return Status::bad_input(*arguments.expect + ":" + std::to_string(list[0].line) +
                                 ": no name, " + list[0].hash +
                                 ", allowed: a name behind the hash, or one FILE on the command "
                                 "line");
    if (!arguments.files.empty()) return Status::ok();
    for (const ListedHash& entry : list) arguments.files.push_back(entry.file);
    return Status::ok();
}

/// Says all that is wrong at once: a missing file must not hide a picture that differs.
Status run_hash(HashArguments arguments) {
    const bool alone = arguments.files.size() == 1;
    std::vector<ListedHash> list;
    PILEUS_TRY(read_list(arguments, list));
    Status faults;
    for (const std::string& file : arguments.files) {
        std::string hash;
        Status status = hash_of(file, arguments.layer, hash);
        if (status) {
            PILEUS_TRY(print(alone ? hash + '\n' : hash + "  " + file + '\n'));
            if (arguments.expect) status = check_hash(file, hash, arguments, list);
        }
        const Code worst = std::max(faults.code, status.code);
        add_fault(status, faults);
        faults.code = worst;
    }
    return faults;
}

}  // namespace

void add_hash(CLI::App& app, Chosen& chosen) {
    CLI::App* command = app.add_subcommand("hash", "Print the pixel hashes of pictures");
    const auto arguments = std::make_shared<HashArguments>();
    command->add_option("file", arguments->files, "Pictures: " + picture_extensions(is_read))
        ->type_name("FILE ...");
    command
        ->add_option("--expect", arguments->expect,
                     "A list of lines HASH  FILE: exit status 1 where a picture has another hash; "
                     "without FILE all pictures of the list")
        ->type_name("LIST");
    command->add_option("--layer", arguments->layer, "Layer of the files")->type_name("NAME");
    command->footer(
        help_example("pileus hash out/*.exr > hashes.txt\n  pileus hash --expect hashes.txt"));
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_hash(*arguments); }; });
}

}  // namespace pileus
