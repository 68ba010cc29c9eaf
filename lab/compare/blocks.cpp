// SPDX-License-Identifier: Apache-2.0
// See blocks.h.
// in: pictures or text -> out: sums in doubles, in the order of the passes.
// docs/crosscheck.md, "File of blocks"
#include "lab/compare/blocks.h"

#include <cmath>

#include "src/base/number_text.h"
#include "src/base/printable.h"

namespace pileus {
namespace {

constexpr const char* kMagic = "pileus-blocks";
constexpr int kMaxSide = 1 << 14;

/// Words of a text, comments left out, with the line that each stands on.
struct Words {
    const std::string& name;
    const char* at;
    const char* end;
    int line = 1;

    Status fault(const std::string& what, const std::string& allowed) const {
        return Status::bad_input(name + ":" + std::to_string(line) + ": " + what +
                                 ", allowed: " + allowed);
    }
    bool skip() {
        for (; at != end; ++at) {
            if (*at == '#')
                while (at != end && *at != '\n') ++at;
            if (at == end) break;
            if (*at == '\n') ++line;
            if (*at != '\n' && *at != ' ' && *at != '\t' && *at != '\r') return true;
        }
        return false;
    }
    std::string word() {
        const char* from = at;
        while (at != end && *at != '\n' && *at != ' ' && *at != '\t' && *at != '\r') ++at;
        return std::string(from, at);
    }
    Status expect(const char* text) {
        if (!skip()) return fault("file: ends early", text);
        const std::string found = word();
        if (found == text) return Status::ok();
        return fault("word: \"" + printable_line(found.substr(0, 40)) + "\"",
                     std::string("\"") + text + "\"");
    }
    template <class Number>
    Status number(const char* what, double low, double high, Number& value) {
        if (!skip()) return fault(std::string(what) + ": the file ends before it", "all blocks");
        const std::string text = word();
        const char* last = text.data() + text.size();
        const auto [stop, error] = number_from(text.data(), last, value);
        if (error == std::errc() && stop == last && double(value) >= low && double(value) <= high)
            return Status::ok();
        return fault(std::string(what) + ": \"" + printable_line(text) + "\"",
                     "a number in [" + number_text(low) + ", " + number_text(high) + "]");
    }
};

Status read_head(Words& in, BlockSums& b) {
    int version = 0;
    PILEUS_TRY(in.expect(kMagic));
    PILEUS_TRY(in.number("version", 1, 1, version));
    PILEUS_TRY(in.expect("picture"));
    PILEUS_TRY(in.number("width", 1, kMaxSide, b.width));
    PILEUS_TRY(in.number("height", 1, kMaxSide, b.height));
    PILEUS_TRY(in.expect("side"));
    return in.number("side", 1, kMaxSide, b.side);
}

Status read_block(Words& in, double& passes, BlockSum* sums) {
    PILEUS_TRY(in.number("passes", 2, 1e15, passes));
    for (int c = 0; c < 3; ++c) {
        BlockSum& s = sums[c];
        PILEUS_TRY(in.number("sum", -1e150, 1e150, s.sum));
        PILEUS_TRY(in.number("sum of squares", 0, 1e300, s.square));
        // Cauchy and Schwarz; the last digits of both may be rounded.
        if (s.square * passes < s.sum * s.sum * (1 - 1e-5))
            return in.fault("sum of squares: too small for its sum", "at least sum * sum / passes");
    }
    return Status::ok();
}

void append(double value, char behind, std::string& text) {
    text += number_text(value);
    text += behind;
}

}  // namespace

void start_blocks(int width, int height, int side, BlockSums& blocks) {
    blocks = {};
    blocks.width = width;
    blocks.height = height;
    blocks.side = side;
    blocks.passes.assign(blocks.blocks(), 0);
    blocks.sums.assign(3 * blocks.blocks(), {});
}

Status add_pass(const Image& image, BlockSums& b) {
    if (image.width != b.width || image.height != b.height)
        return Status::bad_input("blocks: picture: another size than the first pass has");
    const std::size_t columns = std::size_t(b.columns()), width = std::size_t(b.width);
    const std::size_t side = std::size_t(b.side), last = b.blocks() - 1;
    std::vector<double> total(b.blocks()), pixels(b.blocks());
    for (std::size_t c = 0; c < 3; ++c) {
        const char* const names[] = {"R", "G", "B"};
        const Channel* channel = image.find(names[c]);
        if (channel == nullptr) return Status::bad_input("blocks: picture: has no R G B");
        total.assign(total.size(), 0);
        pixels.assign(pixels.size(), 0);
        for (std::size_t i = 0; i < channel->pixels.size(); ++i) {
            const double value = double(channel->pixels[i]);
            if (!std::isfinite(value))
                return Status::bad_input("blocks: picture: a pixel is no finite number");
            const std::size_t block = i / width / side * columns + i % width / side;
            total[block] += value;
            pixels[block] += 1;
            total[last] += value;
            pixels[last] += 1;
        }
        for (std::size_t i = 0; i <= last; ++i) {
            const double mean = total[i] / pixels[i];
            b.sums[3 * i + c].sum += mean;
            b.sums[3 * i + c].square += mean * mean;
        }
    }
    for (double& n : b.passes) n += 1;
    return Status::ok();
}

std::string blocks_text(const BlockSums& b) {
    std::string text = std::string(kMagic) + " 1\npicture " + std::to_string(b.width) + " " +
                       std::to_string(b.height) + " side " + std::to_string(b.side) +
                       "\n# passes, then sum and sum of squares of R, G and B: a line a block, "
                       "the whole picture last\n";
    for (std::size_t i = 0; i < b.blocks(); ++i) {
        append(b.passes[i], ' ', text);
        for (std::size_t c = 0; c < 3; ++c) {
            append(b.sums[3 * i + c].sum, ' ', text);
            append(b.sums[3 * i + c].square, c < 2 ? ' ' : '\n', text);
        }
    }
    return text;
}

Status read_blocks(const std::string& name, Span<const char> bytes, BlockSums& b) {
    const Span<const char> text = without_mark(bytes);
    Words in{name, text.begin(), text.end()};
    b = {};
    PILEUS_TRY(read_head(in, b));
    // A block takes seven numbers and as many blanks: believe no more than the file can hold.
    if (b.blocks() > text.size / 14 + 1)
        return in.fault("file: too short for " + std::to_string(b.blocks()) + " blocks",
                        "a line of seven numbers for each");
    start_blocks(b.width, b.height, b.side, b);
    for (std::size_t i = 0; i < b.blocks(); ++i)
        PILEUS_TRY(read_block(in, b.passes[i], &b.sums[3 * i]));
    if (in.skip())
        return in.fault("file: goes on after its last block",
                        std::to_string(b.blocks()) + " blocks");
    return Status::ok();
}

}  // namespace pileus
