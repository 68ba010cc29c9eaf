// SPDX-License-Identifier: Apache-2.0
// Fuzz target: NanoVDB grids.
// in: bytes as an .nvdb file -> out: a lawful volume and an equal head, or one line with its place.
// docs/formats.md
#include "src/io/volumes/vdb/vdb_file.h"
#include "tests/fuzz/target.h"

int fuzz::nvdb(const std::uint8_t* data, std::size_t size) {
    return fuzz::check_sparse_grid("v.nvdb", fuzz::text_of(data, size), pileus::decode_nvdb,
                                   pileus::decode_nvdb_head);
}
