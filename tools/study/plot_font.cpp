// SPDX-License-Identifier: Apache-2.0
// A font of straight strokes, so that a plot needs neither a library nor a file to have words.
// in: ASCII text -> out: polylines.
// docs/study.md, "Plots"
#include "tools/study/plot_drawing.h"

namespace pileus {

namespace {

/// A letter's strokes on a grid: digits x y from the left and from the top of capitals (the
/// baseline is y = 6, small letters begin at 2, their tails end at 8); a blank lifts the pen.
struct Glyph {
    char letter;
    int width;  ///< of the grid, without the gap behind it
    const char* strokes;
};

constexpr Glyph kGlyphs[] = {
    {' ', 2, ""},
    {'!', 0, "0004 0606"},
    {'"', 2, "0002 2022"},
    {'#', 4, "1016 3036 0242 0444"},
    {'%', 4, "0640 0010110100 3545463635"},
    {'&', 4, "46110112213103 0304051636 3644"},
    {'\'', 0, "0002"},
    {'(', 1, "10010516"},
    {')', 1, "00111506"},
    {'*', 4, "2024 0143 4103"},
    {'+', 4, "0444 2226"},
    {',', 1, "1607"},
    {'-', 3, "0434"},
    {'.', 0, "0606"},
    {'/', 3, "3006"},
    {'0', 4, "103041453616050110"},
    {'1', 2, "011016 0626"},
    {'2', 4, "01103041420646"},
    {'3', 4, "0110304142334445361605 3313"},
    {'4', 4, "36300444"},
    {'5', 4, "400002324345361605"},
    {'6', 4, "3010010516364544331304"},
    {'7', 4, "004016"},
    {'8', 4, "1302011030414233130405163645443313"},
    {'9', 4, "4233130201103041453616"},
    {':', 0, "0303 0606"},
    {';', 1, "1313 1607"},
    {'<', 4, "420446"},
    {'=', 4, "0343 0545"},
    {'>', 4, "024406"},
    {'?', 4, "0110304142332324 2626"},
    {'@', 4, "3432120304152535344440301001051636"},
    {'A', 4, "062046 1434"},
    {'B', 4, "0006364544330030 0333 30414233 0030"},
    {'C', 4, "4130100105163645"},
    {'D', 4, "00062644422000"},
    {'E', 4, "40000646 0333"},
    {'F', 4, "400006 0333"},
    {'G', 4, "41301001051636454323"},
    {'H', 4, "0006 4046 0343"},
    {'I', 0, "0006"},
    {'J', 3, "3035261605"},
    {'K', 4, "0006 400346"},
    {'L', 4, "000646"},
    {'M', 4, "0600234046"},
    {'N', 4, "06004640"},
    {'O', 4, "103041453616050110"},
    {'P', 4, "06003041423303"},
    {'Q', 4, "103041453616050110 3446"},
    {'R', 4, "06003041423303 2346"},
    {'S', 4, "413010010213334445361605"},
    {'T', 4, "0040 2026"},
    {'U', 4, "000516364540"},
    {'V', 4, "002640"},
    {'W', 6, "0016314660"},
    {'X', 4, "0046 4006"},
    {'Y', 4, "002340 2326"},
    {'Z', 4, "00400646"},
    {'[', 1, "10000616"},
    {'\\', 3, "0036"},
    {']', 1, "00101606"},
    {'^', 2, "021022"},
    {'_', 4, "0747"},
    {'`', 1, "0011"},
    {'a', 4, "12324346 441405163645"},
    {'b', 4, "0006 0312324345361605"},
    {'c', 4, "4332120305163645"},
    {'d', 4, "4046 4332120305163645"},
    {'e', 4, "04444332120305163645"},
    {'f', 3, "30201116 0222"},
    {'g', 4, "4247381807 4332120305163645"},
    {'h', 4, "0006 0312324346"},
    {'i', 0, "0206 0000"},
    {'j', 1, "121708 1010"},
    {'k', 3, "0006 320436"},
    {'l', 1, "000516"},
    {'m', 6, "0206 0312223336 3342526366"},
    {'n', 4, "0206 0312324346"},
    {'o', 4, "123243453616050312"},
    {'p', 4, "0208 0312324345361605"},
    {'q', 4, "4248 4332120305163645"},
    {'r', 3, "0206 031232"},
    {'s', 4, "43321203143445361605"},
    {'t', 3, "10152636 0232"},
    {'u', 4, "0205163645 4246"},
    {'v', 4, "022642"},
    {'w', 6, "0216334662"},
    {'x', 4, "0246 4206"},
    {'y', 4, "0226 421808"},
    {'z', 4, "02420646"},
    {'{', 2, "20100203 0304161626"},
    {'|', 0, "0007"},
    {'}', 2, "00101203 2314160616"},
    {'~', 4, "0413243342"},
};

constexpr const char* kUnknown = "0040460600";
constexpr double kUnit = 0.72 / 6;  // capitals are 0.72 of the size
constexpr int kGap = 2;

void add_glyph(const char* strokes, double left, std::vector<std::vector<PlotXy>>& lines) {
    std::vector<PlotXy> line;
    for (const char* at = strokes; *at != '\0';) {
        if (*at == ' ') {
            lines.push_back(line);
            line.clear();
            ++at;
            continue;
        }
        line.push_back({left + kUnit * (at[0] - '0'), kUnit * (at[1] - '6')});
        at += 2;
    }
    if (!line.empty()) lines.push_back(line);
}

}  // namespace

std::vector<std::vector<PlotXy>> text_strokes(const std::string& text, double& width) {
    std::vector<std::vector<PlotXy>> lines;
    width = 0;
    for (const char c : text) {
        // Further bytes of one character of UTF-8 share its box.
        if ((static_cast<unsigned char>(c) & 0xC0) == 0x80) continue;
        const Glyph* glyph = nullptr;
        for (const Glyph& known : kGlyphs)
            if (known.letter == c) glyph = &known;
        add_glyph(glyph != nullptr ? glyph->strokes : kUnknown, width, lines);
        width += kUnit * ((glyph != nullptr ? glyph->width : 4) + kGap);
    }
    return lines;
}

}  // namespace pileus
