// SPDX-License-Identifier: Apache-2.0
// See overlay.h. Letters are five columns of seven bits each, the lowest bit at the top.
#include "tools/view/overlay.h"

#include <algorithm>

namespace pileus::view {
namespace {

constexpr int kColumns = 5, kRows = 7, kAdvance = 6, kLine = 9;

struct Glyph {
    char letter;
    std::uint8_t columns[kColumns];
};
constexpr Glyph kGlyphs[] = {
    {'A', {0x7E, 0x11, 0x11, 0x11, 0x7E}}, {'B', {0x7F, 0x49, 0x49, 0x49, 0x36}},
    {'C', {0x3E, 0x41, 0x41, 0x41, 0x22}}, {'D', {0x7F, 0x41, 0x41, 0x22, 0x1C}},
    {'E', {0x7F, 0x49, 0x49, 0x49, 0x41}}, {'F', {0x7F, 0x09, 0x09, 0x09, 0x01}},
    {'G', {0x3E, 0x41, 0x49, 0x49, 0x7A}}, {'H', {0x7F, 0x08, 0x08, 0x08, 0x7F}},
    {'I', {0x00, 0x41, 0x7F, 0x41, 0x00}}, {'J', {0x20, 0x40, 0x41, 0x3F, 0x01}},
    {'K', {0x7F, 0x08, 0x14, 0x22, 0x41}}, {'L', {0x7F, 0x40, 0x40, 0x40, 0x40}},
    {'M', {0x7F, 0x02, 0x0C, 0x02, 0x7F}}, {'N', {0x7F, 0x04, 0x08, 0x10, 0x7F}},
    {'O', {0x3E, 0x41, 0x41, 0x41, 0x3E}}, {'P', {0x7F, 0x09, 0x09, 0x09, 0x06}},
    {'Q', {0x3E, 0x41, 0x51, 0x21, 0x5E}}, {'R', {0x7F, 0x09, 0x19, 0x29, 0x46}},
    {'S', {0x46, 0x49, 0x49, 0x49, 0x31}}, {'T', {0x01, 0x01, 0x7F, 0x01, 0x01}},
    {'U', {0x3F, 0x40, 0x40, 0x40, 0x3F}}, {'V', {0x1F, 0x20, 0x40, 0x20, 0x1F}},
    {'W', {0x3F, 0x40, 0x38, 0x40, 0x3F}}, {'X', {0x63, 0x14, 0x08, 0x14, 0x63}},
    {'Y', {0x07, 0x08, 0x70, 0x08, 0x07}}, {'Z', {0x61, 0x51, 0x49, 0x45, 0x43}},
    {'0', {0x3E, 0x51, 0x49, 0x45, 0x3E}}, {'1', {0x00, 0x42, 0x7F, 0x40, 0x00}},
    {'2', {0x42, 0x61, 0x51, 0x49, 0x46}}, {'3', {0x21, 0x41, 0x45, 0x4B, 0x31}},
    {'4', {0x18, 0x14, 0x12, 0x7F, 0x10}}, {'5', {0x27, 0x45, 0x45, 0x45, 0x39}},
    {'6', {0x3C, 0x4A, 0x49, 0x49, 0x30}}, {'7', {0x01, 0x71, 0x09, 0x05, 0x03}},
    {'8', {0x36, 0x49, 0x49, 0x49, 0x36}}, {'9', {0x06, 0x49, 0x49, 0x29, 0x1E}},
    {'.', {0x00, 0x60, 0x60, 0x00, 0x00}}, {',', {0x00, 0x50, 0x30, 0x00, 0x00}},
    {':', {0x00, 0x36, 0x36, 0x00, 0x00}}, {'/', {0x20, 0x10, 0x08, 0x04, 0x02}},
    {'%', {0x23, 0x13, 0x08, 0x64, 0x62}}, {'+', {0x08, 0x08, 0x3E, 0x08, 0x08}},
    {'-', {0x08, 0x08, 0x08, 0x08, 0x08}}, {'(', {0x00, 0x1C, 0x22, 0x41, 0x00}},
    {')', {0x00, 0x41, 0x22, 0x1C, 0x00}}, {'=', {0x14, 0x14, 0x14, 0x14, 0x14}},
    {'<', {0x08, 0x14, 0x22, 0x41, 0x00}}, {'>', {0x00, 0x41, 0x22, 0x14, 0x08}},
};

const std::uint8_t* columns_of(char letter) {
    if (letter >= 'a' && letter <= 'z') letter = char(letter - 'a' + 'A');
    for (const Glyph& g : kGlyphs)
        if (g.letter == letter) return g.columns;
    return nullptr;
}

void fill(const Canvas& c, int x, int y, int width, int height, int grey, bool over) {
    for (int j = std::max(y, 0); j < std::min(y + height, c.height); ++j)
        for (int i = std::max(x, 0); i < std::min(x + width, c.width); ++i) {
            std::uint8_t* at = c.pixels + 4 * (std::ptrdiff_t(j) * c.width + i);
            for (int n = 0; n < 3; ++n) at[n] = std::uint8_t(over ? grey : (at[n] + 2 * grey) / 3);
        }
}

}  // namespace

void draw_text(const Canvas& canvas, int x, int y, int scale,
               const std::vector<std::string>& lines) {
    std::size_t longest = 0;
    for (const std::string& line : lines) longest = std::max(longest, line.size());
    fill(canvas, x - 3 * scale, y - 3 * scale, (int(longest) * kAdvance + 5) * scale,
         (int(lines.size()) * kLine + 4) * scale, 20, false);
    for (std::size_t n = 0; n < lines.size(); ++n)
        for (std::size_t i = 0; i < lines[n].size(); ++i) {
            const std::uint8_t* columns = columns_of(lines[n][i]);
            for (int a = 0; a < kColumns && columns != nullptr; ++a)
                for (int b = 0; b < kRows; ++b)
                    if ((columns[a] >> b & 1) != 0)
                        fill(canvas, x + (int(i) * kAdvance + a) * scale,
                             y + (int(n) * kLine + b) * scale, scale, scale, 235, true);
        }
}

void draw_times(const Canvas& canvas, int x, int y, int width, int height,
                const std::deque<double>& seconds, double target_s) {
    fill(canvas, x, y, width, height, 20, false);
    const auto bar = [&](double s) { return std::min(int(0.5 * height * s / target_s), height); };
    int at = x + width;
    for (std::size_t i = seconds.size(); i-- > 0 && at > x;) {
        at -= 2;
        const int h = bar(seconds[i]);
        fill(canvas, at, y + height - h, 1, h, 200, true);
    }
    fill(canvas, x, y + height - bar(target_s), width, 1, 130, true);
}

void draw_slider(const Canvas& canvas, int height, double share) {
    const int y = canvas.height - height;
    fill(canvas, 0, y, canvas.width, height, 20, false);
    fill(canvas, 8, y + height / 2, canvas.width - 16, 1, 150, true);
    const int at = 8 + int(share * (canvas.width - 16));
    fill(canvas, at - 3, y + 4, 7, height - 8, 235, true);
}

}  // namespace pileus::view
