// SPDX-License-Identifier: Apache-2.0
// The values of one node of an OpenVDB tree: compressed blocks, masks, three kinds of numbers.
// in: a cursor at a node's values -> out: a float per entry, inactive entries 0.
// docs/formats.md
#pragma once
#include "src/base/buffer.h"
#include "src/io/text/byte_cursor.h"
#include "src/io/text/packed_bytes.h"
#include "src/io/volumes/vdb/vdb_grid.h"

namespace pileus {

constexpr unsigned kVdbMaxEntries = 1u << 15;  // a node of 32^3 entries

/// Whether bit `index` of a node's mask is on.
inline bool vdb_mask_on(const unsigned char* mask, unsigned index) {
    return (mask[index >> 3] >> (index & 7) & 1) != 0;
}

/// Number of bits that are on among `entries`, a multiple of 8.
unsigned vdb_mask_count(const unsigned char* mask, unsigned entries);

class VdbValues {
public:
    /// Takes working memory: kLimit where there is none.
    Status prepare(const VdbGrid& grid);

    /// Reads the values of a node with `entries` entries, of which `mask` are active; what at()
    /// gives for the others is 0.
    Status read(ByteCursor& in, const unsigned char* mask, unsigned entries);
    float at(unsigned entry) const { return values_.at(entry); }

    /// One number as it stands in tiles and backgrounds, never half.
    Status single(ByteCursor& in, const char* what, float& value) const;

private:
    Status block(ByteCursor& in, std::uint64_t bytes, Span<const unsigned char>& from);

    unsigned compression_ = 0, stored_bytes_ = 4, value_bytes_ = 4;
    Buffer<unsigned char> unpacked_;
    Buffer<float> values_;
};

}  // namespace pileus
