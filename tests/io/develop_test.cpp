// SPDX-License-Identifier: Apache-2.0
// Pictures as a display shows them: automatic exposure, tone curves by name, white balance, glare.
// in: small pictures -> out: pass or fail.
// docs/exposure.md
#include <cmath>
#include <vector>

#include "src/base/fnv1a64.h"
#include "src/io/images/develop/glare.h"
#include "src/io/images/develop/tones.h"
#include "src/io/images/develop/white_balance.h"
#include "tests/io/test_image.h"

using namespace pileus;

namespace {

constexpr Tone kTones[] = {Tone::kStandard, Tone::kHable, Tone::kAgx, Tone::kAgxPunchy,
                           Tone::kLinear};

Image blank(int width, int height, std::initializer_list<const char*> names) {
    Image image;
    image.width = width, image.height = height;
    for (const char* name : names) {
        image.channels.emplace_back();
        image.channels.back().name = name;
        REQUIRE(
            image.channels.back().pixels.resize(std::size_t(width) * std::size_t(height), name));
    }
    return image;
}

/// A thousand greys: `bright` of them are 0.5, the others `dark`.
Image grey_image(float dark, int bright) {
    Image image = blank(1000, 1, {"Y"});
    for (int i = 0; i < 1000; ++i)
        image.channels[0].pixels[std::size_t(i)] = i < bright ? 0.5f : dark;
    return image;
}

/// Colours over six octaves in no order.
Image coloured(int width, int height) {
    Image image = blank(width, height, {"R", "G", "B"});
    std::uint32_t state = 1;
    for (Channel& channel : image.channels)
        for (float& v : channel.pixels.span()) {
            state = state * 1664525u + 1013904223u;
            v = std::ldexp(1.0f + float(state >> 16 & 1023) / 1024, -int(state >> 28 & 5));
        }
    return image;
}

std::vector<int> codes(const Image& image, const ToneSettings& tone) {
    Buffer<std::uint8_t> rgb;
    REQUIRE(tone_map_8bit(image, tone, rgb));
    return {rgb.span().begin(), rgb.span().end()};
}

double stops(const Image& image, const ToneSettings& tone = {true}) {
    double found = 0;
    REQUIRE(measured_stops(image, tone, found));
    return found;
}

int grey_code(Tone tone, float light, float gain) {
    const Rgb<float> c = apply_tone(tone, {light, light, light}, gain);
    CHECK((c.r == c.g && c.g == c.b));
    return int(srgb_code(c.r));
}

}  // namespace

TEST_CASE("exposure: automatic follows the bright parts and minds the middle") {
    // A tenth of the picture is its subject: it is brought near white.
    const std::vector<int> plain = codes(grey_image(0.1f, 100), {true, 0});
    CHECK(plain[0] >= 230);
    CHECK(plain[0] <= 242);
    CHECK(stops(grey_image(0.1f, 100)) ==
          doctest::Approx(std::log2(1.25 / 0.5 / 3.5)).epsilon(0.02));

    // A picture without bright parts is a middle one, not a white one.
    CHECK(codes(grey_image(0.1f, 0), {true, 0})[0] >= 180);
    CHECK(codes(grey_image(0.1f, 0), {true, 0})[0] <= 192);

    // Less than a hundredth may burn out; less than a twentieth where it is far brighter.
    CHECK(codes(grey_image(0.01f, 5), {true, 0}) != plain);
    CHECK(codes(grey_image(0.01f, 5), {true, 0})[2999] >= 180);
    CHECK(codes(grey_image(0.001f, 40), {true, 0})[2999] >= 60);
    CHECK(codes(grey_image(0.001f, 40), {true, 0})[0] == 255);

    // A dark picture with a subject is raised, by two stops at most.
    CHECK(stops(grey_image(0.001f, 60)) ==
          doctest::Approx(std::log2(1.25 / 0.5 / 3.5) + 2).epsilon(0.02));

    // Stops count from what was found.
    CHECK(codes(grey_image(0.1f, 100), {true, -2})[0] < plain[0] - 40);

    // Black, and values that are no brightness, leave the daylight exposure alone.
    for (const float odd : {0.0f, -1.0f, std::numeric_limits<float>::infinity()}) {
        CHECK(codes(grey_image(odd, 0), {true, 0}) == codes(grey_image(odd, 0), {false, 0}));
        CHECK(stops(grey_image(odd, 0)) == 0);
    }
}

TEST_CASE("exposure: black around it, alpha and the order of pixels change nothing") {
    const Image image = coloured(40, 30);
    Image large = blank(80, 60, {"R", "G", "B", "A"}), turned = blank(30, 40, {"R", "G", "B"});
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t y = 0; y < 30; ++y)
            for (std::size_t x = 0; x < 40; ++x) {
                const float v = image.channels[c].pixels[y * 40 + x];
                large.channels[c].pixels[(y + 9) * 80 + x + 7] = v;
                turned.channels[c].pixels[x * 30 + 29 - y] = v;
            }
    CHECK(stops(turned) == stops(image));
    CHECK(stops(large) == stops(image));
    // A faint haze there, eleven stops below, is black, too.
    for (float& v : large.channels[1].pixels.span()) v = v > 0 ? v : 0x1p-10f;
    for (float& v : large.channels[3].pixels.span()) v = 1;
    CHECK(stops(large) == stops(image));
}

TEST_CASE("exposure: a texel like the sun moves it little, in small pictures, too") {
    for (const int side : {5, 9, 20, 64}) {
        Image image = coloured(side, side);
        const double before = stops(image);
        for (std::size_t c = 0; c < 3; ++c) image.channels[c].pixels[5] = 1e5f;
        CAPTURE(side);
        CHECK(std::fabs(stops(image) - before) <= (side < 11 ? 4.1 : 0.05));
    }
}

TEST_CASE("exposure: light twice as strong gives the same picture, under every curve") {
    for (const Tone tone : kTones)
        for (const double glare : {0.0, 0.3}) {
            ToneSettings settings{true, 0.5f, tone, glare > 0 ? 4321.0 : 0.0, glare};
            Image image = coloured(33, 21);
            const std::vector<int> before = codes(image, settings);
            for (const int by : {-40, -1, 7, 60}) {
                Image scaled = coloured(33, 21);
                for (Channel& channel : scaled.channels)
                    for (float& v : channel.pixels.span()) v = std::ldexp(v, by);
                CHECK(codes(scaled, settings) == before);
                CHECK(stops(scaled, settings) ==
                      doctest::Approx(stops(image, settings) - by).epsilon(1e-9));
            }
        }
}

TEST_CASE("tones: greys have the codes of the published formulas, and stay greys") {
    // Codes of greys of this light: standard, hable, agx, agx-punchy, linear.
    const struct {
        float light;
        int code[5];
    } rows[] = {{0.001f, {1, 6, 1, 0, 3}},           {0.01f, {12, 37, 27, 18, 25}},
                {0.05f, {59, 85, 85, 78, 63}},       {0.2f, {149, 149, 149, 149, 124}},
                {0.5f, {206, 197, 189, 193, 188}},   {1.0f, {232, 228, 214, 219, 255}},
                {1.25f, {237, 237, 220, 225, 255}},  {2.0f, {245, 252, 232, 237, 255}},
                {4.0f, {252, 255, 244, 247, 255}},   {8.0f, {255, 255, 251, 255, 255}},
                {1000.0f, {255, 255, 255, 255, 255}}};
    for (const auto& row : rows)
        for (int t = 0; t < 5; ++t) {
            CAPTURE(row.light);
            CAPTURE(t);
            CHECK(grey_code(kTones[t], row.light, 1) == row.code[t]);
        }
    // 18 % grey in sunlight looks alike under all but the linear one.
    const float grey = 0.18f * 0.3183099f;
    for (int t = 1; t < 4; ++t)
        CHECK(std::fabs(apply_tone(kTones[t], {grey, grey, grey}, 3.5f).g -
                        apply_tone(Tone::kStandard, {grey, grey, grey}, 3.5f).g) < 1e-5f);
    Tone found = Tone::kStandard;
    CHECK(find_tone("agx", found));
    CHECK(found == Tone::kAgx);
    CHECK_FALSE(find_tone("AgX", found));
    CHECK_FALSE(find_tone("", found));
    CHECK(tone_names() == "standard, hable, agx, agx-punchy, linear");
}

TEST_CASE("tones: colours of AgX are those of its fit") {
    // Worked out by the published matrices; their rows add up to 1 within 2e-4.
    const Rgb<float> c = apply_tone(Tone::kAgx, {0.8f, 0.2f, 0.05f}, 1);
    CHECK(double(c.r) == doctest::Approx(0.676250).epsilon(2e-3));
    CHECK(double(c.g) == doctest::Approx(0.318541).epsilon(2e-3));
    CHECK(double(c.b) == doctest::Approx(0.140191).epsilon(2e-3));
    // A strong light loses its colour.
    const Rgb<float> strong = apply_tone(Tone::kAgx, {0, 0, 1e4f}, 1);
    CHECK(srgb_code(strong.r) > 180);
    CHECK(srgb_code(strong.b) == 255);
}

TEST_CASE("tones: greys never get darker, tested on neighbouring floats around every step") {
    for (const Tone tone : kTones) {
        CAPTURE(int(tone));
        int steps = 0;
        for (int code = 1; code <= 255; ++code) {
            std::uint32_t low = 0, high = 0x7f800000;
            while (high - low > 1) {
                const std::uint32_t middle = low + (high - low) / 2;
                (grey_code(tone, reinterpret<float>(middle), 3.5f) >= code ? high : low) = middle;
            }
            int before = 0;
            for (std::uint32_t bits = high - 50; bits < high + 50; ++bits) {
                const int now = grey_code(tone, reinterpret<float>(bits), 3.5f);
                if (now < before) FAIL("darker at bits ", bits);
                steps += now > before && bits > high - 50 ? 1 : 0;
                before = now;
            }
        }
        CHECK(steps == 255);
    }
}

TEST_CASE("tones: S72 anything at all stays within 8 bits") {
    const float inf = std::numeric_limits<float>::infinity(), nan = std::nanf("");
    for (const Tone tone : kTones)
        for (const float gain : {3.5f, 1e-30f, 1e30f}) {
            for (const float dark : {0.0f, -0.0f, -1.0f, -inf, nan})
                CHECK(grey_code(tone, dark, gain) == 0);
            CHECK(grey_code(tone, inf, gain) == 255);
            const Rgb<float> mixed = apply_tone(tone, {nan, inf, -inf}, gain);
            CHECK(srgb_code(mixed.g) == 255);
            CHECK(srgb_code(mixed.r) <= 255);
        }
}

TEST_CASE("white balance: known lights have their places, and become white") {
    // CIE 15: D65, D50; illuminant A is a black body of 2856 K.
    const double known[][4] = {
        {6504, 0.3127, 0.3290, 3e-4}, {5003, 0.3457, 0.3585, 3e-4}, {2856, 0.44757, 0.40745, 5e-4}};
    for (const auto& row : known) {
        CHECK(std::fabs(white_place(row[0])[0] - row[1]) < row[3]);
        CHECK(std::fabs(white_place(row[0])[1] - row[2]) < row[3]);
    }
    for (double k = 2000; k < 25000; k *= 1.001) {
        const auto here = white_place(k), next = white_place(k * 1.001);
        CHECK(here[0] > next[0]);
        CHECK(std::fabs(here[1] - next[1]) < 1e-3);
    }
    for (const double k : {2000.0, 3200.0, 4500.0, 6504.0, 25000.0}) {
        // What the matrix makes white is the light, and it is as bright.
        const ColorMatrix m = white_matrix(k);
        const auto place = white_place(k);
        const double y = 1, x = place[0] / place[1], z = (1 - place[0] - place[1]) / place[1];
        const double rgb[3] = {3.2409699 * x - 1.5373832 * y - 0.4986108 * z,
                               -0.9692436 * x + 1.8759675 * y + 0.0415551 * z,
                               0.0556301 * x - 0.2039770 * y + 1.0569715 * z};
        for (const auto& row : m)
            CHECK(row[0] * rgb[0] + row[1] * rgb[1] + row[2] * rgb[2] ==
                  doctest::Approx(1).epsilon(2e-6));
    }
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            CHECK(std::fabs(white_matrix(6504)[i][j] - (i == j)) < 2e-3);
    // Of a grey under daylight a low temperature makes blue.
    const Image grey = grey_image(0.1f, 0);
    const std::vector<int> cold = codes(grey, {false, 0, Tone::kStandard, 3200, 0});
    CHECK(cold[2] > cold[0] + 40);
    const std::vector<int> warm = codes(grey, {false, 0, Tone::kStandard, 12000, 0});
    CHECK(warm[0] > warm[2] + 10);
}

TEST_CASE("glare: even light stays, no light is lost, and it spreads alike") {
    constexpr int kWidth = 37, kHeight = 21;
    std::vector<float> even(kWidth * kHeight, 0.7f);
    REQUIRE(add_glare(kWidth, kHeight, kWidth, 0.5, {even.data(), even.size()}));
    for (const float v : even) CHECK(double(v) == doctest::Approx(0.7).epsilon(1e-6));

    std::vector<float> spike(kWidth * kHeight, 0.0f);
    const std::size_t middle = 10 * kWidth + 18;
    spike[middle] = 1000;
    REQUIRE(add_glare(kWidth, kHeight, kWidth, 0.2, {spike.data(), spike.size()}));
    double sum = 0;
    for (const float v : spike) sum += double(v);
    CHECK(sum == doctest::Approx(1000).epsilon(1e-6));
    CHECK(spike[middle] < 1000);
    CHECK(spike[middle] > 800);
    for (std::size_t d = 1; d < 10; ++d) {
        CHECK(double(spike[middle + d]) ==
              doctest::Approx(double(spike[middle - d])).epsilon(1e-6));
        CHECK(double(spike[middle + d]) ==
              doctest::Approx(double(spike[middle + d * kWidth])).epsilon(0.3));
        CHECK(spike[middle + d] <= spike[middle + d - 1]);
        CHECK(spike[middle + d] > 0);
    }

    // What is no light spreads nothing and stays.
    const float inf = std::numeric_limits<float>::infinity();
    std::vector<float> odd = {1, inf, -1, 1};
    REQUIRE(add_glare(4, 1, 400, 0.5, {odd.data(), odd.size()}));
    CHECK(odd[1] == inf);
    CHECK(odd[2] == -1);
    CHECK(odd[0] > 0.5f);
    CHECK(odd[0] < 1);
    std::vector<float> one = {3};
    REQUIRE(add_glare(1, 1, 1, 1, {one.data(), one.size()}));
    CHECK(one[0] == 3);
}

TEST_CASE("glare: a part of a picture is spread as wide as the whole") {
    Image image = coloured(24, 16);
    const std::vector<int> whole = codes(image, {false, 0, Tone::kStandard, 0, 0.5});
    image.display = {0, 0, 24, 16};
    CHECK(codes(image, {false, 0, Tone::kStandard, 0, 0.5}) == whole);
    image.display = {0, 0, 240, 160};
    CHECK(codes(image, {false, 0, Tone::kStandard, 0, 0.5}) != whole);
}

TEST_CASE("develop: colours of a display stay, whatever is asked for") {
    Image image = coloured(24, 16);
    image.display_colours = true;
    const std::vector<int> plain = codes(image, {});
    CHECK(codes(image, {true, 3, Tone::kAgx, 3000, 0.5}) == plain);
}

TEST_CASE("develop: the same bytes on every machine") {
    Fnv1a64 all;
    for (const Tone tone : kTones)
        for (const ToneSettings& settings :
             {ToneSettings{false, 0.3f, tone, 0, 0}, ToneSettings{true, 0, tone, 3456, 0.2}})
            for (const int code : codes(coloured(61, 47), settings)) all.byte(std::uint8_t(code));
    CHECK(all.value() == 0xa1a50237d3427961ull);
}
