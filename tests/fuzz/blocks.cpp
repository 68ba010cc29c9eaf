// SPDX-License-Identifier: Apache-2.0
// Fuzz target: files of blocks, as any other renderer may write them.
// in: bytes as a file of blocks -> out: sums that survive a round trip, or one line with its place.
// docs/crosscheck.md, "File of blocks"
#include "lab/compare/blocks.h"

#include "tests/fuzz/target.h"

int fuzz::blocks(const std::uint8_t* data, std::size_t size) {
    pileus::BlockSums blocks, again;
    const pileus::Status status = pileus::read_blocks("b.txt", fuzz::text_of(data, size), blocks);
    if (!status) {
        fuzz::check_fault(status, "b.txt:", true);
        return 0;
    }
    fuzz::require(blocks.passes.size() == blocks.blocks(), "a block has its passes");
    fuzz::require(blocks.sums.size() == 3 * blocks.blocks(), "a block has three channels");
    for (const double passes : blocks.passes)
        fuzz::require(passes >= 2 && passes <= 1e15, "2 to 1e15 passes");
    const std::string text = pileus::blocks_text(blocks);
    fuzz::require(bool(pileus::read_blocks("b.txt", {text.data(), text.size()}, again)),
                  "what was written can be read");
    fuzz::require(pileus::blocks_text(again) == text, "a round trip keeps every digit");
    return 0;
}
