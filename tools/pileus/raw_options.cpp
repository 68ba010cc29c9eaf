// SPDX-License-Identifier: Apache-2.0
// Options that describe a raw grid.
// in: texts of the command line -> out: see raw_options.h.
// docs/program.md
#include "tools/pileus/raw_options.h"

#include "src/scene/toml/toml_tree.h"
#include "tools/pileus/option_text.h"

namespace pileus {

void add_raw_options(CLI::App& command, RawOptions& options) {
    command.add_option("--size", options.size, "Cells of a .raw grid along x, y and z")
        ->expected(3)
        ->type_name("N");
    command.add_option("--type", options.type, "Of a .raw grid: float32, uint16 or uint8")
        ->type_name("TYPE");
    command.add_flag("--big-endian", options.big_endian, "Byte order of a .raw grid");
}

Status read_raw_type(const RawOptions& options, RawType& type) {
    if (options.type == "float32")
        type = RawType::kFloat32;
    else if (options.type == "uint16")
        type = RawType::kUint16;
    else if (options.type == "uint8")
        type = RawType::kUint8;
    else
        return Status::bad_input("--type: unknown, " + quote_text(options.type) +
                                 ", allowed: float32, uint16, uint8");
    return Status::ok();
}

Status read_raw_facts(const std::string& file, const RawOptions& options, MediumSettings& medium) {
    if (options.size.size() != 3)
        return Status::bad_input(file +
                                 ": --size: missing, allowed: --size NX NY NZ for a raw grid");
    for (std::size_t a = 0; a < 3; ++a) {
        std::int64_t side = 0;
        PILEUS_TRY(read_integer("--size", options.size[a], 1, kMaxVolumeSide, side));
        medium.source.raw_size[a] = int(side);
    }
    medium.source.raw_big_endian = options.big_endian;
    return read_raw_type(options, medium.source.raw_type);
}

}  // namespace pileus
