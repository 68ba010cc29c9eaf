// SPDX-License-Identifier: Apache-2.0
// See colours.h.
// in: tables of sRGB codes -> out: linear light by the thresholds that the 8-bit writers use.
// kernels_cpu/display/tone.h
#include "lab/views/colours.h"

#include "kernels_cpu/display/tone.h"

namespace pileus {
namespace {

constexpr int kSteps = 9;
constexpr std::uint8_t kHeatCodes[kSteps][3] = {{0, 0, 4},      {31, 12, 72},   {85, 15, 109},
                                                {136, 34, 106}, {186, 54, 85},  {227, 89, 51},
                                                {249, 140, 10}, {249, 201, 50}, {252, 255, 164}};
constexpr std::uint8_t kSizeCodes[kSteps][3] = {{68, 1, 84},    {71, 44, 122},  {59, 81, 139},
                                                {44, 113, 142}, {33, 144, 141}, {39, 173, 129},
                                                {92, 200, 99},  {170, 220, 50}, {253, 231, 37}};
constexpr std::uint32_t kNames = 12;
constexpr std::uint8_t kNameCodes[kNames][3] = {{78, 121, 167},  {242, 142, 43},  {225, 87, 89},
                                                {118, 183, 178}, {89, 161, 79},   {237, 201, 72},
                                                {176, 122, 161}, {255, 157, 167}, {156, 117, 95},
                                                {186, 176, 172}, {134, 188, 182}, {160, 203, 232}};

Float3 linear_of(const std::uint8_t (&codes)[3]) {
    return {linear_of_code(codes[0]), linear_of_code(codes[1]), linear_of_code(codes[2])};
}

}  // namespace

float linear_of_code(std::uint32_t code) {
    if (code == 0) return 0.0f;
    if (code >= 255) return 1.0f;
    return 0.5f * (kSrgbThresholds[code - 1] + kSrgbThresholds[code]);
}

Float3 map_colour(ColourMap map, float share) {
    const auto& codes = map == ColourMap::kHeat ? kHeatCodes : kSizeCodes;
    const float held = !(share > 0.0f) ? 0.0f : (share > 1.0f ? 1.0f : share);
    const float at = held * float(kSteps - 1);
    const int step = int(at) < kSteps - 2 ? int(at) : kSteps - 2;
    const Float3 low = linear_of(codes[step]), high = linear_of(codes[step + 1]);
    Float3 colour;
    for (std::size_t c = 0; c < 3; ++c)
        colour[c] = low[c] + (high[c] - low[c]) * (at - float(step));
    return colour;
}

Float3 name_colour(std::uint32_t index) {
    // Multiplicative hashing (Knuth) spreads neighbours over the table.
    return linear_of(kNameCodes[(index * 2654435761u >> 16) % kNames]);
}

}  // namespace pileus
