// SPDX-License-Identifier: Apache-2.0
// What independent passes of one picture say block by block: a count, sums and sums of squares.
// in: pictures of one scene under several seeds -> out: a text file; and back.
// docs/crosscheck.md, "File of blocks": any other program can write it.
#pragma once
#include <string>
#include <vector>

#include "src/base/status.h"
#include "src/io/images/image.h"

namespace pileus {

/// One channel of one block: `sum` and `square` over the passes of the block's mean radiance.
struct BlockSum {
    double sum = 0, square = 0;
};

/// Blocks in rows from the top, three channels R G B each; the last block is the whole picture.
/// Blocks at the right and lower edge may be smaller.
struct BlockSums {
    int width = 0, height = 0;   ///< of the picture, pixels
    int side = 0;                ///< of a block, pixels
    std::vector<double> passes;  ///< [block]
    std::vector<BlockSum> sums;  ///< [block][channel]

    int columns() const { return (width + side - 1) / side; }
    int rows() const { return (height + side - 1) / side; }
    std::size_t blocks() const { return std::size_t(columns()) * std::size_t(rows()) + 1; }
};

/// Makes room for pictures of that size. All in 1..2^14, or the result of a file's check.
void start_blocks(int width, int height, int side, BlockSums& blocks);

/// Adds one pass. kBadInput: another size, no R G B, a pixel that is no finite number.
Status add_pass(const Image& image, BlockSums& blocks);

/// The file's text.
std::string blocks_text(const BlockSums& blocks);

/// Reads such a text; `name` opens each line about a fault. kBadInput: not of this form, too short
/// or too long, fewer than 2 passes, no finite number, squares smaller than the sums allow.
Status read_blocks(const std::string& name, Span<const char> text, BlockSums& blocks);

}  // namespace pileus
