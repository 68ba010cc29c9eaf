// SPDX-License-Identifier: Apache-2.0
// Fuzz target: OpenVDB fog volumes.
// in: bytes as a .vdb file -> out: a lawful volume and an equal head, or one line with its place.
// docs/formats.md
#include "src/io/volumes/vdb/vdb_file.h"
#include "tests/fuzz/target.h"

int fuzz::vdb(const std::uint8_t* data, std::size_t size) {
    return fuzz::check_sparse_grid("v.vdb", fuzz::text_of(data, size), pileus::decode_vdb,
                                   pileus::decode_vdb_head);
}
